"""Downloads as jobs of the gateway: they go on when whoever began them has left. One at a time; while it
lasts nothing else goes to the board. Keeps account of what they leave behind: slots that hold half a group.

Knows packets and a wire. Must not know HTTP, nor who may begin one and when.
"""

import asyncio
import logging
import secrets
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol

from servodeck.answers import Answers
from servodeck.broken_slots import BrokenSlots
from servodeck.download import EDGE_FRAME_TIMEOUT_S, Download, Progress
from servodeck.errors import GatewayError, MovingError, NotFoundError, SlotBrokenError
from servodeck.messages import JobState
from servodeck.values import Command, Erase, Erased, Frame, Report, Run
from servodeck.wire import Wire

REMEMBERED = 16
# Often enough for a bar that moves, seldom enough for 200 who look on.
TOLD_EVERY_S = 0.1
# Count table only: 46 ms typical, 403 ms worst (boards.md section 3, flash times).
ERASE_TIMEOUT_S = 1.0
log = logging.getLogger("servodeck.robot")


@dataclass(frozen=True, slots=True)
class Group:
    slot: int
    name: str
    frames: Sequence[Frame]


class JobEvents(Protocol):
    def job_changed(self, state: JobState) -> None: ...

    def broken_slots_changed(self) -> None: ...

    def group_stored(self, group: Group) -> None:
        """All of it is on the board."""


class Job:
    """One download. The owner of its packets on the wire."""

    def __init__(self, group: Group, packets: Sequence[bytes], by: str, board: str, wire: Wire) -> None:
        """`board` is what its broken slots are remembered by."""
        self.group = group
        self.packets = packets
        self.board = board
        self.wire = wire
        self.has_begun = False
        # Its slot was whole before: where nothing has left, it still is.
        self.broke = False
        self.download: Download
        self.task: asyncio.Task[None]
        self.state = JobState(
            id=secrets.token_hex(6),
            slot=group.slot,
            name=group.name,
            by=by,
            status="running",
            frames_stored=0,
            frame_count=len(packets),
            bytes_sent=0,
            bytes_total=sum(map(len, packets)),
            remaining_ms=0,
        )

    def note(self, progress: Progress) -> None:
        self.state = self.state.model_copy(
            update={
                "frames_stored": progress.frames_stored,
                "bytes_sent": progress.bytes_sent,
                "remaining_ms": round(progress.remaining_s * 1000),
            }
        )

    def conclude(self, error: GatewayError | None) -> None:
        status = "done" if error is None else "cancelled" if error.code == "cancelled" else "failed"
        reason = {} if error is None else {"code": error.code, "detail": error.detail}
        self.state = self.state.model_copy(update={"status": status, "remaining_ms": 0, **reason})


