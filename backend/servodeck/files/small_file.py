"""Writes a small file whole or not at all, whatever ends the process meanwhile. Knows no content."""

import asyncio
import logging
import os
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

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


class FileBehind:
    """What is held in memory, written behind: a disk that takes nothing hinders nobody."""

    def __init__(self, file: Path | None, text: Callable[[], str]) -> None:
        """`text` is asked for in a thread. Without a file it is forgotten with the gateway."""
        self._file = file
        self._text = text
        self._lock = threading.Lock()
        self._keeping: set[asyncio.Task[None]] = set()

    async def kept(self) -> None:
        """When the disk has it as it is now, or does not take it."""
        if self._file is None:
            return
        with suppress(TimeoutError):
            async with asyncio.timeout(DISK_WAIT_S):
                await in_thread(self._write)

    def keep_soon(self) -> None:
        task = asyncio.create_task(self.kept())
        self._keeping.add(task)
        task.add_done_callback(self._keeping.discard)

    def _write(self) -> None:
        """What it writes is asked within the lock, so that nothing older overwrites it."""
        assert self._file
        with self._lock:
            try:
                write_whole(self._file, self._text())
            except OSError as error:
                log.warning("not kept", extra={"facts": {"file": self._file.name, "detail": str(error)}})
