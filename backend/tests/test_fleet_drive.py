"""Driving one robot of a fleet by a page's socket: in virtual time on a console of the test, and once over a
real Mosquitto.
"""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import asynccontextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any, cast

import pytest

from servodeck.access.guard import Guard
from servodeck.api.app import create_app
from servodeck.events import PROTOCOL
from servodeck.fleet.broker import parse_broker
from servodeck.fleet.console import Console
from servodeck.fleet.drive import DriveSession
from servodeck.fleet.drive_messages import (
    AnyDriveNews,
    DriveBeat,
    DriveLease,
    DriveMove,
    DriveRefused,
    DriveRelease,
    DriveRequest,
    drive_wish,
)
from servodeck.fleet.driving import TASK, FleetDriver
from servodeck.fleet.heard import Robot
from servodeck.fleet.messages import Done, Live, State
from servodeck.fleet.outcomes import RefusedError
from servodeck.fleet.service import FleetService
from servodeck.intents import Target
from servodeck.library.library import wall_clock_ms
from servodeck.robot.control import Control
from servodeck.robot.lease import GONE_S
from servodeck.snapshots import LinkState, MotionState
from tests.fake_port import FakePorts
from tests.fleet import Gateway, eventually, fleet_on
from tests.knocking import scope_of
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto
from tests.running import NO_LIBRARY, PORT, entrance_to
from tests.test_gate import headers_of
from tests.virtual_time import in_virtual_time, now

ARM = "arm-1"
MOVE, STOP = 3, 7
WITHIN_S = 20.0
NO_MOTION = MotionState(servos=[], run_slot=None, released=[], reported=[])


def state_of(driver: str | None = None, epoch: int = 1) -> State:
    return State.model_construct(
        epoch=epoch,
        nonce=f"state-{epoch}",
        latch=False,
        driver=driver,
        running=None,
        link=LinkState(status="ready"),
    )


def live_of(nonce: str, epoch: int = 1) -> Live:
    return Live(instance="i", epoch=epoch, nonce=nonce, latch=False, driver="anna", motion=NO_MOTION)


class FakeConsole:
    """Answers as `answers` says; notes what was asked, with its time."""

    def __init__(self) -> None:
        self.state: State = state_of()
        self.live: Live | None = None
        self.stops = 0
        self.has_lease = False
        self.grants = True
        self.refuses: RefusedError | None = None
        self.asked: list[tuple[float, str, dict[str, Any]]] = []
        self.beats: list[tuple[float, str]] = []

    def robot(self, name: str) -> Robot:
        return Robot(name, "present", None, self.state, self.live, self.stops)

    def drives(self, _: str) -> bool:
        return self.has_lease

    def withdraw_holds(self) -> None:
        """Not of interest."""

    def beat(self, gateways: Sequence[str]) -> None:
        """Of the tasks."""
        self.beats += [(round(now(), 3), gateway) for gateway in gateways]

    def beat_for(self, _: str, nonce: str) -> None:
        self.beats.append((round(now(), 3), nonce))

    def request(self, gateway: str, verb: str, **fields: Any) -> "Future[Done]":
        self.asked.append((round(now(), 3), verb, fields))
        answered: Future[Done] = Future()
        if verb == "ask":
            self.has_lease = fields["action"] == "request" and self.grants
        if self.refuses and verb in ("move", "run"):
            answered.set_exception(self.refuses)
        else:
            done = Done(gateway=gateway, n=1, nonce="new", epoch=1, drives=self.has_lease)
            answered.set_result(done)
        return answered

    def verbs(self) -> list[str]:
        return [verb for _, verb, _ in self.asked]

    def moves(self) -> list[tuple[float, dict[int, int]]]:
        return [
            (at_s, {target.servo: target.position for target in fields["targets"]})
            for at_s, verb, fields in self.asked
            if verb == "move"
        ]


class Page:
    """One session, and what it has said."""

    def __init__(self, console: FakeConsole, driver: FleetDriver, name: str = "Ben") -> None:
        self.session = DriveSession(ARM, name, cast("Console", console), driver, now)
        self.news: list[AnyDriveNews] = []
        self.running = asyncio.create_task(self.session.run())
        self._reading = asyncio.create_task(self._read())

    async def _read(self) -> None:
        while True:
            self.news.append(await self.session.next())

    def move(self, position: int, servo: int = 1, nonce: str = "n") -> None:
        targets = [Target(servo=servo, position=position)]
        self.session.take(DriveMove(type="move", targets=targets, duration_ms=100, nonce=nonce))

    def beat(self, nonce: str | None = "n") -> None:
        self.session.take(DriveBeat(type="beat", nonce=nonce))

    def leases(self) -> list[tuple[str, str | None]]:
        return [(one.lease, one.driver) for one in self.news if isinstance(one, DriveLease)]

    def refusals(self) -> list[str]:
        return [one.detail for one in self.news if isinstance(one, DriveRefused)]

    async def end(self) -> None:
        self.running.cancel()
        self._reading.cancel()
        await asyncio.gather(self.running, self._reading, return_exceptions=True)


