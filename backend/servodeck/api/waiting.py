"""Requests that wait for the end of what they begin, a motion or a download. While one waits, it is the
heartbeat of its program: a client that leaves, leaves no run behind.

Knows clocks and who drives; no route.
"""

import asyncio
from collections.abc import Callable
from typing import Annotated

from pydantic import Field
from starlette.requests import Request

from servodeck.callers import Caller
from servodeck.errors import CancelledError, LatchedError, NotDrivingError
from servodeck.protocol.timings import LEASE
from servodeck.robot.control import Control
from servodeck.robot.scripts import Scripts
from servodeck.snapshots import JobState, PlayState

# Half of the time for which a key is remembered; programs and proxies seldom wait longer for an answer.
WaitMs = Annotated[
    int,
    Field(
        ge=1,
        le=300_000,
        description="Answers when it has ended, at the latest after so long. Needs no `heartbeat` meanwhile.",
    ),
]
LOOK_S = 0.05
BEAT_S = LEASE.silent_ms / 2000


class Waiting:
    """Of one request."""

    def __init__(self, request: Request, caller: Caller, scripts: Scripts, control: Control) -> None:
        self._request = request
        self._caller = caller
        self._scripts = scripts
        self._control = control

    async def moved(self, over_in_ms: int, wait_ms: int | None) -> bool | None:
        """Whether that motion has ended in that time; None where it is not waited for. Raises LatchedError or
        NotDrivingError where it has ended with that.
        """
        until_s = self._control.now() + over_in_ms / 1000
        return await self._at_rest(lambda: self._control.now() < until_s, wait_ms)

    async def ran(self, slot: int, wait_ms: int | None) -> bool | None:
        """As `moved`. Raises CancelledError where another group runs in its place."""

        def may_run() -> bool:
            motion = self._control.board.motion
            if not motion.group_may_run(self._control.now()):
                return False
            if motion.run and motion.run.slot != slot:
                raise CancelledError(f"Another group runs now: slot {motion.run.slot}.")
            return True

        return await self._at_rest(may_run, wait_ms)

    async def played(self, begun: PlayState, wait_ms: int | None) -> PlayState:
        """Its state at the end, or after that time."""

        def state() -> PlayState:
            latest = self._control.board.plays.latest
            if latest is None or latest.id != begun.id:
                raise CancelledError("Another group is played now.")
            return latest

        if wait_ms is None:
            return begun
        await self._until(lambda: state().status != "playing", wait_ms)
        return state()

    async def stored(self, job: JobState, wait_ms: int | None) -> JobState:
        """Its state at the end, or after that time."""
        jobs = self._control.board.jobs
        if wait_ms is None:
            return job
        await self._until(lambda: jobs.find(job.id).status != "running", wait_ms)
        return jobs.find(job.id)

    async def _at_rest(self, may_move: Callable[[], bool], wait_ms: int | None) -> bool | None:
        def is_over() -> bool:
            self._judge()
            return not may_move()

        return None if wait_ms is None else await self._until(is_over, wait_ms)

    async def _until(self, is_over: Callable[[], bool], wait_ms: int) -> bool:
        """A request whose client has left waits no longer."""
        now = self._control.now
        until_s, beaten_s = now() + wait_ms / 1000, now()
        while not is_over():
            if now() >= until_s or await self._request.is_disconnected():
                return False
            if now() - beaten_s >= BEAT_S:
                beaten_s = now()
                self._scripts.act(self._caller, "heartbeat")
            await asyncio.sleep(min(LOOK_S, max(0.0, until_s - now())))
        return True

    def _judge(self) -> None:
        driver = self._control.driving.driver
        if self._control.latch:
            raise LatchedError("Stopped: motion is refused until a person resumes.")
        if driver and driver.caller.id != self._caller.id:
            raise NotDrivingError(f"{driver.caller.name} drives now, and motion was stopped first.")
