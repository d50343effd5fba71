"""The move that holds the robot where it is, as a packet. Pure: knows what a board takes; no estimate, no
wire.
"""

from collections.abc import Callable

from servodeck.protocol.families import Family
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.values import Move


def untraced(page_hold: bytes | None, is_traced: Callable[[int], bool]) -> Move | None:
    """A page's own hold, for the servos that the gateway knows nothing of."""
    hold = parse_command(page_hold) if page_hold else None
    if not isinstance(hold, Move):
        return None
    return Move(hold.duration_ms, tuple(target for target in hold.targets if not is_traced(target.servo)))


def hold_packet(own: Move | None, theirs: Move | None, family: Family) -> bytes | None:
    """Where the gateway has them, and the others where a page believes them."""
    targets = own.targets if own else ()
    held = {target.servo for target in targets}
    others = tuple(target for target in (theirs.targets if theirs else ()) if target.servo not in held)
    targets = (targets + others)[: family.servos_per_move]
    if not targets:
        return None
    duration_ms = max(
        own.duration_ms if own else 0,
        theirs.duration_ms if theirs and others else 0,
    )
    return encode(Move(min(duration_ms, family.duration_ms.max), targets), family)
