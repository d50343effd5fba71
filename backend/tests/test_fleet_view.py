"""What the fleet page gets of robots that the test defines."""

import asyncio
from typing import Any, cast

import pytest

from servodeck.fleet.console import Console
from servodeck.fleet.driving import Share
from servodeck.fleet.heard import Robot
from servodeck.fleet.tasks import MOST_TASKS, Order, Tasks
from servodeck.fleet.view import FleetView
from servodeck.fleet.view_messages import FleetRobot


class Site:
    """A console that has heard of that robot."""

    problem = None

    def robots(self) -> list[Robot]:
        return [Robot("arm-1", "present", None, None, None)]


def view_of() -> FleetView:
    return FleetView(cast("Console", Site()), "lab", None, lambda: 0)


async def done_at_once(_robot: str, _share: Share) -> None:
    """There was nothing to do."""


async def test_of_many_tasks_the_latest_are_kept() -> None:
    view = view_of()
    tasks = Tasks(view)
    for _ in range(MOST_TASKS * 2):
        tasks.begin(Order("run", ["Bow"], "anna", done_at_once), ["arm-1"])
        await asyncio.sleep(0.001)
    assert len((await view.changes(0)).tasks) == MOST_TASKS


async def test_a_defect_at_one_robot_keeps_no_stop_from_the_others() -> None:
    async def carry_out(robot: str, _share: Share) -> None:
        assert robot != "arm-1"
        await asyncio.sleep(60)

    view = view_of()
    tasks = Tasks(view)
    tasks.begin(Order("run", ["Bow"], "anna", carry_out), ["arm-1", "arm-2"])
    await asyncio.sleep(0.01)
    tasks.cancel_all()
    await asyncio.sleep(0.01)
    [task] = (await view.changes(0)).tasks
    assert [part.status for part in task.parts] == ["failed", "failed"]


async def test_a_task_that_is_stopped_before_its_first_step_has_failed() -> None:
    view = view_of()
    tasks = Tasks(view)
    tasks.begin(Order("run", ["Bow"], "anna", done_at_once), ["arm-1"])
    tasks.cancel_all()
    await asyncio.sleep(0.01)
    [task] = (await view.changes(0)).tasks
    assert [part.status for part in task.parts] == ["failed"]


async def test_a_robot_that_is_as_before_is_not_made_again_for_each_page(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With a thousand robots and some pages nothing else would be done, no STOP either."""
    made: list[FleetRobot] = []

    def make(**fields: Any) -> FleetRobot:
        made.append(FleetRobot(**fields))
        return made[-1]

    monkeypatch.setattr("servodeck.fleet.view.FleetRobot", make)
    view = view_of()
    for _ in range(5):
        assert len((await view.changes(0)).robots) == 1
    assert len(made) == 1
    await view.group(["arm-1"], "Table 1")
    assert (await view.changes(0)).robots[0].groups == ["Table 1"]
