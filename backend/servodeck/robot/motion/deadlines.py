"""Groups on deadlines: a frame begins when the time of the one before it is over (S42-S50). The open
firmware's way; of the closed boards it is unknown, and the simulated ones do the same. Knows runs; no servo's
way. Twin of shared/src/motion/deadlines.ts.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from servodeck.protocol.families import Family
from servodeck.protocol.timings import ESTIMATE, wire_ms
from servodeck.protocol.values import Frame, Run
from servodeck.robot.motion.model import (
    DeadlineRun,
    KnownBoard,
    Motion,
    PolledRun,
    UnknownRun,
    running_unknown,
)
from servodeck.robot.motion.tracks import (
    LONGEST_MOVE_MS,
    Order,
    board_duration_ms,
    contested,
    ordered,
    retarget,
    stopped_before,
    unrest_after,
)

BARE_PACKET_MS = wire_ms(4)
RUN_REPORT_MS = wire_ms(7)


def announcement_ms(family: Family) -> float:
    """The report that the board sends before it looks for the group (S18, X1), by busy-waiting (S21)."""
    if family.run_reports_name_slot:
        return RUN_REPORT_MS
    return BARE_PACKET_MS if "run" in family.answers else 0


def owes_end(motion: Motion, at_ms: float, family: Family) -> bool:
    """The end of the group before may be reported while the next one runs, and then not which it was."""
    return (
        not family.run_reports_name_slot
        and at_ms - motion.unreported_end_ms < ESTIMATE.end_reported_within_ms
    )


def longest_ms(wanted: Run, family: Family) -> float:
    """By then a group of unknown frames has ended: as many frames as fit, each as long as a move can take,
    and of each group that is played behind it (S49).
    """
    if wanted.times == 0:
        return inf
    chained_slot = family.motion.chained_slot
    is_chained = chained_slot is not None and wanted.slot >= chained_slot
    passes = wanted.times + (family.slot.max - wanted.slot if is_chained else 0)
    return passes * family.frames_per_group * LONGEST_MOVE_MS


def end_of(run: DeadlineRun, board: KnownBoard) -> float:
    """When it has ended at the latest, what follows it by itself included."""
    frames = board.played_frames(run.slot)
    if run.times == 0:
        return inf
    if frames is None or run.slot == board.family.motion.chained_slot:
        return run.next_at_ms + longest_ms(Run(run.slot, run.times), board.family)
    passes_ms = sum(frame.duration_ms for frame in frames) * max(run.times - run.loops_done - 1, 0)
    return run.next_at_ms + sum(frame.duration_ms for frame in frames[run.next :]) + passes_ms


def begin(motion: Motion, wanted: Run, at_ms: float, board: KnownBoard, ends_to_hear: int = 1) -> Motion:
    """A run that begins at `at_ms`."""
    frames = board.played_frames(wanted.slot)
    ends = ends_to_hear + (1 if owes_end(motion, at_ms, board.family) else 0)
    if frames is None:
        return running_unknown(motion, wanted.slot, ends, at_ms + longest_ms(wanted, board.family))
    run = DeadlineRun(wanted.slot, at_ms, len(frames), 0, at_ms, at_ms, wanted.times, 0, ends)
    return replace(motion, unreported_end_ms=-inf, run=run)


def is_empty(slot: int, board: KnownBoard) -> bool:
    """Running it does nothing, and the board says nothing of it (S44)."""
    frames = board.played_frames(slot)
    return frames is not None and not frames


def request_during(motion: Motion, run: DeadlineRun, wanted: Run, at_ms: float, board: KnownBoard) -> Motion:
    """While another group runs: its length is overwritten, whether or not the request takes effect (S45,
    S46).
    """
    frames = board.played_frames(wanted.slot)
    if frames is None:
        longest = max(longest_ms(wanted, board.family), longest_ms(Run(run.slot, run.times), board.family))
        return running_unknown(motion, None, until_ms=at_ms + longest)
    times = wanted.times if wanted.slot == run.slot else run.times
    return replace(motion, run=replace(run, total=len(frames), times=times))


def begin_frame(motion: Motion, run: DeadlineRun, board: KnownBoard) -> Motion:
    """Behind the last stored frame is erased flash: the run ends there without a report (S35, S46)."""
    frames = board.played_frames(run.slot)
    if frames is None:
        longest = longest_ms(Run(run.slot, run.times), board.family)
        return running_unknown(motion, run.slot, run.ends_to_hear, run.next_at_ms + longest)
    if run.next >= len(frames):
        return replace(motion, run=None)
    frame, family = frames[run.next], board.family
    end_ms = run.next_at_ms + board_duration_ms(frame.duration_ms, family)
    order = Order("frame", frame.targets, run.next_at_ms, end_ms, motion.tracks)
    recent = ordered(motion.recent, order, family)
    tracks = retarget(motion.tracks, frame.targets, frame.duration_ms, run.next_at_ms, family)
    unrest = [motion.restless_until_ms, motion.inherited_until_ms]
    if frame.targets:
        unrest = [unrest_after(each, frame.duration_ms, run.next_at_ms, family) for each in unrest]
    return replace(
        motion,
        recent=recent,
        tracks=contested(tracks, recent, family, run.requested_at_ms),
        restless_until_ms=unrest[0],
        inherited_until_ms=unrest[1],
        # The raw time, not the one the servos were given (S43).
        run=replace(run, next=run.next + 1, next_at_ms=run.next_at_ms + frame.duration_ms),
    )


def end_pass(motion: Motion, run: DeadlineRun, board: KnownBoard) -> Motion:
    """Loops done while endless are not counted (S45)."""
    loops_done = run.loops_done if run.times == 0 else run.loops_done + 1
    if run.times != 0 and loops_done >= run.times:
        return end_run(motion, run, board)
    # Without any time it goes round as fast as the board's loop, and it is unknown how fast that is.
    if run.next_at_ms == run.pass_at_ms:
        longest = longest_ms(Run(run.slot, run.times), board.family)
        return running_unknown(motion, run.slot, run.ends_to_hear, run.next_at_ms + longest)
    return replace(motion, run=replace(run, next=0, pass_at_ms=run.next_at_ms, loops_done=loops_done))


def is_chained(slot: int | None, board: KnownBoard) -> bool:
    """The next one is played once (S49), unless there is none."""
    chained_slot = board.family.motion.chained_slot
    if chained_slot is None or slot not in (None, chained_slot):
        return False
    return not is_empty(chained_slot + 1, board)


def end_run(motion: Motion, run: DeadlineRun, board: KnownBoard) -> Motion:
    ended_motion = replace(motion, run=None)
    if not is_chained(run.slot, board):
        return replace(ended_motion, unreported_end_ms=run.next_at_ms)
    # Its own end, still to be heard, and the next one's.
    at_ms = run.next_at_ms + BARE_PACKET_MS
    return begin(ended_motion, Run(run.slot + 1, 1), at_ms, board, run.ends_to_hear + 1)


class Deadlines:
    def request(self, motion: Motion, request: Run, at_ms: float, board: KnownBoard) -> Motion:
        run = motion.run
        if is_empty(request.slot, board):
            return motion
        if run is not None and not isinstance(run, DeadlineRun):
            until_ms = run.until_ms if isinstance(run, UnknownRun) else run.end_ms
            return running_unknown(
                motion, None, until_ms=max(until_ms, at_ms + longest_ms(request, board.family))
            )
        preempts = request.slot == ESTIMATE.preemptive_slot and (
            run is None or run.slot != ESTIMATE.preemptive_slot
        )
        if run is not None and not preempts:
            return request_during(motion, run, request, at_ms, board)
        return begin(motion, request, at_ms + announcement_ms(board.family), board)

    def advance(self, motion: Motion, now_ms: float, board: KnownBoard) -> Motion:
        while isinstance(run := motion.run, DeadlineRun) and run.next_at_ms <= now_ms:
            step = begin_frame if run.next < run.total else end_pass
            motion = step(motion, run, board)
        return motion

    def stop(self, motion: Motion, at_ms: float, board: KnownBoard) -> Motion:
        """The frame in progress continues to its end (S50), and none begins behind it."""
        return replace(
            motion,
            run=None,
            tracks=stopped_before(motion.tracks, motion.recent, at_ms, board.family),
            recent=tuple(order for order in motion.recent if order.by == "move"),
        )

    def interrupt(self, motion: Motion, _at_ms: float) -> Motion:
        return motion

    def ended(self, motion: Motion, board: KnownBoard) -> Motion:
        """The board knows better than our clock; but each end it reports is only one of those it owes."""
        run = motion.run
        if run is None:
            return replace(motion, unreported_end_ms=-inf)
        if isinstance(run, PolledRun):
            return motion
        if run.ends_to_hear > 1:
            return replace(motion, run=replace(run, ends_to_hear=run.ends_to_hear - 1))
        chained_slot = board.family.motion.chained_slot
        if chained_slot is None or not is_chained(run.slot, board):
            return replace(motion, run=None)
        until_ms = run.until_ms if isinstance(run, UnknownRun) else inf
        return running_unknown(motion, chained_slot + 1, until_ms=until_ms)

    def pass_ms(self, frames: Sequence[Frame]) -> float:
        return sum(frame.duration_ms for frame in frames)


deadlines = Deadlines()