@asynccontextmanager
async def driving(name: str = "Ben") -> AsyncIterator[tuple[FakeConsole, FleetDriver, Page]]:
    """A page that has the lease."""
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    page = Page(console, driver, name)
    await asyncio.sleep(0.1)
    assert page.leases()[-1] == ("driving", name)
    yield console, driver, page
    await page.end()


@in_virtual_time
async def test_of_many_moves_the_newest_leaves_at_most_twenty_times_a_second() -> None:
    async with driving() as (console, _, page):
        for position in range(1000, 1100):
            page.move(position)
            await asyncio.sleep(0.005)
        await asyncio.sleep(0.1)
    times = [at_s for at_s, _ in console.moves()]
    assert len(times) <= 11
    assert all(later - earlier >= 0.049 for earlier, later in pairwise(times))
    assert console.moves()[-1][1] == {1: 1099}


@in_virtual_time
async def test_moves_of_two_servos_leave_together_and_no_value_is_lost() -> None:
    async with driving() as (console, _, page):
        page.move(1000)
        await asyncio.sleep(0.01)
        page.move(1100, servo=1)
        page.move(1200, servo=2)
        page.move(1300, servo=2)
        await asyncio.sleep(0.2)
    assert [targets for _, targets in console.moves()] == [{1: 1000}, {1: 1100, 2: 1300}]


@in_virtual_time
async def test_a_move_has_the_nonce_that_the_page_has_got_and_is_not_sent_again() -> None:
    async with driving() as (console, _, page):
        console.refuses = RefusedError(ARM, "expired", "This request is too old.")
        page.move(1000, nonce="old")
        await asyncio.sleep(1)
    [(_, fields)] = [(verb, fields) for _, verb, fields in console.asked if verb == "move"]
    assert fields["nonce"] == "old"
    assert page.refusals() == ["This request is too old."]


@in_virtual_time
async def test_only_the_beats_of_the_page_are_passed_on() -> None:
    async with driving() as (console, driver, page):
        driver.start()
        console.live = live_of("live-1")
        for _ in range(4):
            page.beat("live-1")
            await asyncio.sleep(0.25)
        heard = len(console.beats)
        await asyncio.sleep(3)  # the page is frozen; the driver of tasks beats for others alone
        assert len(console.beats) == heard == 4
        await driver.end()


@in_virtual_time
async def test_a_page_that_is_not_heard_for_ten_seconds_drives_no_more() -> None:
    async with driving() as (_, driver, page):
        page.beat()
        await asyncio.sleep(GONE_S - 0.1)
        assert not page.running.done()
        await asyncio.sleep(0.3)
        assert page.running.done()
        assert driver.claim(ARM, SomebodyElse()) is None


@in_virtual_time
async def test_the_lease_is_given_back_at_the_end() -> None:
    async with driving() as (console, _, page):
        page.session.take(DriveRelease(type="release"))
        await asyncio.sleep(0.1)
        assert page.running.done()
        page.beat()
        page.move(1500)
        await asyncio.sleep(0.2)
    assert [fields["action"] for _, verb, fields in console.asked if verb == "ask"] == ["request", "release"]
    assert console.moves() == []
    assert console.beats == []


@in_virtual_time
async def test_a_second_page_waits_until_the_first_has_ended() -> None:
    async with driving("Ben") as (console, driver, ben):
        carla = Page(console, driver, "Carla")
        await asyncio.sleep(1)
        carla.move(1500)
        carla.beat()
        await asyncio.sleep(1)
        assert carla.leases() == [("requested", "Ben")]
        assert carla.refusals() == ["This page does not drive the robot."]
        assert (console.beats, console.moves()) == ([], [])
        ben.session.take(DriveRelease(type="release"))
        await asyncio.sleep(0.2)
        assert carla.leases()[-1] == ("driving", "Carla")
        await carla.end()


@in_virtual_time
async def test_who_keeps_the_lease_is_named_and_it_can_be_asked_for_again() -> None:
    console = FakeConsole()
    console.grants, console.state = False, state_of("Dora")
    page = Page(console, FleetDriver(cast("Console", console), lambda: True))
    for _ in range(8):
        page.beat()
        await asyncio.sleep(1)
    assert page.leases() == [("requested", "Dora"), ("none", "Dora")]
    assert page.refusals() == ["Dora drives it."]
    console.grants = True
    page.session.take(DriveRequest(type="request"))
    await asyncio.sleep(0.2)
    assert page.leases()[-1] == ("driving", "Ben")
    await page.end()


@in_virtual_time
async def test_a_lease_that_has_passed_to_somebody_else_is_not_asked_for_by_itself() -> None:
    async with driving() as (console, _, page):
        console.has_lease, console.state = False, state_of("Dora", epoch=2)
        await asyncio.sleep(1)
        assert page.leases()[-1] == ("none", "Dora")
        page.beat("old")
    assert console.verbs().count("ask") == 1
    assert console.beats == []


