"""The HTTP interface of whole groups: download them to the board or have the gateway play them, look how far
that is, end it. Translates between HTTP and `control`; decides nothing.
"""

import asyncio
from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from servodeck.access.roles import DRIVER, VIEWER
from servodeck.api.motion import Scripted, Take
from servodeck.api.routes import Controlled, routes
from servodeck.api.websocket import play as play_for_page
from servodeck.callers import Caller
from servodeck.errors import MalformedError
from servodeck.intents import ContinueMs, FrameBody, MessageId, Nonce, PlayIntent
from servodeck.protocol.values import Frame
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.board.rules import Group, parts_of
from servodeck.schema import Message
from servodeck.snapshots import JobState, PlayState

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


@jobs_api.post("/download", status_code=202)
async def download(
    wish: DownloadWish,
    caller: Annotated[Caller, DRIVER],
    control: Controlled,
    scripts: Scripted,
) -> JobState:
    """Stores groups in slots of the board, one after the other, as one job, also where they come in several
    requests. Goes on when its client has left. STOP ends it, and so does the loss of the right to drive; then
    the slot of the group in progress is broken: nobody may run it before another download to it has ended
    well.
    """
    control.board.judge_known()
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


@play_api.post("/play", status_code=202)
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
    """Ends it with its frame in progress, whoever began it; how the latest one ended."""
    control.requests.stop_playing()
    return control.board.plays.latest
