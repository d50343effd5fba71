"""The page of a fleet over HTTP: a real Mosquitto, gateways with ports of which the test sees every packet,
and the application that serves the page, as a browser asks it.
"""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from httpx2 import AsyncClient

from servodeck.api.app import create_app
from servodeck.fleet.broker import parse_broker
from servodeck.fleet.messages import ResumeRequest
from servodeck.fleet.service import FleetService
from servodeck.fleet.view import GROUPS_FILE
from servodeck.library.library import wall_clock_ms
from servodeck.robot.control import Control
from servodeck.robot.latch import Cause
from tests.fake_port import FakePorts
from tests.fleet import Fleet, Gateway, eventually, fleet_on
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto
from tests.running import NO_LIBRARY, client_of, entrance_to

pytestmark = [pytest.mark.slow, needs_mosquitto]
NAMES = ("arm-1", "arm-2")
RUN, STOP, DOWNLOAD = 6, 7, 25
WITHIN_S = 10.0
GROUP: dict[str, Any] = {"slot": 4, "name": "Bow", "frames": [{"durationMs": 400, "positions": {"1": 1200}}]}
SEVERAL = [
    {**GROUP, "slot": slot, "name": name, "frames": [*GROUP["frames"]] * 2}
    for slot, name in enumerate(("Nod", "Bend", "Rise"))
]
LONG = {"slot": 4, "name": "Long", "frames": [{"durationMs": 9000, "positions": {"1": 1200}}]}
Stage = tuple[Mosquitto, Fleet, list[Gateway]]


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    with (
        Mosquitto(tmp_path / "broker", NAMES) as mosquitto,
        fleet_on(mosquitto, NAMES) as (fleet, gateways),
    ):
        yield mosquitto, fleet, gateways


@pytest.fixture(autouse=True)
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """A page here may ask as often as it likes."""
    monkeypatch.setattr("servodeck.fleet.view.EACH_S", 0.02)


class Page:
    """As frontend/src/fleet/fleetStore.ts follows it."""

    def __init__(self, client: AsyncClient) -> None:
        self.client = client
        self.robots: dict[str, Any] = {}
        self.tasks: dict[str, Any] = {}
        self.events: list[Any] = []
        self._revision = 0

    async def follow(self) -> None:
        changes = (await self.client.get("/api/fleet", params={"since": self._revision})).json()
        assert changes["site"] == "lab"
        self._revision = changes["revision"]
        self.robots |= {one["id"]: one for one in changes["robots"]}
        self.tasks |= {one["id"]: one for one in changes["tasks"]}
        self.events += changes["events"]

    async def until(self, is_so: Callable[[], bool]) -> None:
        async with asyncio.timeout(WITHIN_S):
            while not is_so():
                await self.follow()

    async def ask(self, path: str, **body: Any) -> dict[str, Any]:
        answer = await self.client.post(f"/api/fleet/{path}", json=body)
        assert answer.status_code == 200, answer.text
        said: dict[str, Any] = answer.json()
        return said

    def statuses(self, task: str) -> dict[str, str]:
        parts = self.tasks[task]["parts"] if task in self.tasks else []
        return {part["robot"]: part["status"] for part in parts}

    async def over(self, task: dict[str, Any]) -> dict[str, str]:
        """How it ended at each robot."""
        self.tasks[task["id"]] = task
        await self.until(lambda: self._is_over(task["id"]))
        return self.statuses(task["id"])

    def _is_over(self, task: str) -> bool:
        statuses = set(self.statuses(task).values())
        return bool(statuses) and statuses <= {"done", "failed"}


@asynccontextmanager
async def page_of(stage: Stage, folder: Path | None = None) -> AsyncIterator[Page]:
    mosquitto, _, _ = stage
    service = FleetService(mosquitto.broker_for("anna"), LAB, folder, wall_clock_ms)
    control = Control(FakePorts(), asyncio.get_running_loop().time, "doc", None)
    service.start()
    try:
        async with client_of(create_app(control, NO_LIBRARY, entrance_to(), fleet=service)) as client:
            page = Page(client)
            await page.until(lambda: presences(page) == dict.fromkeys(NAMES, "present"))
            yield page
    finally:
        await service.end()


def presences(page: Page) -> dict[str, str]:
    return {name: robot["presence"] for name, robot in page.robots.items()}


async def awaits(is_so: Callable[[], bool]) -> None:
    assert await asyncio.to_thread(eventually, is_so)


