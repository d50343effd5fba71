"""What may go wrong on a broker, each with a real Mosquitto: docs/adr/0048 has the table."""

import signal
import socket
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.fleet.broker import Broker
from servodeck.fleet.console import Console
from servodeck.fleet.outcomes import NoAnswerError, RefusedError
from servodeck.fleet.stopping import stop_robots
from tests.client import Client
from tests.fleet import WAIT_S, Gateway, console_of, eventually, fleet_on
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto
from tests.raw_client import FOR_ARM, TARGETS, driving, move, raw_client
from tests.samples import MOVE as MOVE_PACKET

pytestmark = [pytest.mark.slow, needs_mosquitto]
MOVE, RUN, STOP = 3, 6, 7
NAMES = ("arm-1", "arm-2")


@pytest.fixture(scope="module")
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path_factory.mktemp("broker"), NAMES) as made:
        yield made


@pytest.fixture
def own_mosquitto(tmp_path: Path) -> Iterator[Mosquitto]:
    """For a test that harms it."""
    with Mosquitto(tmp_path / "broker", NAMES) as made:
        yield made


@pytest.fixture
def arm(mosquitto: Mosquitto) -> Iterator[Gateway]:
    with fleet_on(mosquitto, ["arm-1"]) as (_, (gateway,)):
        yield gateway


def test_a_retained_request_is_refused_now_and_not_delivered_later(mosquitto: Mosquitto) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw:
        with fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)):
            nonce = driving(raw)
            raw.say(FOR_ARM + "move", move(3, nonce), is_retained=True)
            assert raw.answer()["code"] == "retained"
            assert arm.count(MOVE) == 0
        with fleet_on(mosquitto, ["arm-1"]) as (_, (again,)):
            raw.say(FOR_ARM + "report", {"v": 1, "n": 4})
            assert raw.answer()["kind"] == "done"
            assert (again.count(MOVE), again.door.status().refused) == (0, {})
        raw.say(FOR_ARM + "move", b"", is_retained=True)  # leaves none behind


def test_a_request_that_comes_twice_is_done_once_and_an_older_one_never(
    mosquitto: Mosquitto, arm: Gateway
) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw:
        nonce = driving(raw)
        raw.say(FOR_ARM + "move", move(5, nonce))
        first = raw.answer()
        assert first["kind"] == "done"
        raw.say(FOR_ARM + "move", move(5, nonce))
        assert raw.answer() == first
        raw.say(FOR_ARM + "move", move(4, nonce))
        assert raw.answer()["code"] == "superseded"
    assert arm.count(MOVE) == 1


def test_a_hold_stops_those_that_come_later_until_it_is_withdrawn(mosquitto: Mosquitto) -> None:
    hold = "sd/1/lab/all/hold/driver/anna"
    with raw_client(mosquitto.broker_for("anna")) as raw:
        raw.say(hold, b"today", is_retained=True)
        with fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)):
            assert eventually(lambda: arm.control.latch)
        raw.say(hold, b"", is_retained=True)
        with fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)):
            raw.say(FOR_ARM + "report", {"v": 1, "n": 1})
            assert raw.answer()["state"]["latch"] is False


def test_of_two_consoles_one_drives(mosquitto: Mosquitto, arm: Gateway) -> None:
    with console_of(mosquitto, "anna", "arm-1") as anna, console_of(mosquitto, "ben", "arm-1") as ben:
        assert anna.ask("arm-1", "ask", action="request").drives
        assert not ben.ask("arm-1", "ask", action="request").drives
        with pytest.raises(RefusedError) as refused:
            ben.ask("arm-1", "move", targets=TARGETS, duration_ms=1500)
        assert refused.value.code == "notDriving"
        anna.ask("arm-1", "ask", action="release")  # passes to the one that waits
        assert ben.until(lambda: ben.drives("arm-1"), WAIT_S)
        assert not anna.drives("arm-1")
    assert arm.count(MOVE) == 0


