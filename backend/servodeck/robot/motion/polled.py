"""Groups without deadlines: LeArm looks now and then whether all servos have arrived, then begins the next
frame (L6-L11). That moment is not known within a tick, so of a group only the first frame is known, and
where it ends. Knows runs; no servo's way. Twin of shared/src/motion/polled.ts.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf

from servodeck.protocol.timings import ESTIMATE
from servodeck.protocol.values import Frame, Run
from servodeck.robot.motion.model import KnownBoard, Motion, PolledRun, running_unknown
from servodeck.robot.motion.tracks import (
    LONGEST_MOVE_MS,
    Track,
    Tracks,
    board_duration_ms,
    frozen,
    last_end_ms,
    retarget,
)
from servodeck.value import value

POLL_MS = ESTIMATE.poll_ms
STEP_MS = ESTIMATE.poll_step_ms
SPARE_POLLS = ESTIMATE.spare_polls
NOWHERE = (inf, inf)


def latest_ms(frame: Frame) -> float:
    """By then the next frame has begun; the first servo may not have moved before."""
    return (math.ceil(frame.duration_ms / STEP_MS) + SPARE_POLLS) * POLL_MS


def surely_ms(frame: Frame, board: KnownBoard) -> float:
    """A frame that moves nothing is over at once."""
    return board_duration_ms(frame.duration_ms, board.family) if frame.targets else 0


def last_targets(frames: Sequence[Frame]) -> dict[int, int]:
    return {target.servo: target.position for frame in frames for target in frame.targets}


def passes_of(times: int) -> int:
    """One byte, and 0 means once (L6)."""
    return times & 0xFF or 1


@value
class Order:
    slot: int
    first: Frame
    behind: Sequence[Frame]
    passes_left: int
    frames: Sequence[Frame]


def order_of_play(slot: int, frames: Sequence[Frame], times: int, *, skips_first: bool) -> Order | None:
    """The frames of a request: the first, those behind it in its pass, and how many whole passes follow; None
    for none.
    """
    if not frames:
        return None
    # Skipping the only frame skips a pass.
    index = 1 % len(frames) if skips_first else 0
    passes_left = passes_of(times) - (2 if skips_first and index == 0 else 1)
    if passes_left < 0:
        return None
    return Order(slot, frames[index], tuple(frames[index + 1 :]), passes_left, frames)


def begin(motion: Motion, order: Order, at_ms: float, board: KnownBoard) -> Motion:
    """Before the first frame, too, it may wait until all servos have arrived."""
    first = order.first
    rested_ms = max(last_end_ms(motion.tracks, at_ms), motion.restless_until_ms)
    if rested_ms > at_ms:
        return replace(motion, run=run_of(order, (first,), at_ms, rested_ms, at_ms, board))
    tracks = retarget(motion.tracks, first.targets, first.duration_ms, at_ms, board.family)
    arrived_ms = last_end_ms(tracks, at_ms)
    surely_until_ms = at_ms + surely_ms(first, board)
    run = run_of(order, (), arrived_ms, arrived_ms, surely_until_ms, board)
    return replace(motion, tracks=tracks, run=run)


def begin_either(motion: Motion, whole: Order, less: Order | None, at_ms: float, board: KnownBoard) -> Motion:
    """It may play `less` or not: it moves its servos from now on, as long as `whole` takes, to the
    end of one or the other.
    """
    rested_ms = max(last_end_ms(motion.tracks, at_ms), motion.restless_until_ms)

    def run_for(order: Order) -> PolledRun:
        return run_of(order, (order.first,), at_ms, rested_ms, at_ms, board)

    run = run_for(whole)
    shorter = run_for(less) if less else None
    unsure = {servo for servo, to in run.rest.items() if not shorter or shorter.rest.get(servo) != to}
    surely_until_ms = shorter.surely_until_ms if shorter else at_ms
    either = replace(run, rest_at_ms=at_ms, surely_until_ms=surely_until_ms, unsure=frozenset(unsure))
    return replace(motion, run=either)


def run_of(
    order: Order,
    ahead: tuple[Frame, ...],
    rest_at_ms: float,
    counted_ms: float,
    surely_so_far_ms: float,
    board: KnownBoard,
) -> PolledRun:
    """`ahead` and all behind it come somewhen after `rest_at_ms`, and no later than counted from
    `counted_ms`.
    """
    this_pass = (*ahead, *order.behind)

    def total(time_of: Callable[[Frame], float]) -> float:
        return sum(map(time_of, this_pass)) + order.passes_left * sum(map(time_of, order.frames))

    return PolledRun(
        slot=order.slot,
        rest=last_targets((*this_pass, *order.frames) if order.passes_left > 0 else this_pass),
        rest_at_ms=rest_at_ms,
        surely_until_ms=surely_so_far_ms + total(lambda frame: surely_ms(frame, board)),
        rested_ms=counted_ms,
        longest_ms=max(surely_ms(frame, board) for frame in order.frames),
        end_ms=counted_ms + SPARE_POLLS * POLL_MS + total(latest_ms),
    )


def blur(motion: Motion, run: PolledRun) -> Motion:
    """Behind the first frame each servo is somewhere until the run is over for sure."""
    duration_ms = run.end_ms - run.rest_at_ms
    ways = {
        servo: Track(None, to, run.rest_at_ms, duration_ms, *(NOWHERE if servo in run.unsure else ()))
        for servo, to in run.rest.items()
    }
    return replace(motion, tracks={**motion.tracks, **ways}, run=replace(run, is_blurred=True))


def cut(motion: Motion, at_ms: float) -> Motion:
    """No further frame begins; which one is in progress is known of the first alone."""
    run = motion.run
    if run is None:
        return motion
    if not isinstance(run, PolledRun):
        return replace(motion, run=None, restless_until_ms=at_ms + LONGEST_MOVE_MS)
    if at_ms < run.rest_at_ms or not run.rest:
        return replace(motion, run=None)
    until_ms = min(run.end_ms, max(run.rested_ms, at_ms + run.longest_ms))
    return replace(motion, run=None, tracks={**motion.tracks, **lost_ways(run, until_ms)})


def lost_ways(run: PolledRun, until_ms: float) -> Tracks:
    """On their way to one of its places, it is unknown to which."""
    duration_ms = until_ms - run.rest_at_ms
    return {servo: Track(None, to, run.rest_at_ms, duration_ms, *NOWHERE) for servo, to in run.rest.items()}


class Polled:
    def request(self, motion: Motion, request: Run, at_ms: float, board: KnownBoard) -> Motion:
        frames = board.played_frames(request.slot)
        after = replace(motion, skips_first="no")
        # What becomes of a run when the next one comes has not been read in the firmware.
        if frames is None or motion.run is not None:
            return running_unknown(after, request.slot, until_ms=at_ms + self._longest_ms(request, board))
        order = order_of_play(request.slot, frames, request.times, skips_first=motion.skips_first == "yes")
        if order is None:
            return after
        if motion.skips_first != "maybe":
            return begin(after, order, at_ms, board)
        less = order_of_play(request.slot, frames, request.times, skips_first=True)
        return begin_either(after, order, less, at_ms, board)

    def advance(self, motion: Motion, now_ms: float, _board: KnownBoard) -> Motion:
        run = motion.run
        if not isinstance(run, PolledRun) or now_ms < run.rest_at_ms:
            return motion
        blurred = motion if run.is_blurred else blur(motion, run)
        return blurred if now_ms < run.end_ms else replace(blurred, run=None)

    def stop(self, motion: Motion, at_ms: float, board: KnownBoard) -> Motion:
        stopped = cut(motion, at_ms)
        return replace(stopped, tracks=frozen(stopped.tracks, board.family, at_ms))

    def interrupt(self, motion: Motion, at_ms: float) -> Motion:
        """The group ends without a report (L8), and leaves its place in the frames behind (L11)."""
        run = motion.run
        if run is None:
            return motion
        surely = isinstance(run, PolledRun) and at_ms < run.surely_until_ms
        return replace(cut(motion, at_ms), skips_first="yes" if surely else "maybe")

    def ended(self, motion: Motion, _board: KnownBoard) -> Motion:
        """It reports no end (L6)."""
        return motion

    def pass_ms(self, frames: Sequence[Frame]) -> float:
        return sum(map(latest_ms, frames))

    def _longest_ms(self, request: Run, board: KnownBoard) -> float:
        longest = latest_ms(Frame(LONGEST_MOVE_MS, ()))
        return passes_of(request.times) * board.family.frames_per_group * longest


polled = Polled()
