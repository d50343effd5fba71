"""The clients on the WebSocket: a seat each, with a bounded outbox, so that one who does not read stalls
no other.

Knows seats, who sits there, and text; no socket, no message's meaning, no port.
"""

import asyncio
from collections.abc import Callable, Collection, Coroutine
from dataclasses import replace
from typing import Any, TypeVar

from servodeck.callers import THIS_COMPUTER, Caller, Role
from servodeck.value import value

# Enough for a second of a busy board (960 bytes) and the answers to a full queue; far more means that
# it does not read.
OUTBOX_MESSAGES = 256
# So many may sit when somebody of that role comes: viewers never take the seats of those who drive, nor these
# the seats of owners, who let others in.
SESSIONS_AT_MOST: dict[Role, int] = {"stopper": 200, "viewer": 200, "driver": 208, "owner": 216}
# More windows are not needed; a single phone shall not take every seat.
SESSIONS_EACH = 8
TRY_AGAIN_LATER, AGAINST_THE_RULES, GOING_AWAY = 1013, 1008, 1012


T = TypeVar("T")


@value
class CloseReason:
    """With which code and words the connection is closed."""

    code: int
    reason: str


class Session:
    """One client. Its server takes texts with `next`, and closes it once it has `ended`."""

    def __init__(self, caller: Caller, *, answers: bool = True) -> None:
        """`answers` is False for one that only listens."""
        self.caller = caller
        self.answers = answers
        self._outbox: asyncio.Queue[str | Callable[[], str]] = asyncio.Queue(OUTBOX_MESSAGES)
        self.ended = asyncio.Event()
        self.close_reason: CloseReason | None = None
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
            self.end(TRY_AGAIN_LATER, "This client does not read its messages.")

    def end(self, code: int, reason: str) -> None:
        self.close_reason = self.close_reason or CloseReason(code, reason)
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


def is_of(session: Session | None, caller_id: str) -> bool:
    return session is not None and session.caller.id == caller_id


class Hub:
    def __init__(self) -> None:
        # In the order in which they came.
        self._sessions: dict[Session, None] = {}

    def __len__(self) -> int:
        return len(self._sessions)

    @property
    def sessions(self) -> tuple[Session, ...]:
        return tuple(self._sessions)

    def has_room_for(self, caller: Caller) -> bool:
        own = sum(session.caller.id == caller.id for session in self._sessions)
        return len(self._sessions) < SESSIONS_AT_MOST[caller.role] and (
            own < SESSIONS_EACH or caller is THIS_COMPUTER
        )

    def holds(self, caller_id: str) -> bool:
        return any(session.caller.id == caller_id for session in self._sessions)

    def rename(self, caller_id: str, name: str) -> None:
        """They stay where they sit."""
        for session in self._sessions:
            if session.caller.id == caller_id:
                session.caller = replace(session.caller, name=name)

    def close(self) -> None:
        """All clients have to go."""
        for session in self._sessions:
            session.end(GOING_AWAY, "The gateway is shutting down.")

    def join(self, session: Session) -> None:
        self._sessions[session] = None

    def leave(self, session: Session) -> None:
        self._sessions.pop(session, None)

    def send_all(self, text: str, but: Session | None = None) -> None:
        for session in self._sessions:
            if session is not but:
                session.put(text)
