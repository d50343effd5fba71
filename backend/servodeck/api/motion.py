"""The HTTP interface that moves the robot: moves, poses, runs, the lease, and whole groups, to be downloaded
to the board or played by the gateway.

Translates requests for `scripts` and the robot profile, and decides nothing.
"""

from collections.abc import Mapping
from typing import Annotated

from fastapi import Depends, Path, Request
from pydantic import ConfigDict, Field
from starlette.requests import HTTPConnection

from servodeck.api.once import KEYED, KeyedRoute
from servodeck.api.routes import DRIVER, OWNER, SEEN_AT_ROBOT, VIEWER, Controlled, named, routes
from servodeck.api.waiting import Waiting, WaitMs
from servodeck.api.websocket import play as play_for_page
from servodeck.callers import Caller
from servodeck.errors import CancelledError, MalformedError
from servodeck.intents import Anyway, ContinueMs, GroupBody, MessageId, Nonce, PersonId, PlayIntent, Servo
from servodeck.robot.board.download import frames_of, group_of, parts_of
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.scripts import ScriptAction, Scripts
from servodeck.schema import Message
from servodeck.snapshots import JobState, LeaseState, Name, NamedPose, Outcome, PlayState

Beats = Annotated[
    bool,
    Field(
        description="The move ends with the `heartbeat` of this program: it is stopped 2 s after the last "
        "one. Without it, the request permits the move to its end."
    ),
]
Take = Annotated[bool, Field(description="An owner's: without asking the driver.")]


class MoveWish(Message):
    """`positions` by servo number, in the board's unit; all of them at once."""

    time_ms: Annotated[int, Field(ge=0, le=30_000)]
    positions: Annotated[
        dict[Servo, Annotated[int, Field(ge=0, le=0xFFFF)]], Field(min_length=1, max_length=253)
    ]
    take: Take = False
    beats: Beats = False
    wait_ms: WaitMs | None = None


