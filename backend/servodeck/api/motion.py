"""The HTTP interface that moves the robot: moves, poses, runs, and the lease of those who use it; whole
groups, to be downloaded to the board or played by the gateway.

Translates for `scripts` and the robot profile; decides which pose a name means.
"""

import asyncio
from collections.abc import Mapping, Sequence
from typing import Annotated

from fastapi import Depends, Path, Request
from pydantic import Field
from starlette.requests import HTTPConnection

from servodeck.api.routes import DRIVER, OWNER, VIEWER, Controlled, routes
from servodeck.api.websocket import play as play_for_page
from servodeck.callers import Caller
from servodeck.errors import CancelledError, MalformedError, NotFoundError, OutOfRangeError
from servodeck.intents import ContinueMs, FrameBody, MessageId, Nonce, PersonId, PlayIntent, Servo
from servodeck.protocol.families import Family
from servodeck.protocol.limits import UNITS
from servodeck.protocol.values import Frame
from servodeck.robot.board.download import Group, parts_of
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.scripts import ScriptAction, Scripts
from servodeck.schema import Message
from servodeck.snapshots import JobState, LeaseState, Name, NamedPose, Outcome, PlayState

Take = Annotated[bool, Field(description="An owner's: without asking the driver.")]


class MoveWish(Message):
    """`positions` by servo number, in the board's unit; all of them at once."""

    time_ms: Annotated[int, Field(ge=0, le=30_000)]
    positions: Annotated[
        dict[Servo, Annotated[int, Field(ge=0, le=0xFFFF)]], Field(min_length=1, max_length=253)
    ]
    take: Take = False


class MoveBegun(Message):
    """`firstMoves`: these servos stood at an unknown place, so they started one after another."""

    packets: int
    over_in_ms: int
    first_moves: list[int]


class RunWish(Message):
    """`times` 0: until stopped. `continueForMs`: it goes on without a `heartbeat`, for so long at most."""

    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    continue_for_ms: ContinueMs | None = None
    take: Take = False


class RunBegun(Message):
    """`acknowledged`: the board has taken it, which says nothing of the slot. `silent`: it should have said
    so and has not. `sent`: such a board never says.
    """

    outcome: Outcome


class EraseWish(Message):
    take: Take = False


class Erased(Message):
    erased: bool


class LeaseWish(Message):
    """`heartbeat`: what this script has begun may go on. The others as in a page: `request`, `take`,
    `release`.
    """

    action: ScriptAction


class DriverWish(Message):
    """As `GET /api/people` and the lease's `candidates` name them."""

    id: PersonId


ONCE, POLITELY = RunWish(), EraseWish()


async def scripts_of(connection: HTTPConnection) -> Scripts:
    scripts = connection.app.state.scripts
    assert isinstance(scripts, Scripts)
    return scripts


Scripted = Annotated[Scripts, Depends(scripts_of)]
Driving = Annotated[Caller, DRIVER]
motion_api = routes("/api", "motion")


async def once_identified(request: Request, control: Controlled) -> None:
    """A script may begin with the gateway: what it asks waits until the port is open and the board has
    answered.
    """
    await control.until_identified()
    if await request.is_disconnected():
        raise CancelledError("The client disconnected.")


ONCE_IDENTIFIED = [Depends(once_identified)]


@motion_api.post("/move", dependencies=ONCE_IDENTIFIED)
async def move(wish: MoveWish, request: Request, caller: Driving, scripts: Scripted) -> MoveBegun:
    """Moves servos together. Answers when the last packet has left the wire; `overInMs` later they are there.
    Servos of unknown place take 1500 ms at least and start one after another.
    """
    positions = {int(servo): position for servo, position in wish.positions.items()}
    return await begin_move(request, caller, scripts, wish.time_ms, positions, take=wish.take)


async def begin_move(
    request: Request,
    caller: Caller,
    scripts: Scripts,
    time_ms: int,
    positions: Mapping[int, int],
    *,
    take: bool,
) -> MoveBegun:
    async def is_wanted() -> bool:
        return not await request.is_disconnected()

    moved = await scripts.move(caller, time_ms, positions, take=take, is_wanted=is_wanted)
    return MoveBegun(packets=moved.packets, over_in_ms=moved.over_in_ms, first_moves=list(moved.first_moves))


@motion_api.post("/slots/{slot}/run", dependencies=ONCE_IDENTIFIED)
async def run(
    slot: Annotated[int, Path(ge=0, le=255)], caller: Driving, scripts: Scripted, wish: RunWish = ONCE
) -> RunBegun:
    """Runs the group in that slot; what moves ends first. It is stopped 2 s after the last `heartbeat`,
    unless it may continue.
    """
    outcome = await scripts.run(caller, slot, wish.times, take=wish.take, continue_ms=wish.continue_for_ms)
    return RunBegun(outcome=outcome)


@motion_api.post("/erase", dependencies=ONCE_IDENTIFIED)
async def erase(caller: Annotated[Caller, OWNER], scripts: Scripted, wish: EraseWish = POLITELY) -> Erased:
    """Erases every slot of the board, for good."""
    await scripts.erase(caller, take=wish.take)
    return Erased(erased=True)


@motion_api.post("/lease")
async def lease(wish: LeaseWish, caller: Driving, scripts: Scripted) -> LeaseState:
    """Who drives. Requested by itself with each motion, and held 2 s longer than that lasts."""
    return scripts.act(caller, wish.action)


