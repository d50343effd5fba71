"""The effect of STOP on a motion: the move that holds the robot, and the motion that continues in spite of
it. Both come from one value, so that they cannot contradict each other. Knows the estimate; no clock, no
link. Twin of shared/src/motion/haltPlan.ts.
"""

import math
from math import inf

from servodeck.protocol.families import Family
from servodeck.protocol.timings import MOVE, STOP, wire_ms
from servodeck.protocol.values import Move, ServoTarget, Stop
from servodeck.robot.motion.model import KnownBoard, Motion
from servodeck.robot.motion.motion import advance, after_command, hears
from servodeck.robot.motion.tracks import LONGEST_MOVE_MS, Track, end_ms, leeway_of, position_of, stands
from servodeck.value import value

STOP_OFFSETS_MS = [STOP.repeat_every_ms * (index + 1) for index in range(STOP.repeats)]


@value
class Unheld:
    """The motion that a STOP cannot hold. `servos` None: it is unknown which, because a group whose frames
    are not known may run. `for_ms`: the longest that they may still move, counted from the press of STOP.
    """

    servos: tuple[int, ...] | None
    for_ms: float


@value
class HaltPlan:
    """`unheld` None: all is held."""

    hold: Move | None
    unheld: Unheld | None


@value
class Held:
    """`way`: how far it may have to go to get there."""

    servo: int
    position: int
    is_under_way: bool
    way: float


def halt_plan(motion: Motion, now_ms: float, board: KnownBoard, holds_to_follow: int = 0) -> HaltPlan:
    """At the press of STOP at `now_ms`: the first hold, and the motion that continues after the last one."""
    stopped_ms = now_ms + wire_ms(4)
    stopped = after_command(advance(motion, now_ms, board), Stop(), stopped_ms, board)
    hold = hold_after_stop(stopped, stopped_ms, board)
    current = after_hold(stopped, hold, stopped_ms, board)
    for offset_ms in STOP_OFFSETS_MS:
        current = after_command(current, Stop(), stopped_ms + offset_ms, board)
    last_stop_ms = stopped_ms + max(STOP_OFFSETS_MS)
    last_hold = hold_after_stop(current, last_stop_ms, board)
    last_ms = hold_leaves_ms(last_hold, last_stop_ms, board.family)
    held = after_hold(current, last_hold, last_stop_ms, board)
    return HaltPlan(hold, unheld_since(now_ms, held, last_ms, board, holds_to_follow))


def hold_after_stop(motion: Motion, stopped_ms: float, board: KnownBoard) -> Move | None:
    """The hold that follows a stop whose last bit left at `stopped_ms`."""
    arrives_ms = stopped_ms + board.family.service_gap_ms + move_ms(len(motion.tracks))
    return hold_at(advance(motion, arrives_ms, board), arrives_ms, board.family)


def move_ms(servos: int) -> float:
    """On the wire."""
    return wire_ms(7 + 3 * servos)


def hold_leaves_ms(hold: Move | None, stopped_ms: float, family: Family) -> float:
    return stopped_ms if hold is None else stopped_ms + family.service_gap_ms + move_ms(len(hold.targets))


def after_hold(motion: Motion, hold: Move | None, stopped_ms: float, board: KnownBoard) -> Motion:
    if hold is None:
        return motion
    return after_command(motion, hold, hold_leaves_ms(hold, stopped_ms, board.family), board)


def unheld_since(
    pressed_ms: float, motion: Motion, last_ms: float, board: KnownBoard, holds_to_follow: int = 0
) -> Unheld | None:
    """The unheld motion, after the last packet of a STOP pressed at `pressed_ms` left at `last_ms`. Where the
    board re-times every servo (S26), each hold that is to follow puts off the end of what is under way, by a
    tick that has begun.
    """
    family, limit_ms = board.family, last_ms + STOP.held_within_ms
    traits = family.motion
    later_ms = holds_to_follow * (traits.tick_ms + traits.talk_ms) if traits.timing == "shared" else 0.0
    current = advance(motion, last_ms, board)
    rests_at_ms = {servo: rests_ms(track, family) + later_ms for servo, track in current.tracks.items()}
    late = {servo: until_ms for servo, until_ms in rests_at_ms.items() if until_ms > limit_ms}
    unknown_ms = unknown_until_ms(current, last_ms) + later_ms
    is_unknown = unknown_ms > limit_ms
    if not late and not is_unknown:
        return None
    for_ms = max([*late.values(), *([unknown_ms] if is_unknown else [])]) - pressed_ms
    others = others_than_halted(current, last_ms, family) if is_unknown else ()
    return Unheld(None if others is None else tuple(sorted({*others, *late})), for_ms)