@in_virtual_time
async def test_a_task_and_a_person_do_not_take_the_robot_from_each_other() -> None:
    async with driving() as (console, driver, _):
        with pytest.raises(RefusedError, match="Ben drives it"):
            await driver.run(ARM, 3, 1)
        assert "run" not in console.verbs()
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.run(ARM, 3, 1))
    await asyncio.sleep(0.1)
    page = Page(console, driver)
    await asyncio.sleep(0.1)
    assert page.leases() == [("requested", TASK)]
    task.cancel()
    await page.end()


@in_virtual_time
async def test_a_report_of_a_lease_that_has_passed_is_not_shown() -> None:
    async with driving() as (console, _, page):
        console.live, console.state = live_of("old", epoch=1), state_of("anna", epoch=2)
        await asyncio.sleep(0.2)
        console.live = live_of("new", epoch=2)
        await asyncio.sleep(0.2)
    nonces = [one.nonce for one in page.news if one.type == "live"]
    assert nonces == ["state-1", "state-2", "new"]


class SomebodyElse:
    name = "Somebody else"


class Socket:
    """The page's socket, as the server hands it to the application."""

    def __init__(self, app: Guard, robot: str, extra: str = f"protocol={PROTOCOL}") -> None:
        host = f"localhost:{PORT}"
        scope = scope_of(
            "websocket", "GET", f"/api/fleet/robots/{robot}/drive", headers_of(host, f"http://{host}")
        )
        self.sent: list[dict[str, Any]] = []
        self._inbox: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self._inbox.put_nowait({"type": "websocket.connect"})
        self.served = asyncio.create_task(
            app({**scope, "query_string": extra.encode()}, self._inbox.get, self._send)
        )

    async def _send(self, message: Any) -> None:
        self.sent.append(message)

    def say(self, **message: Any) -> None:
        drive_wish.validate_python(message)
        self._inbox.put_nowait({"type": "websocket.receive", "text": json.dumps(message)})

    def lose(self) -> None:
        self._inbox.put_nowait({"type": "websocket.disconnect", "code": 1006})

    def newest(self, kind: str) -> dict[str, Any]:
        texts = [json.loads(one["text"]) for one in self.sent if one["type"] == "websocket.send"]
        return next((one for one in reversed(texts) if one["type"] == kind), {})

    async def beat_until(self, is_so: Callable[[], bool], **move: Any) -> None:
        """As a page does while it is seen, and while a person drags a slider."""
        async with asyncio.timeout(WITHIN_S):
            while not is_so():
                nonce = self.newest("live").get("nonce")
                self.say(type="beat", nonce=nonce)
                if move:
                    self.say(type="move", nonce=nonce, **move)
                await asyncio.sleep(0.1)


@pytest.fixture
def arm(tmp_path: Path) -> Iterator[tuple[Mosquitto, Gateway]]:
    with (
        Mosquitto(tmp_path / "broker", (ARM,)) as mosquitto,
        fleet_on(mosquitto, (ARM,)) as (_, [gateway]),
    ):
        yield mosquitto, gateway


def is_present(service: FleetService, robot: str) -> bool:
    """What the broker had retained of it says nothing."""
    known = service.view.robots().get(robot)
    return known is not None and known.presence == "present"


@needs_mosquitto
@pytest.mark.slow
async def test_a_robot_whose_page_is_lost_while_it_moves_is_stopped(arm: tuple[Mosquitto, Gateway]) -> None:
    mosquitto, gateway = arm
    service = FleetService(mosquitto.broker_for("anna"), LAB, None, wall_clock_ms)
    control = Control(FakePorts(), asyncio.get_running_loop().time, "doc", None)
    app = create_app(control, NO_LIBRARY, entrance_to(), fleet=service)
    service.start()
    try:
        assert await asyncio.to_thread(eventually, lambda: is_present(service, ARM))
        socket = Socket(app, ARM)
        await socket.beat_until(lambda: bool(socket.newest("live").get("motion")))
        assert socket.newest("lease") == {"type": "lease", "lease": "driving", "driver": "This computer"}

        drag: dict[str, Any] = {"targets": [{"servo": 1, "position": 1300}], "durationMs": 5000}

        def is_moving() -> bool:
            return gateway.count(MOVE) > 0 and bool(socket.newest("live")["motion"]["servos"])

        await socket.beat_until(lambda: is_moving() or gateway.control.latch, **drag)
        while gateway.control.latch:  # the computer stalled: to the gateway the page was lost then
            await service.driver.resume(ARM)
            await socket.beat_until(lambda: is_moving() or gateway.control.latch, **drag)
        before = gateway.count(STOP)
        socket.lose()
        assert await asyncio.to_thread(eventually, lambda: gateway.count(STOP) > before)
        assert await asyncio.to_thread(eventually, lambda: gateway.control.latch)
        await socket.served
    finally:
        await service.end()


async def test_a_robot_that_nobody_knows_cannot_be_driven() -> None:
    service = FleetService(parse_broker("mqtt://anna@127.0.0.1:1"), LAB, None, wall_clock_ms)
    control = Control(FakePorts(), asyncio.get_running_loop().time, "doc", None)
    socket = Socket(create_app(control, NO_LIBRARY, entrance_to(), fleet=service), "arm-9")
    await socket.served
    assert [one.get("status") for one in socket.sent if "status" in one] == [404]
