"""The sessions of connected clients, each with a bounded outbox, so that a client that does not read stalls
no other; the commands that have left the wire, which are sent to all of them; and how often a state is
published that changes often.

Knows sessions, callers, texts and commands; no socket, no other message's meaning, no port.
"""

import asyncio
import sys
from collections.abc import Callable, Collection, Coroutine
from dataclasses import replace
from functools import lru_cache
from typing import Any, TypeVar

from servodeck.callers import THIS_COMPUTER, Caller, Role
from servodeck.events import LeftMessage, encode
from servodeck.packet_models import command_model
from servodeck.port.wire import Owner
from servodeck.protocol.values import Command, Move
from servodeck.schema import Message
from servodeck.value import value

# Enough for a second of a busy board (960 bytes) and the answers to a full queue; far more means that
# it does not read.
OUTBOX_MESSAGES = 256
# Of texts alone: what is made only when it is sent takes no room before.
OUTBOX_BYTES = 256 * 1024
# Sessions up to which a caller of that role may connect: viewers never take the places of drivers, nor
# drivers those of owners, who can revoke others.
SESSIONS_AT_MOST: dict[Role, int] = {"stopper": 200, "viewer": 200, "driver": 208, "owner": 216}
# More windows are not needed; a single phone must not take every place.
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
        self._outbox_bytes = 0
        self.ended = asyncio.Event()
        self.close_reason: CloseReason | None = None
        self._pending: set[asyncio.Task[Any]] = set()

    def put(self, text: str) -> None:
        self._put(text)

    def put_later(self, text: Callable[[], str]) -> None:
        """`text` is called only when the message is sent, so that it has the newest state then."""
        self._put(text)

    def _put(self, text: str | Callable[[], str]) -> None:
        if self.ended.is_set():
            return
        size = size_of(text)
        if self._outbox.full() or (self._outbox_bytes and self._outbox_bytes + size > OUTBOX_BYTES):
            self.end(TRY_AGAIN_LATER, "This client does not read its messages.")
            return
        self._outbox_bytes += size
        self._outbox.put_nowait(text)

    def end(self, code: int, reason: str) -> None:
        self.close_reason = self.close_reason or CloseReason(code, reason)
        self.ended.set()

    def begin(self, work: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
        """Work that it requested and that takes a while; it ends with the session."""
        task = asyncio.create_task(work)
        self._pending.add(task)
        task.add_done_callback(self._pending.discard)
        return task

    def drop_pending(self) -> Collection[asyncio.Task[Any]]:
        """Cancels its work."""
        pending = tuple(self._pending)
        for task in pending:
            task.cancel()
        return pending

    @property
    def waiting(self) -> int:
        return self._outbox.qsize()

    async def next(self) -> str:
        text = await self._outbox.get()
        self._outbox_bytes -= size_of(text)
        return text if isinstance(text, str) else text()


def size_of(text: str | Callable[[], str]) -> int:
    """In memory, where one letter of a name may double what each of the others takes."""
    return sys.getsizeof(text) if isinstance(text, str) else 0


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
        """Their sessions stay connected."""
        for session in self._sessions:
            if session.caller.id == caller_id:
                session.caller = replace(session.caller, name=name)

    def close(self) -> None:
        """Ends all sessions."""
        for session in self._sessions:
            session.end(GOING_AWAY, "The gateway is shutting down.")

    def join(self, session: Session) -> None:
        self._sessions[session] = None

    def leave(self, session: Session) -> None:
        self._sessions.pop(session, None)

    def send_all(self, message: Message, but: Session | None = None) -> None:
        text = encode(message)
        for session in self._sessions:
            if session is not but:
                session.put(text)


class Throttle:
    """Publishes a state that changes often: at once, but not more often than every `every_s`; then the latest
    one at the end of that time.
    """

    def __init__(self, publish: Callable[[], None], every_s: float, now: Callable[[], float]) -> None:
        self._publish = publish
        self._every_s = every_s
        self._now = now
        self._published_s = float("-inf")
        self._timer: asyncio.TimerHandle | None = None

    def soon(self) -> None:
        if self._timer is None:
            delay_s = self._published_s + self._every_s - self._now()
            if delay_s > 0:
                self._timer = asyncio.get_running_loop().call_later(delay_s, self.at_once)
            else:
                self.at_once()

    def at_once(self) -> None:
        if self._timer:
            self._timer.cancel()
        self._timer, self._published_s = None, self._now()
        self._publish()


FLUSH_S = 0.05

Commands = tuple[Command, ...]


@value
class Leaving:
    """It was sent to `known_to` separately."""

    command: Command
    at_s: float
    known_to: Collection[Session]


class Relay:
    def __init__(self, hub: Hub, now: Callable[[], float], driver: Callable[[], Session | None]) -> None:
        self._hub = hub
        self._now = now
        self._driver = driver
        self._leaving: list[Leaving] = []
        self._after: dict[Session, Commands] = {}
        self._timer: asyncio.TimerHandle | None = None

    def leaving(self, owner: Owner, command: Command, at_s: float) -> None:
        """Its last bit leaves at `at_s`. Then it is sent to clients, to its `owner` and the driver without
        delay.
        """
        driver = self._driver()
        known_to = [session for session in self._hub.sessions if session is owner or session is driver]
        for session in known_to:
            text = text_of((command,))
            asyncio.get_running_loop().call_later(max(0.0, at_s - self._now()), session.put, text)
        self._leaving.append(Leaving(command, at_s, known_to))
        if self._timer is None:
            self._plan()

    def send_left(self) -> None:
        """Sends the commands that have left by now, before a message that follows from them."""
        if self._timer:
            self._timer.cancel()
            self._flush()

    def forget(self, session: Session) -> None:
        self._after.pop(session, None)

    def _plan(self) -> None:
        delay_s = max(FLUSH_S, self._leaving[0].at_s - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._flush)

    def _flush(self) -> None:
        now = self._now()
        left = [each for each in self._leaving if each.at_s <= now]
        self._leaving = self._leaving[len(left) :]
        self._timer = None
        if self._leaving:
            self._plan()
        latest = newest(tuple(each.command for each in left))
        knowing = {session for each in left for session in each.known_to}
        for session in self._hub.sessions:
            known = session in knowing
            unheard = tuple(each.command for each in left if session not in each.known_to) if known else ()
            self._publish(session, newest(unheard) if known else latest)

    def _publish(self, session: Session, commands: Commands) -> None:
        if not commands:
            return
        behind = self._after.get(session)
        waiting = commands if behind is None else newest(behind + commands)
        if len(waiting) > OUTBOX_MESSAGES:  # of commands, none of which replaces another
            session.end(TRY_AGAIN_LATER, "This client does not read its messages.")
            return
        self._after[session] = waiting
        if behind is None:
            session.put_later(lambda: text_of(self._after.pop(session, ())))


@lru_cache(maxsize=16)
def text_of(commands: Commands) -> str:
    """Most sessions get the same text, which is made once."""
    return encode(LeftMessage(commands=[command_model(command) for command in commands]))


@lru_cache(maxsize=16)
def newest(commands: Commands) -> Commands:
    """Without moves whose servos all got a later target."""
    latest: list[Command] = []
    moved: set[int] = set()
    for command in reversed(commands):
        servos = {target.servo for target in command.targets} if isinstance(command, Move) else None
        if servos is None:
            moved.clear()
        elif servos <= moved:
            continue
        else:
            moved |= servos
        latest.append(command)
    return tuple(reversed(latest))
