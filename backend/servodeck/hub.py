"""The clients on the WebSocket: a seat each, with a bounded outbox, so that one who does not read stalls
nobody.

Knows seats, who sits there, and text; no socket, no message's meaning, no port.
"""

import asyncio

from servodeck.callers import Caller

# Enough for a second of a busy board (960 bytes) and the answers to a full queue; far more means nobody
# reads.
OUTBOX_MESSAGES = 256
SEATS = 216


class Seat:
    """One client. Whoever serves it takes texts with `next`; it ends with `overflowed` when too many wait."""

    def __init__(self, caller: Caller) -> None:
        self.caller = caller
        self._outbox: asyncio.Queue[str] = asyncio.Queue(OUTBOX_MESSAGES)
        self.overflowed = asyncio.Event()

    def put(self, text: str) -> None:
        if self.overflowed.is_set():
            return
        try:
            self._outbox.put_nowait(text)
        except asyncio.QueueFull:
            self.overflowed.set()

    @property
    def waiting(self) -> int:
        return self._outbox.qsize()

    async def next(self) -> str:
        return await self._outbox.get()


class Hub:
    def __init__(self) -> None:
        self._seats: set[Seat] = set()

    def __len__(self) -> int:
        return len(self._seats)

    @property
    def is_full(self) -> bool:
        return len(self._seats) >= SEATS

    def join(self, seat: Seat) -> None:
        self._seats.add(seat)

    def leave(self, seat: Seat) -> None:
        self._seats.discard(seat)

    def tell_all(self, text: str, but: Seat | None = None) -> None:
        for seat in self._seats:
            if seat is not but:
                seat.put(text)