def test_nothing_waits_for_a_gateway_that_is_away(mosquitto: Mosquitto, arm: Gateway) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw:
        for n in range(20):
            raw.say("sd/1/lab/arm-2/do/driver/anna/move", move(n, "x.1-1"))
        raw.say(FOR_ARM + "report", {"v": 1, "n": 1})
        assert raw.answer()["gateway"] == arm.name  # so the broker has had the moves, too
        with fleet_on(mosquitto, ["arm-2"]) as (_, (late,)), console_of(mosquitto, "vera", "arm-2"):
            assert late.door.status().refused == {}
            assert late.count(MOVE) == 0


def test_what_cannot_be_read_is_refused_and_the_gateway_stays(mosquitto: Mosquitto, arm: Gateway) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw:
        damaged = [b"", b"{", b"[]" * 500, b"\xff" * 64, b'{"v":1,"n":1e999}', b"[" * 2000]
        for payload in damaged:
            raw.say(FOR_ARM + "move", payload)
            assert raw.answer()["code"] == "malformed"
        raw.say(FOR_ARM + "move", b" " * 20_000)
        assert raw.answer()["code"] == "tooLarge"
        assert driving(raw)
    assert arm.door.status().refused == {"malformed": len(damaged), "tooLarge": 1}


def test_the_broker_cuts_what_is_larger_than_anything(mosquitto: Mosquitto, arm: Gateway) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw:
        raw.say(FOR_ARM + "download", b" " * 700_000, qos=0)
        assert eventually(lambda: raw.connections == 2)
    assert arm.door.status().refused == {}


@pytest.mark.parametrize(
    ("user", "topic"),
    [
        ("vera", "sd/1/lab/arm-1/do/driver/vera/ask"),
        ("vera", "sd/1/lab/arm-1/do/driver/anna/ask"),
        ("vera", "sd/1/lab/arm-1/do/owner/vera/stop"),
        ("vera", "sd/1/lab/all/hold/driver/anna"),
        ("arm-2", "sd/1/lab/arm-1/do/owner/arm-2/stop"),
        ("arm-2", "sd/1/lab/arm-1/state"),
    ],
)
def test_no_user_writes_below_another_name_or_role(
    mosquitto: Mosquitto, arm: Gateway, user: str, topic: str
) -> None:
    with raw_client(mosquitto.broker_for(user)) as raw, raw_client(mosquitto.broker_for("anna")) as anna:
        raw.say(topic, b'{"v":1,"n":1}')
        raw.say(topic, b'{"v":1,"n":1}')
        anna.say(FOR_ARM + "report", {"v": 1, "n": 1})
        assert anna.answer()["kind"] == "done"
    assert not arm.control.latch
    assert arm.door.status().refused == {}
    assert not arm.door.status().is_cloned


@pytest.mark.parametrize("password", ["wrong", None])
def test_nobody_gets_in_without_the_password(mosquitto: Mosquitto, password: str | None) -> None:
    broker = replace_password(mosquitto.broker_for("anna"), password)
    with Console(broker, LAB, "driver") as console:
        assert console.until(lambda: "refuses" in (console.problem or ""), WAIT_S)
        with pytest.raises(NoAnswerError):
            console.ask("arm-1", "report")


def replace_password(broker: Broker, password: str | None) -> Broker:
    return Broker(broker.host, broker.port, None, broker.user, password, None)


async def local_move(gateway: Gateway) -> None:
    """As a page of this computer does it."""
    page = Client(gateway.control)
    await page.send(MOVE_PACKET)


def test_a_lost_broker_is_a_lost_driver_and_the_local_page_works_on(own_mosquitto: Mosquitto) -> None:
    with (
        fleet_on(own_mosquitto, ["arm-1"]) as (fleet, (arm,)),
        console_of(own_mosquitto, "anna", "arm-1") as console,
    ):
        console.ask("arm-1", "ask", action="request")
        console.ask("arm-1", "run", slot=3, times=0)
        own_mosquitto.kill()
        assert eventually(lambda: arm.control.latch)
        assert eventually(lambda: arm.count(STOP) >= 3)
        assert arm.control.driving.driver is None
        status = arm.door.status()
        assert (status.is_connected, bool(status.problem)) == (False, True)
        fleet.call(lambda: arm.control.resume(THIS_COMPUTER))
        fleet.do(local_move(arm))
        own_mosquitto.start()
        assert console.until(lambda: console.is_present("arm-1"), WAIT_S)
        assert not arm.control.latch


