"""`servodeck.Robot` as a program uses it: against a real gateway, whose port the test sees."""

import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, nullcontext, suppress
from importlib.resources import files
from pathlib import Path

import pytest

from servodeck import Robot
from servodeck.access import addresses
from servodeck.callers import Caller
from servodeck.client import TimedOutError, UnreachableError
from servodeck.errors import (
    ClosedError,
    ForbiddenError,
    LatchedError,
    MalformedError,
    NotDrivingError,
    NotFoundError,
    NotPairedError,
    OutOfRangeError,
    TooManyError,
)
from tests.client import ANNA, Client
from tests.fake_port import FakePort, FakePorts
from tests.samples import STOP
from tests.scripted import RUN_ENDED, RUN_TAKEN, move
from tests.served_robot import Served, served

pytestmark = pytest.mark.slow

LIGHT = """
import sys
from servodeck import AsyncRobot, Robot
from servodeck.errors import LatchedError
Robot("http://127.0.0.1:1")
heavy = {"fastapi", "starlette", "uvicorn", "pydantic", "serial", "typer"} & set(sys.modules)
assert not heavy, heavy
"""
RUN_COMMAND = 6
# Time-outs here are 0.5 s; a quiet computer takes 0.6.
BUSY_S = 0.9


class BoardPort(FakePort):
    """Acknowledges a run, and reports its end once `ends_in_s` have passed."""

    ends_in_s: float | None = None

    def write(self, data: bytes) -> None:
        super().write(data)
        if data[3] == RUN_COMMAND:
            self.say(RUN_TAKEN)
            if self.ends_in_s is not None:
                threading.Timer(self.ends_in_s, self.say, (RUN_ENDED,)).start()


@pytest.fixture
def port() -> BoardPort:
    return BoardPort()


@pytest.fixture
def here(tmp_path: Path, port: BoardPort) -> Iterator[Served]:
    with served(tmp_path, FakePorts(port)) as made:
        yield made


def sent(port: FakePort) -> list[bytes]:
    """Behind the stop at the opening."""
    return port.packets()[1:]


def has(condition: Callable[[], bool]) -> None:
    """Waits until it holds."""
    until_s = time.monotonic() + 5
    while not condition():
        assert time.monotonic() < until_s
        threading.Event().wait(0.01)


def test_it_is_loaded_without_the_gateway() -> None:
    subprocess.run([sys.executable, "-W", "error", "-c", LIGHT], check=True, timeout=30)


def test_type_checkers_find_its_types() -> None:
    assert (files("servodeck") / "py.typed").is_file()


def test_servos_are_moved_by_name_in_degrees_from_home(here: Served, port: BoardPort) -> None:
    with Robot(here.url) as robot:
        assert [servo.name for servo in robot.servos()] == ["Base", "Elbow", "Gripper"]
        begun_s = time.monotonic()
        robot.move({"Base": 30, "elbow": 10}, units="deg")
        assert time.monotonic() - begun_s >= 1.5
        robot.move({"Base": 1500, "2": 1520}, units="board", seconds=0.04)  # they have arrived
    moves = [packet for packet in sent(port) if packet != STOP]
    assert moves == [move(1500, s1=1800), move(1500, s2=1420), move(40, s1=1500, s2=1520)]


def test_poses_are_applied_by_name_and_home_is_number_0(here: Served, port: BoardPort) -> None:
    with Robot(here.url) as robot:
        assert robot.poses() == {0: "home", 1: "Greeting"}
        robot.pose("home", wait=False)
        assert sent(port) == [move(1500, s1=1500), move(1500, s2=1520), move(1500, s3=1500)]


def test_errors_have_the_codes_and_sentences_of_the_gateway(here: Served, port: BoardPort) -> None:
    with Robot(here.url) as robot:
        with pytest.raises(OutOfRangeError, match=r"Base \(servo 1\): position is 2450, allowed 600..2400"):
            robot.move({"Base": 95}, units="deg")
        with pytest.raises(OutOfRangeError, match=r"timeMs is 100, allowed 1500"):
            robot.move({"Base": 0}, units="deg", seconds=0.1)
        with pytest.raises(NotFoundError, match=r"No servo is called Wrist.*Base, Elbow, Gripper"):
            robot.move({"Wrist": 0}, units="deg")
        with pytest.raises(NotFoundError, match="No pose is called Bow"):
            robot.pose("Bow")
        with pytest.raises(NotFoundError, match="No slot is known to hold Wave"):
            robot.run("Wave")
        with pytest.raises(MalformedError):
            robot.move({"Base": 1500.5}, units="board")
        robot.stop()
        with pytest.raises(LatchedError) as refused:
            robot.pose("home")
        assert refused.value.code == "latched"
        robot.resume()
        anna = here.at_gateway(drives(here))
        with pytest.raises(NotDrivingError, match="Anna drives"):
            robot.pose("home")
    assert anna.control.driving.driver is anna
    assert not [packet for packet in sent(port) if packet != STOP]


