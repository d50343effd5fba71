"""The list of who may come in, as a SQLite file of its own in the data folder.

Knows rows, not what they allow. Written as a whole: it is short and seldom changes.
"""

import sqlite3
import threading
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from servodeck.access.devices import Device
from servodeck.errors import StorageError
from servodeck.library.library_file import storage_error

FILE = "devices.sqlite"
BUSY_S = 2.0
VERSION = 1
TABLE = (
    "CREATE TABLE IF NOT EXISTS device (id TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, "
    "role TEXT NOT NULL, digest BLOB NOT NULL, paired_at_ms INTEGER NOT NULL, last_seen_ms INTEGER)"
)


class DeviceFile:
    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        self._lock = threading.Lock()

    def load(self) -> list[Device]:
        """Raises a StorageError for a file that is damaged or of a newer Servodeck."""
        if not self._path.exists():
            return []
        try:
            with closing(self._open()) as db:
                return [Device(*row) for row in db.execute("SELECT * FROM device ORDER BY paired_at_ms, id")]
        except (sqlite3.Error, OSError) as error:
            raise self._unusable(error) from error

    def save(self, devices: Callable[[], list[Device]]) -> None:
        with self._lock:  # and asked within it, so that an older list never overwrites a newer one
            try:
                self._path.parent.mkdir(parents=True, exist_ok=True)
                with closing(self._open()) as db:
                    write(db, devices())
            except sqlite3.Error as error:
                raise storage_error(error) from error
            except OSError as error:
                raise self._unusable(error) from error

    def _open(self) -> sqlite3.Connection:
        # Nobody else of this computer needs to read who is paired.
        self._path.touch(mode=0o600, exist_ok=True)
        db = sqlite3.connect(self._path, timeout=BUSY_S, isolation_level=None)
        try:
            if db.execute("PRAGMA user_version").fetchone()[0] > VERSION:
                raise StorageError(f"{self._path} was written by a newer Servodeck.")  # noqa: TRY301
            db.execute("PRAGMA synchronous = FULL")
            db.execute(TABLE)
        except BaseException:
            db.close()
            raise
        return db

    def _unusable(self, error: Exception) -> StorageError:
        return StorageError(
            f"{self._path} cannot be used: {error}. Moving it away forgets who is paired and begins anew."
        )


def write(db: sqlite3.Connection, devices: list[Device]) -> None:
    db.execute("BEGIN IMMEDIATE")
    try:
        db.execute("DELETE FROM device")
        rows = [
            (one.id, one.kind, one.name, one.role, one.digest, one.paired_at_ms, one.last_seen_ms)
            for one in devices
        ]
        db.executemany("INSERT INTO device VALUES (?, ?, ?, ?, ?, ?, ?)", rows)
        db.execute(f"PRAGMA user_version = {VERSION}")
        db.execute("COMMIT")
    finally:
        if db.in_transaction:
            db.execute("ROLLBACK")
