"""Long moves leave in parts: each packet sends the servos under way to their places at its end, and the next
one leaves before that end. So a packet for one servo never hastens another, a lost packet costs one part, and
what is left of a move ends by not being sent. Pure: knows ways, times and the family; no clock, no wire. Twin
of shared/src/motion/parts.ts.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

from servodeck.protocol.families import Family
from servodeck.protocol.timings import PARTS, wire_ms
from servodeck.protocol.values import Goal, Move, ServoTarget
from servodeck.robot.motion.model import Course, Courses, Motion, held_at, rounded
from servodeck.robot.motion.tracks import (
    LONGEST_MOVE_MS,
    Track,
    board_duration_ms,
    end_ms,
    position_of,
    stands,
)
from servodeck.value import value

Going = Sequence[tuple[int, Course]]


@value
class ServoOrder:
    """One servo of a move that was asked for."""

    servo: int
    position: int
    duration_ms: float


@value
class Part:
    """`courses` are those behind the packet."""

    move: Move
    courses: Courses


def move_bytes(servo_count: int) -> int:
    return 7 + 3 * servo_count


def carries_all(family: Family) -> bool:
    """Where one new target may change the time of every servo, each packet carries all that are under way
    (S26).
    """
    return family.motion.timing != "perServo"


def interval_ms(servo_count: int, family: Family) -> int:
    """Until the next packet of this size can take effect: shorter moves would make the servo stop and go."""
    return max(family.shortest_move_ms, math.ceil(wire_ms(move_bytes(servo_count)) + family.service_gap_ms))


def part_due_ms(motion: Motion, now_ms: float) -> float:
    """When the next part has to begin to leave; infinite where none follows."""
    way_ms = wire_ms(move_bytes(len(under_way(motion, now_ms))))
    dues = [inf]
    for servo, course in motion.courses.items():
        track = motion.tracks.get(servo)
        if track and is_unfinished(course):
            # Until its place is known again it cannot go on.
            is_known = position_of(track, now_ms) is not None
            dues.append(due_ms(course, way_ms) if is_known else end_ms(track))
    return min(dues)


def due_ms(course: Course, way_ms: float) -> float:
    return course.sent_until_ms - PARTS.seam_ms - way_ms


def next_part(
    motion: Motion,
    orders: Sequence[ServoOrder],
    now_ms: float,
    family: Family,
    servos_per_move: int,
    least_ms: float,
) -> Part | None:
    """The next packet: the new orders, and the servos that have to go on with it. None where there is nothing
    to send now. `least_ms`: no packet is shorter, because a servo of unknown place is on its way; one that
    starts goes in one packet of its full time.
    """
    ordered = {order.servo for order in orders}
    going = [one for one in under_way(motion, now_ms).items() if one[0] not in ordered]
    way_ms = wire_ms(move_bytes(len(going) + len(orders)))
    due = [one for one in going if is_due(one[1], way_ms, now_ms)]
    if not orders and part_due_ms(motion, now_ms) > now_ms + PARTS.grain_ms:
        return None
    carried, left = divided(going, due, servos_per_move - len(orders), family)
    arrives_ms = now_ms + wire_ms(move_bytes(len(orders) + len(carried)))
    courses = {order.servo: course_for(motion, order, arrives_ms) for order in orders}
    courses |= {servo: delayed(course, arrives_ms) for servo, course in carried}
    # A way whose start is unknown cannot be cut, nor one whose part the board may not hear.
    is_heard = arrives_ms >= motion.deaf_until_ms and motion.may_swallow == 0
    whole_ms = [each.end_ms - arrives_ms for each in courses.values() if each.start is None or not is_heard]
    least_ms = max([least_ms, *whole_ms])
    is_joined = bool(carried)
    duration_ms = part_ms(list(courses.values()), left, arrives_ms, family, least_ms, is_joined=is_joined)
    span = Span(arrives_ms, duration_ms, arrives_ms + board_duration_ms(duration_ms, family))
    sent = {servo: sent_on(course, span) for servo, course in courses.items()}
    targets = tuple(ServoTarget(servo, course.sent_to) for servo, course in sent.items())
    servos = {servo for servo, _ in going}
    others = {
        servo: course for servo, course in motion.courses.items() if servo in servos or is_unfinished(course)
    }
    goals = tuple(
        Goal(servo, round(course.to), math.ceil(course.end_ms - arrives_ms))
        for servo, course in sent.items()
        if is_unfinished(course)
    )
    return Part(Move(duration_ms, targets, goals), {**others, **sent})


def is_due(course: Course, way_ms: float, now_ms: float) -> bool:
    return is_unfinished(course) and due_ms(course, way_ms) <= now_ms + PARTS.seam_slack_ms


def divided(going: Going, due: Going, room: int, family: Family) -> tuple[Going, Sequence[Course]]:
    """Those that the packet carries, and those that it may re-time without naming them, because there is no
    room.
    """
    if not carries_all(family):
        return due[:room], ()
    if len(going) <= room:
        return going, ()
    # Servos on their last part arrive with the packet rather than cut it short.
    unfinished = [one for one in going if is_unfinished(one[1])]
    carried = sorted(unfinished, key=lambda one: one[1].sent_until_ms)[:room]
    servos = {servo for servo, _ in carried}
    return carried, [course for servo, course in going if servo not in servos]


def under_way(motion: Motion, now_ms: float) -> Mapping[int, Course]:
    """The courses of all servos under way whose place is known; one that no order of ours has moved goes on
    by its track.
    """
    found: dict[int, Course] = {}
    for servo, track in motion.tracks.items():
        at = position_of(track, now_ms)
        if at is None:
            continue
        course = motion.courses.get(servo) or course_of(track)
        if is_unfinished(course) or not (stands(track, now_ms) or abs(track.to - at) <= 1):
            found[servo] = course
    return found


def course_of(track: Track) -> Course:
    end = end_ms(track)
    return Course(track.start, track.to, track.start_ms, end, end, round(track.to))


def course_for(motion: Motion, order: ServoOrder, arrives_ms: float) -> Course:
    start: float | None = held_at(motion.readings, order.servo)
    if start is None and (track := motion.tracks.get(order.servo)):
        start = position_of(track, arrives_ms)
    end = arrives_ms + order.duration_ms
    return Course(start, order.position, arrives_ms, end, arrives_ms, order.position)


def delayed(course: Course, arrives_ms: float) -> Course:
    """The board has stood at the seam since: the rest comes as much later, and no faster."""
    late_ms = arrives_ms - course.sent_until_ms
    if late_ms <= 0 or not is_unfinished(course):
        return course
    return replace(course, start_ms=course.start_ms + late_ms, end_ms=course.end_ms + late_ms)


def re_timed(course: Course, until_ms: float) -> Course:
    """A packet that does not name its servo has the board done with its part only then."""
    if until_ms <= course.sent_until_ms:
        return course
    return replace(delayed(course, until_ms), sent_until_ms=until_ms)


def is_unfinished(course: Course) -> bool:
    return course.end_ms > course.sent_until_ms


def part_ms(
    courses: Sequence[Course],
    left: Sequence[Course],
    arrives_ms: float,
    family: Family,
    least_ms: float,
    *,
    is_joined: bool,
) -> int:
    """The time of the packet: until the first of its servos arrives, at most one part, and not before those
    that it leaves out.
    """
    seams = [course.sent_until_ms - arrives_ms for course in left if is_unfinished(course)]
    left_ms = max((course.sent_until_ms - arrives_ms for course in left), default=0.0)
    arrivals = [max(course.end_ms, course.sent_until_ms) - arrives_ms for course in courses]
    # Servos past their time arrive with any packet.
    ends = [ms for ms in arrivals + seams if ms > PARTS.grain_ms]
    first_ms = min([*ends, float(LONGEST_MOVE_MS)])
    # Servos that arrive almost together arrive together.
    together_ms = max((ms for ms in ends if ms <= first_ms + PARTS.rest_ms), default=0.0)
    longest_ms = inf if family.motion.part_ms is None else float(family.motion.part_ms)
    if together_ms <= longest_ms + PARTS.grain_ms:
        wanted_ms = together_ms
    else:
        wanted_ms = in_ticks(min(longest_ms, first_ms - PARTS.rest_ms), family)
    least = max(wanted_ms, least_ms, left_ms, interval_ms(len(courses), family))
    duration_ms = math.ceil(least - PARTS.grain_ms)
    # Boards cut the rest of a tick, which would make the servos under way faster.
    if is_joined or any(course.end_ms > arrives_ms + duration_ms + PARTS.grain_ms for course in courses):
        duration_ms = in_ticks(duration_ms + family.motion.tick_ms - 1, family)
    return min(duration_ms, family.duration_ms.max)


def in_ticks(ms: float, family: Family) -> int:
    return math.floor(ms / family.motion.tick_ms) * family.motion.tick_ms


@value
class Span:
    """Of a packet: its arrival, the time that it names, and when the board is done with it, which counts in
    ticks.
    """

    arrives_ms: float
    duration_ms: float
    until_ms: float


def sent_on(course: Course, span: Span) -> Course:
    """The course as that packet sends it on."""
    if course.start is None or course.end_ms <= span.arrives_ms + span.duration_ms + PARTS.grain_ms:
        return replace(course, sent_until_ms=max(span.until_ms, course.end_ms), sent_to=round(course.to))
    done = max(0.0, span.until_ms - course.start_ms) / (course.end_ms - course.start_ms)
    position = rounded(course.start + (course.to - course.start) * done)
    return replace(course, sent_until_ms=span.until_ms, sent_to=position)