async def test_stop_all_reaches_every_robot_and_says_so(stage: Stage) -> None:
    _, _, gateways = stage
    async with page_of(stage) as page:
        said = await page.ask("stop", robots=None)
        assert said == {"reached": list(NAMES), "notReached": []}
        assert all(gateway.control.latch and gateway.count(STOP) for gateway in gateways)
        await page.until(lambda: all(one["state"]["latch"] for one in page.robots.values()))
        await page.until(lambda: len(page.events) == len(NAMES))
        assert {event["kind"] for event in page.events} == {"stopped"}
        assert {event["by"] for event in page.events} == {"anna"}


async def test_a_stop_of_some_leaves_the_others(stage: Stage) -> None:
    _, _, (first, second) = stage
    async with page_of(stage) as page:
        assert (await page.ask("stop", robots=["arm-2"]))["reached"] == ["arm-2"]
        assert (first.control.latch, second.control.latch) == (False, True)


async def test_the_gateway_says_that_it_serves_a_fleet_and_has_no_robot(stage: Stage) -> None:
    async with page_of(stage) as page:
        assert (await page.client.get("/api/me")).json()["pages"] == ["fleet"]


async def test_who_is_not_reached_is_named(stage: Stage) -> None:
    _, fleet, (first, _) = stage
    async with page_of(stage) as page:
        await asyncio.to_thread(fleet.call, first.door.end)
        said = await page.ask("stop", robots=list(NAMES))
        assert said == {"reached": ["arm-2"], "notReached": ["arm-1"]}


@pytest.mark.parametrize("name", ["a+b", "#", "a\0b", "arm-1/about", ""])
async def test_a_name_that_no_robot_can_have_keeps_no_stop_from_the_others(stage: Stage, name: str) -> None:
    _, _, (first, _) = stage
    async with page_of(stage) as page:
        said = await page.ask("stop", robots=[name, "arm-1"])
        assert said == {"reached": ["arm-1"], "notReached": [name]}
        assert first.control.latch
        assert presences(page) == dict.fromkeys(NAMES, "present")


async def test_without_the_broker_nobody_is_said_to_be_stopped(stage: Stage) -> None:
    mosquitto, _, _ = stage
    async with page_of(stage) as page:
        mosquitto.kill()
        await page.until(lambda: set(presences(page).values()) == {"silent"})
        said = await page.ask("stop", robots=None)
        assert said == {"reached": [], "notReached": list(NAMES)}


async def test_a_group_is_stored_on_all_and_run_on_all(stage: Stage) -> None:
    _, _, gateways = stage
    async with page_of(stage) as page:
        stored = await page.ask("download", robots=list(NAMES), groups=[GROUP])
        assert await page.over(stored) == dict.fromkeys(NAMES, "done")
        assert all(gateway.count(DOWNLOAD) for gateway in gateways)
        await page.until(lambda: all(one["slots"] for one in page.robots.values()))
        assert page.robots["arm-1"]["slots"] == [{"slot": 4, "name": "Bow"}]
        runs = [{"robot": name, "slot": 4} for name in NAMES]
        running = await page.ask("run", name="Bow", runs=runs)
        await awaits(lambda: all(gateway.count(RUN) == 1 for gateway in gateways))
        assert await page.over(running) == dict.fromkeys(NAMES, "done")
        await page.until(lambda: all(one["state"]["driver"] is None for one in page.robots.values()))


