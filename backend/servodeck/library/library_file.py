"""Opens the library's SQLite file: makes it, brings it up to date, sets it aside where it is damaged.

Knows the tables' shape and its history, no document. A file of a newer Servodeck is left alone.
"""

import sqlite3
import time
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from servodeck.errors import StorageBusyError, StorageError, StorageFullError

FILE = "library.sqlite"
BUSY_S = 2.0
JOURNAL_PAGES = 16

# Each entry brings the file from one version to the next; the first makes it. Only ever append.
STEPS: Sequence[Sequence[str]] = (
    (
        "CREATE TABLE document (id TEXT PRIMARY KEY, revision INTEGER NOT NULL, removed_at_ms INTEGER, "
        "facts TEXT NOT NULL, text TEXT NOT NULL)",
        "CREATE TABLE version (document TEXT NOT NULL REFERENCES document ON DELETE CASCADE, "
        "id TEXT NOT NULL, name TEXT NOT NULL, at_ms INTEGER NOT NULL, text TEXT NOT NULL, "
        "PRIMARY KEY (document, id))",
    ),
    (
        "ALTER TABLE document ADD COLUMN kind TEXT NOT NULL DEFAULT 'group'",
        "UPDATE document SET facts = json_set(facts, '$.kind', 'group')",
    ),
)

DAMAGED = frozenset({sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB})


class DamagedError(Exception):
    """The file is no library any more."""


def open_library(
    folder: Path, steps: Sequence[Sequence[str]] = STEPS
) -> tuple[sqlite3.Connection, str | None]:
    """The open file, and the name under which a damaged one was set aside before. Raises a StorageError."""
    path = folder / FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        try:
            return open_sound(path, steps), None
        except DamagedError:
            aside = set_aside(path)
            return open_sound(path, steps), aside
    except (OSError, DamagedError) as error:
        raise StorageError(f"The library in {folder} cannot be opened: {error}.") from error


def open_sound(path: Path, steps: Sequence[Sequence[str]]) -> sqlite3.Connection:
    db = sqlite3.connect(path, timeout=BUSY_S, isolation_level=None, check_same_thread=False)
    try:
        db.execute("PRAGMA journal_mode = WAL")
        # A document that was called kept survives a power cut; writes are rare enough to pay for it.
        db.execute("PRAGMA synchronous = FULL")
        # What a damaged journal held is gone without a word: few documents stand in it alone.
        db.execute(f"PRAGMA wal_autocheckpoint = {JOURNAL_PAGES}")
        db.execute("PRAGMA foreign_keys = ON")
        if db.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
            raise DamagedError("its contents contradict each other")  # noqa: TRY301
        upgrade(db, path, steps)
    except sqlite3.Error as error:
        db.close()
        raise damaged_or(error) from error
    except BaseException:
        db.close()
        raise
    return db


def upgrade(db: sqlite3.Connection, path: Path, steps: Sequence[Sequence[str]]) -> None:
    if version_of(db) > len(steps):
        raise StorageError(
            f"{path} was written by a newer Servodeck. Use that one, or another --data folder."
        )
    if 0 < version_of(db) < len(steps):
        back_up(db, path.with_name(f"library-before-version-{len(steps)}.sqlite"))
    db.execute("BEGIN IMMEDIATE")
    for step in steps[version_of(db) :]:  # asked again: another gateway may have been faster
        for statement in step:
            db.execute(statement)
    db.execute(f"PRAGMA user_version = {len(steps)}")
    db.execute("COMMIT")


def version_of(db: sqlite3.Connection) -> int:
    return int(db.execute("PRAGMA user_version").fetchone()[0])


def back_up(db: sqlite3.Connection, path: Path) -> None:
    """Under its name only once it is whole: a copy cut by a full disk must not pass for one."""
    half = path.with_name(f"{path.name}.part")
    half.unlink(missing_ok=True)
    try:
        with closing(sqlite3.connect(half)) as copy:
            db.backup(copy)
        half.replace(path)
    finally:
        half.unlink(missing_ok=True)


def set_aside(path: Path) -> str:
    """Renames the file with what belongs to it. Its new name."""
    name = f"library-unreadable-{time.time_ns() // 1_000_000}.sqlite"
    for ending in ("", "-wal", "-shm"):
        part = path.with_name(path.name + ending)
        if part.exists():
            part.rename(path.with_name(name + ending))
    return name


def damaged_or(error: sqlite3.Error) -> Exception:
    return DamagedError(str(error)) if code_of(error) in DAMAGED else storage_error(error)


def storage_error(error: sqlite3.Error) -> StorageError:
    code = code_of(error)
    if code == sqlite3.SQLITE_FULL:
        return StorageFullError("The disk of the library is full. What was kept before is unharmed.")
    if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
        return StorageBusyError("Another program holds the library's file. It is tried again.")
    return StorageError(f"The library's file cannot be used: {error}.")


def code_of(error: sqlite3.Error) -> int:
    """Without what SQLite adds to some codes in the higher bits."""
    return getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
