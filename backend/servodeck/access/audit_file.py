"""The list of acts as a SQLite file in the data folder, and as CSV or JSON lines for other programs.

Writes only entries that changed. Knows entries; not when they are written.
"""

import csv
import io
import json
import sqlite3
from collections.abc import Iterable, Sequence
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from servodeck.access.audit import Act, Entry
from servodeck.errors import StorageError
from servodeck.files import storage_error
from servodeck.value import fields_of

FILE = "audit.sqlite"
BUSY_S = 2.0
VERSION = 1
TABLE = (
    "CREATE TABLE IF NOT EXISTS entry (id INTEGER PRIMARY KEY, act TEXT NOT NULL, who TEXT, "
    "whom TEXT NOT NULL, about TEXT NOT NULL, at_ms INTEGER NOT NULL, until_ms INTEGER NOT NULL, "
    "count INTEGER NOT NULL)"
)


class AuditFile:
    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE

    def load(self) -> list[Entry]:
        if not self._path.exists():
            return []
        try:
            with closing(self._open()) as db:
                return [Entry(*row) for row in db.execute("SELECT * FROM entry ORDER BY id")]
        except (sqlite3.Error, OSError) as error:
            raise StorageError(
                f"{self._path} cannot be used: {error}. Move it away to begin a new list."
            ) from error

    def save(self, changed: Sequence[Entry], oldest_id: int) -> None:
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with closing(self._open()) as db:
                write(db, changed, oldest_id)
        except sqlite3.Error as error:
            raise storage_error(error, FILE) from error
        except OSError as error:
            raise StorageError(f"{FILE} in the data folder cannot be used: {error.strerror}.") from error

    def _open(self) -> sqlite3.Connection:
        self._path.touch(mode=0o600, exist_ok=True)
        db = sqlite3.connect(self._path, timeout=BUSY_S, isolation_level=None)
        try:
            if db.execute("PRAGMA user_version").fetchone()[0] > VERSION:
                raise StorageError(f"{self._path} was written by a newer Servodeck.")  # noqa: TRY301
            db.execute(TABLE)
        except BaseException:
            db.close()
            raise
        return db


def write(db: sqlite3.Connection, changed: Sequence[Entry], oldest_id: int) -> None:
    db.execute("BEGIN IMMEDIATE")
    try:
        rows = map(fields_of, changed)
        db.executemany("INSERT OR REPLACE INTO entry VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)
        db.execute("DELETE FROM entry WHERE id < ?", (oldest_id,))
        db.execute(f"PRAGMA user_version = {VERSION}")
        db.execute("COMMIT")
    finally:
        if db.in_transaction:
            db.execute("ROLLBACK")


def append(folder: Path, act: Act, about: str, at_ms: int) -> None:
    """For a command that works while no gateway runs. Raises a StorageError."""
    file = AuditFile(folder)
    found = file.load()
    entry = Entry(found[-1].id + 1 if found else 1, act, None, "", about, at_ms, at_ms, 1)
    file.save([entry], found[0].id if found else entry.id)


COLUMNS = ("at", "until", "act", "who", "whom", "about", "count")
# A spreadsheet takes a cell that begins so for a formula; names are what people typed.
FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")


def as_csv(entries: Iterable[Entry]) -> str:
    """RFC 4180, with a head line; times are UTC. A text that would be a formula has a quote before it."""
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(COLUMNS)
    for entry in entries:
        writer.writerow(harmless(value) for value in row_of(entry).values())
    return text.getvalue()


def as_json_lines(entries: Iterable[Entry]) -> str:
    """One object a line, with the columns of the CSV."""
    return "".join(f"{json.dumps(row_of(entry), ensure_ascii=False)}\n" for entry in entries)


def row_of(entry: Entry) -> dict[str, Any]:
    values = (
        time_of(entry.at_ms),
        time_of(entry.until_ms),
        *(entry.act, entry.who or "", entry.whom, entry.about, entry.count),
    )
    return dict(zip(COLUMNS, values, strict=True))


def time_of(epoch_ms: int) -> str:
    return datetime.fromtimestamp(epoch_ms / 1000, UTC).isoformat(timespec="milliseconds")


def harmless(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULA) else value
