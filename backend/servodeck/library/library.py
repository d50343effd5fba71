"""The library: documents as opaque texts with a revision, facts for lists, named versions, a trash.

Knows no HTTP and nothing of what a text means. Its file is opened when it is first needed and again after a
failure, so that driving a robot never waits for a disk. May be called from any thread; blocks.
"""

import logging
import sqlite3
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from servodeck.errors import ConflictError, DamagedTextError, ForbiddenError, NotFoundError, OutOfRangeError
from servodeck.files import sqlite_code, storage_error
from servodeck.library.library_file import (
    FACTS_SUM,
    FILE,
    STEPS,
    TEXT_SUM,
    VERSION_SUM,
    open_library,
)
from servodeck.protocol.timings import LIBRARY

TRASH_MS = LIBRARY.trash_days * 24 * 3600 * 1000
MAX_DOCUMENTS = 5000
MAX_VERSIONS = 200
CLOSE_WAIT_S = 0.5
log = logging.getLogger("servodeck.library")
# After these a connection may be used on; after any other it is opened anew.
PASSING = frozenset({sqlite3.SQLITE_FULL, sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED})


class Listed(NamedTuple):
    id: str
    revision: int
    is_removed: bool
    facts: str | None
    """None where the disk has damaged them, or anything else of this."""
    kind: str = "group"


class Version(NamedTuple):
    id: str
    name: str
    at_ms: int


def wall_clock_ms() -> int:
    return time.time_ns() // 1_000_000


