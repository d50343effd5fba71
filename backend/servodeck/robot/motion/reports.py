"""Effects of the board's reports on the motion: answers, positions, the start and the end of groups. Knows
reports; motion.py has the effects of commands. Twin of shared/src/motion/reports.ts.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from servodeck.protocol.families import Family
from servodeck.protocol.timings import ESTIMATE
from servodeck.protocol.values import AllPositions, Positions, Report, Run, RunStarted, ServoTarget
from servodeck.robot.motion.deadlines import longest_ms
from servodeck.robot.motion.model import (
    DeadlineRun,
    KnownBoard,
    Motion,
    after_positions,
    only_released,
    running_unknown,
)
from servodeck.robot.motion.motion import advance, playback_of, restless
from servodeck.robot.motion.tracks import last_end_ms, stands


def reports_end(family: Family) -> bool:
    """A board that says when it takes a run also says when the group has ended (S18, S48, X1)."""
    return "run" in family.answers or family.run_reports_name_slot


def after_report(motion: Motion, report: Report, at_ms: float, board: KnownBoard) -> Motion:
    """After the board sent it at `at_ms`; the end of a group is `after_end`."""
    current = advance(motion, at_ms, board)
    if isinstance(report, RunStarted):
        return after_start(current, report, at_ms, board)
    answered = after_answer(current, type(report), at_ms, board)
    if isinstance(report, Positions | AllPositions):
        return after_positions_report(answered, report.positions, at_ms)
    return answered


def after_positions_report(motion: Motion, positions: Sequence[ServoTarget], at_ms: float) -> Motion:
    """It read them a while ago: what may have moved meanwhile it may have read on its way."""
    if motion.run is not None:
        return motion
    if at_ms < motion.restless_until_ms + ESTIMATE.longest_deafness_ms:
        # Without torque it is on no way.
        free = only_released(motion.readings)
        at_rest = [each for each in positions if each.servo in free]
    else:
        moving = {servo for servo, track in motion.tracks.items() if not stands(track, at_ms)}
        at_rest = [each for each in positions if each.servo not in moving]
    return replace(motion, readings=after_positions(motion.readings, at_rest))


def after_answer(motion: Motion, report: type[Report], at_ms: float, board: KnownBoard) -> Motion:
    """What came while it was deaf it takes up only now: until that is done the next packet may be dropped
    (S9), or it is deaf again.
    """
    if report not in motion.answers_owed:
        return motion
    index = motion.answers_owed.index(report)
    owed = motion.answers_owed[:index] + motion.answers_owed[index + 1 :]
    # It took up what was sent behind the cut packet, so that one is over.
    if owed:
        return replace(motion, answers_owed=owed, may_swallow=0)
    deaf_until_ms = at_ms + board.family.service_gap_ms if motion.may_hold_packet else -inf
    return replace(motion, answers_owed=(), deaf_until_ms=deaf_until_ms, may_hold_packet=False, may_swallow=0)


def after_start(motion: Motion, report: RunStarted, at_ms: float, board: KnownBoard) -> Motion:
    """By our own command a moment ago, or by a person at the board; then its time is not known to the
    tick.
    """
    run, slot = motion.run, report.slot
    if isinstance(run, DeadlineRun) and run.slot == slot and run.next <= 1 and run.loops_done == 0:
        return motion
    until_ms = at_ms + longest_ms(Run(slot, report.times), board.family)
    return running_unknown(motion, slot, until_ms=until_ms)


def after_end(motion: Motion, slot: int | None, at_ms: float, board: KnownBoard) -> Motion:
    """After a group has ended by itself, its last frame with it: the one in `slot`, or None where
    the board does not report which.
    """
    current = advance(motion, at_ms, board)
    # Reported so late that the next one runs already.
    if isinstance(current.run, DeadlineRun) and slot is not None and slot != current.run.slot:
        return current
    return restless(
        current, playback_of(board).ended(current, board), at_ms, last_frame_ms(current, at_ms, board)
    )


def last_frame_ms(motion: Motion, at_ms: float, board: KnownBoard) -> float:
    """Its last frame is over with it; but a move that left meanwhile has re-timed what that frame moves
    (S26).
    """
    is_shared = board.family.motion.timing == "shared"
    return ESTIMATE.last_ticks_ms + (last_end_ms(motion.tracks, at_ms) - at_ms if is_shared else 0)


def after_cut(motion: Motion, at_ms: float, board: KnownBoard) -> Motion:
    """After the group was stopped, or is taken to have ended: its frame in progress continues
    (S50).
    """
    current = advance(motion, at_ms, board)
    return restless(current, replace(current, run=None), at_ms)
