"""The motion estimate as a value, with the positions that the board has reported for servos at rest, and what
a way of playing groups has to answer; and what can be read of it. Twin of shared/src/motion/model.ts.

Knows what can be known of a board's motion; no rule of any board: those are tracks.py, deadlines.py and
polled.py.
"""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import field, replace
from math import inf
from typing import Literal, Protocol

from servodeck.protocol.families import Family
from servodeck.protocol.timings import ESTIMATE
from servodeck.protocol.values import Command, Frame, Move, Release, Report, Run, ServoTarget
from servodeck.robot.motion.tracks import (
    LONGEST_MOVE_MS,
    Order,
    Tracks,
    doubted,
    end_ms,
    last_end_ms,
    leeway_of,
    only,
    position_of,
    share,
)
from servodeck.value import value


@value
class Reading:
    # None: the board has not reported it since.
    position: int | None
    # It has no torque: hands may have turned it since, and its next move starts from anywhere.
    is_released: bool = False


Readings = Mapping[int, Reading]

RELEASED = Reading(None, is_released=True)


def after_positions(readings: Readings, positions: Sequence[ServoTarget]) -> Readings:
    new = {
        each.servo: Reading(each.position, each.servo in readings and readings[each.servo].is_released)
        for each in positions
    }
    return {**readings, **new}


def after_order(readings: Readings, command: Command, *, is_heard: bool) -> Readings:
    """After the command left the wire; `is_heard` False where the board may not have taken it up."""
    match command:
        case Release(servos):
            return {**readings, **dict.fromkeys(servos, RELEASED)}
        case Run():
            return only_released(readings)
        case Move(_, targets):
            moved = {target.servo for target in targets}
            still_free = moved & only_released(readings).keys() if not is_heard else set[int]()
            rest = {servo: reading for servo, reading in readings.items() if servo not in moved}
            return {**rest, **dict.fromkeys(still_free, RELEASED)}
    return readings


def only_released(readings: Readings) -> dict[int, Reading]:
    """Earlier reports of the board are not valid any more."""
    return {servo: RELEASED for servo, reading in readings.items() if reading.is_released}


def held_at(readings: Readings, servo: int) -> int | None:
    """Its reported position; None where there is none, or where a person may have turned it since."""
    reading = readings.get(servo)
    return None if reading is None or reading.is_released else reading.position


@value
class UnknownRun:
    """A group that may move anything at any time: its frames are not ours, or its time cannot be computed.
    `ends_to_hear`: how many ends the board will report until nothing runs any more (S49). `until_ms`: it has
    ended by then, as long as it counts its repeats.
    """

    slot: int | None
    ends_to_hear: int = 1
    until_ms: float = inf


@value
class DeadlineRun:
    """`next` is the frame that begins at `next_at_ms`; `total` what the board takes for the group's length
    (S46). `times` 0: until stopped. What the board heard before `requested_at_ms` is taken up already.
    """

    slot: int
    requested_at_ms: float
    total: int
    next: int
    next_at_ms: float
    pass_at_ms: float
    times: int
    loops_done: int
    ends_to_hear: int


@value
class PolledRun:
    """Known until `rest_at_ms`; behind it `rest` is where the servos of the later frames end, somewhen before
    `end_ms`. `rested_ms`: what moved before the first frame has arrived by then; no frame takes longer than
    `longest_ms`. `unsure`: servos of `rest` that may end elsewhere. `is_blurred`: `rest` stands in the tracks
    already.
    """

    slot: int
    rest: Mapping[int, int]
    rest_at_ms: float
    surely_until_ms: float
    end_ms: float
    rested_ms: float
    longest_ms: float
    unsure: frozenset[int] = frozenset()
    is_blurred: bool = False


AnyRun = UnknownRun | DeadlineRun | PolledRun


@value
class Course:
    """The way that was asked of a servo, linear from `start` (None where it is unknown) at `start_ms` to `to`
    at `end_ms`. The board has been told until `sent_until_ms`, which is its place `sent_to`; the rest leaves
    in later parts (parts.py).
    """

    start: float | None
    to: float
    start_ms: float
    end_ms: float
    sent_until_ms: float
    sent_to: int


