"""What the page of a fleet is told, of robots that the test makes up."""

import asyncio
from typing import cast

from servodeck.fleet.console import Console
from servodeck.fleet.driving import Share
from servodeck.fleet.heard import Robot
from servodeck.fleet.tasks import MOST_TASKS, Order, Tasks
from servodeck.fleet.view import FleetView


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
