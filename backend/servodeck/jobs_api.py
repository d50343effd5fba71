"""The HTTP interface of downloads: begin one, look how far it is, call it off. Translates between HTTP and
`control`; decides nothing.
"""

from typing import Annotated

from fastapi import APIRouter, Depends
from pydantic import Field

from servodeck.api import Controlled, Problem, called_by_own_page
from servodeck.callers import Caller
from servodeck.jobs import Group
from servodeck.messages import JobState, Message, Nonce
from servodeck.motion_api import Scripted, Servo, Take
from servodeck.roles import DRIVER, VIEWER
from servodeck.values import Frame, ServoTarget


class FrameBody(Message):
    """Positions by servo number, in the board's unit, reached after `durationMs`."""

    duration_ms: int
    positions: Annotated[dict[Servo, int], Field(max_length=32)]

    def frame(self) -> Frame:
        targets = (ServoTarget(int(servo), position) for servo, position in self.positions.items())
        return Frame(self.duration_ms, tuple(targets))


class GroupBody(Message):
    """`nonce`: of the page that drives. A program needs none; `take` as with every motion."""

    name: Annotated[str, Field(max_length=64)] = ""
    frames: Annotated[list[FrameBody], Field(min_length=1, max_length=255)]
    nonce: Nonce | None = None
    take: Take = False


jobs_api = APIRouter(
    prefix="/api",
    dependencies=[Depends(called_by_own_page)],
    responses={"4XX": {"model": Problem}, "5XX": {"model": Problem}},
)


@jobs_api.post("/slots/{slot}/download", status_code=202)
async def download(
    slot: int,
    body: GroupBody,
    caller: Annotated[Caller, DRIVER],
    control: Controlled,
    scripts: Scripted,
) -> JobState:
    """Stores the group in that slot. Goes on when whoever asked has left; STOP ends it, and then the slot is
    broken: nobody may run it before another download to it has ended well.
    """
    group = Group(slot, body.name, [frame.frame() for frame in body.frames])
    nonce = body.nonce
    if nonce is None:
        return scripts.download(caller, group, take=body.take)
    return control.download(group, caller.name, lambda: control.driving.judge_request(caller, nonce))


@jobs_api.get("/jobs/{job}", dependencies=[VIEWER])
async def job_state(job: str, control: Controlled) -> JobState:
    """How far it is, or how it ended. The last few are remembered until the gateway ends."""
    return control.board.jobs.find(job)


@jobs_api.delete("/jobs/{job}", dependencies=[DRIVER])
async def cancel(job: str, control: Controlled) -> JobState:
    """Calls it off behind its frame in progress; one that has ended stays what it is."""
    return control.board.jobs.cancel(job)