async def drives(here: Served) -> Client:
    anna = Client(here.running.control, ANNA)
    here.running.control.driving.act(anna, "request")
    return anna


def test_an_owner_may_take_the_lease(here: Served, port: BoardPort) -> None:
    here.at_gateway(drives(here))
    with Robot(here.url, take=True) as robot:
        robot.move({1: 2000}, units="board", wait=False)
        assert robot.snapshot().driver == "A script on this computer"
    assert move(1500, s1=2000) in sent(port)


@pytest.mark.parametrize("error", [None, RuntimeError, KeyboardInterrupt])
def test_what_it_began_is_stopped_at_the_end_and_the_lease_released(
    here: Served, port: BoardPort, error: type[BaseException] | None
) -> None:
    control = here.running.control

    def program() -> None:
        with Robot(here.url) as robot:
            robot.move({1: 2000}, units="board", seconds=20, wait=False)
            if error:
                raise error

    with pytest.raises(error) if error else nullcontext():
        program()
    has(lambda: sent(port).count(STOP) >= 3)
    assert (control.driving.driver, control.latch) == (None, False)


def test_the_motion_of_others_is_not_stopped(here: Served, port: BoardPort) -> None:
    here.at_gateway(drives(here))
    with Robot(here.url) as robot:
        with pytest.raises(NotDrivingError):
            robot.move({1: 2000}, units="board")
        assert robot.snapshot().driver == "Anna"
    assert sent(port) == []


def test_a_run_is_waited_for_until_the_board_reports_its_end(here: Served, port: BoardPort) -> None:
    port.ends_in_s = 0.7
    with Robot(here.url) as robot:
        assert robot.run(8, times=2) == "acknowledged"
    assert sent(port)[0] == bytes.fromhex("55550506080200")


def test_a_run_that_does_not_end_in_time_is_stopped(here: Served, port: BoardPort) -> None:
    with Robot(here.url) as robot:
        with pytest.raises(TimedOutError):
            robot.run(8, timeout=0.3)
        has(lambda: STOP in sent(port))
        with pytest.raises(ValueError, match="repeats until stopped"):
            robot.run(8, times=0)


@pytest.mark.exhaustive
def test_a_run_that_is_not_waited_for_continues_until_the_end_of_the_program(
    here: Served, port: BoardPort
) -> None:
    with Robot(here.url) as robot:
        robot.run(8, times=0, wait=False)
        threading.Event().wait(2.6)  # longer than without a heartbeat
        assert robot.snapshot().raw["motion"]["runSlot"] == 8
        assert STOP not in sent(port)
    has(lambda: STOP in sent(port))


def test_a_wait_ends_with_the_stop_of_a_person(here: Served) -> None:
    with Robot(here.url) as robot:
        stopping = threading.Timer(0.2, here.at_gateway, (stopped(here),))
        stopping.start()
        with pytest.raises(LatchedError):
            robot.move({1: 2000}, units="board", seconds=8)
        stopping.join()


async def stopped(here: Served) -> None:
    await here.running.control.stop()


def test_frames_are_played_in_degrees(here: Served, port: BoardPort) -> None:
    with Robot(here.url) as robot:
        robot.play([(1.5, {"Base": 10}), (0.2, {"Base": 0})], units="deg")
    moves = [packet for packet in sent(port) if packet != STOP]
    assert moves == [move(1500, s1=1600), move(200, s1=1500)]


def test_a_token_lets_a_program_in_and_its_role_limits_it(
    tmp_path: Path, port: BoardPort, monkeypatch: pytest.MonkeyPatch
) -> None:
    with served(tmp_path, FakePorts(port), make_access=lambda number: addresses.lan(number, "Robot")) as lan:
        devices = lan.running.entrance.devices
        _, driver = devices.admit("token", "Dance", "driver")
        _, viewer = devices.admit("token", "Wall", "viewer")
        unknown = Robot(lan.url)
        with pytest.raises(NotPairedError):
            unknown.status()
        with pytest.raises(NotPairedError):
            next(unknown.events())
        with Robot(lan.url, token=viewer) as robot:
            assert robot.snapshot().board == "doc"
            with pytest.raises(ForbiddenError, match="Wall has the role viewer"):
                robot.pose("home")
        monkeypatch.setenv("SERVODECK_URL", lan.url)
        monkeypatch.setenv("SERVODECK_TOKEN", driver)
        with Robot() as robot:
            robot.pose("home", wait=False)
            assert robot.snapshot().driver == "Dance"


