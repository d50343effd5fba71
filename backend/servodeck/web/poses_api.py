"""Poses for scripts, over HTTP: those of the robot on the board, and go there.

Translates for `robot_of_board` and `scripts`; decides which pose a name means.
"""

from collections.abc import Sequence
from typing import Annotated

from fastapi import Path, Request
from pydantic import Field

from servodeck.access.roles import VIEWER
from servodeck.errors import NotFoundError, OutOfRangeError
from servodeck.library.library_messages import Name, NamedPose
from servodeck.protocol.families import Family
from servodeck.protocol.limits import UNITS
from servodeck.schema import Message
from servodeck.web.api import Controlled, routes
from servodeck.web.motion_api import Driving, MoveBegun, Scripted, Take, begin_move


class Poses(Message):
    """Of the robot on the board."""

    robot: Name
    poses: list[NamedPose]


class ApplyWish(Message):
    time_ms: Annotated[int, Field(ge=0, le=30_000)] = 1500
    take: Take = False


GENTLY = ApplyWish()
poses_api = routes("/api/poses", "poses")


@poses_api.get("", dependencies=[VIEWER])
async def list_poses(control: Controlled) -> Poses:
    """The poses of the robot on the board, with its name; number 0 is home. Positions as the board counts."""
    facts = control.robot.facts
    return Poses(robot=facts.name if facts else "", poses=facts.poses if facts else [])


@poses_api.post("/{pose}/apply")
async def apply(
    pose: Annotated[str, Path(min_length=1, max_length=64)],
    request: Request,
    caller: Driving,
    scripts: Scripted,
    control: Controlled,
    wish: ApplyWish = GENTLY,
) -> MoveBegun:
    """Goes to the pose of that number or name; as `move` otherwise."""
    control.board.judge_known()
    found = find((await list_poses(control)).poses, pose)
    judge_unit(found, control.board.family)
    positions = {target.servo: target.position for target in found.targets}
    return await begin_move(request, caller, scripts, wish.time_ms, positions, take=wish.take)


def find(poses: Sequence[NamedPose], wanted: str) -> NamedPose:
    """By its number or its name. Raises NotFoundError, or OutOfRangeError where a name is not enough."""
    found = [pose for pose in poses if wanted in (str(pose.id), pose.name)]
    exact = [pose for pose in found if str(pose.id) == wanted] or found
    if not exact:
        raise NotFoundError(f"No pose is called {wanted}. GET /api/poses lists them.")
    if len(exact) > 1:
        numbers = ", ".join(str(pose.id) for pose in exact)
        raise OutOfRangeError(f"Several poses are called {wanted}: take one of the numbers {numbers}.")
    return exact[0]


def judge_unit(pose: NamedPose, family: Family) -> None:
    if pose.unit != family.unit:
        raise OutOfRangeError(
            f"{pose.name} is in {UNITS[pose.unit]}; a {family.name} counts in {UNITS[family.unit]}."
        )
