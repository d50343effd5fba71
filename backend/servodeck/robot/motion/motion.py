"""The present position of each servo, from the commands that left the wire and their times. One pure value
and functions over it: no clock, no link. How a family moves is data (`Family.motion`), how it plays groups is
deadlines.py or polled.py.

None means that it cannot be known: before the end of a servo's first move unless the board reported where it
stands (model.py), while a group runs whose frames are not ours, behind the first frame of LeArm's groups
(L7), after a release, in a move that flash work froze (S29, S41), and after a command that came when the
board may have been deaf. Twin of shared/src/motion/motion.ts; shared/protocol/vectors/halts.json holds both
to each other.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from math import inf

from servodeck.protocol.decoder import HEADER
from servodeck.protocol.families import Family
from servodeck.protocol.timings import ESTIMATE
from servodeck.protocol.values import (
    AllPositions,
    Battery,
    Command,
    Download,
    Erase,
    Erased,
    Frame,
    FrameStored,
    Move,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Release,
    Report,
    Run,
    RunAccepted,
    ServoTarget,
    Stop,
    Version,
)
from servodeck.robot.motion.deadlines import deadlines, end_of, longest_ms
from servodeck.robot.motion.model import (
    Courses,
    DeadlineRun,
    KnownBoard,
    Motion,
    Playback,
    UnknownRun,
    after_order,
    held_at,
    only_released,
    running_unknown,
    without_servos,
)
from servodeck.robot.motion.parts import carries_all, re_timed
from servodeck.robot.motion.polled import polled
from servodeck.robot.motion.tracks import (
    LONGEST_MOVE_MS,
    Order,
    Track,
    Tracks,
    board_duration_ms,
    contested,
    end_ms,
    lengthened,
    only,
    ordered,
    retarget,
    standing_at,
    stands,
    starting_at,
    stopped_before,
    torn,
    unrest_after,
)

PLAYBACKS: dict[str, Playback] = {"deadlines": deadlines, "polled": polled}

ANSWERS: dict[type[Command], type[Report]] = {
    Download: FrameStored,
    Erase: Erased,
    ReadPositions: Positions,
    ReadAllPositions: AllPositions,
    ReadVersion: Version,
    ReadOffsets: Offsets,
    ReadBattery: Battery,
    Run: RunAccepted,
}
# These keep a board that answers them from its servos and packets until then: flash work, slow talk (S41, X7,
# L13).
DEAFENING = frozenset(ANSWERS) - {ReadBattery, Run}
# What LEN does not count, and the whole of a packet without parameters.
HEAD_BYTES, SHORTEST_PACKET_BYTES = 2, 4


def playback_of(board: KnownBoard) -> Playback:
    return PLAYBACKS[board.family.motion.groups]


def advance(motion: Motion, now_ms: float, board: KnownBoard) -> Motion:
    """The same motion with everything that was due by `now_ms` done. Call before reading it."""
    if isinstance(motion.run, UnknownRun) and now_ms >= motion.run.until_ms:
        return with_planned_courses(replace(motion, run=None))
    if motion.run is not None and not isinstance(motion.run, UnknownRun):
        motion = replace(motion, ran_until_ms=now_ms)
    return with_planned_courses(playback_of(board).advance(motion, now_ms, board))


def with_planned_courses(motion: Motion) -> Motion:
    """What is left of a move is not sent while a group may move its servo, nor where its place is lost."""

    def is_planned(servo: int) -> bool:
        track = motion.tracks.get(servo)
        return motion.run is None and track is not None and track.to_leeway < inf

    planned = {servo: course for servo, course in motion.courses.items() if is_planned(servo)}
    return motion if len(planned) == len(motion.courses) else replace(motion, courses=planned)


def hears(motion: Motion, at_ms: float) -> bool:
    """False where the board may be too busy to take up what it is sent, or takes it for the rest of a cut
    packet.
    """
    return at_ms >= motion.deaf_until_ms and motion.may_swallow == 0


def after_command(motion: Motion, command: Command, at_ms: float, board: KnownBoard) -> Motion:
    """After the last bit of `command` left the wire at `at_ms`."""
    current = advance(motion, at_ms, board)
    is_heard = hears(current, at_ms)
    if is_heard:
        after = restless(current, after_heard(current, command, at_ms, board), at_ms)
    else:
        after = maybe_swallowed(after_unheard(current, command, at_ms, board), at_ms)
    return replace(
        after,
        courses=courses_after(after.courses, command, at_ms, board.family),
        readings=after_order(after.readings, command, is_heard=is_heard),
    )


def courses_after(courses: Courses, command: Command, at_ms: float, family: Family) -> Courses:
    """What is left of a move ends with a stop, a run, a release, and with a newer move of its servo. Where a
    move re-times servos that it does not name (S26), the rest of theirs comes as much later.
    """
    match command:
        case Stop() | Run() | Release():
            return {}
        case Move(duration_ms, targets) if courses:
            sent = {target.servo: target.position for target in targets}
            until_ms = at_ms + board_duration_ms(duration_ms, family) if carries_all(family) else -inf
            return {
                servo: course if servo in sent else re_timed(course, until_ms)
                for servo, course in courses.items()
                if sent.get(servo, course.sent_to) == course.sent_to
            }
    return courses


def maybe_swallowed(motion: Motion, at_ms: float) -> Motion:
    """The packet that is completed then may move any servo to any position."""
    if motion.may_swallow == 0:
        return motion
    return replace(
        motion,
        tracks={},
        readings=only_released(motion.readings),
        may_swallow=motion.may_swallow - 1,
        restless_until_ms=max(at_ms, motion.deaf_until_ms) + LONGEST_MOVE_MS,
    )


def after_cut_packet(motion: Motion, family: Family) -> Motion:
    """After one of our packets was cut. Where no filler ends it (S7) the board waits for its rest, and takes
    what comes next for that.
    """
    if family.resync_filler is not None:
        return motion
    if family.left_over_bytes < HEADER:
        # It takes a header for LEN, which is more than it has room for: only an answer says that it survived
        # that (L3).
        return replace(motion, may_swallow=inf)
    # Cut in its head, it gets the first header of the next one for its LEN.
    longest_bytes = max(HEADER, family.max_length) + HEAD_BYTES
    return replace(motion, may_swallow=math.ceil(longest_bytes / SHORTEST_PACKET_BYTES))


def after_filler(motion: Motion, cut: Move, at_ms: float, family: Family) -> Motion:
    """The filler, whose last bit left at `at_ms`, may have completed that move (S2): it begins only now."""
    ends_ms = at_ms + board_duration_ms(cut.duration_ms, family) + ESTIMATE.last_ticks_ms
    return replace(motion, restless_until_ms=max(motion.restless_until_ms, ends_ms))


def restless(before: Motion, after: Motion, at_ms: float, for_ms: float = LONGEST_MOVE_MS) -> Motion:
    """The last move of an unknown group may last that long after its end."""
    if not isinstance(before.run, UnknownRun) or after.run is not None:
        return after
    return replace(after, restless_until_ms=max(after.restless_until_ms, at_ms + for_ms))


def after_heard(motion: Motion, command: Command, at_ms: float, board: KnownBoard) -> Motion:
    playback = playback_of(board)
    if isinstance(command, Run):
        return playback.request(motion, command, at_ms, board)
    if isinstance(command, Stop):
        return playback.stop(motion, at_ms, board)
    cut = playback.interrupt(motion, at_ms)
    if isinstance(command, Move):
        return moved(cut, command, at_ms, board)
    if isinstance(command, Release):
        return released(cut, command.servos)
    is_answered = command.kind in board.family.answers
    return deafened(cut, command, at_ms, board) if is_answered and type(command) in DEAFENING else cut


def moved(motion: Motion, move: Move, at_ms: float, board: KnownBoard) -> Motion:
    end_ms = at_ms + board_duration_ms(move.duration_ms, board.family)
    order = Order("move", move.targets, at_ms, end_ms, motion.tracks)
    recent = ordered(motion.recent, order, board.family)
    # A frame of that group may overrule it at any time.
    is_sure = not isinstance(motion.run, UnknownRun)
    tracks = retarget(
        with_start(motion, move.targets),
        move.targets,
        move.duration_ms,
        at_ms,
        board.family,
        is_sure=is_sure,
    )
    return replace(
        motion,
        recent=recent,
        tracks=contested(tracks, recent, board.family),
        restless_until_ms=unrest_after(motion.restless_until_ms, move.duration_ms, at_ms, board.family),
        inherited_until_ms=unrest_after(motion.inherited_until_ms, move.duration_ms, at_ms, board.family),
    )


def with_start(motion: Motion, targets: Sequence[ServoTarget]) -> Tracks:
    """Those of the targets that stand where the board reported begin there."""
    readings = {target.servo: held_at(motion.readings, target.servo) for target in targets}
    at_rest = {servo: standing_at(at) for servo, at in readings.items() if at is not None}
    return {**motion.tracks, **at_rest}


def released(motion: Motion, servos: Collection[int]) -> Motion:
    """It drops, who knows where to."""
    return without_servos(motion, servos)


def deafened(motion: Motion, command: Command, at_ms: float, board: KnownBoard) -> Motion:
    """Servos at rest stay; those under way freeze and jump (S29), but they arrive. A group continues, at an
    unknown time.
    """
    deaf_until_ms = at_ms + ESTIMATE.longest_deafness_ms
    deaf = replace(
        motion, deaf_until_ms=deaf_until_ms, answers_owed=(ANSWERS[type(command)],), may_hold_packet=False
    )
    if motion.run is not None:
        until_ms = latest_end_ms(motion, board) + ESTIMATE.longest_deafness_ms
        return running_unknown(deaf, None, until_ms=until_ms)
    return replace(deaf, tracks=held_up(motion.tracks, at_ms, deaf_until_ms))


def held_up(tracks: Tracks, at_ms: float, until_ms: float) -> dict[int, Track]:
    """Those under way arrive, but from where and when is unknown: by then at the latest."""
    return {
        servo: track if stands(track, at_ms) else lengthened(track, until_ms)
        for servo, track in tracks.items()
    }


def latest_end_ms(motion: Motion, board: KnownBoard) -> float:
    """By then the run has ended, if nothing holds it up; -inf without a run."""
    match motion.run:
        case None:
            return -inf
        case UnknownRun(until_ms=until_ms):
            return until_ms
        case DeadlineRun() as run:
            return end_of(run, board)
        case run:
            return run.end_ms


def after_unheard(motion: Motion, command: Command, at_ms: float, board: KnownBoard) -> Motion:
    """It is dropped or comes late, when the board hears again."""
    family = board.family
    answer = ANSWERS.get(type(command))
    owed = (answer,) if answer and command.kind in family.answers else ()
    later = replace(
        motion,
        deaf_until_ms=at_ms + ESTIMATE.longest_deafness_ms if owed else motion.deaf_until_ms,
        answers_owed=(*motion.answers_owed, *owed),
        may_hold_packet=True,
    )
    if isinstance(command, Run):
        until_ms = later.deaf_until_ms + longest_ms(command, family)
        # Where nothing else runs, its end will be the end of that group.
        slot = command.slot if motion.run is None else None
        return running_unknown(later, slot, until_ms=max(until_ms, latest_end_ms(motion, board)))
    if isinstance(command, Move):
        return perhaps_moved(later, command, at_ms, family)
    if isinstance(command, Stop):
        return perhaps_stopped(later, at_ms, family)
    tracks: Tracks = held_up(later.tracks, at_ms, later.deaf_until_ms)
    if isinstance(command, Release):
        tracks = perhaps_released(tracks, command.servos, at_ms)
    return replace(later, tracks=tracks)


def perhaps_moved(motion: Motion, move: Move, at_ms: float, family: Family) -> Motion:
    """It may not have moved them, and where the board re-times every servo all that was under way may be
    later by it (S26).
    """
    is_shared, traits = family.motion.timing != "perServo", family.motion
    until_ms = motion.deaf_until_ms + board_duration_ms(move.duration_ms, family)
    until_ms += traits.tick_ms + traits.talk_ms
    tracks = held_up(motion.tracks, at_ms, until_ms if is_shared else motion.deaf_until_ms)
    for target in move.targets:
        track = motion.tracks.get(target.servo)
        is_there = track and stands(track, at_ms) and track.to == target.position and track.to_leeway == 0
        if not is_there:
            tracks[target.servo] = torn(track or starting_at(target.position, at_ms), until_ms)

    def unrest(restless_ms: float) -> float:
        return max(restless_ms, until_ms) if is_shared and restless_ms > at_ms else restless_ms

    return replace(
        motion,
        tracks=tracks,
        restless_until_ms=unrest(motion.restless_until_ms),
        inherited_until_ms=unrest(motion.inherited_until_ms),
    )


def perhaps_stopped(motion: Motion, at_ms: float, family: Family) -> Motion:
    """What a stop halts (L9) may continue, and a frame that it keeps from beginning may have begun."""
    tracks = stopped_before(motion.tracks, motion.recent, at_ms, family)
    for servo in family.motion.halted_by_stop:
        if (track := tracks.get(servo)) and not stands(track, at_ms):
            tracks[servo] = torn(track, motion.deaf_until_ms)
    return replace(motion, tracks=tracks)


def perhaps_released(tracks: Tracks, servos: Collection[int], at_ms: float) -> Tracks:
    """Those under way drop or arrive."""
    others = only(tracks, lambda track, servo: not (servo in servos and stands(track, at_ms)))
    return {
        servo: torn(track, end_ms(track)) if servo in servos else track for servo, track in others.items()
    }


def pass_ms(frames: Sequence[Frame], board: KnownBoard) -> float:
    """The longest duration of one pass of a group."""
    return playback_of(board).pass_ms(frames)