class Library:
    def __init__(
        self,
        folder: Path,
        now_ms: Callable[[], int] = wall_clock_ms,
        steps: Sequence[Sequence[str]] = STEPS,
    ) -> None:
        self.damaged_file: str | None = None
        """The name that a damaged file was given when it was found."""
        self.changes_lost = False
        """The last ones before the start may be missing."""
        self.folder = folder
        self._now_ms = now_ms
        self._steps = steps
        self._lock = threading.Lock()
        self._db: sqlite3.Connection | None = None

    def list(self) -> list[Listed]:
        with self._transaction("BEGIN") as db:
            rows = db.execute(
                "SELECT id, revision, removed_at_ms IS NOT NULL, "
                f"CASE WHEN facts_sum = {FACTS_SUM} THEN facts END, kind FROM document"
            )
            return [Listed(row[0], row[1], bool(row[2]), *row[3:]) for row in rows]

    def read(self, document: str) -> tuple[str, int]:
        """The text and its revision. Raises a DamagedTextError for one that is not what was written."""
        with self._transaction("BEGIN") as db:
            query = f"SELECT text, revision, text_sum = {TEXT_SUM} FROM document WHERE id = ?"
            text, revision, is_whole = found(db.execute(query, (document,)))
            if not is_whole:
                raise DamagedTextError(f"{name_in(db, document)} is damaged. {whole_versions(db, document)}")
            return text, revision

    def facts_of(self, document: str, kind: str) -> tuple[str, int]:
        """The facts of one of that kind outside the trash, and its revision."""
        with self._transaction("BEGIN") as db:
            query = (
                f"SELECT facts, revision, facts_sum = {FACTS_SUM} FROM document "
                "WHERE id = ? AND kind = ? AND removed_at_ms IS NULL"
            )
            facts, revision, is_whole = found(db.execute(query, (document, kind)))
            if not is_whole:
                raise DamagedTextError(f"The list entry of {name_in(db, document)} is damaged.")
            return facts, revision

    def write(
        self,
        document: str,
        text: str,
        facts: str,
        expected: int,
        *,
        kind: str = "group",
        is_removed: bool = False,
    ) -> int:
        """Its new revision. Raises a ConflictError where it is not at `expected` and holds another text, or
        is of another kind. The same text sent again, because the answer was lost, is no conflict; one that is
        not here is taken in.
        """
        with self._transaction() as db:
            row = db.execute("SELECT revision, text, kind FROM document WHERE id = ?", (document,)).fetchone()
            if row is None:
                require_room(db, "document", (), MAX_DOCUMENTS)
            elif (row[1] != text and row[0] != expected) or row[2] != kind:
                raise ConflictError("Another client has changed this document since it was read.")
            revision = row[0] if row and row[1] == text else expected + 1
            removed_at_ms = self._now_ms() if is_removed else None
            db.execute(
                "INSERT INTO document VALUES (?, ?, ?, ?, ?, ?, 0, 0) ON CONFLICT (id) DO UPDATE SET "
                "revision = excluded.revision, removed_at_ms = excluded.removed_at_ms, "
                "facts = excluded.facts, text = excluded.text",
                (document, revision, removed_at_ms, facts, text, kind),
            )
            sums = f"text_sum = {TEXT_SUM}, facts_sum = {FACTS_SUM}"
            db.execute(f"UPDATE document SET {sums} WHERE id = ?", (document,))
            return int(revision)

    def remove(self, documents: Sequence[str]) -> None:
        """To the trash, for 30 days: all of them or none."""
        self._mark(documents, self._now_ms())

    def require_removed(self, document: str) -> None:
        """Raises a ForbiddenError for one outside the trash: only an owner may put it there."""
        with self._transaction("BEGIN") as db:
            row = db.execute("SELECT removed_at_ms FROM document WHERE id = ?", (document,)).fetchone()
            if row is not None and row[0] is None:
                raise ForbiddenError("Only an owner may remove documents.")

    def restore(self, documents: Sequence[str]) -> None:
        """Out of the trash: all of them or none."""
        self._mark(documents, None)

    def versions(self, document: str) -> Sequence[Version]:
        """Oldest first."""
        with self._transaction("BEGIN") as db:
            rows = db.execute(
                "SELECT id, name, at_ms FROM version WHERE document = ? ORDER BY at_ms, id", (document,)
            )
            return [Version(*row) for row in rows]

    def read_version(self, document: str, version: str) -> str:
        with self._transaction("BEGIN") as db:
            query = f"SELECT text, name, text_sum = {VERSION_SUM} FROM version WHERE document = ? AND id = ?"
            text, name, is_whole = found(db.execute(query, (document, version)))
            if not is_whole:
                raise DamagedTextError(f"Version {name} is damaged. {whole_versions(db, document)}")
            return str(text)

    def keep_version(self, document: str, version: Version, text: str) -> None:
        """Instead of the one with that id, if there is one."""
        with self._transaction() as db:
            found(db.execute("SELECT id FROM document WHERE id = ?", (document,)))
            others = "version WHERE document = ? AND id != ?"
            require_room(db, others, (document, version.id), MAX_VERSIONS)
            row, key = (document, *version, text), (document, version.id)
            db.execute("INSERT OR REPLACE INTO version VALUES (?, ?, ?, ?, ?, 0)", row)
            db.execute(f"UPDATE version SET text_sum = {VERSION_SUM} WHERE document = ? AND id = ?", key)

    def remove_version(self, document: str, version: str) -> None:
        """For good."""
        with self._transaction() as db:
            key = (document, version)
            found(db.execute("SELECT id FROM version WHERE document = ? AND id = ?", key))
            db.execute("DELETE FROM version WHERE document = ? AND id = ?", key)

    def close(self) -> None:
        """Left to the file's own journal where a request still waits for the disk."""
        if self._lock.acquire(timeout=CLOSE_WAIT_S):
            self._forget()
            self._lock.release()

    def _mark(self, documents: Sequence[str], removed_at_ms: int | None) -> None:
        with self._transaction() as db:
            for document in documents:
                found(db.execute("SELECT id FROM document WHERE id = ?", (document,)))
                db.execute("UPDATE document SET removed_at_ms = ? WHERE id = ?", (removed_at_ms, document))
                db.execute(f"UPDATE document SET facts_sum = {FACTS_SUM} WHERE id = ?", (document,))

    @contextmanager
    def _transaction(self, begin: str = "BEGIN IMMEDIATE") -> Iterator[sqlite3.Connection]:
        """Whole or not at all. Raises a StorageError."""
        with self._lock:
            try:
                db = self._db = self._db or self._open()
                db.execute(begin)
                try:
                    yield db
                    db.execute("COMMIT")
                finally:
                    if db.in_transaction:
                        db.execute("ROLLBACK")
            except sqlite3.Error as error:
                if sqlite_code(error) not in PASSING:
                    self._forget()
                raise storage_error(error, FILE) from error

    def _open(self) -> sqlite3.Connection:
        db, damaged_file, changes_lost = open_library(self.folder, self._steps)
        self.damaged_file = damaged_file or self.damaged_file
        self.changes_lost |= changes_lost
        if damaged_file:
            log.warning("library damaged", extra={"facts": {"kept_as": damaged_file}})
        if changes_lost:
            log.warning("library's journal damaged: its last changes may be missing")
        past_ms = self._now_ms() - TRASH_MS
        # A damaged one stays.
        db.execute(f"DELETE FROM document WHERE removed_at_ms < ? AND facts_sum = {FACTS_SUM}", (past_ms,))
        return db

    def _forget(self) -> None:
        if self._db:
            self._db.close()
        self._db = None


def found(rows: sqlite3.Cursor) -> tuple[Any, ...]:
    row: tuple[Any, ...] | None = rows.fetchone()
    if row is None:
        raise NotFoundError("The library has no such document.")
    return row


def name_in(db: sqlite3.Connection, document: str) -> str:
    """Its name for lists, if it can be read."""
    query = "SELECT json_extract(facts, '$.name') FROM document WHERE id = ? AND json_valid(facts)"
    row = db.execute(query, (document,)).fetchone()
    return str(row[0]) if row and row[0] else document


def whole_versions(db: sqlite3.Connection, document: str) -> str:
    """Versions that are intact, the newest first."""
    query = (
        f"SELECT name FROM version WHERE document = ? AND text_sum = {VERSION_SUM} ORDER BY at_ms DESC, id"
    )
    names = [name for (name,) in db.execute(query, (document,))]
    return (
        f"Go back to a version that is whole: {', '.join(names)}." if names else "No version of it is whole."
    )


def require_room(db: sqlite3.Connection, where: str, values: tuple[str, ...], limit: int) -> None:
    count = db.execute(f"SELECT count(*) FROM {where}", values).fetchone()[0]
    if count >= limit:
        raise OutOfRangeError(f"The library is limited to {limit} of these.")
