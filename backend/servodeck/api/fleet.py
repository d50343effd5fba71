"""The fleet over HTTP: the state of all robots of a site, STOP of some or all, and what is asked of several.

Translates between messages and the fleet's view, tasks and driver; decides nothing. Loaded where the gateway
is a client of a broker.
"""

import asyncio
from collections.abc import Awaitable, Sequence
from typing import Annotated

from fastapi import Depends, Query
from pydantic import Field
from starlette.requests import HTTPConnection

from servodeck.api.routes import DRIVER, STOPPER, VIEWER, leaves, routes
from servodeck.callers import Caller
from servodeck.errors import NotFoundError, OutOfRangeError
from servodeck.fleet.download import Download
from servodeck.fleet.driving import Share
from servodeck.fleet.outcomes import FleetError
from servodeck.fleet.service import FleetService
from servodeck.fleet.tasks import Order, Spread
from servodeck.fleet.view_messages import FleetChanges, FleetCues, FleetTask
from servodeck.intents import GroupBody, Slot
from servodeck.schema import Message

RobotId = Annotated[str, Field(max_length=64)]
RobotIds = Annotated[list[RobotId], Field(min_length=1, max_length=1000)]


class FleetStopWish(Message):
    """`robots` null: every robot of the site, also those that this gateway does not know."""

    robots: RobotIds | None = None


class FleetStopped(Message):
    """`reached`: they have confirmed that they are stopped. `notReached`: they have not, within a second, or
    had no board to stop.
    """

    reached: list[str]
    not_reached: list[str]


class FleetRun(Message):
    robot: RobotId
    slot: Slot


class FleetRunWish(Message):
    """`name` of the group, for people; boards have it in slots of their own."""

    name: Annotated[str, Field(max_length=64)] = ""
    runs: Annotated[list[FleetRun], Field(min_length=1, max_length=1000)]
    times: Annotated[int, Field(ge=1, le=0xFFFF)] = 1
    together: Annotated[bool, Field(description="All at the same time, or none.")] = False
    stops_others: Annotated[bool, Field(description="Where one fails, all of them are stopped.")] = False


class FleetDownloadWish(Message):
    """Each of the groups for the slot that it names, and all of them for each of the robots."""

    robots: RobotIds
    groups: Annotated[list[GroupBody], Field(min_length=1, max_length=256)]


class FleetResumeWish(Message):
    robots: RobotIds


class FleetGroupWish(Message):
    """`group` empty: into none."""

    robots: RobotIds
    group: Annotated[str, Field(max_length=64)]


async def fleet_of(connection: HTTPConnection) -> FleetService:
    """Raises NotFoundError where this gateway serves no fleet."""
    fleet = connection.app.state.fleet
    if fleet is None:
        raise NotFoundError(
            "This gateway serves no fleet. Start it with --fleet and the address of the broker."
        )
    assert isinstance(fleet, FleetService)
    return fleet


OfFleet = Annotated[FleetService, Depends(fleet_of)]
fleet_api = routes("/api/fleet", "fleet")


@fleet_api.get("", dependencies=[VIEWER])
async def changes(
    fleet: OfFleet, since: Annotated[int, Query(ge=0, description="0: all of it.")] = 0
) -> FleetChanges:
    """What has changed since that revision; waits until something has, for a second or so at most."""
    return await fleet.view.changes(since)


@fleet_api.post("/stop", dependencies=[STOPPER, leaves("fleetStopped")])
async def stop(wish: FleetStopWish, fleet: OfFleet) -> FleetStopped:
    """STOP of those robots, or of all; answers when each has confirmed it, or after a second."""
    if wish.robots is None:
        fleet.tasks.cancel_all()
    report = await asyncio.shield(fleet.driver.stop(wish.robots))
    failed = sorted([*report.missing, *(name for name, _ in report.refused)])
    return FleetStopped(reached=list(report.stopped), not_reached=failed)


@fleet_api.post("/run", dependencies=[leaves("fleetAsked")])
async def run(wish: FleetRunWish, fleet: OfFleet, caller: Annotated[Caller, DRIVER]) -> FleetTask:
    """Has each robot run its slot."""
    slots = {each.robot: each.slot for each in wish.runs}

    async def run_one(robot: str, _share: Share) -> None:
        await guarded(robot, fleet.driver.run(robot, slots[robot], wish.times))

    async def finish(robot: str, _share: Share) -> None:
        await guarded(robot, fleet.driver.finish(robot))

    async def guarded(robot: str, running: Awaitable[None]) -> None:
        try:
            await running
        except FleetError:
            if wish.stops_others:
                await fleet.driver.stop([other for other in slots if other != robot])
            raise

    async def begin(robots: Sequence[str]) -> Spread:
        return await fleet.driver.start_together({robot: slots[robot] for robot in robots}, wish.times)

    names = [wish.name]
    together = Order("run", names, caller.name, finish, begin)
    order = together if wish.together else Order("run", names, caller.name, run_one)
    return fleet.tasks.begin(order, list(slots))


@fleet_api.post("/download", dependencies=[leaves("fleetAsked")])
async def download(wish: FleetDownloadWish, fleet: OfFleet, caller: Annotated[Caller, DRIVER]) -> FleetTask:
    """Stores the groups on each robot, one after the other. A retry sends a robot those that are missing."""
    slots = [group.slot for group in wish.groups]
    if len(set(slots)) < len(slots):
        raise OutOfRangeError("A slot is given twice.")
    download = Download(fleet.driver, wish.groups)
    names = [group.name for group in wish.groups]
    return fleet.tasks.begin(Order("download", names, caller.name, download.carry_out), wish.robots)


@fleet_api.post("/resume", dependencies=[leaves("fleetAsked")])
async def resume(wish: FleetResumeWish, fleet: OfFleet, caller: Annotated[Caller, DRIVER]) -> FleetTask:
    """Allows motion again. Moves nothing."""

    async def carry_out(robot: str, _share: Share) -> None:
        await fleet.driver.resume(robot)

    return fleet.tasks.begin(Order("resume", [], caller.name, carry_out), wish.robots)


@fleet_api.post("/tasks/{task}/retry", dependencies=[DRIVER, leaves("fleetAsked")])
async def retry(task: str, fleet: OfFleet) -> FleetTask:
    """Asks those robots again at which it failed."""
    return fleet.tasks.retry(task)


@fleet_api.put("/cues", status_code=204, dependencies=[DRIVER, leaves("fleetGrouped")])
async def set_cues(wanted: FleetCues, fleet: OfFleet) -> None:
    """The steps of a show, in place of the ones before. Starts none."""
    await fleet.view.set_cues(wanted)


@fleet_api.post("/groups", status_code=204, dependencies=[DRIVER, leaves("fleetGrouped")])
async def group(wish: FleetGroupWish, fleet: OfFleet) -> None:
    """Puts robots into a group of robots, and takes them out of the others."""
    await fleet.view.group(wish.robots, wish.group)
