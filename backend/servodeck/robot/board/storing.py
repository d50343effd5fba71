"""Downloads as jobs of the gateway: they continue when their client has left. One at a time; while it lasts
nothing else goes to the board. Records what they leave in the slots. Knows packets and a wire. Must not know
HTTP, nor who may begin one and when.
"""

import asyncio
import logging
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Protocol

from servodeck.callers import Caller
from servodeck.errors import (
    CancelledError,
    GatewayError,
    MovingError,
    NotDrivingError,
    NotFoundError,
    SlotBrokenError,
    SlotChangedError,
)
from servodeck.port.wire import Wire
from servodeck.protocol.packets import CommandPacket, parse_command
from servodeck.protocol.timings import ERASE
from servodeck.protocol.values import Command, Erase, Erased, Report, Run
from servodeck.robot.board.download import EDGE_FRAME_TIMEOUT_S, Download, Job, Part
from servodeck.robot.board.replies import Replies
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.hub import Throttle
from servodeck.snapshots import JobState

REMEMBERED = 16
# Often enough for a progress bar, seldom enough for 200 clients.
PUBLISH_EVERY_S = 0.1
# Count table only: 46 ms typical, 403 ms worst (boards.md section 3, flash times).
ERASE_TIMEOUT_S = ERASE.timeout_ms / 1000
log = logging.getLogger("servodeck.robot")


class JobEvents(Protocol):
    def job_changed(self, state: JobState) -> None: ...

    def slots_changed(self) -> None: ...

    def group_stored(self, part: Part) -> None:
        """All of it is on the board."""