def test_an_old_word_of_a_dead_gateway_is_not_believed(mosquitto: Mosquitto) -> None:
    with fleet_on(mosquitto, ["arm-2"]), console_of(mosquitto, "vera", "arm-2") as before:
        state = before.robot("arm-2")
        assert state
    with raw_client(mosquitto.broker_for("arm-2")) as dead:
        assert state.state
        dead.say("sd/1/lab/arm-2/online", {"v": 1, "instance": "dead", "isOnline": True}, is_retained=True)
        dead.say("sd/1/lab/arm-2/state", state.state.model_dump_json().encode(), is_retained=True)
        with fleet_on(mosquitto, ["arm-1"]), console_of(mosquitto, "vera", "arm-1") as console:
            found = console.robot("arm-2")
            assert found
            assert found.state
            assert found.presence == "silent"
        dead.say("sd/1/lab/arm-2/state", b"", is_retained=True)


def test_two_gateways_with_one_name_both_say_so_and_neither_moves(mosquitto: Mosquitto) -> None:
    with fleet_on(mosquitto, ["arm-1", "arm-1"]) as (_, pair), console_of(mosquitto, "anna") as console:
        assert eventually(lambda: all(gateway.door.status().is_cloned for gateway in pair))
        assert console.until(lambda: is_cloned(console), WAIT_S)
        with pytest.raises(RefusedError) as refused:
            console.ask("arm-1", "ask", action="request")
        assert refused.value.code == "cloned"
        report = stop_robots(console, ["arm-1"])
        assert eventually(lambda: all(gateway.control.latch for gateway in pair))
        assert (report.stopped, report.missing) == ((), ("arm-1",))  # one may have answered for both


def is_cloned(console: Console) -> bool:
    robot = console.robot("arm-1")
    return robot is not None and robot.presence == "cloned"


def test_a_revoked_user_is_cut_off(own_mosquitto: Mosquitto) -> None:
    with (
        fleet_on(own_mosquitto, ["arm-1"]) as (_, (arm,)),
        console_of(own_mosquitto, "anna", "arm-1") as anna,
    ):
        anna.ask("arm-1", "ask", action="request")
        own_mosquitto.revoke("anna")
        assert anna.until(lambda: anna.problem is not None, WAIT_S)
        with pytest.raises(NoAnswerError):
            anna.ask("arm-1", "move", targets=TARGETS, duration_ms=1500)
        assert arm.count(MOVE) == 0


@pytest.mark.exhaustive
def test_moves_that_a_frozen_broker_held_back_are_refused(own_mosquitto: Mosquitto) -> None:
    with (
        fleet_on(own_mosquitto, ["arm-1"]) as (_, (arm,)),
        raw_client(own_mosquitto.broker_for("anna")) as raw,
    ):
        nonce = driving(raw)
        begun_s = time.monotonic()
        own_mosquitto.signal(signal.SIGSTOP)
        for n in range(60):
            raw.say(FOR_ARM + "move", move(10 + n, nonce))
        assert eventually(lambda: time.monotonic() - begun_s > 0.6)
        own_mosquitto.signal(signal.SIGCONT)
        codes = [raw.answer()["code"] for _ in range(60)]
        assert set(codes) <= {"expired", "notDriving"}
        assert arm.count(MOVE) == 0


@pytest.mark.exhaustive
def test_a_flood_moves_nothing_and_stop_passes(mosquitto: Mosquitto, arm: Gateway) -> None:
    with raw_client(mosquitto.broker_for("anna")) as raw, console_of(mosquitto, "ben", "arm-1") as ben:
        for n in range(10_000):
            raw.say(FOR_ARM + "move", move(n, "x.1-1"), qos=0)
        stopped = ben.stop("arm-1")
        for n in range(10_000):
            raw.say(FOR_ARM + "move", move(n, "x.1-1"), qos=0)
        stopped.result(WAIT_S)
        assert arm.control.latch
        assert eventually(lambda: arm.door.status().refused.get("tooMany", 0) > 10_000)
        assert arm.count(MOVE) == 0


