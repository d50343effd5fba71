"""Tasks of a fleet's page in virtual time on a console of the test: what is left of one that is cancelled."""

import asyncio
import threading
from collections.abc import Sequence
from concurrent.futures import Future
from typing import Any, cast

import pytest

from servodeck.fleet.console import Console
from servodeck.fleet.drive_messages import DriveRelease
from servodeck.fleet.driving import ANSWER_S, FleetDriver, Share
from servodeck.fleet.heard import Heard
from servodeck.fleet.messages import Done, Started, State
from servodeck.fleet.outcomes import RefusedError
from servodeck.fleet.tasks import Order, Spread, Tasks
from servodeck.fleet.view import FleetView
from servodeck.fleet.view_messages import FleetTask
from tests.test_fleet_drive import ARM, FakeConsole, Page, SomebodyElse, state_of
from tests.virtual_time import in_virtual_time

ARMS = ("arm-1", "arm-2", "arm-3")


class SlowConsole(FakeConsole):
    """Gives the lease at once, but answers nothing else."""

    def request(self, gateway: str, verb: str, **fields: Any) -> "Future[Done]":
        if fields.get("action") == "release":
            self.asked.append((0.0, verb, {**fields, "robot": gateway}))
            return Future()
        return super().request(gateway, verb, **fields)


async def test_no_robot_stays_with_a_start_that_is_cancelled_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    goes_on = threading.Event()
    monkeypatch.setattr("servodeck.fleet.driving.start_together", lambda *_, **__: goes_on.wait())
    console = SlowConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.start_together(dict.fromkeys(ARMS, 3), 1))
    await asyncio.sleep(0.1)
    task.cancel()
    await asyncio.sleep(0.1)
    task.cancel()  # STOP was pressed again
    await asyncio.gather(task, return_exceptions=True)
    goes_on.set()
    assert [driver.claim(robot, SomebodyElse()) for robot in ARMS] == [None] * 3
    released = [fields["robot"] for _, _, fields in console.asked if fields.get("action") == "release"]
    assert released == list(ARMS)


@in_virtual_time
async def test_a_request_for_the_lease_does_not_outlive_its_task() -> None:
    console = FakeConsole()
    console.grants = False
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.run("arm-1", 3, 1))
    await asyncio.sleep(1)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)
    actions = [fields["action"] for _, verb, fields in console.asked if verb == "ask"]
    assert actions == ["request", "release"]


@in_virtual_time
async def test_a_page_that_waits_for_the_lease_and_leaves_withdraws_its_request() -> None:
    for how in ("release", "gone"):
        console = FakeConsole()
        console.grants = False
        page = Page(console, FleetDriver(cast("Console", console), lambda: True))
        await asyncio.sleep(1)
        if how == "release":
            page.session.take(DriveRelease(type="release"))
        else:
            page.running.cancel()
        await asyncio.sleep(0.2)
        actions = [fields["action"] for _, verb, fields in console.asked if verb == "ask"]
        assert actions == ["request", "release"], how
        await page.end()


@in_virtual_time
async def test_what_a_person_began_who_has_gone_ends_before_the_next_one_drives() -> None:
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    ben = Page(console, driver, "Ben")
    await asyncio.sleep(0.1)
    await ben.end()
    carla = Page(console, driver, "Carla")
    await asyncio.sleep(0.2)
    actions = [fields["action"] for _, verb, fields in console.asked if verb == "ask"]
    assert carla.leases()[-1] == ("driving", "Carla")
    assert actions == ["request", "release", "request"]
    await carla.end()


@in_virtual_time
async def test_an_old_target_does_not_leave_with_a_newer_nonce() -> None:
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    page = Page(console, driver, "Ben")
    await asyncio.sleep(0.1)
    page.move(1000, servo=1, nonce="old")
    page.move(1200, servo=2, nonce="new")
    await asyncio.sleep(0.2)
    sent = [(f["nonce"], [t.servo for t in f["targets"]]) for _, verb, f in console.asked if verb == "move"]
    assert sent == [("old", [1]), ("new", [2])]
    await page.end()


class SilentConsole(FakeConsole):
    """Of a robot that answers no move."""

    def __init__(self) -> None:
        super().__init__()
        self.unanswered: list[Future[Done]] = []

    def request(self, gateway: str, verb: str, **fields: Any) -> "Future[Done]":
        if verb != "move":
            return super().request(gateway, verb, **fields)
        self.unanswered.append(Future())
        return self.unanswered[-1]


