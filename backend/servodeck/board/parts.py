"""Groups as the packets that store them, judged for one family of boards.

Knows frames and packets; no job and no time. A large group takes a while, and a stop must not wait for it:
whoever waits for the packets lets others go on between two frames. A full board's frames would be 200 MB, its
packets are 10.
"""

import asyncio
import secrets
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from servodeck.access.gate import judge_frame
from servodeck.errors import CancelledError, OutOfRangeError
from servodeck.protocol.values import Download, Frame, ServoTarget


@dataclass(frozen=True, slots=True)
class Group:
    slot: int
    name: str
    frames: Sequence[Frame]
    version: str = ""
    replaces: str | None = None
    document: str | None = None


@dataclass(frozen=True, slots=True)
class Part:
    """One group of a download; `packets` in the order of its frames, for boards of the family `board`.
    `extremes`: the least and the greatest position of each servo. `version`: what it is called, by whoever
    asks, to tell it from others; `replaces`: that of what they have seen in its slot, if they have looked;
    `document`: of the library, where it is of one.
    """

    slot: int
    name: str
    packets: Sequence[bytes]
    board: str
    extremes: Sequence[ServoTarget]
    version: str
    replaces: str | None
    document: str | None


def judge_parts(parts: Sequence[Part], board: str) -> None:
    """Raises OutOfRangeError where a slot is wanted twice, CancelledError where they were made for another
    family.
    """
    slots = [part.slot for part in parts]
    twice = next((slot for at, slot in enumerate(slots) if slot in slots[:at]), None)
    if twice is not None:
        raise OutOfRangeError(f"Slot {twice} is wanted twice.")
    if any(part.board != board for part in parts):
        raise CancelledError("The board is taken for another one now.")


async def parts_of(groups: Sequence[Group], board: str) -> list[Part]:
    """Raises what such a board cannot take of them."""
    return [await part_of(group, board) for group in groups]


async def part_of(group: Group, board: str) -> Part:
    packets = []
    for packet in packets_of(group, board):
        packets.append(packet)
        await asyncio.sleep(0)
    return made_of(group, packets, board)


def made_of(group: Group, packets: Sequence[bytes], board: str) -> Part:
    return Part(
        group.slot,
        group.name,
        packets,
        board,
        extremes_of(group.frames),
        group.version or secrets.token_hex(8),
        group.replaces,
        group.document,
    )


def extremes_of(frames: Sequence[Frame]) -> list[ServoTarget]:
    least: dict[int, ServoTarget] = {}
    greatest: dict[int, ServoTarget] = {}
    for target in (target for frame in frames for target in frame.targets):
        servo, position = target.servo, target.position
        if servo not in least or position < least[servo].position:
            least[servo] = target
        if servo not in greatest or position > greatest[servo].position:
            greatest[servo] = target
    return [*least.values(), *greatest.values()]


def packets_of(group: Group, board: str) -> Iterator[bytes]:
    count = len(group.frames)
    if count == 0:
        raise OutOfRangeError("An action group needs at least one frame.")
    for index, frame in enumerate(group.frames):
        yield judge_frame(Download(group.slot, count, index, frame), board)
