"""The clients on the WebSocket: a seat each, with a bounded outbox, so that one who does not read stalls
nobody.

Knows seats, who sits there, and text; no socket, no message's meaning, no port.
"""

import asyncio
from collections.abc import Callable, Collection, Coroutine
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from servodeck.callers import THIS_COMPUTER, Caller, Role

# Enough for a second of a busy board (960 bytes) and the answers to a full queue; far more means nobody
# reads.
OUTBOX_MESSAGES = 256
# So many may sit when somebody of that role comes: viewers never take the seats of those who drive, nor these
# the seats of whoever lets others in.
SEATS: dict[Role, int] = {"stopper": 200, "viewer": 200, "driver": 208, "owner": 216}
# Nobody needs more windows; a single phone shall not take every seat.
SEATS_EACH = 8
TRY_AGAIN_LATER, AGAINST_THE_RULES, GOING_AWAY = 1013, 1008, 1012


T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Farewell:
    """With which code and words the connection is closed."""

    code: int
    reason: str


class Seat:
    """One client. Whoever serves it takes texts with `next`, and closes it once it has `ended`."""

    def __init__(self, caller: Caller, *, answers: bool = True) -> None:
        """`answers` is False for one that only listens."""
        self.caller = caller
        self.answers = answers
        self._outbox: asyncio.Queue[str | Callable[[], str]] = asyncio.Queue(OUTBOX_MESSAGES)
        self.ended = asyncio.Event()
        self.farewell: Farewell | None = None
        self._pending: set[asyncio.Task[Any]] = set()

    def put(self, text: str) -> None:
        self._put(text)

    def put_later(self, text: Callable[[], str]) -> None:
        """What is asked for its words only when its turn has come: they shall be the newest then."""
        self._put(text)

    def _put(self, text: str | Callable[[], str]) -> None:
        if self.ended.is_set():
            return
        try:
            self._outbox.put_nowait(text)
        except asyncio.QueueFull:
            self.end(TRY_AGAIN_LATER, "This client does not read.")

    def end(self, code: int, reason: str) -> None:
        self.farewell = self.farewell or Farewell(code, reason)
        self.ended.set()

    def begin(self, work: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
        """What it has asked for and is not done at once; it ends with the seat."""
        task = asyncio.create_task(work)
        self._pending.add(task)
        task.add_done_callback(self._pending.discard)
        return task

    def drop_pending(self) -> Collection[asyncio.Task[Any]]:
        """They end where they wait now."""
        pending = tuple(self._pending)
        for task in pending:
            task.cancel()
        return pending

    @property
    def waiting(self) -> int:
        return self._outbox.qsize()

    async def next(self) -> str:
        text = await self._outbox.get()
        return text if isinstance(text, str) else text()


def is_of(seat: Seat | None, caller_id: str) -> bool:
    return seat is not None and seat.caller.id == caller_id


class Hub:
    def __init__(self) -> None:
        # In the order in which they came.
        self._seats: dict[Seat, None] = {}

    def __len__(self) -> int:
        return len(self._seats)

    @property
    def seats(self) -> tuple[Seat, ...]:
        return tuple(self._seats)

    def has_room_for(self, caller: Caller) -> bool:
        own = sum(seat.caller.id == caller.id for seat in self._seats)
        return len(self._seats) < SEATS[caller.role] and (own < SEATS_EACH or caller is THIS_COMPUTER)

    def holds(self, caller_id: str) -> bool:
        return any(seat.caller.id == caller_id for seat in self._seats)

    def rename(self, caller_id: str, name: str) -> None:
        """They stay where they sit."""
        for seat in self._seats:
            if seat.caller.id == caller_id:
                seat.caller = replace(seat.caller, name=name)

    def close(self) -> None:
        """Nobody sits here any more."""
        for seat in self._seats:
            seat.end(GOING_AWAY, "The gateway is ending.")

    def join(self, seat: Seat) -> None:
        self._seats[seat] = None

    def leave(self, seat: Seat) -> None:
        self._seats.pop(seat, None)

    def tell_all(self, text: str, but: Seat | None = None) -> None:
        for seat in self._seats:
            if seat is not but:
                seat.put(text)
