"""What the slots of each board hold, as far as downloads tell: which hold half a group, so that nobody runs
them, and what the others got last, from whom and when. Kept on disk, also for after a crash.

Knows one small file and names of boards; no port and no packet. A disk that takes nothing hinders no
download: then it is remembered until the gateway ends.
"""

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from servodeck.files.small_file import FileBehind
from servodeck.told import StoredGroup

FILE = "slots.json"
# Of earlier versions: for each board the slots that hold half a group.
OLD_FILE = "broken-slots.json"


@dataclass(frozen=True, slots=True)
class Slots:
    """Of one board."""

    broken: frozenset[int] = frozenset()
    stored: Mapping[int, StoredGroup] = field(default_factory=dict)


NOTHING = Slots()


class SlotMemory:
    def __init__(self, folder: Path | None = None, today: Callable[[], float] = time.time) -> None:
        """Without a folder they are forgotten with the gateway. `today`: seconds since 1970."""
        self._today = today
        self._boards = read(folder) if folder else {}
        behind = FileBehind(folder / FILE if folder else None, self._text)
        self.kept = behind.kept
        self.keep_soon = behind.keep_soon

    def broken(self, board: str) -> list[int]:
        return sorted(self._of(board).broken)

    def stored(self, board: str) -> Mapping[int, StoredGroup]:
        """What was stored whole in each slot last."""
        return self._of(board).stored

    def version(self, board: str, slot: int) -> str:
        """Empty where nobody knows of any."""
        stored = self.stored(board).get(slot)
        return stored.version if stored else ""

    def breaks(self, board: str, slot: int) -> None:
        """It holds half a group from here on, or may."""
        self._put(board, replace(self._of(board), broken=self._of(board).broken | {slot}))

    def mend(self, board: str, slot: int) -> None:
        """It holds what it held before."""
        self._put(board, replace(self._of(board), broken=self._of(board).broken - {slot}))

    def store(
        self, board: str, slot: int, version: str, name: str = "", document: str | None = None, by: str = ""
    ) -> None:
        """It holds that, all of it."""
        self.mend(board, slot)
        at_ms = round(self._today() * 1000)
        group = StoredGroup(version=version, name=name, document=document, by=by, at_ms=at_ms)
        self._put(board, replace(self._of(board), stored={**self.stored(board), slot: group}))

    def forget(self, board: str) -> None:
        """An erase has begun: nobody knows what is left. What was broken is, until the board says more."""
        self._put(board, replace(self._of(board), stored={}))

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
                board: {
                    "broken": sorted(slots.broken),
                    "versions": {slot: group.model_dump() for slot, group in slots.stored.items()},
                }
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
    stored = {int(slot): group_of(group) for slot, group in found["versions"].items()}
    return Slots(frozenset(map(int, found["broken"])), stored)


def group_of(found: Any) -> StoredGroup:
    """Earlier versions kept nothing but its version."""
    return StoredGroup(version=found) if isinstance(found, str) else StoredGroup.model_validate(found)


def json_in(file: Path) -> Any:
    """None where there is nothing, or nothing that was written here."""
    try:
        found = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None