class Jobs:
    def __init__(
        self, events: JobEvents, replies: Replies, now: Callable[[], float], memory: SlotMemory
    ) -> None:
        self._events = events
        self._now = now
        self._memory = memory
        self._replies = replies
        self._known: dict[str, Job] = {}
        self._current: Job | None = None
        self._progress = Throttle(self._publish, PUBLISH_EVERY_S, now)
        # Until then the board may acknowledge a frame that no download waits for any more.
        self._owed_until_s = float("-inf")
        self._erasing_until_s = float("-inf")

    @property
    def latest(self) -> JobState | None:
        return next((job.state for job in reversed(self._known.values())), None)

    def find(self, job_id: str) -> JobState:
        return self._found(job_id).state

    def begin(self, parts: Sequence[Part], by: Caller, board: str, wire: Wire) -> JobState:
        """One group after the other, until one fails. Raises MovingError while another job lasts."""
        self.judge_idle()
        job = Job(parts, by, board, wire, self._now)
        self._current = self._known[job.state.id] = job
        for old in list(self._known)[:-REMEMBERED]:
            del self._known[old]
        facts = {"slots": job.state.slots, "frames": job.state.frame_count}
        log.info("download begun", extra={"facts": facts})
        self._progress.at_once()
        job.task = asyncio.create_task(self._run(job))
        return job.state

    def parts_of(self, job_id: str) -> Sequence[Part]:
        """Raises CancelledError where it has ended."""
        job = self._found(job_id)
        if job is not self._current or job.is_cancelled:
            raise CancelledError("That download has ended: start a new one.")
        return job.parts

    def add(self, job_id: str, parts: Sequence[Part], by: Caller) -> JobState:
        """To one that lasts, behind what it has. Raises NotDrivingError where another began it."""
        job = self._found(job_id)
        if job.by.id != by.id:
            raise NotDrivingError(f"{job.state.by} began that download: only the same client may add to it.")
        job.add(parts)
        self._progress.at_once()
        return job.state

    def cancel(self, job_id: str) -> JobState:
        """It ends after its frame in progress; the groups behind are not begun."""
        job = self._found(job_id)
        job.is_cancelled = True
        return job.state

    def end(self, error: GatewayError) -> None:
        """At once, also within a frame."""
        if job := self._current:
            job.wire.purge(lambda waiting: waiting.owner is job, error)
            job.task.cancel()
            self._finish(job, error)

    def forget(self) -> None:
        """Another board may be at the port: it owes no answer and erases nothing."""
        self._owed_until_s = self._erasing_until_s = float("-inf")

    def disown(self, caller_id: str, error: GatewayError) -> None:
        """Ends the download of that caller, which may not drive any more."""
        if self._current and self._current.by.id == caller_id:
            self.end(error)

    def is_busy(self) -> bool:
        """The board works on its flash."""
        return self._current is not None or self._now() < self._erasing_until_s

    def judge_idle(self) -> None:
        """Raises MovingError while the board works on its flash: what comes then overwrites what is being
        stored (S10, S11).
        """
        if job := self._current:
            raise MovingError(
                f"A download to slot {job.state.slot} is in progress ({job.state.frames_stored} of "
                f"{job.state.frame_count} frames): wait for its end, or cancel it."
            )
        if self._now() < self._erasing_until_s:
            raise MovingError("The board is erasing its slots: wait until it has finished.")

    def judge_run(self, command: Command | None, board: str) -> None:
        if isinstance(command, Run) and command.slot in self._memory.broken(board):
            raise SlotBrokenError(f"Slot {command.slot} holds half a group: download it again.")

    def judge_replaced(self, part: Part, board: str) -> None:
        """Raises SlotChangedError where the slot does not hold any more what the caller has seen there."""
        if part.replaces is not None and part.replaces != self._memory.version(board, part.slot):
            raise SlotChangedError(f"Something else was stored in slot {part.slot} in the meantime.")

    def left(self, command: Command | None, at_s: float, board: str) -> None:
        """The last bit of that command leaves then."""
        if isinstance(command, Erase):
            self._erasing_until_s = at_s + ERASE_TIMEOUT_S
            self._memory.forget(board)
            self._memory.save_soon()
            self._events.slots_changed()

    def heard(self, report: Report, board: str) -> None:
        if isinstance(report, Erased) and self._now() < self._erasing_until_s:
            self._erasing_until_s = float("-inf")
            self._memory.clear(board)
            self._memory.save_soon()
            self._events.slots_changed()

    async def _run(self, job: Job) -> None:
        try:
            for part in job.parts:
                await self._store(job, part)
            self._finish(job, None)
        except GatewayError as error:
            self._finish(job, error)
        finally:
            if self._current is job:  # after a defect of ours, so that the robot can be used again
                self._finish(
                    job,
                    GatewayError(
                        "The download failed because of an error in the gateway; its log has the details."
                    ),
                )

    async def _store(self, job: Job, part: Part) -> None:
        slot = part.slot
        download = Download(
            part.packets,
            lambda packet: job.wire.send(CommandPacket(parse_command(packet), packet), job),
            self._replies,
            self._now,
            lambda: job.is_cancelled,
            lambda frames: self._progressed(job, frames),
        )
        await download.settle(self._owed_until_s - self._now())
        job.broke = slot not in self._memory.broken(job.board)
        self._memory.breaks(job.board, slot)
        self._events.slots_changed()
        await self._memory.saved()  # before the first byte leaves: a crash must not forget it
        job.has_begun = True
        await download.store()
        self._owed_until_s = float("-inf")
        self._memory.store(job.board, slot, part.version, part.name, part.document, job.state.by)
        self._memory.save_soon()
        job.note_whole()
        self._events.group_stored(part)
        self._events.slots_changed()
        self._progress.at_once()

    def _finish(self, job: Job, error: GatewayError | None) -> None:
        self._current = None
        if error:
            self._owed_until_s = self._now() + EDGE_FRAME_TIMEOUT_S
        if job.broke and not job.has_begun:
            self._memory.mend(job.board, job.part.slot)
            self._memory.save_soon()
        job.conclude(error)
        facts = {"slot": job.state.slot, "code": job.state.code, "detail": job.state.detail}
        log.info("download %s", job.state.status, extra={"facts": facts})
        self._events.slots_changed()
        self._progress.at_once()

    def _progressed(self, job: Job, frames: int) -> None:
        job.note(frames)
        self._progress.soon()

    def _publish(self) -> None:
        if self.latest:
            self._events.job_changed(self.latest)

    def _found(self, job_id: str) -> Job:
        with suppress(KeyError):
            return self._known[job_id]
        raise NotFoundError(f"There is no download with the id {job_id}.")