async def test_several_groups_arrive_in_as_many_messages_as_they_need(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, _, (first, second) = stage
    monkeypatch.setattr("servodeck.fleet.download.MESSAGE_BYTES", 1)
    async with page_of(stage) as page:
        task = await page.ask("download", robots=list(NAMES), groups=SEVERAL)
        assert task["names"] == ["Nod", "Bend", "Rise"]
        assert await page.over(task) == dict.fromkeys(NAMES, "done")
        assert first.count(DOWNLOAD) == second.count(DOWNLOAD) == 6
        await page.until(lambda: all(len(one["slots"]) == 3 for one in page.robots.values()))


@pytest.mark.exhaustive
async def test_a_download_that_is_tried_again_sends_what_is_missing(stage: Stage) -> None:
    _, _, (first, _) = stage
    async with page_of(stage) as page:
        task = await page.ask("download", robots=["arm-1"], groups=SEVERAL)
        await awaits(lambda: first.count(DOWNLOAD) == 4)  # the second frame of the second group
        await page.ask("stop", robots=["arm-1"])
        assert await page.over(task) == {"arm-1": "failed"}
        assert await page.over(await page.ask("resume", robots=["arm-1"])) == {"arm-1": "done"}
        before = first.count(DOWNLOAD)
        while page.statuses(task["id"]) == {"arm-1": "failed"}:  # it may be about to hold its servos
            await page.over(await page.ask(f"tasks/{task['id']}/retry"))
        assert page.statuses(task["id"]) == {"arm-1": "done"}
        assert first.count(DOWNLOAD) - before == 4


async def test_a_slot_is_wanted_once_of_a_group_as_large_as_there_is(stage: Stage) -> None:
    async with page_of(stage) as page:
        positions = {str(servo): 1500 for servo in range(1, 33)}
        large = {"slot": 4, "name": "Large", "frames": [{"durationMs": 20, "positions": positions}] * 255}
        wanted = {"robots": ["arm-1"], "groups": [GROUP, large]}
        refused = await page.client.post("/api/fleet/download", json=wanted)
        assert refused.json()["code"] == "outOfRange"


async def test_robots_that_start_together_all_start(stage: Stage) -> None:
    _, _, gateways = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=list(NAMES), groups=[GROUP]))
        runs = [{"robot": name, "slot": 4} for name in NAMES]
        task = await page.ask("run", runs=runs, together=True)
        assert await page.over(task) == dict.fromkeys(NAMES, "done")
        assert [gateway.count(RUN) for gateway in gateways] == [1, 1]
        await page.until(lambda: page.tasks[task["id"]]["spreadMs"] is not None)


@pytest.mark.exhaustive
async def test_none_starts_together_where_one_is_stopped_and_the_failed_are_tried_again(stage: Stage) -> None:
    _, _, gateways = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=list(NAMES), groups=[GROUP]))
        await page.ask("stop", robots=["arm-2"])
        runs = [{"robot": name, "slot": 4} for name in NAMES]
        task = await page.ask("run", runs=runs, together=True)
        assert await page.over(task) == dict.fromkeys(NAMES, "failed")
        assert "arm-2" in page.tasks[task["id"]]["parts"][0]["detail"]
        assert [gateway.count(RUN) for gateway in gateways] == [0, 0]
        assert await page.over(await page.ask("resume", robots=["arm-2"])) == {"arm-2": "done"}
        await page.ask(f"tasks/{task['id']}/retry")
        await page.until(lambda: set(page.statuses(task["id"]).values()) == {"done"})
        assert [gateway.count(RUN) for gateway in gateways] == [1, 1]


@pytest.mark.exhaustive
async def test_a_resume_is_new_enough_although_states_are_rare(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.fleet.gateway.STATE_S", 60.0)
    async with page_of(stage) as page:
        await page.ask("stop", robots=["arm-1"])
        await page.until(lambda: bool(page.robots["arm-1"]["state"]["latch"]))
        monkeypatch.setattr(ResumeRequest, "WITHIN_S", 0.2)  # what it said last is older by far
        await page.follow()
        assert await page.over(await page.ask("resume", robots=["arm-1"])) == {"arm-1": "done"}


@pytest.mark.exhaustive
async def test_a_robot_that_cannot_run_fails_alone_and_says_why(stage: Stage) -> None:
    _, fleet, (_, second) = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=list(NAMES), groups=[GROUP]))
        await asyncio.to_thread(fleet.do, stopped(second))
        task = await page.ask("run", runs=[{"robot": name, "slot": 4} for name in NAMES])
        assert await page.over(task) == {"arm-1": "done", "arm-2": "failed"}
        assert "Stopped" in page.tasks[task["id"]]["parts"][1]["detail"]


async def stopped(gateway: Gateway) -> None:
    await gateway.control.stop(Cause("person", "Bert"))


@pytest.mark.exhaustive
async def test_a_robot_whose_cable_is_pulled_has_failed_at_once(stage: Stage) -> None:
    _, fleet, (first, _) = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=["arm-1"], groups=[LONG]))
        task = await page.ask("run", runs=[{"robot": "arm-1", "slot": 4}])
        await awaits(lambda: first.count(RUN) == 1)
        await page.until(lambda: page.robots["arm-1"]["state"]["running"] is not None)
        await asyncio.to_thread(fleet.call, first.board.unplug)
        assert await page.over(task) == {"arm-1": "failed"}
        assert "lost" in page.tasks[task["id"]]["parts"][0]["detail"]


