"""Small files of the data folder, written whole or not at all; the memory of the gateway in one of them; and
a check whether the disk can be written.

Knows no document and no database. Blocking calls run in threads and never longer than a moment: a disk that
hangs must not make its caller hang.
"""

import asyncio
import logging
import os
import shutil
import sqlite3
import tempfile
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from servodeck.errors import StorageBusyError, StorageError, StorageFullError
from servodeck.schema import Message
from servodeck.threads import in_thread

DISK_WAIT_S = 1.0
log = logging.getLogger("servodeck.files")


def write_whole(file: Path, text: str) -> None:
    """Raises OSError; what was there before is unharmed then."""
    file.parent.mkdir(parents=True, exist_ok=True)
    fresh = file.with_name(f"{file.name}.new")
    with fresh.open("w", encoding="utf-8") as opened:
        opened.write(text)
        opened.flush()
        os.fsync(opened.fileno())
    fresh.replace(file)


class BackgroundFile:
    """A value in memory that is written later: a full or slow disk delays no caller."""

    def __init__(self, file: Path | None, text: Callable[[], str]) -> None:
        """`text` is called in a thread. Without a file it is forgotten with the gateway."""
        self._file = file
        self._text = text
        self._lock = threading.Lock()
        self._saving: set[asyncio.Task[None]] = set()

    async def saved(self) -> None:
        """Waits until the present state is written, or has failed to be."""
        if self._file is None:
            return
        with suppress(TimeoutError):
            async with asyncio.timeout(DISK_WAIT_S):
                await in_thread(self._write)

    def save_soon(self) -> None:
        task = asyncio.create_task(self.saved())
        self._saving.add(task)
        task.add_done_callback(self._saving.discard)

    def _write(self) -> None:
        """Gets the text within the lock, so that no older text overwrites it."""
        assert self._file
        with self._lock:
            try:
                write_whole(self._file, self._text())
            except OSError as error:
                log.warning("not stored", extra={"facts": {"file": self._file.name, "detail": str(error)}})


WAIT_S = 0.5
GOOD_FOR_S = 5.0
NEEDED_BYTES = 16 * 1024 * 1024


class Disk:
    def __init__(self, folder: Path, now: Callable[[], float]) -> None:
        self._folder = folder
        self._now = now
        self._answer: str | None = None
        self._answered_at = float("-inf")
        self._checking: asyncio.Task[None] | None = None

    async def problem(self) -> str | None:
        """The problem of the disk, for people; checked again after a few seconds."""
        if self._checking is None and self._now() - self._answered_at > GOOD_FOR_S:
            self._checking = asyncio.create_task(self._check())
        if self._checking:
            try:
                await asyncio.wait_for(asyncio.shield(self._checking), WAIT_S)
            except TimeoutError:
                return "The disk does not answer."
        return self._answer

    async def _check(self) -> None:
        try:
            self._answer = await in_thread(lambda: problem_of(self._folder))
            self._answered_at = self._now()
        finally:
            self._checking = None


def problem_of(folder: Path) -> str | None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(b"\0")
            file.flush()
        free_bytes = shutil.disk_usage(folder).free
    except OSError as error:
        return f"The data folder takes no files: {error.strerror}."
    return "The disk of the data folder is full." if free_bytes < NEEDED_BYTES else None


FILE = "remembered.json"


class Memory(Message):
    port: Annotated[str, Field(max_length=256)] | None = None
    boards: dict[str, str] = Field(default_factory=dict)
    robots: dict[str, str] = Field(default_factory=dict)


class Remembered:
    def __init__(self, folder: Path | None = None) -> None:
        """Without a folder it is forgotten with the gateway. Each `remember_…` is stored."""
        file = folder / FILE if folder else None
        self._memory = read(file) if file else Memory()
        behind = BackgroundFile(file, self._text)
        self.saved = behind.saved
        self.save_soon = behind.save_soon

    @property
    def port(self) -> str | None:
        """The one that a person chose, by its lasting name where the system has one."""
        return self._memory.port

    def remember_port(self, device: str | None) -> None:
        self._memory = self._memory.model_copy(update={"port": device})

    def board_at(self, place: str) -> str | None:
        """The family that a person chose."""
        return self._memory.boards.get(place)

    def remember_board(self, place: str, family: str | None) -> None:
        self._memory = self._memory.model_copy(
            update={"boards": with_entry(self._memory.boards, place, family)}
        )

    def robot_on(self, board: str) -> str | None:
        """The document in the library."""
        return self._memory.robots.get(board)

    def remember_robot(self, board: str, document: str | None) -> None:
        self._memory = self._memory.model_copy(
            update={"robots": with_entry(self._memory.robots, board, document)}
        )

    def _text(self) -> str:
        return self._memory.model_dump_json()


def with_entry(entries: Mapping[str, str], key: str, value: str | None) -> dict[str, str]:
    """None takes it out."""
    others = {other: there for other, there in entries.items() if other != key}
    return others if value is None else others | {key: value}


def read(file: Path) -> Memory:
    """Unreadable content counts as empty."""
    try:
        return Memory.model_validate_json(file.read_text("utf-8"))
    except (OSError, ValueError, ValidationError):
        return Memory()


def storage_error(error: sqlite3.Error, file: str) -> StorageError:
    """`file`: the name of a SQLite file in the data folder, the library or the list of paired devices."""
    code = sqlite_code(error)
    if code == sqlite3.SQLITE_FULL:
        return StorageFullError("The disk of the data folder is full. Nothing that was stored is lost.")
    if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
        return StorageBusyError(f"Another program is using {file}. Try again.")
    if code == sqlite3.SQLITE_READONLY:
        return StorageError(
            f"{file} in the data folder cannot be written: it or its disk is read-only. "
            "Nothing in it is lost."
        )
    return StorageError(f"{file} in the data folder cannot be used: {error}.")


def sqlite_code(error: sqlite3.Error) -> int:
    """Without what SQLite adds to some codes in the higher bits."""
    return getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
