"""Poses for scripts, over HTTP: which there are, and go there. Pages hand them over.

Translates for `pose_shelf` and `scripts`; decides nothing.
"""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Depends, Path, Request
from pydantic import Field
from starlette.requests import HTTPConnection

from servodeck.api import Controlled, Problem, called_by_own_page
from servodeck.errors import OutOfRangeError
from servodeck.families import Family
from servodeck.library_messages import NamedPose
from servodeck.limits import UNITS
from servodeck.messages import Message
from servodeck.motion_api import Driving, MoveBegun, Scripted, Take, begin_move
from servodeck.pose_shelf import Poses, PoseShelf
from servodeck.roles import DRIVER, VIEWER


class ApplyWish(Message):
    time_ms: Annotated[int, Field(ge=0, le=30_000)] = 1500
    take: Take = False


async def shelf_of(connection: HTTPConnection) -> PoseShelf:
    shelf = connection.app.state.poses
    assert isinstance(shelf, PoseShelf)
    return shelf


GENTLY = ApplyWish()
Shelved = Annotated[PoseShelf, Depends(shelf_of)]
poses_api = APIRouter(
    prefix="/api/poses",
    dependencies=[Depends(called_by_own_page)],
    responses={"4XX": {"model": Problem}, "5XX": {"model": Problem}},
)


# Plain functions where a disk is waited for: they run in threads.
@poses_api.get("", dependencies=[VIEWER])
def list_poses(shelf: Shelved) -> Poses:
    """The poses that a page has handed over, with the name of their robot."""
    return shelf.read()


@poses_api.put("", status_code=204, dependencies=[DRIVER])
def hand_over(poses: Poses, shelf: Shelved) -> None:
    """Keeps these in place of all that were here. Positions as the board counts, with the trim in them."""
    shelf.write(poses)


@poses_api.post("/{pose}/apply")
async def apply(
    pose: Annotated[str, Path(min_length=1, max_length=64)],
    request: Request,
    caller: Driving,
    scripts: Scripted,
    control: Controlled,
    shelf: Shelved,
    wish: ApplyWish = GENTLY,
) -> MoveBegun:
    """Goes to the pose of that number or name; as `move` otherwise."""
    found = await asyncio.to_thread(shelf.find, pose)
    judge_unit(found, control.board.family)
    positions = {target.servo: target.position for target in found.targets}
    return await begin_move(request, caller, scripts, wish.time_ms, positions, take=wish.take)


def judge_unit(pose: NamedPose, family: Family) -> None:
    if pose.unit != family.unit:
        raise OutOfRangeError(
            f"{pose.name} is in {UNITS[pose.unit]}; a {family.name} counts in {UNITS[family.unit]}."
        )
