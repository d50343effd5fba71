"""Opens the library's SQLite file: makes it, brings it up to date, renames a damaged one.

Knows the tables' shape and its history, no document. A file of a newer Servodeck is left alone.
"""

import sqlite3
import time
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

from servodeck.errors import StorageError
from servodeck.files import sqlite_code, storage_error

FILE = "library.sqlite"
BUSY_S = 2.0
JOURNAL_PAGES = 16
# SQLite's file format, "The WAL File Format".
JOURNAL_HEAD_BYTES, FRAME_HEAD_BYTES = 32, 24
PAGE_SIZES = frozenset(2**power for power in range(9, 17))
USUAL_PAGE_BYTES = 4096

# SQLite finds what contradicts its own shape; a bit that the disk has changed within a row, only these. As
# bytes, because what is damaged may be no text any more. They are written into files: never change them.
TEXT_SUM = "sum_of(CAST(text AS BLOB))"
FACTS_SUM = "sum_of(CAST(id AS BLOB), revision, removed_at_ms, CAST(kind AS BLOB), CAST(facts AS BLOB))"
VERSION_SUM = (
    "sum_of(CAST(document AS BLOB), CAST(id AS BLOB), CAST(name AS BLOB), at_ms, CAST(text AS BLOB))"
)

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
    (
        "ALTER TABLE document ADD COLUMN text_sum INTEGER NOT NULL DEFAULT 0",
        "ALTER TABLE document ADD COLUMN facts_sum INTEGER NOT NULL DEFAULT 0",
        "ALTER TABLE version ADD COLUMN text_sum INTEGER NOT NULL DEFAULT 0",
        f"UPDATE document SET text_sum = {TEXT_SUM}, facts_sum = {FACTS_SUM}",
        f"UPDATE version SET text_sum = {VERSION_SUM}",
    ),
)

DAMAGED = frozenset({sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB})


class DamagedError(Exception):
    """The file is no library any more."""


class Opened(NamedTuple):
    db: sqlite3.Connection
    damaged_file: str | None
    """The name that a damaged file was given."""
    changes_lost: bool
    """The journal is damaged before its end: what was written last may be missing."""


def open_library(folder: Path, steps: Sequence[Sequence[str]] = STEPS) -> Opened:
    """Raises a StorageError."""
    path = folder / FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        announced = announced_frames(path)
        try:
            db, damaged_file = open_sound(path, steps), None
        except DamagedError:
            damaged_file, announced = keep_damaged(path), 0
            db = open_sound(path, steps)
        return Opened(db, damaged_file, changes_lost=announced > found_frames(db))
    except (OSError, DamagedError) as error:
        raise StorageError(f"The library in {folder} cannot be opened: {error}.") from error


def open_sound(path: Path, steps: Sequence[Sequence[str]]) -> sqlite3.Connection:
    db = sqlite3.connect(path, timeout=BUSY_S, isolation_level=None, check_same_thread=False)
    db.create_function("sum_of", -1, sum_of, deterministic=True)
    db.text_factory = lambda data: data.decode(errors="replace")  # its sum tells
    try:
        db.execute("PRAGMA journal_mode = WAL")
        # A document that was called saved survives a power cut; writes are rare enough to pay for it.
        db.execute("PRAGMA synchronous = FULL")
        # What a damaged journal held is gone: few documents stand in it alone.
        db.execute(f"PRAGMA wal_autocheckpoint = {JOURNAL_PAGES}")
        db.execute("PRAGMA foreign_keys = ON")
        if db.execute("PRAGMA integrity_check(1)").fetchone()[0] != "ok":
            raise DamagedError("its contents contradict each other")  # noqa: TRY301
        upgrade(db, path, steps)
    except sqlite3.Error as error:
        db.close()
        raise damaged_or(error) from error
    except BaseException:
        db.close()
        raise
    return db


def announced_frames(path: Path) -> int:
    """The last committed frame of the journal, read before SQLite opens it: SQLite stops silently at a
    damaged first frame. Frames of earlier rounds bear another salt.
    """
    try:
        journal = path.with_name(f"{path.name}-wal").read_bytes()
    except OSError:
        return 0
    page_bytes = int.from_bytes(journal[8:12])
    step = FRAME_HEAD_BYTES + (page_bytes if page_bytes in PAGE_SIZES else USUAL_PAGE_BYTES)
    heads = [journal[at : at + FRAME_HEAD_BYTES] for at in range(JOURNAL_HEAD_BYTES, len(journal), step)]
    salts = {journal[16:24], *(head[8:16] for head in heads[:1])}
    ends = (n for n, head in enumerate(heads, 1) if head[8:16] in salts and any(head[4:8]))
    return max(ends, default=0)


def found_frames(db: sqlite3.Connection) -> int:
    """As many of them as SQLite has found whole."""
    return int(db.execute("PRAGMA wal_checkpoint(PASSIVE)").fetchone()[1])


def sum_of(*values: bytes | int | None) -> int:
    sum_ = 0
    for value in values:
        sum_ = crc32(value if isinstance(value, bytes) else b"\0%s\0" % str(value).encode(), sum_)
    return sum_


def upgrade(db: sqlite3.Connection, path: Path, steps: Sequence[Sequence[str]]) -> None:
    if version_of(db) > len(steps):
        raise StorageError(
            f"{path} was written by a newer Servodeck. Use that version, or another --data folder."
        )
    if 0 < version_of(db) < len(steps):
        back_up(db, path.with_name(f"library-before-version-{len(steps)}.sqlite"))
    db.execute("BEGIN IMMEDIATE")
    for step in steps[version_of(db) :]:  # read again: another gateway may have been faster
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


def keep_damaged(path: Path) -> str:
    """Renames the file with what belongs to it. Its new name."""
    name = f"library-unreadable-{time.time_ns() // 1_000_000}.sqlite"
    for ending in ("", "-wal", "-shm"):
        part = path.with_name(path.name + ending)
        if part.exists():
            part.rename(path.with_name(name + ending))
    return name


def damaged_or(error: sqlite3.Error) -> Exception:
    return DamagedError(str(error)) if sqlite_code(error) in DAMAGED else storage_error(error, FILE)