class Begun(Message):
    """`ended`, with `waitMs`: whether the motion has ended in that time."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    ended: bool | None = None


class MoveBegun(Begun):
    """`firstMoves`: these servos started from an unknown position, so they started one after another."""

    packets: int
    over_in_ms: int
    first_moves: list[int]


class RunWish(Message):
    """`times` 0: until stopped. `continueForMs`: how long the run may continue without a `heartbeat`."""

    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    continue_for_ms: ContinueMs | None = None
    take: Take = False
    anyway: Anyway = False
    wait_ms: WaitMs | None = None


class RunBegun(Begun):
    """`batteryUnknown`: a run is refused where the battery is at its alarm, and its voltage is not known.
    `acknowledged`: the board has accepted the command, which says nothing about the slot. `silent`: the
    acknowledgement is missing. `sent`: such a board sends none.
    """

    outcome: Outcome
    battery_unknown: bool | None = None


class EraseWish(Message):
    take: Take = False


class Erased(Message):
    erased: bool


class LeaseWish(Message):
    """`heartbeat`: the motion of this script may continue. `request`, `take` and `release` as on a page."""

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


async def waiting_of(request: Request, scripts: Scripted, control: Controlled) -> Waiting:
    return Waiting(request, request.state.caller, scripts, control)


Waits = Annotated[Waiting, Depends(waiting_of)]
motion_api = routes("/api", "motion", KeyedRoute)


async def once_identified(request: Request, control: Controlled) -> None:
    """A script may start together with the gateway: its request waits until the port is open and the board is
    identified.
    """
    await control.until_identified()
    await judge_connected(request)


async def once_settled(request: Request, control: Controlled) -> None:
    """Also until what others began before the port was opened has ended, on a board that answers nothing."""
    await control.until_settled()
    await judge_connected(request)


async def judge_connected(request: Request) -> None:
    """Raises CancelledError for a client that has gone while its request waited."""
    if await request.is_disconnected():
        raise CancelledError("The client disconnected.")


ONCE_IDENTIFIED = [SEEN_AT_ROBOT, Depends(once_identified)]
KEYED_ONCE_IDENTIFIED = [KEYED, *ONCE_IDENTIFIED]
ONCE_SETTLED = [SEEN_AT_ROBOT, Depends(once_settled)]


@motion_api.post("/move", dependencies=KEYED_ONCE_IDENTIFIED, response_model_exclude_none=True)
async def move(
    wish: MoveWish, request: Request, caller: Driving, scripts: Scripted, waits: Waits
) -> MoveBegun:
    """Moves servos together. Answers when the last packet has left the wire; `overInMs` later the servos have
    arrived. Servos of unknown position take at least 1500 ms and start one after another.

    """
    positions = {int(servo): position for servo, position in wish.positions.items()}
    begun = await begin_move(request, caller, scripts, positions, wish)
    return begun.model_copy(update={"ended": await waits.moved(begun.over_in_ms, wish.wait_ms)})


async def begin_move(
    request: Request,
    caller: Caller,
    scripts: Scripts,
    positions: Mapping[int, int],
    wish: "MoveWish | ApplyWish",
) -> MoveBegun:
    async def is_wanted() -> bool:
        return not await request.is_disconnected()

    moved = await scripts.move(
        caller, wish.time_ms, positions, take=wish.take, beats=wish.beats, is_wanted=is_wanted
    )
    return MoveBegun(packets=moved.packets, over_in_ms=moved.over_in_ms, first_moves=list(moved.first_moves))


@motion_api.post("/slots/{slot}/run", dependencies=KEYED_ONCE_IDENTIFIED, response_model_exclude_none=True)
async def run(
    slot: Annotated[int, Path(ge=0, le=255)],
    caller: Driving,
    scripts: Scripted,
    waits: Waits,
    wish: RunWish = ONCE,
) -> RunBegun:
    """Runs the group in that slot; a motion in progress ends first. It is stopped 2 s after the last
    `heartbeat`, unless it may continue.
    """
    ran = await scripts.run(
        *(caller, slot, wish.times),
        take=wish.take,
        continue_ms=wish.continue_for_ms,
        anyway=wish.anyway,
    )
    ended = await waits.ran(slot, wish.wait_ms)
    return RunBegun(outcome=ran.outcome, battery_unknown=ran.is_battery_unknown or None, ended=ended)


@motion_api.post("/erase", dependencies=ONCE_SETTLED)
async def erase(caller: Annotated[Caller, OWNER], scripts: Scripted, wish: EraseWish = POLITELY) -> Erased:
    """Erases every slot of the board, for good."""
    await scripts.erase(caller, take=wish.take)
    return Erased(erased=True)


@motion_api.post("/lease", dependencies=[SEEN_AT_ROBOT])
async def lease(wish: LeaseWish, caller: Driving, scripts: Scripted) -> LeaseState:
    """Requests, takes, holds or releases the lease. Each motion requests it by itself and holds it until 2 s
    after its end.
    """
    return scripts.act(caller, wish.action)


@motion_api.put("/driver", dependencies=[SEEN_AT_ROBOT])
async def give(wish: DriverWish, caller: Driving, scripts: Scripted) -> LeaseState:
    """Hands the lease to a connected client that may drive, without a request; motion is stopped first. For
    the driver and owners.
    """
    return scripts.give(caller, wish.id)


class Poses(Message):
    """Of the robot on the board."""

    robot: Name
    poses: list[NamedPose]


class ApplyWish(Message):
    time_ms: Annotated[int, Field(ge=0, le=30_000)] = 1500
    take: Take = False
    beats: Beats = False
    wait_ms: WaitMs | None = None


GENTLY = ApplyWish()
poses_api = routes("/api/poses", "poses", KeyedRoute)


@poses_api.get("", dependencies=[VIEWER])
async def list_poses(control: Controlled) -> Poses:
    """The poses of the robot on the board, with its name; number 0 is home. Positions as the board counts."""
    facts = control.robot.facts
    return Poses(robot=facts.name, poses=facts.poses) if facts else Poses(robot="", poses=[])


@poses_api.post("/{pose}/apply", dependencies=KEYED_ONCE_IDENTIFIED, response_model_exclude_none=True)
async def apply(
    pose: Annotated[str, Path(min_length=1, max_length=64)],
    request: Request,
    caller: Driving,
    scripts: Scripted,
    control: Controlled,
    waits: Waits,
    wish: ApplyWish = GENTLY,
) -> MoveBegun:
    """Moves the robot to the pose of that number or name, in the same way as `move`."""
    control.board.identification.judge_known()
    found = control.robot.pose(pose, control.board.family)
    positions = {target.servo: target.position for target in found.targets}
    begun = await begin_move(request, caller, scripts, positions, wish)
    return begun.model_copy(update={"ended": await waits.moved(begun.over_in_ms, wish.wait_ms)})


class DownloadWish(Message):
    """`groups` are stored in this order, each in a slot of its own. `behind`: the download in progress to
    which they are added, because a request holds a limited number. `nonce`: of the page that drives; a
    program needs none. `take` as with every motion.

    """

    groups: Annotated[list[GroupBody], Field(min_length=1, max_length=256)]
    behind: Annotated[str, Field(max_length=64)] | None = None
    nonce: Nonce | None = None
    take: Take = False
    wait_ms: WaitMs | None = None


jobs_api = routes("/api", "jobs", KeyedRoute)


@jobs_api.post("/download", status_code=202, dependencies=[KEYED, *ONCE_SETTLED])
async def download(
    wish: DownloadWish,
    caller: Annotated[Caller, DRIVER],
    control: Controlled,
    scripts: Scripted,
    waits: Waits,
) -> JobState:
    """Stores groups in slots of the board, one after the other, as one job, also from several requests. It
    continues when its client has left. STOP ends it, and so does the loss of the right to drive; then the
    slot of the group in progress is broken: it cannot be run until another download to it has succeeded.

    """
    control.board.identification.judge_known()
    groups = [await group_of(body) for body in wish.groups]
    parts = await parts_of(groups, control.board.family_id)
    nonce = wish.nonce
    if nonce is None:
        job = scripts.download(caller, parts, wish.behind, take=wish.take)
        return await waits.stored(job, wish.wait_ms)

    def claim() -> None:
        control.driving.judge_request(caller, nonce)

    job = control.requests.download(parts, caller, claim, wish.behind)
    return await waits.stored(job, wish.wait_ms)


@jobs_api.get("/jobs/{job}", dependencies=[VIEWER])
async def job_state(job: str, control: Controlled) -> JobState:
    """Its progress or result. The last few downloads are remembered until the gateway ends."""
    return control.board.jobs.find(job)


@jobs_api.delete("/jobs/{job}", dependencies=[DRIVER, SEEN_AT_ROBOT])
async def cancel(job: str, control: Controlled) -> JobState:
    """Cancels it after its frame in progress, with the groups behind it. One that has ended stays
    unchanged.
    """
    return control.board.jobs.cancel(job)


class PlayWish(PlayIntent):
    """`id` and `nonce`: of the page that drives, which gets `played` with that id on its WebSocket. A program
    needs neither. `continueForMs`: how long it may continue without a `heartbeat`.

    """

    id: MessageId | None = None
    nonce: Nonce | None = None
    continue_for_ms: ContinueMs | None = None
    take: Take = False
    wait_ms: WaitMs | None = None


play_api = routes("/api", "play", KeyedRoute)


@play_api.post("/play", status_code=202, dependencies=KEYED_ONCE_IDENTIFIED)
async def play(
    wish: PlayWish,
    caller: Annotated[Caller, DRIVER],
    control: Controlled,
    scripts: Scripted,
    waits: Waits,
) -> PlayState:
    """Plays frames by the gateway's clock, gently to the first one. Answers when the first one has begun. It
    is stopped 2 s after the last `heartbeat`, unless it may continue; one of a page ends with its page.
    """
    group = FrameGroup(await frames_of(wish.frames), wish.times, wish.loop_from)
    if wish.nonce is None:
        begun = await scripts.play(
            caller, group, take=wish.take, continue_ms=wish.continue_for_ms, anyway=wish.anyway
        )
        return await waits.played(begun, wish.wait_ms)
    if wish.id is None:
        raise MalformedError("id: a page needs one beside its nonce")
    page = control.driving.driving_page(caller)
    return await play_for_page(group, wish, wish.id, wish.nonce, page, control)


@play_api.delete("/play", dependencies=[SEEN_AT_ROBOT])
async def stop_playing(request: Request, control: Controlled, caller: Driving) -> PlayState | None:
    """Ends the play with its frame in progress, whichever client began it. Answers how it ended."""
    control.stop_playing(named(request, caller))
    return control.board.plays.latest