@in_virtual_time
async def test_an_answer_that_never_comes_is_not_waited_for_without_end() -> None:
    console = SilentConsole()
    page = Page(console, FleetDriver(cast("Console", console), lambda: True))
    await asyncio.sleep(0.1)
    page.move(1000)
    await asyncio.sleep(ANSWER_S + 1)
    await page.end()
    assert [answered.cancelled() for answered in console.unanswered] == [True]
    assert page.refusals() == [f"{ARM} did not answer in {ANSWER_S:g} s."]


@in_virtual_time
async def test_what_waits_for_a_lease_ends_with_a_stop(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("servodeck.fleet.driving.stop_robots", lambda *_: None)
    for stopped in ([ARM], None, "at its own page"):
        console = FakeConsole()
        console.grants = False
        driver = FleetDriver(cast("Console", console), lambda: True)
        task = asyncio.create_task(driver.run(ARM, 3, 1))
        await asyncio.sleep(1)
        if isinstance(stopped, str):
            console.stops += 1
        else:
            await driver.stop(stopped)
        await driver.resume(ARM)
        console.has_lease = True  # its driver has let it pass
        [error] = await asyncio.gather(task, return_exceptions=True)
        assert isinstance(error, RefusedError)
        assert "run" not in console.verbs()


@in_virtual_time
async def test_a_resume_that_is_on_its_way_does_not_undo_a_stop(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.fleet.driving.stop_robots", lambda *_: None)
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.resume(ARM))
    await asyncio.sleep(0)
    assert console.verbs() == ["report"]
    await driver.stop([ARM])
    [error] = await asyncio.gather(task, return_exceptions=True)
    assert isinstance(error, RefusedError)
    assert console.verbs() == ["report"]


@in_virtual_time
async def test_a_resume_just_after_a_stop_is_not_undone_by_the_news_of_that_stop() -> None:
    console = FakeConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.resume(ARM))
    await asyncio.sleep(0)
    console.stops += 1  # the report that is awaited says so
    await task
    assert console.verbs() == ["report", "resume"]


def test_each_stop_of_a_robot_is_counted_once() -> None:
    heard = Heard(lambda: 0.0)
    for latch in (True, True, False, True):
        said = {**dict(state_of()), "instance": "i", "is_cloned": False, "latch": latch}
        heard.state(ARM, State.model_construct(**said), 0.0)
    [robot] = heard.robots()
    assert robot.stops == 2


@pytest.mark.parametrize("started", [None, "another", "this"])
async def test_one_that_did_not_start_with_the_others_has_not_done_it(
    monkeypatch: pytest.MonkeyPatch, started: str | None
) -> None:
    """What it had promised is void where something else moves the robot then."""
    monkeypatch.setattr("servodeck.fleet.driving.start_together", lambda *_, **__: 0.0)
    monkeypatch.setattr("servodeck.fleet.driving.new_name", lambda: "this")
    monkeypatch.setattr("servodeck.fleet.driving.BEGUN_S", 0.05)
    console = FakeConsole()
    said = Started(name=started, late_ms=1.0) if started else None
    console.state = State.model_construct(**{**dict(state_of()), "started": said})
    driver = FleetDriver(cast("Console", console), lambda: True)
    await driver.start_together({ARM: 3}, 1)
    [error] = await asyncio.gather(driver.finish(ARM), return_exceptions=True)
    assert (error is None) == (started == "this"), error
    assert driver.claim(ARM, SomebodyElse()) is None


class Shown:
    """The view, of which nothing is asked here."""

    def put_task(self, _: FleetTask) -> None:
        """Not of interest."""


async def test_a_task_that_is_stopped_at_its_start_keeps_no_robot(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.fleet.driving.start_together", lambda *_, **__: 0.0)
    driver = FleetDriver(cast("Console", FakeConsole()), lambda: True)
    tasks = Tasks(cast("FleetView", Shown()))

    async def begin(robots: Sequence[str]) -> Spread:
        spread = await driver.start_together(dict.fromkeys(robots, 3), 1)
        asyncio.get_running_loop().call_soon(tasks.cancel_all)
        return spread

    async def finish(robot: str, _share: Share) -> None:
        await driver.finish(robot)

    tasks.begin(Order("run", [""], "anna", finish, begin), ARMS)
    await asyncio.sleep(0.2)
    assert [driver.claim(robot, SomebodyElse()) for robot in ARMS] == [None] * 3