def unknown_until_ms(motion: Motion, last_ms: float) -> float:
    """Until then servos may move that no track is known of; a group runs on only where no stop was heard."""
    restless_ms = max(motion.restless_until_ms, motion.inherited_until_ms) if motion.run is None else inf
    if motion.may_swallow > 0:
        return restless_ms
    return min(restless_ms, max(last_ms, motion.deaf_until_ms) + LONGEST_MOVE_MS)


def rests_ms(track: Track, family: Family) -> float:
    """When the board's last tick for it is over."""
    if track.start == track.to and track.start_leeway == 0:
        return -inf
    return end_ms(track) + family.motion.tick_ms + family.motion.talk_ms


def others_than_halted(motion: Motion, last_ms: float, family: Family) -> tuple[int, ...] | None:
    """Where a stop that was heard halts some servos, only the others continue with a frame (L9); None: any of
    them.
    """
    halted = family.motion.halted_by_stop
    if not halted or not hears(motion, last_ms):
        return None
    return tuple(servo for servo in range(1, family.usual_servo_count + 1) if servo not in halted)


def hold_at(motion: Motion, at_ms: float, family: Family) -> Move | None:
    """The one move that holds the robot where it is at `at_ms`, which is when it arrives; None where there is
    nothing to hold.
    """
    moved = {servo: track for servo, track in motion.tracks.items() if not has_rested(motion, track, at_ms)}
    found = [held_at(servo, track, at_ms, family) for servo, track in moved.items()]
    first = sorted((held for held in found if held), key=lambda held: not held.is_under_way)
    held = first[: family.servos_per_move]
    if not held:
        return None
    targets = tuple(ServoTarget(one.servo, one.position) for one in held)
    return Move(hold_ms(motion, held, at_ms, family), targets)


def has_rested(motion: Motion, track: Track, at_ms: float) -> bool:
    """No command can have moved it since: a hold would only undo what is not known here."""
    return max(end_ms(track), motion.ran_until_ms) + STOP.rested_ms < at_ms


def held_at(servo: int, track: Track, at_ms: float, family: Family) -> Held | None:
    """None for a servo that cannot be held, or need not be: a hold of an unknown position would throw it."""
    leeway = leeway_of(track, at_ms, family)
    if leeway == 0:
        return Held(servo, round(track.to), is_under_way=False, way=0)
    at = position_of(track, at_ms)
    # A stop has halted it; where is not known to the tick.
    if at is None or (stands(track, at_ms) and track.to_leeway > 0):
        return None
    return held_ahead(servo, at, track.to, leeway)


def held_ahead(servo: int, at: float, to: float, leeway: float) -> Held:
    """The farthest place where it may be by now, at most its target: a hold never takes a servo back."""
    left = to - at
    ahead = to if abs(left) <= leeway else at + math.copysign(leeway, left)
    position = max(to, math.floor(ahead)) if left < 0 else min(to, math.ceil(ahead))
    return Held(servo, round(position), is_under_way=True, way=abs(position - at) + leeway)


def hold_ms(motion: Motion, held: list[Held], at_ms: float, family: Family) -> int:
    """As short as can be where each place is sure; no servo goes faster than in its first move, and no
    unknown one snaps to its target.
    """
    way_range = family.position.max - family.position.min
    way = min(way_range, max(one.way for one in held))
    needs_ms = max(
        family.shortest_move_ms,
        MOVE.first_ms * way / way_range,
        0 if family.motion.timing == "perServo" else unknown_ms(motion, at_ms, family.motion.tick_ms),
    )
    return math.ceil(needs_ms / family.motion.tick_ms) * family.motion.tick_ms


def unknown_ms(motion: Motion, at_ms: float, tick_ms: float) -> float:
    """How long what cannot be held still needs, a begun tick with it, or is given."""
    unheld = [track for track in motion.tracks.values() if position_of(track, at_ms) is None]
    needs_ms = [min(end_ms(track) - at_ms + tick_ms, most_ms(track)) for track in unheld]
    return max([min(STOP.unknown_frame_ms, motion.restless_until_ms - at_ms), *needs_ms])


def most_ms(track: Track) -> float:
    """Of what may have been begun or not."""
    return STOP.unknown_frame_ms if track.start_leeway == inf else inf
