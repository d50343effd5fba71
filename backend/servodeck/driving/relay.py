"""What left the wire, told to everybody who did not send it: twenty times a second at most, so that a hand on
one page's sliders is seen on all of them.

Knows seats and packets, no port. Whoever reads slowly gets the newest of it and misses what that made void.
"""

import asyncio
from collections.abc import Callable
from functools import lru_cache

from servodeck.access.gate import MOVE
from servodeck.access.hub import Hub, Seat
from servodeck.messages import LeftMessage, encode
from servodeck.port.wire import Owner
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.packets import parse_command
from servodeck.protocol.values import Move

FLUSH_S = 0.05

Packets = tuple[bytes, ...]


class Relay:
    def __init__(self, hub: Hub, now: Callable[[], float]) -> None:
        self._hub = hub
        self._now = now
        self._leaving: list[tuple[Owner, bytes, float]] = []
        self._behind: dict[Seat, Packets] = {}
        self._timer: asyncio.TimerHandle | None = None

    def leaving(self, owner: Owner, packet: bytes, at_s: float) -> None:
        """Its last bit leaves then; it is told when it has."""
        self._leaving.append((owner, packet, at_s))
        if self._timer is None:
            self._plan()

    def forget(self, seat: Seat) -> None:
        self._behind.pop(seat, None)

    def _plan(self) -> None:
        delay_s = max(FLUSH_S, self._leaving[0][2] - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._flush)

    def _flush(self) -> None:
        now = self._now()
        left = [(owner, packet) for owner, packet, at_s in self._leaving if at_s <= now]
        self._leaving = self._leaving[len(left) :]
        self._timer = None
        if self._leaving:
            self._plan()
        told = newest(tuple(packet for _, packet in left))
        senders = {owner for owner, _ in left}
        for seat in self._hub.seats:
            own = seat in senders
            self._tell(seat, newest(tuple(p for owner, p in left if owner is not seat)) if own else told)

    def _tell(self, seat: Seat, packets: Packets) -> None:
        if not packets:
            return
        behind = self._behind.get(seat)
        self._behind[seat] = packets if behind is None else newest(behind + packets)
        if behind is None:
            seat.put_later(lambda: text_of(self._behind.pop(seat, ())))


@lru_cache(maxsize=16)
def text_of(packets: Packets) -> str:
    """The same for most seats, and then made once."""
    return encode(LeftMessage(packets=[packet.hex() for packet in packets]))


@lru_cache(maxsize=16)
def newest(packets: Packets) -> Packets:
    """Without the moves whose every servo was sent elsewhere right after."""
    kept: list[bytes] = []
    moved: set[int] = set()
    for packet in reversed(packets):
        servos = servos_of(packet)
        if servos is None:
            moved.clear()
        elif servos <= moved:
            continue
        else:
            moved |= servos
        kept.append(packet)
    return tuple(reversed(kept))


def servos_of(packet: bytes) -> set[int] | None:
    """Of a move; None for all else."""
    command = parse_command(packet) if packet[COMMAND_AT] == MOVE else None
    return {target.servo for target in command.targets} if isinstance(command, Move) else None