class Jobs:
    def __init__(
        self, events: JobEvents, answers: Answers, now: Callable[[], float], memory: BrokenSlots
    ) -> None:
        self._events = events
        self._now = now
        self._memory = memory
        self._answers = answers
        self._known: dict[str, Job] = {}
        self._current: Job | None = None
        self._told_s = float("-inf")
        self._teller: asyncio.TimerHandle | None = None
        # Until then the board may acknowledge a frame that nobody waits for any more.
        self._owed_until_s = float("-inf")
        self._erasing_until_s = float("-inf")

    @property
    def latest(self) -> JobState | None:
        return next((job.state for job in reversed(self._known.values())), None)

    def find(self, job_id: str) -> JobState:
        return self._found(job_id).state

    def begin(self, group: Group, packets: Sequence[bytes], by: str, board: str, wire: Wire) -> JobState:
        """Raises MovingError while another one lasts."""
        self.judge_idle()
        job = Job(group, packets, by, board, wire)
        job.download = Download(
            packets,
            lambda packet: wire.send(packet, job),
            self._answers,
            self._now,
            lambda progress: self._progressed(job, progress),
        )
        self._current = self._known[job.state.id] = job
        for old in list(self._known)[:-REMEMBERED]:
            del self._known[old]
        log.info("download begun", extra={"facts": {"slot": group.slot, "frames": len(packets)}})
        self._tell(job)
        job.task = asyncio.create_task(self._run(job))
        return job.state

    def cancel(self, job_id: str) -> JobState:
        """It ends after its frame in progress."""
        job = self._found(job_id)
        job.download.cancel()
        return job.state

    def end(self, error: GatewayError) -> None:
        """At once, whatever of a frame is on the board by now."""
        if job := self._current:
            job.wire.purge(lambda waiting: waiting.owner is job, error)
            job.task.cancel()
            self._finish(job, error)

    def judge_idle(self) -> None:
        """Raises MovingError while the board works on its flash: what comes then overwrites what is being
        stored (S10, S11).
        """
        if job := self._current:
            raise MovingError(
                f"A download to slot {job.group.slot} is under way ({job.state.frames_stored} of "
                f"{job.state.frame_count} frames): wait for its end, or cancel it."
            )
        if self._now() < self._erasing_until_s:
            raise MovingError("The board is erasing: wait for its end.")

    def judge_run(self, command: Command | None, board: str) -> None:
        if isinstance(command, Run) and command.slot in self._memory.of(board):
            raise SlotBrokenError(f"Slot {command.slot} holds half a group: download it again.")

    def broken(self, board: str) -> list[int]:
        return self._memory.of(board)

    def left(self, command: Command | None, at_s: float) -> None:
        """The last bit of that command leaves then."""
        if isinstance(command, Erase):
            self._erasing_until_s = at_s + ERASE_TIMEOUT_S

    def heard(self, report: Report, board: str) -> None:
        if isinstance(report, Erased) and self._now() < self._erasing_until_s:
            self._erasing_until_s = float("-inf")
            self._memory.clear(board)
            self._memory.keep_soon()
            self._events.broken_slots_changed()

    async def _run(self, job: Job) -> None:
        try:
            await job.download.settle(self._owed_until_s - self._now())
            job.broke = job.group.slot not in self._memory.of(job.board)
            self._memory.add(job.board, job.group.slot)
            self._events.broken_slots_changed()
            await self._memory.kept()  # before the first byte leaves: a crash must not forget it
            job.has_begun = True
            await job.download.store()
            self._finish(job, None)
            self._events.group_stored(job.group)
        except GatewayError as error:
            self._finish(job, error)
        finally:
            if self._current is job:  # a defect of ours, and the robot is not to wait for it
                self._finish(job, GatewayError("The download ended by a mistake of the gateway."))

    def _finish(self, job: Job, error: GatewayError | None) -> None:
        self._current = None
        self._owed_until_s = float("-inf") if error is None else self._now() + EDGE_FRAME_TIMEOUT_S
        if error is None or (job.broke and not job.has_begun):
            self._memory.remove(job.board, job.group.slot)
            self._memory.keep_soon()
        job.conclude(error)
        facts = {"slot": job.group.slot, "code": job.state.code, "detail": job.state.detail}
        log.info("download %s", job.state.status, extra={"facts": facts})
        self._events.broken_slots_changed()
        self._tell(job)

    def _progressed(self, job: Job, progress: Progress) -> None:
        job.note(progress)
        if self._teller is None:
            delay_s = max(0.0, self._told_s + TOLD_EVERY_S - self._now())
            self._teller = asyncio.get_running_loop().call_later(delay_s, self._tell, job)

    def _tell(self, job: Job) -> None:
        if self._teller:
            self._teller.cancel()
        self._teller, self._told_s = None, self._now()
        self._events.job_changed(job.state)

    def _found(self, job_id: str) -> Job:
        with suppress(KeyError):
            return self._known[job_id]
        raise NotFoundError(f"There is no job {job_id} here, or not any more.")
