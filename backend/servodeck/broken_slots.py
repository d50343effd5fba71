"""Which slots of which board hold half a group, kept on disk: nobody may run them, also after a crash.

Knows one small file and names of boards; no port and no packet. A disk that takes nothing hinders no
download: then it is remembered until the gateway ends.
"""

import json
from pathlib import Path
from typing import Any

from servodeck.small_file import FileBehind

FILE = "broken-slots.json"


class BrokenSlots:
    def __init__(self, folder: Path | None = None) -> None:
        """Without a folder they are forgotten with the gateway."""
        file = folder / FILE if folder else None
        self._slots = read(file) if file else {}
        behind = FileBehind(file, self._text)
        self.kept = behind.kept
        self.keep_soon = behind.keep_soon

    def of(self, board: str) -> list[int]:
        return sorted(self._slots.get(board, ()))

    def add(self, board: str, slot: int) -> None:
        self._slots = {**self._slots, board: self._slots.get(board, frozenset()) | {slot}}

    def remove(self, board: str, slot: int) -> None:
        self._slots = {**self._slots, board: self._slots.get(board, frozenset()) - {slot}}

    def clear(self, board: str) -> None:
        self._slots = {other: slots for other, slots in self._slots.items() if other != board}

    def _text(self) -> str:
        return json.dumps({board: sorted(slots) for board, slots in self._slots.items() if slots})


def read(file: Path) -> dict[str, frozenset[int]]:
    """What cannot be read was not written here."""
    try:
        found: Any = json.loads(file.read_text("utf-8"))
        return {str(board): frozenset(map(int, slots)) for board, slots in found.items()}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}
