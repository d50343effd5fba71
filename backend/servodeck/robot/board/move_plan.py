"""How servos are moved: as few packets as the board takes, as fast as the link allows where no time is named,
and servos of unknown place slowly and one after another. Pure: time comes in.

Knows what a board can take and where its servos are; not who may move them, nor how a packet leaves. Twin of
shared/src/robot/estimate.ts (`softened`) and moveBuffer.ts.
"""

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

from servodeck.errors import OutOfRangeError
from servodeck.protocol.families import Family
from servodeck.protocol.limits import PacketError, check
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import MOVE, wire_s
from servodeck.protocol.values import Command, Move, ServoTarget
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.packet_rules import refusal_of
from servodeck.value import value

FIRST_MOVE_MS = MOVE.first_ms
FIRST_MOVE_STAGGER_S = MOVE.first_stagger_ms / 1000


@value
class Step:
    """`after_s`: since the step before."""

    move: Move
    after_s: float


@value
class MovePlan:
    """`first_moves` are the servos that start one after another."""

    steps: tuple[Step, ...]
    first_moves: tuple[int, ...]


def plan_move(
    duration_ms: int,
    positions: Mapping[int, int],
    family: Family,
    motion: Estimate,
    now: float,
    name_of: Callable[[int], str],
) -> MovePlan:
    """In exactly that time, as a script asks for it. Raises what the board cannot take, and where a first
    move would be too fast: nothing is made slower unsaid.
    """
    new = tuple(servo for servo in sorted(positions) if motion.is_unknown(servo, now))
    known = tuple(servo for servo in sorted(positions) if servo not in new)
    needs_ms = max(first_ms(known, motion, now), first_ms(new, motion, now))
    judge_time(duration_ms, new, needs_ms, family, name_of)
    portions = [*portions_of(known, family.servos_per_move), *((servo,) for servo in new)]
    moves = [
        Move(duration_ms, tuple(ServoTarget(servo, positions[servo]) for servo in portion))
        for portion in portions
    ]
    for move in moves:
        judge_command(move, family)
    starts = len(moves) - len(new)
    waits = [FIRST_MOVE_STAGGER_S if index > starts else 0.0 for index in range(len(moves))]
    return MovePlan(tuple(map(Step, moves, waits)), new)


def judge_time(
    duration_ms: int, new: Sequence[int], needs_ms: float, family: Family, name_of: Callable[[int], str]
) -> None:
    if duration_ms >= needs_ms:
        return
    why = (
        f"nobody knows where {', '.join(map(name_of, new))} stands before its first move"
        if new
        else "a servo is still in its first move"
    )
    raise OutOfRangeError(f"timeMs is {duration_ms}, allowed {needs_ms}..{family.duration_ms.max}: {why}")


def softened(
    targets: Sequence[ServoTarget],
    duration_ms: int,
    swift: Collection[int],
    family: Family,
    motion: Estimate,
    now: float,
) -> Move:
    """The move with the time that it needs at least: a first move 1.5 s, `swift` servos the soft limit's for
    their way from where they are when it arrives; and where the board re-times every servo (S26) the time
    that the others were given.
    """
    servos = [target.servo for target in targets]
    arrives_s = now + wire_s(move_bytes(len(targets)))
    ways = [motion.farthest_from(target, now, arrives_s) for target in targets if target.servo in swift]
    needs_ms = max(
        float(duration_ms),
        interval_ms(len(targets), family),
        first_ms(servos, motion, now),
        soft_ms(max(ways, default=0), family),
        motion.others_ms(servos, now) if family.motion.timing == "shared" else 0,
    )
    return Move(min(math.ceil(needs_ms), family.duration_ms.max), tuple(targets))


def first_ms(servos: Collection[int], motion: Estimate, now: float) -> float:
    """How long a move of these takes at least because one of unknown place starts with it or is on its first
    way still; else 0.
    """
    if any(motion.is_unknown(servo, now) for servo in servos):
        return FIRST_MOVE_MS
    return min(FIRST_MOVE_MS, motion.first_moves_ms(servos, now))


def soft_ms(way: float, family: Family) -> float:
    share = way / (family.position.max - family.position.min)
    # Boards cut what is no whole tick.
    return math.ceil(share * MOVE.range_ms / family.motion.tick_ms) * family.motion.tick_ms


def interval_ms(servo_count: int, family: Family) -> int:
    """Until the next packet of this size can take effect: shorter moves would make the servo stop and go."""
    return max(
        family.shortest_move_ms, math.ceil(wire_s(move_bytes(servo_count)) * 1000 + family.service_gap_ms)
    )


def move_bytes(servo_count: int) -> int:
    return 7 + 3 * servo_count


def portions_of(servos: Sequence[int], size: int) -> Iterator[Sequence[int]]:
    for start in range(0, len(servos), size):
        yield servos[start : start + size]


def judge_targets(targets: Sequence[ServoTarget], duration_ms: int, family: Family) -> None:
    """Raises what the board cannot take of any of them; how many there are does not matter."""
    for target in targets:
        judge_command(Move(duration_ms, (target,)), family)


def judge_command(command: Command, family: Family) -> None:
    """Raises what the board cannot take of it."""
    try:
        check(command, family)
    except PacketError as error:
        raise refusal_of(error) from error


def packet_of(command: Command, family: Family) -> bytes:
    """Raises what the board cannot take of it."""
    try:
        return encode(command, family)
    except PacketError as error:
        raise refusal_of(error) from error