Courses = Mapping[int, Course]


@value
class Motion:
    tracks: Tracks = field(default_factory=dict)
    courses: Courses = field(default_factory=dict)
    """Of servos that our orders move, or moved last."""
    readings: Readings = field(default_factory=dict)
    """Of servos without a track."""
    run: AnyRun | None = None
    ran_until_ms: float = -inf
    """A group of known frames ran until then."""
    recent: tuple[Order, ...] = ()
    """Moves and frames of almost now."""
    unreported_end_ms: float = -inf
    """When a group ended by our clock whose end the board has not reported yet."""
    deaf_until_ms: float = -inf
    """Until then the board may be busy with flash or servos, its servos frozen, packets waiting or dropped
    (S9, S41).
    """
    answers_owed: tuple[type[Report], ...] = ()
    """When it has answered all that, it hears again sooner."""
    may_hold_packet: bool = False
    """A packet came while it was deaf, and may wait to be taken up."""
    may_swallow: float = 0
    """So many more packets the board may take for the rest of one that was cut."""
    restless_until_ms: float = -inf
    """Until then a servo we know nothing of may still be on its way."""
    inherited_until_ms: float = -inf
    """Until then what others set in motion before the port was opened may continue. Only STOP reports it."""
    skips_first: Literal["no", "maybe", "yes"] = "no"
    """The next run skips its first frame (L11)."""


class KnownBoard(Protocol):
    """The board as far as it stays the same while it moves."""

    @property
    def family(self) -> Family: ...

    def played_frames(self, slot: int) -> Sequence[Frame] | None:
        """The group with the times it is played with (X3), empty where nothing is stored, or None where
        it is unknown.
        """


class Playback(Protocol):
    """One way of playing groups. Each function gets a motion that is advanced to the time it happens."""

    def request(self, motion: Motion, request: Run, at_ms: float, board: KnownBoard, /) -> Motion: ...

    def advance(self, motion: Motion, now_ms: float, board: KnownBoard, /) -> Motion:
        """Everything that was due by `now_ms` has happened."""

    def stop(self, motion: Motion, at_ms: float, board: KnownBoard, /) -> Motion: ...

    def interrupt(self, motion: Motion, at_ms: float, /) -> Motion:
        """Any other command came."""

    def ended(self, motion: Motion, board: KnownBoard, /) -> Motion:
        """The board reports that a group has ended."""

    def pass_ms(self, frames: Sequence[Frame]) -> float:
        """The longest duration of one pass of a group."""


# Nothing is known: after connecting, and after anything that may have moved the robot behind our back.
UNKNOWN_MOTION = Motion()


def running_unknown(motion: Motion, slot: int | None, ends_to_hear: int = 1, until_ms: float = inf) -> Motion:
    """It is unknown where anything is while that group may run, and behind it; perhaps its slot is empty, and
    the moves continue.
    """
    run = UnknownRun(slot, ends_to_hear, until_ms)
    return replace(motion, tracks=doubted(motion.tracks), readings=only_released(motion.readings), run=run)


def forgotten(motion: Motion, at_ms: float, run_ends_ms: float) -> Motion:
    """Nothing is known any more: the robot may have been moved or the board restarted. A group that ran may
    continue until `run_ends_ms`.
    """
    if motion.run is not None:
        still_ms: float = LONGEST_MOVE_MS
    else:
        still_ms = last_end_ms(motion.tracks, at_ms) - at_ms + ESTIMATE.last_ticks_ms
    return replace(
        UNKNOWN_MOTION,
        readings=only_released(motion.readings),
        run=UnknownRun(None, until_ms=run_ends_ms) if motion.run else None,
        deaf_until_ms=motion.deaf_until_ms,
        may_swallow=motion.may_swallow,
        inherited_until_ms=motion.inherited_until_ms,
        restless_until_ms=max(motion.restless_until_ms, at_ms + still_ms),
        skips_first="maybe",
    )


