"""Which slots of which board hold half a group, kept on disk: nobody may run them, also after a crash.

Knows one small file and names of boards; no port and no packet. A disk that takes nothing hinders no
download: then it is remembered until the gateway ends.
"""

import asyncio
import json
import logging
import threading
from contextlib import suppress
from pathlib import Path
from typing import Any

from servodeck.background import in_thread
from servodeck.small_file import write_whole

FILE = "broken-slots.json"
DISK_WAIT_S = 1.0
log = logging.getLogger("servodeck.robot")


class BrokenSlots:
    def __init__(self, folder: Path | None = None) -> None:
        """Without a folder they are forgotten with the gateway."""
        self._file = folder / FILE if folder else None
        self._slots = read(self._file) if self._file else {}
        self._lock = threading.Lock()
        self._keeping: set[asyncio.Task[None]] = set()

    def of(self, board: str) -> list[int]:
        return sorted(self._slots.get(board, ()))

    def add(self, board: str, slot: int) -> None:
        self._slots = {**self._slots, board: self._slots.get(board, frozenset()) | {slot}}

    def remove(self, board: str, slot: int) -> None:
        self._slots = {**self._slots, board: self._slots.get(board, frozenset()) - {slot}}

    def clear(self, board: str) -> None:
        self._slots = {other: slots for other, slots in self._slots.items() if other != board}

    async def kept(self) -> None:
        """When the disk has it as it is now, or does not take it."""
        if self._file is None:
            return
        with suppress(TimeoutError):
            async with asyncio.timeout(DISK_WAIT_S):
                await in_thread(self._write, undo=lambda _: None)

    def keep_soon(self) -> None:
        task = asyncio.create_task(self.kept())
        self._keeping.add(task)
        task.add_done_callback(self._keeping.discard)

    def _write(self) -> None:
        """In a thread; what it writes is asked within the lock, so that nothing older overwrites it."""
        assert self._file
        with self._lock:
            text = json.dumps({board: sorted(slots) for board, slots in self._slots.items() if slots})
            try:
                write_whole(self._file, text)
            except OSError as error:
                log.warning("broken slots not kept", extra={"facts": {"detail": str(error)}})


def read(file: Path) -> dict[str, frozenset[int]]:
    """What cannot be read was not written here."""
    try:
        found: Any = json.loads(file.read_text("utf-8"))
        return {str(board): frozenset(map(int, slots)) for board, slots in found.items()}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}
