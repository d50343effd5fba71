"""Which packets a board of a family can take: single commands, and groups as the packets that store them.

Pure but for `parts_of`, which lets other tasks run between two frames: a large group takes a while, and a
stop must not wait for it. A full board's frames would be 200 MB, its packets are 10. Knows no port, no client
and no time.
"""

import asyncio
import secrets
from collections.abc import Iterator, Sequence

from servodeck.callers import Role
from servodeck.errors import (
    CancelledError,
    GatewayError,
    LatchedError,
    MalformedError,
    NotSupportedError,
    OutOfRangeError,
)
from servodeck.protocol.families import FAMILIES, Family
from servodeck.protocol.limits import PacketError, check
from servodeck.protocol.packets import CommandPacket, check_command, encoded
from servodeck.protocol.values import Command, Download, Frame, Move, ServoTarget
from servodeck.value import value

MOVE, RUN, STOP, ERASE, DOWNLOAD = 3, 6, 7, 8, 25
BATTERY, POSITIONS, VERSION, ALL_POSITIONS, OFFSETS = 15, 21, 1, 13, 2
HARMLESS = frozenset({STOP, BATTERY, POSITIONS, VERSION, ALL_POSITIONS, OFFSETS})


def judge_packet(text: str, board: str) -> CommandPacket:
    """The packet in `text` (hex) when it is one command that board can take. Raises what is wrong with it."""
    try:
        packet = bytes.fromhex(text)
    except ValueError:
        raise MalformedError("The packet is not in hex digits.") from None
    try:
        return CommandPacket(check_command(packet, FAMILIES[board]), packet)
    except PacketError as error:
        raise refusal_of(error) from error


def packet_of(command: Command, family: Family) -> CommandPacket:
    """Raises what the board cannot take of it."""
    try:
        return encoded(command, family)
    except PacketError as error:
        raise refusal_of(error) from error


def judge_command(command: Command, family: Family) -> None:
    """Raises what the board cannot take of it."""
    try:
        check(command, family)
    except PacketError as error:
        raise refusal_of(error) from error


def judge_targets(targets: Sequence[ServoTarget], duration_ms: int, family: Family) -> None:
    """Raises what the board cannot take of any of them; how many there are does not matter."""
    for target in targets:
        judge_command(Move(duration_ms, (target,)), family)


def portions_of(servos: Sequence[int], size: int) -> Iterator[Sequence[int]]:
    for start in range(0, len(servos), size):
        yield servos[start : start + size]


def judge_single_packet(packet: CommandPacket) -> None:
    """A frame alone only breaks the slot it goes to (S33, S35). Raises NotSupportedError."""
    if packet.number == DOWNLOAD:
        raise NotSupportedError("A single frame cannot be stored: use POST /api/download for a whole group.")


def refusal_of(error: PacketError) -> GatewayError:
    if error.code == "malformed":
        return MalformedError(error.detail)
    return (NotSupportedError if error.field == "command" else OutOfRangeError)(error.detail)


def is_harmless(packet: CommandPacket) -> bool:
    """It moves nothing and stores nothing, so it needs no driver."""
    return packet.number in HARMLESS


def role_for(packet: CommandPacket) -> Role:
    """Who may send it at least: questions do no harm, an erased board is empty for all."""
    if packet.number == STOP:
        return "stopper"
    if is_harmless(packet):
        return "viewer"
    return "owner" if packet.number == ERASE else "driver"


def judge_latch(number: int, latch: bool) -> None:
    """While stopped, only what moves nothing and stores nothing passes. Raises LatchedError."""
    if latch and number not in HARMLESS:
        raise LatchedError("Stopped: motion is refused until somebody resumes.")


@value
class Group:
    slot: int
    name: str
    frames: Sequence[Frame]
    version: str = ""
    replaces: str | None = None
    document: str | None = None


@value
class Part:
    """One group of a download; `packets` in the order of its frames, for boards of the family `board`.
    `extremes`: the least and the greatest position of each servo. `version`: what it is called, by the client
    that asks, to tell it from others; `replaces`: that of what they have seen in its slot, if they have
    looked; `document`: of the library, where it is of one.
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
        raise OutOfRangeError(f"Slot {twice} is given twice.")
    if any(part.board != board for part in parts):
        raise CancelledError("Another board was chosen.")


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
        yield packet_of(Download(group.slot, count, index, frame), FAMILIES[board]).data
