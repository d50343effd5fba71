"""A move that a script asks for, as packets: as few as the board takes, and servos of unknown place slowly
and one after another. Pure: time comes in.

Knows what a board can take and where its servos are; not who may move them, nor how a packet leaves.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from servodeck.access.gate import refusal_of
from servodeck.board.estimate import Estimate
from servodeck.errors import OutOfRangeError
from servodeck.protocol.families import Family
from servodeck.protocol.limits import PacketError
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Command, Move, ServoTarget

# As in shared/src/session/timings.ts: slow, and far enough apart to see which one moves.
FIRST_MOVE_MS = 1500
FIRST_MOVE_STAGGER_S = 0.25


@dataclass(frozen=True, slots=True)
class Step:
    """`after_s`: since the step before."""

    packet: bytes
    after_s: float


@dataclass(frozen=True, slots=True)
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
    """Raises what the board cannot take, and where a first move would be too fast: nothing is made slower
    unsaid.
    """
    new = tuple(servo for servo in sorted(positions) if motion.is_unknown(servo, now))
    known = tuple(servo for servo in sorted(positions) if servo not in new)
    judge_time(duration_ms, new, motion.first_moves_ms(known, now), family, name_of)
    portions = [*portions_of(known, family.servos_per_move), *((servo,) for servo in new)]
    packets = [
        packet_of(Move(duration_ms, tuple(ServoTarget(servo, positions[servo]) for servo in portion)), family)
        for portion in portions
    ]
    starts = len(packets) - len(new)
    waits = [FIRST_MOVE_STAGGER_S if index > starts else 0.0 for index in range(len(packets))]
    return MovePlan(tuple(map(Step, packets, waits)), new)


def judge_time(
    duration_ms: int, new: Sequence[int], first_moves_ms: float, family: Family, name_of: Callable[[int], str]
) -> None:
    needs_ms = FIRST_MOVE_MS if new else min(FIRST_MOVE_MS, first_moves_ms)
    if duration_ms >= needs_ms:
        return
    why = (
        f"nobody knows where {', '.join(map(name_of, new))} stands before its first move"
        if new
        else "a servo is still in its first move"
    )
    raise OutOfRangeError(f"timeMs is {duration_ms}, allowed {needs_ms}..{family.duration_ms.max}: {why}")


def portions_of(servos: Sequence[int], size: int) -> Iterator[Sequence[int]]:
    for start in range(0, len(servos), size):
        yield servos[start : start + size]


def packet_of(command: Command, family: Family) -> bytes:
    """Raises what the board cannot take of it."""
    try:
        return encode(command, family)
    except PacketError as error:
        raise refusal_of(error) from error