def test_a_program_that_sends_too_many_requests_is_still_stopped_at_its_end(
    tmp_path: Path, port: BoardPort
) -> None:
    with served(tmp_path, FakePorts(port), make_access=lambda number: addresses.lan(number, "Robot")) as lan:
        device, token = lan.running.entrance.devices.admit("token", "Dance", "driver")
        with Robot(lan.url, token=token) as robot:
            robot.move({1: 2000}, units="board", seconds=20, wait=False)
            lan.at_gateway(exhausted(lan, device.caller))
        has(lambda: sent(port).count(STOP) >= 3)
        assert lan.running.control.driving.driver is None


async def exhausted(here: Served, caller: Caller) -> None:
    """It has used up its rate."""
    with suppress(TooManyError):
        while True:
            here.running.entrance.count(caller)


class LosingProxy:
    """Between a program and its gateway: drops so many answers after they were given."""

    def __init__(self, host: str, losses: int) -> None:
        name, _, number = host.rpartition(":")
        self._gateway = (name, int(number))
        self.losses = losses
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._host = host
        self.url = f"http://127.0.0.1:{self._listener.getsockname()[1]}"
        self._begin()

    def _begin(self) -> None:
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self) -> None:
        while True:
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return
            self.losses -= 1
            threading.Thread(target=self._relay, args=(connection, self.losses >= 0), daemon=True).start()

    def _relay(self, connection: socket.socket, is_lost: bool) -> None:
        """Until one of both hangs up."""
        own, host = self.url.removeprefix("http://").encode(), self._host.encode()
        with suppress(OSError), connection, socket.create_connection(self._gateway) as gateway:
            threading.Thread(target=copy, args=(connection, gateway, own, host), daemon=True).start()
            if is_lost:
                gateway.recv(65536)
            else:
                copy(gateway, connection, b"", b"")
            connection.shutdown(socket.SHUT_RDWR)  # a close alone would wait for the other thread

    def close(self) -> None:
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)  # a close alone would wait for the other thread
        self._listener.close()

    def pause(self, for_s: float) -> None:
        """Nothing listens there for so long."""
        place = self._listener.getsockname()
        self.close()

        def reopen() -> None:
            self._listener = socket.create_server(place)
            self._begin()

        threading.Timer(for_s, reopen).start()


def copy(source: socket.socket, to: socket.socket, name: bytes, host: bytes) -> None:
    with suppress(OSError):
        while part := source.recv(65536):
            to.sendall(part.replace(name, host) if name else part)


def test_a_lost_answer_is_requested_again_and_nothing_moves_twice(here: Served, port: BoardPort) -> None:
    port.ends_in_s = 0.2
    with closing(LosingProxy(here.running.host, 2)) as proxy:
        robot = Robot(proxy.url)
        robot.run(8, wait=False, alone=60)
        assert [packet[3] for packet in sent(port)].count(RUN_COMMAND) == 1
        proxy.losses = 1
        with pytest.raises(UnreachableError):
            robot.resume()  # a stop may have come between
        robot.close()


def test_a_gateway_that_was_there_is_waited_for(here: Served) -> None:
    with closing(LosingProxy(here.running.host, 0)) as proxy, Robot(proxy.url) as robot:
        robot.status()
        proxy.pause(0.4)
        assert robot.status()["board"] == "doc"


def test_events_come_first_with_the_whole_state_and_again_after_a_lost_stream(here: Served) -> None:
    with Robot(here.url) as robot:
        events = robot.events(seconds=20)
        first = next(events)
        assert (first.type, first.data["board"]) == ("welcome", "doc")
        here.at_gateway(disconnected(here))
        until = [next(events).type]
        while until[-1] != "welcome":
            until.append(next(events).type)
        assert "gap" in until
        assert next(event.type for event in robot.events(seconds=0.2)) == "welcome"


async def disconnected(here: Served) -> None:
    for session in list(here.running.control.hub.sessions):
        session.end(1000, "The test ends it.")


def test_without_a_gateway_it_says_so_at_once() -> None:
    with pytest.raises(UnreachableError, match="No gateway answers"):
        Robot("http://127.0.0.1:1").status()
    with pytest.raises(ValueError, match="no address"):
        Robot("http://")
    with pytest.raises(ValueError, match="family of its board"):
        Robot("/dev/ttyUSB0")


