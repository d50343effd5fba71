"""Whether the data folder takes files now. Knows one folder, no document and no database.

Asks in a thread and never longer than a moment: a disk that hangs must not make whoever asks hang.
"""

import asyncio
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from servodeck.threads import in_thread

WAIT_S = 0.5
GOOD_FOR_S = 5.0
NEEDED_BYTES = 16 * 1024 * 1024


class Disk:
    def __init__(self, folder: Path, now: Callable[[], float]) -> None:
        self._folder = folder
        self._now = now
        self._answer: str | None = None
        self._answered_at = float("-inf")
        self._asking: asyncio.Task[None] | None = None

    async def problem(self) -> str | None:
        """What is wrong, for people; not asked anew within a few seconds."""
        if self._asking is None and self._now() - self._answered_at > GOOD_FOR_S:
            self._asking = asyncio.create_task(self._ask())
        if self._asking:
            try:
                await asyncio.wait_for(asyncio.shield(self._asking), WAIT_S)
            except TimeoutError:
                return "The disk does not answer."
        return self._answer

    async def _ask(self) -> None:
        try:
            self._answer = await in_thread(lambda: problem_of(self._folder))
            self._answered_at = self._now()
        finally:
            self._asking = None


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