def inherited(motion: Motion, at_ms: float) -> Motion:
    """The last owner of the port, which was opened at `at_ms`, may have set something in motion."""
    # A question of ours may have ended their group (L8).
    return replace(motion, inherited_until_ms=at_ms + LONGEST_MOVE_MS, skips_first="maybe")


def either_of(one: Motion, other: Motion) -> Motion:
    """Of two forgotten motions it is unknown which it was."""
    return replace(
        one,
        run=one.run or other.run,
        deaf_until_ms=max(one.deaf_until_ms, other.deaf_until_ms),
        restless_until_ms=max(one.restless_until_ms, other.restless_until_ms),
        inherited_until_ms=max(one.inherited_until_ms, other.inherited_until_ms),
    )


def position_at(motion: Motion, servo: int, now_ms: float) -> int | None:
    """Present position of a servo in board units, or None while it is unknown."""
    readings = held_at(motion.readings, servo)
    if readings is not None:
        return readings
    track = motion.tracks.get(servo)
    position = position_of(track, now_ms) if track else None
    return None if position is None else rounded(position)


def rounded(position: float) -> int:
    """Half up, as JavaScript does."""
    return math.floor(position + 0.5)


def leeway_at(motion: Motion, servo: int, now_ms: float, family: Family) -> float:
    """How far off `position_at` may be, in board units: the way of one tick, and more for a servo redirected
    on its way.
    """
    if held_at(motion.readings, servo) is not None:
        return 0
    track = motion.tracks.get(servo)
    return leeway_of(track, now_ms, family) if track else inf


def farthest_from(motion: Motion, servo: int, to: float, now_ms: float, family: Family) -> float:
    """Its largest possible distance from there, in board units."""
    at = position_at(motion, servo, now_ms)
    if at is not None:
        return abs(to - at)
    position, track = family.position, motion.tracks.get(servo)
    if track is None or track.to_leeway == inf:
        return max(to - position.min, position.max - to)
    return abs(to - track.to) + (position.max - position.min) * (1 - share(track, now_ms))


def target_of(motion: Motion, servo: int) -> float | None:
    """The last target of a servo, or None."""
    track = motion.tracks.get(servo)
    if track is None or track.to_leeway == inf:
        return None
    course = motion.courses.get(servo)
    # Its part has left.
    return course.to if course and course.sent_to == track.to else track.to


def without_servos(motion: Motion, servos: Collection[int]) -> Motion:
    """The motion of the others alone."""
    courses = {servo: course for servo, course in motion.courses.items() if servo not in servos}
    tracks = only(motion.tracks, lambda _, servo: servo not in servos)
    return replace(motion, tracks=tracks, courses=courses)


def remaining_ms(motion: Motion, now_ms: float) -> float:
    """Milliseconds until the moves in progress end, with what is still to be sent of them; 0 at rest."""
    ends_ms = [course.end_ms for course in motion.courses.values()]
    return max([last_end_ms(motion.tracks, now_ms), *ends_ms]) - now_ms


def unknown_rest_ms(motion: Motion, but: Collection[int], now_ms: float) -> float:
    """Milliseconds until the other servos have ended whose place is unknown on the way."""
    unknown = only(
        motion.tracks, lambda track, servo: servo not in but and position_of(track, now_ms) is None
    )
    return last_end_ms(unknown, now_ms) - now_ms


def gentle_ms(motion: Motion, servos: Collection[int], now_ms: float, family: Family) -> float:
    """The least duration of a move, so that no servo of unknown position snaps to its target."""
    is_shared = family.motion.timing != "perServo"
    if is_shared and isinstance(motion.run, UnknownRun):
        return inf
    ends_ms = [
        end_ms(track)
        for servo, track in motion.tracks.items()
        if position_of(track, now_ms) is None and (is_shared or servo in servos)
    ]
    restless_ms = motion.restless_until_ms - now_ms if is_shared else 0
    return math.ceil(max([0, restless_ms, *(end - now_ms for end in ends_ms)]))
