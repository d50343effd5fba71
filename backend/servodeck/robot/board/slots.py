"""The content of the board's slots: the groups that this gateway stored there since it opened the port (twin
of `createGroupMemory` in shared/src/robot/estimate.ts), and, on disk, which version of what was stored in
each slot last.

Of a group only its packets are stored: a full board's frames would be 200 MB, its packets are 10. Knows
slots; not what runs.
"""

import json
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any, overload

from servodeck.files import BackgroundFile
from servodeck.protocol.packets import parse_command
from servodeck.protocol.timings import RUN
from servodeck.protocol.values import Download, Frame
from servodeck.snapshots import StoredGroup
from servodeck.value import value

AS_STORED = RUN.as_stored_percent


@value
class PlayedFrames(Sequence[Frame]):
    """Of the packets that stored them, with the times at that speed."""

    packets: Sequence[bytes]
    percent: int

    def __len__(self) -> int:
        return len(self.packets)

    @overload
    def __getitem__(self, index: int) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Frame]: ...
    def __getitem__(self, index: int | slice) -> Frame | Sequence[Frame]:
        if isinstance(index, slice):
            return PlayedFrames(self.packets[index], self.percent)
        download = parse_command(self.packets[index])
        assert isinstance(download, Download)
        frame = download.frame
        if self.percent == AS_STORED:
            return frame
        return Frame((frame.duration_ms * AS_STORED + self.percent // 2) // self.percent, frame.targets)


class GroupMemory:
    def __init__(self) -> None:
        self._packets: dict[int, Sequence[bytes] | None] = {}
        """None: it is unknown what that slot holds."""
        self._are_others_empty = False
        self._percents: dict[int, int | None] = {}
        self._usual_percent: int | None = AS_STORED

    def store(self, slot: int, packets: Sequence[bytes]) -> None:
        self._packets[slot] = packets

    def clear(self, slot: int | None = None) -> None:
        """It is unknown what it holds; without a slot, of all of them."""
        if slot is None:
            self._packets.clear()
            self._are_others_empty = False
        else:
            self._packets[slot] = None

    def empty(self) -> None:
        """The board has erased every slot."""
        self._packets.clear()
        self._are_others_empty = True

    def set_speed(self, slot: int | None, percent: int | None) -> None:
        """Without a slot, of every group (X3); without a percentage it is unknown whether it took one."""
        if slot is None:
            self._percents.clear()
            self._usual_percent = percent
        else:
            self._percents[slot] = percent

    def forget_speeds(self) -> None:
        """The board may have lost its speeds with its power, or not."""
        if self._percents or self._usual_percent != AS_STORED:
            self._usual_percent = None
        self._percents.clear()

    def played_frames(self, slot: int) -> Sequence[Frame] | None:
        """With the times the board plays them in; empty where nothing is stored, None where the frames or the
        speed are unknown.
        """
        packets = self._packets.get(slot, () if self._are_others_empty else None)
        percent = self._percents.get(slot, self._usual_percent)
        return None if packets is None or percent is None else PlayedFrames(packets, percent)


FILE = "slots.json"
# Of earlier versions: for each board the slots that hold half a group.
OLD_FILE = "broken-slots.json"


@value
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
        behind = BackgroundFile(folder / FILE if folder else None, self._text)
        self.saved = behind.saved
        self.save_soon = behind.save_soon

    def broken(self, board: str) -> list[int]:
        return sorted(self._of(board).broken)

    def stored(self, board: str) -> Mapping[int, StoredGroup]:
        """The last complete group of each slot."""
        return self._of(board).stored

    def version(self, board: str, slot: int) -> str:
        """Empty where none is known."""
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
        """An erase has begun: it is unknown what is left. What was broken is, until a report."""
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
    """Unreadable content counts as empty."""
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
    """Earlier releases stored only its version."""
    return StoredGroup(version=found) if isinstance(found, str) else StoredGroup.model_validate(found)


def json_in(file: Path) -> Any:
    """None where there is nothing, or nothing that was written here."""
    try:
        found = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None