def test_a_server_that_is_no_gateway_is_named(here: Served) -> None:
    with closing(socket.create_server(("127.0.0.1", 0))) as other:
        url = f"http://127.0.0.1:{other.getsockname()[1]}"

        def answer() -> None:
            connection, _ = other.accept()
            with connection:
                connection.recv(4096)
                connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\nhello")

        threading.Thread(target=answer, daemon=True).start()
        with pytest.raises(UnreachableError, match="not a Servodeck gateway"):
            Robot(url).status()


def test_a_gateway_that_does_not_answer_ends_in_the_time_out(here: Served) -> None:
    with closing(socket.create_server(("127.0.0.1", 0))) as silent:
        url = f"http://127.0.0.1:{silent.getsockname()[1]}"
        begun_s = time.monotonic()
        with pytest.raises(UnreachableError):
            Robot(url, timeout=0.3).status()
        assert time.monotonic() - begun_s < BUSY_S


def test_a_gateway_that_vanishes_is_noticed_within_the_time_out_whatever_was_asked(here: Served) -> None:
    """One that was reached and then takes requests without answering; a move may take half a minute."""
    with closing(socket.create_server(("127.0.0.1", 0))) as silent:
        robot = Robot(f"http://127.0.0.1:{silent.getsockname()[1]}", timeout=0.5)
        for ask in (
            lambda: robot.move({1: 1500}, units="board"),
            lambda: robot.pose("home"),
            lambda: robot.run(8),
            lambda: robot.play([(0.5, {1: 1500})], units="board"),
            lambda: robot.download(8, [(0.5, {1: 1500})], units="board"),
            robot.battery,
            robot.snapshot,
            robot.stop,
            robot.resume,
        ):
            begun_s = time.monotonic()
            with pytest.raises(UnreachableError):
                ask()
            assert time.monotonic() - begun_s < BUSY_S
        with pytest.raises(UnreachableError):
            robot.close()


def test_a_time_out_ends_the_motion_on_time(here: Served, port: BoardPort) -> None:
    frames = [(1.5, {1: 1800}), (2.0, {1: 1200})]
    with Robot(here.url) as robot:
        for begin in (
            lambda: robot.move({1: 1800}, units="board", seconds=5, timeout=0.5),
            lambda: robot.pose("home", seconds=5, timeout=0.5),
            lambda: robot.play(frames, units="board", timeout=0.5),
            lambda: robot.run(8, timeout=0.5),
        ):
            begun_s, before = time.monotonic(), len(sent(port))
            with pytest.raises(TimedOutError):
                begin()
            assert 0.5 <= time.monotonic() - begun_s < BUSY_S
            has(lambda: sent(port)[before:].count(STOP) >= 3)  # noqa: B023


def test_a_closed_robot_refuses_every_method(here: Served, port: BoardPort) -> None:
    robot = Robot(here.url)
    robot.close()
    robot.close()
    for ask in (
        lambda: robot.move({1: 1500}, units="board"),
        lambda: robot.pose("home"),
        lambda: robot.run(8),
        lambda: robot.play([(0.5, {1: 1500})], units="board"),
        lambda: robot.download(8, [(0.5, {1: 1500})], units="board"),
        robot.erase,
        robot.stop,
        robot.resume,
        robot.request_lease,
        robot.release,
        robot.snapshot,
        robot.status,
        robot.battery,
        robot.poses,
        robot.servos,
        lambda: next(robot.events()),
    ):
        with pytest.raises(ClosedError, match="was closed"):
            ask()
    assert sent(port) == []


def test_unknown_units_and_a_servo_that_is_named_twice_are_refused(here: Served, port: BoardPort) -> None:
    twice: dict[str | int, float] = {"Base": 10, 1: -10}
    with Robot(here.url) as robot:
        for units in ("degrees", "rad", "Deg", "", None):
            with pytest.raises(OutOfRangeError, match=f"units is {units}, allowed: deg, board"):
                robot.move({1: 30}, units=units)  # type: ignore[arg-type]
            with pytest.raises(OutOfRangeError, match=f"units is {units}, allowed: deg, board"):
                robot.play([(1.5, {1: 30})], units=units)  # type: ignore[arg-type]
            with pytest.raises(OutOfRangeError, match=f"units is {units}, allowed: deg, board"):
                robot.download(5, [(1.5, {1: 30})], units=units)  # type: ignore[arg-type]
        with pytest.raises(OutOfRangeError, match="Servo 1 is named twice, the second time as 1"):
            robot.move(twice, units="deg")
        with pytest.raises(OutOfRangeError, match="Servo 1 is named twice, the second time as base"):
            robot.play([(1.5, {"1": 1500, "base": 1600})], units="board")
    assert sent(port) == []
