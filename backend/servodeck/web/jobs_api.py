"""The HTTP interface of downloads: begin one, look how far it is, call it off. Translates between HTTP and
`control`; decides nothing.
"""

import asyncio
from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from servodeck.access.roles import DRIVER, VIEWER
from servodeck.board.parts import Group, parts_of
from servodeck.callers import Caller
from servodeck.intents import FrameBody
from servodeck.messages import Nonce
from servodeck.protocol.values import Frame
from servodeck.schema import Message
from servodeck.told import JobState
from servodeck.web.api import Controlled, routes
from servodeck.web.motion_api import Scripted, Take

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
    parts = await parts_of(groups, control.board.taken_for)
    nonce = wish.nonce
    if nonce is None:
        return scripts.download(caller, parts, wish.behind, take=wish.take)

    def claim() -> None:
        control.driving.judge_request(caller, nonce)

    return control.download(parts, caller, claim, wish.behind)


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
