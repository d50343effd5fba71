"""The list of acts: who did what and when, the newest 10,000 entries, in memory and in a SQLite file of their
own that is written some seconds later, in a thread.

An act is noted without waiting for a disk and never fails. Repeated acts of one person within a while are one
entry with a count, so that a script or a guesser of codes cannot push out the others. Knows no request.
"""

import asyncio
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Literal, Protocol

from servodeck.errors import StorageError
from servodeck.robot.acts import RobotAct
from servodeck.threads import in_thread
from servodeck.value import value

AccessAct = Literal[
    "gatewayStarted",
    "gatewayEnded",
    "restored",
    "paired",
    "pairRefused",
    "invited",
    "withdrew",
    "renamed",
    "roleChanged",
    "revoked",
    "tokenMade",
    "tokenExpired",
    "stopLinkMade",
    "portOpened",
    "portClosed",
    "robotChosen",
    "librarySaved",
    "libraryRemoved",
    "libraryRestored",
    "fleetStopped",
    "fleetAsked",
    "fleetGrouped",
]
Act = Literal[RobotAct, AccessAct]
MAX_ENTRIES = 10_000
# An act is repeated if it follows within so long.
REPEAT_MS = 60_000
REPEATS_MS: dict[Act, float] = {
    # Of one span of driving, which ends when another person drives.
    "moved": float("inf"),
    "pairRefused": 600_000,
    "librarySaved": 3_600_000,
}
MAX_REPEATABLE = 256
WRITE_AFTER_S = 5.0


@value
class Entry:
    """`count` such acts from `at_ms` until `until_ms`. `who` and `whom` are names at that time; `who` None:
    no person. `about`: a slot, a role, a cause, a port or a document.
    """

    id: int
    act: Act
    who: str | None
    whom: str
    about: str
    at_ms: int
    until_ms: int
    count: int


class AuditStore(Protocol):
    def load(self) -> list[Entry]:
        """The oldest first. Raises a StorageError."""

    def save(self, changed: Sequence[Entry], oldest_id: int) -> None:
        """Writes these, and removes those before `oldest_id`. Called from any thread. Raises a
        StorageError.
        """


class NoAuditStore:
    """Where the list ends with the gateway."""

    def load(self) -> list[Entry]:
        return []

    def save(self, changed: Sequence[Entry], oldest_id: int) -> None:
        """Nothing is stored."""


Taken = tuple[list[Entry], int]
"""What is to be written, and the oldest entry that stays."""


class Audit:
    def __init__(self, store: AuditStore, now_ms: Callable[[], int]) -> None:
        """A file that cannot be read is left alone, and the list is held in memory."""
        self._store = store
        self._now_ms = now_ms
        self.problem: str | None = None
        """Why entries are not stored at present, for people."""
        try:
            found = store.load()
        except StorageError as error:
            found, self.problem, self._store = [], error.detail, NoAuditStore()
        self._ids: deque[int] = deque((one.id for one in found), MAX_ENTRIES)
        self._entries = {one.id: one for one in found[-MAX_ENTRIES:]}
        self._next_id = found[-1].id + 1 if found else 1
        # The one that was repeated longest ago comes first.
        self._repeatable: dict[tuple[Act, str | None, str, str], int] = {}
        self._last_driver: str | None = None
        self._changed: set[int] = set()
        self._timer: asyncio.TimerHandle | None = None
        self._writing: asyncio.Task[None] | None = None

    def note(self, act: Act, who: str | None, about: str = "", whom: str = "") -> None:
        now_ms = self._now_ms()
        if act == "tookLease" and who != self._last_driver:
            self._end_repeats("moved")
            self._last_driver = who
        key = act, who, about, whom
        before = self._entries.get(self._repeatable.pop(key, 0))
        if before and 0 <= now_ms - before.until_ms <= REPEATS_MS.get(act, REPEAT_MS):
            entry = Entry(before.id, *key[:2], whom, about, before.at_ms, now_ms, before.count + 1)
        else:
            entry = Entry(self._next_id, act, who, whom, about, now_ms, now_ms, 1)
            self._append(entry)
        self._repeatable[key] = entry.id
        if len(self._repeatable) > MAX_REPEATABLE:
            del self._repeatable[next(iter(self._repeatable))]
        self._entries[entry.id] = entry
        self._changed.add(entry.id)
        self._write_later()

    def find(
        self, before: int | None = None, act: Act | None = None, who: str | None = None
    ) -> Iterator[Entry]:
        """The newest first; `before`: older than that entry."""
        for id_ in reversed(self._ids):
            entry = self._entries[id_]
            if (before is None or id_ < before) and act in (None, entry.act) and who in (None, entry.who):
                yield entry

    @property
    def names(self) -> list[str]:
        """Of those who did something, sorted."""
        return sorted({one.who for one in self._entries.values() if one.who is not None})

    def close(self) -> None:
        """Writes what is not written yet."""
        if self._timer:
            self._timer.cancel()
        taken = self._taken()
        self._written(taken, self._write(taken))

    def _append(self, entry: Entry) -> None:
        self._next_id += 1
        if len(self._ids) == MAX_ENTRIES:
            gone = self._ids.popleft()
            del self._entries[gone]
            self._changed.discard(gone)
        self._ids.append(entry.id)

    def _end_repeats(self, act: Act) -> None:
        self._repeatable = {key: id_ for key, id_ in self._repeatable.items() if key[0] != act}

    def _write_later(self) -> None:
        if self._timer is None and self._writing is None and not isinstance(self._store, NoAuditStore):
            self._timer = asyncio.get_running_loop().call_later(WRITE_AFTER_S, self._begin_write)

    def _begin_write(self) -> None:
        self._timer = None
        self._writing = asyncio.create_task(self._write_in_thread())

    async def _write_in_thread(self) -> None:
        taken = self._taken()
        problem = await in_thread(lambda: self._write(taken))
        self._writing = None
        self._written(taken, problem)
        if self._changed:
            self._write_later()

    def _taken(self) -> Taken:
        changed = [self._entries[id_] for id_ in sorted(self._changed)]
        self._changed = set()
        return changed, self._ids[0] if self._ids else self._next_id

    def _write(self, taken: Taken) -> str | None:
        """In a thread. The problem, or None."""
        try:
            self._store.save(*taken)
        except StorageError as error:
            return error.detail
        return None

    def _written(self, taken: Taken, problem: str | None) -> None:
        if problem:
            self._changed |= {one.id for one in taken[0] if one.id in self._entries}
        if not isinstance(self._store, NoAuditStore):
            self.problem = problem
