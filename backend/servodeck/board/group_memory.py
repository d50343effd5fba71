"""The groups that this gateway stored on the board, and how fast the board plays them. Knows slots; not what
runs. Twin of shared/src/session/groupMemory.ts.

Of a group only its packets are kept: a full board's frames would be 200 MB, its packets are 10.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

from servodeck.protocol.packets import parse_command
from servodeck.protocol.timings import RUN
from servodeck.protocol.values import Download, Frame

AS_STORED = RUN.as_stored_percent


@dataclass(frozen=True, slots=True)
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
        """None: nobody knows what that slot holds."""
        self._are_others_empty = False
        self._percents: dict[int, int | None] = {}
        self._usual_percent: int | None = AS_STORED

    def store(self, slot: int, packets: Sequence[bytes]) -> None:
        self._packets[slot] = packets

    def clear(self, slot: int | None = None) -> None:
        """What it holds nobody knows; without a slot, of all of them."""
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
        """Without a slot, of every group (X3); without a percentage nobody knows whether it took one."""
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