@motion_api.put("/driver")
async def give(wish: DriverWish, caller: Driving, scripts: Scripted) -> LeaseState:
    """Hands the robot to somebody who is here with a page and may drive, unasked; what moves is stopped
    first. The driver may, and owners.
    """
    return scripts.give(caller, wish.id)


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


@poses_api.post("/{pose}/apply", dependencies=ONCE_IDENTIFIED)
async def apply(
    pose: Annotated[str, Path(min_length=1, max_length=64)],
    request: Request,
    caller: Driving,
    scripts: Scripted,
    control: Controlled,
    wish: ApplyWish = GENTLY,
) -> MoveBegun:
    """Goes to the pose of that number or name; as `move` otherwise."""
    control.board.identification.judge_known()
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
        raise OutOfRangeError(f"Several poses are called {wanted}: use a number instead, {numbers}.")
    return exact[0]


def judge_unit(pose: NamedPose, family: Family) -> None:
    if pose.unit != family.unit:
        raise OutOfRangeError(
            f"{pose.name} is in {UNITS[pose.unit]}; a {family.name} uses {UNITS[family.unit]}."
        )


Version = Annotated[str, Field(max_length=64)]


class GroupBody(Message):
    """`version` tells it from other groups: a text of one's own, or the gateway makes one up. `replaces`: the
    version that was seen in its slot, an empty text for none; where another one is there now, it is refused.
    `document`: which one of the library it is of.
    """

    slot: Annotated[int, Field(ge=0, le=255)]
    name: Annotated[str, Field(max_length=64)] = ""
    version: Version = ""
    replaces: Version | None = None
    document: Version | None = None
    frames: Annotated[list[FrameBody], Field(min_length=1, max_length=255)]

    async def group(self) -> Group:
        frames = await frames_of(self.frames)
        return Group(self.slot, self.name, frames, self.version, self.replaces, self.document)


async def frames_of(bodies: Sequence[FrameBody]) -> list[Frame]:
    """As `parts` does: others go on between two frames."""
    frames = []
    for body in bodies:
        frames.append(body.frame())
        await asyncio.sleep(0)
    return frames


class DownloadWish(Message):
    """`groups` in the order in which they are stored, each to a slot of its own. `behind`: the download under
    way that they belong to; more than one request takes goes in several, one right after the other. `nonce`:
    of the page that drives. A program needs none; `take` as with every motion.
    """

    groups: Annotated[list[GroupBody], Field(min_length=1, max_length=256)]
    behind: Annotated[str, Field(max_length=64)] | None = None
    nonce: Nonce | None = None
    take: Take = False


jobs_api = routes("/api", "jobs")


@jobs_api.post("/download", status_code=202, dependencies=ONCE_IDENTIFIED)
async def download(
    wish: DownloadWish,
    caller: Annotated[Caller, DRIVER],
    control: Controlled,
    scripts: Scripted,
) -> JobState:
    """Stores groups in slots of the board, one after the other, as one job, also where they come in several
    requests. Goes on when its client has left. STOP ends it, and so does the loss of the right to drive; then
    the slot of the group in progress is broken: it cannot be run before another download to it has ended
    well.
    """
    control.board.identification.judge_known()
    groups = [await body.group() for body in wish.groups]
    parts = await parts_of(groups, control.board.family_id)
    nonce = wish.nonce
    if nonce is None:
        return scripts.download(caller, parts, wish.behind, take=wish.take)

    def claim() -> None:
        control.driving.judge_request(caller, nonce)

    return control.requests.download(parts, caller, claim, wish.behind)


@jobs_api.get("/jobs/{job}", dependencies=[VIEWER])
async def job_state(job: str, control: Controlled) -> JobState:
    """How far it is, or how it ended. The last few are remembered until the gateway ends."""
    return control.board.jobs.find(job)


@jobs_api.delete("/jobs/{job}", dependencies=[DRIVER])
async def cancel(job: str, control: Controlled) -> JobState:
    """Calls it off behind its frame in progress, with the groups behind it; one that has ended stays what it
    is.
    """
    return control.board.jobs.cancel(job)


class PlayWish(PlayIntent):
    """`id` and `nonce`: of the page that drives, which hears `played` with that id on its WebSocket. A
    program needs neither. `continueForMs`: it goes on without a `heartbeat`, for so long at most.
    """

    id: MessageId | None = None
    nonce: Nonce | None = None
    continue_for_ms: ContinueMs | None = None
    take: Take = False


play_api = routes("/api", "play")


@play_api.post("/play", status_code=202, dependencies=ONCE_IDENTIFIED)
async def play(
    wish: PlayWish, caller: Annotated[Caller, DRIVER], control: Controlled, scripts: Scripted
) -> PlayState:
    """Plays frames by the gateway's clock, gently to the first one. Answers when the first one has begun. It
    is stopped 2 s after the last `heartbeat`, unless it may continue; one of a page ends with its page.
    """
    group = FrameGroup(await frames_of(wish.frames), wish.times, wish.loop_from)
    if wish.nonce is None:
        return await scripts.play(caller, group, take=wish.take, continue_ms=wish.continue_for_ms)
    if wish.id is None:
        raise MalformedError("id: a page needs one beside its nonce")
    return play_for_page(group, wish.id, wish.nonce, control.driving.driving_page(caller), control)


@play_api.delete("/play", dependencies=[DRIVER])
async def stop_playing(control: Controlled) -> PlayState | None:
    """Ends it with its frame in progress, whichever client began it; how the latest one ended."""
    control.requests.stop_playing()
    return control.board.plays.latest