@pytest.mark.exhaustive
def test_a_gateway_that_does_not_hear_itself_says_so_and_is_not_driven(own_mosquitto: Mosquitto) -> None:
    acl = own_mosquitto.folder / "acl"
    acl.write_text(acl.read_text().replace("topic read sd/1/lab/arm-1/state\n", ""))
    own_mosquitto.kill()
    own_mosquitto.start()
    with fleet_on(own_mosquitto, []) as (fleet, _):
        arm = fleet.add("arm-1", own_mosquitto.broker_for("arm-1"))
        with console_of(own_mosquitto, "anna", "arm-1") as anna:
            anna.ask("arm-1", "ask", action="request")
            assert eventually(lambda: arm.control.driving.driver is None)
            assert "bring back" in (arm.door.status().problem or "")


@pytest.mark.exhaustive
def test_a_run_ends_where_the_broker_freezes(own_mosquitto: Mosquitto) -> None:
    with (
        fleet_on(own_mosquitto, ["arm-1"]) as (_, (arm,)),
        console_of(own_mosquitto, "anna", "arm-1") as anna,
    ):
        anna.ask("arm-1", "ask", action="request")
        anna.ask("arm-1", "run", slot=3, times=0)
        own_mosquitto.signal(signal.SIGSTOP)
        try:
            assert eventually(beating(anna, lambda: arm.control.latch))
            assert eventually(lambda: arm.control.driving.driver is None)
        finally:
            own_mosquitto.signal(signal.SIGCONT)


def beating(console: Console, is_so: Callable[[], bool]) -> Callable[[], bool]:
    def look() -> bool:
        console.beat()
        return is_so()

    return look


@pytest.mark.exhaustive
def test_eight_come_back_after_the_broker_was_killed(tmp_path: Path) -> None:
    names = [f"arm-{number}" for number in range(8)]
    with (
        Mosquitto(tmp_path / "broker", names) as mosquitto,
        fleet_on(mosquitto, names),
        console_of(mosquitto, "anna", *names) as anna,
    ):
        assert anna.stop_all().stopped == tuple(names)
        mosquitto.kill()
        assert anna.until(lambda: all(robot.presence == "silent" for robot in anna.robots()), WAIT_S)
        mosquitto.start()
        assert anna.until(lambda: all(map(anna.is_present, names)), WAIT_S)
        assert all(robot.state and robot.state.latch for robot in anna.robots())


@pytest.mark.exhaustive
def test_a_client_that_never_reads_holds_up_nobody(own_mosquitto: Mosquitto) -> None:
    with (
        socket.create_connection(("127.0.0.1", own_mosquitto.port)) as deaf,
        fleet_on(own_mosquitto, ["arm-1"]) as (_, (arm,)),
        raw_client(own_mosquitto.broker_for("anna")) as raw,
        console_of(own_mosquitto, "ben", "arm-1") as ben,
    ):
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        secret = (own_mosquitto.folder / "secrets" / "vera").read_text().strip()
        deaf.sendall(connect_packet("vera", secret) + SUBSCRIBE_ALL)
        for number in range(20):  # more than the buffers of both ends
            raw.say("sd/1/lab/all/hold/driver/anna", bytes((number,)) * 500_000, is_retained=True)
        assert eventually(lambda: arm.control.latch)
        assert eventually(lambda: is_resumed(ben))
        assert ben.ask("arm-1", "ask", action="request").drives


def is_resumed(console: Console) -> bool:
    """Not while more holds come."""
    try:
        return console.ask("arm-1", "resume").kind == "done"
    except RefusedError:
        return False


# By hand, as no library subscribes and then does not read: MQTT 5, keep-alive 60 s, all topics with QoS 0.
SUBSCRIBE_ALL = bytes((0x82, 7, 0, 1, 0, 0, 1)) + b"#" + bytes((0,))


def connect_packet(user: str, password: str) -> bytes:
    body = b"\0\4MQTT\5\xc2\0\x3c\0" + b"".join(
        len(text).to_bytes(2, "big") + text.encode() for text in ("deaf", user, password)
    )
    return bytes((0x10, len(body))) + body
