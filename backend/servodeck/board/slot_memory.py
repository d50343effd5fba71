"""What the slots of each board hold, as far as downloads tell: which hold half a group, so that nobody runs
them, and which version the others got last. Kept on disk, also for after a crash.

Knows one small file and names of boards; no port and no packet. A disk that takes nothing hinders no
download: then it is remembered until the gateway ends.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from servodeck.files.small_file import FileBehind

FILE = "slots.json"
# Of earlier versions: for each board the slots that hold half a group.
OLD_FILE = "broken-slots.json"


@dataclass(frozen=True, slots=True)
class Slots:
    """Of one board."""

    broken: frozenset[int] = frozenset()
    versions: Mapping[int, str] = field(default_factory=dict)


NOTHING = Slots()


class SlotMemory:
    def __init__(self, folder: Path | None = None) -> None:
        """Without a folder they are forgotten with the gateway."""
        self._boards = read(folder) if folder else {}
        behind = FileBehind(folder / FILE if folder else None, self._text)
        self.kept = behind.kept
        self.keep_soon = behind.keep_soon

    def broken(self, board: str) -> list[int]:
        return sorted(self._of(board).broken)

    def versions(self, board: str) -> Mapping[int, str]:
        """What was stored whole in each slot last, by what whoever stored it calls it."""
        return self._of(board).versions

    def breaks(self, board: str, slot: int) -> None:
        """It holds half a group from here on, or may."""
        self._put(board, replace(self._of(board), broken=self._of(board).broken | {slot}))

    def mend(self, board: str, slot: int) -> None:
        """It holds what it held before."""
        self._put(board, replace(self._of(board), broken=self._of(board).broken - {slot}))

    def store(self, board: str, slot: int, version: str) -> None:
        """It holds that, all of it."""
        self.mend(board, slot)
        self._put(board, replace(self._of(board), versions={**self.versions(board), slot: version}))

    def forget(self, board: str) -> None:
        """An erase has begun: nobody knows what is left. What was broken is, until the board says more."""
        self._put(board, replace(self._of(board), versions={}))

    def clear(self, board: str) -> None:
        self._put(board, NOTHING)

    def _of(self, board: str) -> Slots:
        return self._boards.get(board, NOTHING)

    def _put(self, board: str, slots: Slots) -> None:
        # A new one each time: the disk's thread may be reading the old one.
        self._boards = {**self._boards, board: slots}

    def _text(self) -> str:
        return json.dumps(
            {
                board: {"broken": sorted(slots.broken), "versions": slots.versions}
                for board, slots in self._boards.items()
                if slots != NOTHING
            }
        )


def read(folder: Path) -> dict[str, Slots]:
    """What cannot be read was not written here."""
    found = json_in(folder / FILE)
    if found is None:
        old = json_in(folder / OLD_FILE) or {}
        found = {board: {"broken": slots, "versions": {}} for board, slots in old.items()}
    try:
        return {str(board): slots_of(slots) for board, slots in found.items()}
    except (AttributeError, KeyError, TypeError, ValueError):
        return {}


def slots_of(found: dict[str, Any]) -> Slots:
    versions = {int(slot): str(version) for slot, version in found["versions"].items()}
    return Slots(frozenset(map(int, found["broken"])), versions)


def json_in(file: Path) -> Any:
    """None where there is nothing, or nothing that was written here."""
    try:
        found = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None