@pytest.mark.exhaustive
async def test_a_page_that_is_closed_has_no_driver_any_more_and_the_group_is_stopped(stage: Stage) -> None:
    _, _, (first, _) = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=["arm-1"], groups=[GROUP]))
        await page.ask("run", runs=[{"robot": "arm-1", "slot": 4}], times=60000)
        await awaits(lambda: first.count(RUN) == 1)
        await awaits(lambda: first.count(STOP) > 0)  # nobody asks for changes any more


async def test_a_request_that_waits_on_is_no_page_that_watches(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, seconds in (("LONGEST_WAIT_S", 5.0), ("PRESENT_S", 0.2)):
        monkeypatch.setattr(f"servodeck.fleet.view.{name}", seconds)
    view = FleetService(parse_broker("mqtt://anna@127.0.0.1:1", "", None), LAB, None, wall_clock_ms).view
    revision = (await view.changes(0)).revision
    left = asyncio.create_task(view.changes(revision))  # as a server goes on with it when its page is closed
    await asyncio.sleep(0.1)
    assert view.is_watched
    await asyncio.sleep(0.3)
    assert not left.done()
    assert not view.is_watched
    left.cancel()


async def test_groups_of_robots_are_kept(stage: Stage, tmp_path: Path) -> None:
    async with page_of(stage, tmp_path) as page:
        for robots, group in (
            (["arm-1", "arm-2", "arm-away"], "Table 1"),
            (["arm-1"], "Table 2"),
            (["arm-1"], ""),
            (["arm-2"], "Table 2"),
        ):
            wish = {"robots": robots, "group": group}
            assert (await page.client.post("/api/fleet/groups", json=wish)).status_code == 204
        await page.until(lambda: page.robots["arm-2"]["groups"] == ["Table 2"])
    kept = {"Table 1": ["arm-away"], "Table 2": ["arm-2"]}
    assert json.loads((tmp_path / GROUPS_FILE).read_text("utf-8")) == {"groups": kept}
    async with page_of(stage, tmp_path) as page:
        assert page.robots["arm-2"]["groups"] == ["Table 2"]
        assert page.robots["arm-1"]["groups"] == []
        many = [f"arm-{number}" for number in range(1000)]
        answers = [
            await page.client.post("/api/fleet/groups", json={"robots": robots, "group": "Table 3"})
            for robots in (many, ["one more"])
        ]
        assert [answer.status_code for answer in answers] == [204, 422]
        assert answers[1].json()["code"] == "outOfRange"


async def test_cues_are_kept(stage: Stage, tmp_path: Path) -> None:
    cue = {"name": "Bow", "robots": "", "times": 1, "stopsOthers": True}
    async with page_of(stage, tmp_path) as page:
        assert (await page.client.put("/api/fleet/cues", json={"cues": [cue]})).status_code == 204
    async with page_of(stage, tmp_path) as page:
        assert (await page.client.get("/api/fleet")).json()["cues"] == [cue]


@pytest.mark.exhaustive
@pytest.mark.parametrize("stops_others", [False, True])
async def test_where_one_fails_the_others_go_on_or_are_stopped(stage: Stage, *, stops_others: bool) -> None:
    _, fleet, (first, second) = stage
    async with page_of(stage) as page:
        await page.over(await page.ask("download", robots=list(NAMES), groups=[LONG]))
        runs = [{"robot": name, "slot": 4} for name in NAMES]
        task = await page.ask("run", runs=runs, stopsOthers=stops_others)
        await awaits(lambda: first.count(RUN) == second.count(RUN) == 1)
        await asyncio.to_thread(fleet.do, stopped(second))
        await page.until(lambda: page.statuses(task["id"]).get("arm-2") == "failed")
        await page.until(lambda: page.robots["arm-1"]["state"]["latch"] == stops_others)
        assert first.control.latch == stops_others
        await page.ask("stop", robots=None)


async def test_a_damaged_list_of_groups_is_an_empty_one(stage: Stage, tmp_path: Path) -> None:
    (tmp_path / GROUPS_FILE).write_text("{", "utf-8")
    async with page_of(stage, tmp_path) as page:
        assert page.robots["arm-1"]["groups"] == []


async def test_a_gateway_without_a_fleet_says_how_it_gets_one() -> None:
    control = Control(FakePorts(), asyncio.get_running_loop().time, "doc", None)
    async with client_of(create_app(control, NO_LIBRARY, entrance_to())) as client:
        answer = await client.get("/api/fleet")
    assert answer.status_code == 404
    assert "--fleet" in answer.json()["detail"]
