"""Packets to values and back, and what a board of a family can take: the gateway's door to the protocol.

Knows no port, no time and no client, and no words for people (describe.py). The gateway needs less of it than
the page (shared/src/codec). shared/protocol/vectors holds both codecs to each other.
"""

from collections.abc import Iterator, Sequence
from typing import Literal, assert_never

from servodeck.errors import MalformedError
from servodeck.protocol.decoder import COMMAND_AT, HEADER, Packet
from servodeck.protocol.families import Family, Range, check, check_range
from servodeck.protocol.values import (
    AllPositions,
    Battery,
    Command,
    CommandKind,
    Download,
    Erase,
    Erased,
    Frame,
    FrameStored,
    Move,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Release,
    Report,
    Run,
    RunAccepted,
    RunFinished,
    RunStarted,
    RunStopped,
    ServoOffset,
    ServoTarget,
    SetSpeed,
    Stop,
    UnknownReport,
    Version,
)
from servodeck.value import value

COMMAND_NUMBER: dict[CommandKind, int] = {
    "move": 3,
    "run": 6,
    "stop": 7,
    "erase": 8,
    "readBattery": 15,
    "download": 25,
    "setSpeed": 11,
    "release": 20,
    "readPositions": 21,
    "readVersion": 1,
    "readAllPositions": 13,
    "readOffsets": 2,
}
MOVE, RUN, STOP, ERASE, DOWNLOAD = (
    COMMAND_NUMBER[kind] for kind in ("move", "run", "stop", "erase", "download")
)
HARMLESS = frozenset(
    number for kind, number in COMMAND_NUMBER.items() if kind == "stop" or kind.startswith("read")
)
"""They move nothing and store nothing, so they need no driver."""
# In place of a slot: every group.
ALL_GROUPS = 0xFF
# What the board drives, by the number it reports with its version.
SERVO_TYPES: dict[int, Literal["us", "steps"]] = {1: "us", 2: "steps"}
MIN_LENGTH = 2
# Count and time before the entries of a move or frame; slot, count and number before those of a download.
FRAME_HEAD, ENTRY, DOWNLOAD_HEAD = 3, 3, 3


@value
class CommandPacket:
    """A command with its bytes, so that nothing behind has to read these again. `command` is None for bytes
    that are none: filler.
    """

    command: Command | None
    data: bytes

    @property
    def number(self) -> int:
        return self.data[COMMAND_AT]

    @property
    def is_harmless(self) -> bool:
        return self.number in HARMLESS


def encoded(command: Command, family: Family) -> CommandPacket:
    """Raises what a board of this family cannot take of it."""
    return CommandPacket(command, encode(command, family))


def encode(command: Command, family: Family) -> bytes:
    """The whole packet. Raises what a board of this family cannot take of it."""
    check(command, family)
    params = params_of(command, family)
    length = len(params) + MIN_LENGTH
    check_range("length", length, Range(MIN_LENGTH, family.max_length))
    return bytes((HEADER, HEADER, length, COMMAND_NUMBER[command.kind])) + params


def params_of(command: Command, family: Family) -> bytes:
    match command:
        case Move(duration_ms, targets):
            return frame_bytes(Frame(duration_ms, targets))
        case Run(slot, times):
            return bytes((slot,)) + word(times)
        case Erase():
            return bytes(family.erase_length - MIN_LENGTH)  # reserved
        case SetSpeed(slot, percent):
            return bytes((ALL_GROUPS if slot is None else slot,)) + word(percent)
        case Release(servos) | ReadPositions(servos):
            return bytes((len(servos), *servos))
        case Stop() | ReadBattery() | ReadVersion() | ReadAllPositions() | ReadOffsets():
            return b""
        case Download(slot, frame_count, frame_index, frame):
            return bytes((slot, frame_count, frame_index)) + frame_bytes(frame)
    assert_never(command)


def frame_bytes(frame: Frame) -> bytes:
    entries = (bytes((target.servo,)) + word(target.position) for target in frame.targets)
    return bytes((len(frame.targets),)) + word(frame.duration_ms) + b"".join(entries)


def word(value: int) -> bytes:
    return value.to_bytes(2, "little")


def check_command(packet: bytes, family: Family) -> Command:
    """The command that `packet` is. Raises MalformedError where it is not exactly one command, or what the
    family cannot take of it.
    """
    command = parse_command(packet)
    if command is None:
        raise MalformedError("The bytes are not exactly one well-formed command.")
    expected = encode(command, family)  # all limits, LEN among them
    if len(expected) != len(packet):
        raise MalformedError(f"This board takes {command.kind} with LEN {expected[2]}.")
    return command


def portions_of(servos: Sequence[int], size: int) -> Iterator[Sequence[int]]:
    """As many at a time as a packet takes."""
    for start in range(0, len(servos), size):
        yield servos[start : start + size]


def whole_packet(packet: bytes) -> Packet | None:
    """The packet, if these bytes are exactly one; its command may be unknown."""
    if len(packet) < MIN_LENGTH + 2 or packet[:2] != bytes((HEADER, HEADER)):
        return None
    return Packet(packet[3], packet[4:]) if packet[2] + 2 == len(packet) else None


def parse_command(packet: bytes) -> Command | None:
    """The command, or None where the bytes are not exactly a known one in shape. Judges no limits."""
    whole = whole_packet(packet)
    if whole is None:
        return None
    params = whole.params
    match whole.command, len(params):
        case 3, _:
            return read_move(params)
        case 6, 3:
            return Run(params[0], read_uint16(params, 1))
        case 7, 0:
            return Stop()
        case 8, 0 | 1:  # the reserved byte is not everywhere
            return Erase()
        case 15, 0:
            return ReadBattery()
        case 25, _:
            return read_download(params)
    return family_command(whole)


def family_command(packet: Packet) -> Command | None:
    """Those that only some families have."""
    params = packet.params
    match packet.command, len(params):
        case 11, 3:
            return SetSpeed(None if params[0] == ALL_GROUPS else params[0], read_uint16(params, 1))
        case 20, size if size and size == 1 + params[0]:
            return Release(tuple(params[1:]))
        case 21, size if size and size == 1 + params[0]:
            return ReadPositions(tuple(params[1:]))
        case 1, 0:
            return ReadVersion()
        case 13, 0:
            return ReadAllPositions()
        case 2, 0:
            return ReadOffsets()
    return None


def read_move(params: bytes) -> Move | None:
    frame = read_frame(params)
    return None if frame is None else Move(frame.duration_ms, frame.targets)


def read_download(params: bytes) -> Download | None:
    frame = read_frame(params[DOWNLOAD_HEAD:])
    return None if frame is None else Download(params[0], params[1], params[2], frame)


def read_frame(params: bytes) -> Frame | None:
    """Count, time and entries; None where the count and the bytes there disagree (S13)."""
    if len(params) < FRAME_HEAD or len(params) != FRAME_HEAD + ENTRY * params[0]:
        return None
    entries = range(FRAME_HEAD, len(params), ENTRY)
    targets = tuple(ServoTarget(params[at], read_uint16(params, at + 1)) for at in entries)
    return Frame(read_uint16(params, 1), targets)


def read_uint16(data: bytes, at: int, *, signed: bool = False) -> int:
    return int.from_bytes(data[at : at + 2], "little", signed=signed)


def parse_report(packet: Packet, family: Family) -> Report:
    """The report of the packet from a board of this family; unknown where no such board sends it."""
    report = empty_report(packet.command, family) if not packet.params else full_report(packet, family)
    return report or UnknownReport(packet.command, packet.params)


def empty_report(command: int, family: Family) -> Report | None:
    match command:
        case 6 if "run" in family.answers:
            return RunAccepted()
        case 7 if family.empty_seven == "runFinished":
            return RunFinished(None)
        case 7 if family.empty_seven == "runStopped":
            return RunStopped()
        case 8 if "erase" in family.answers:
            return Erased()
        case 25 if "download" in family.answers:
            return FrameStored()
    return None


def full_report(packet: Packet, family: Family) -> Report | None:
    params = packet.params
    match packet.command, len(params):
        case 15, 2 if "readBattery" in family.answers:
            return Battery(read_uint16(params, 0))
        case 6, 3 if family.run_reports_name_slot:
            return RunStarted(params[0], read_uint16(params, 1))
        case 8, 3 if family.run_reports_name_slot:
            return RunFinished(params[0])
        case 21, _ if "readPositions" in family.answers:
            positions = read_positions(params)
            return Positions(positions) if positions else None
        case 13, 18 if "readAllPositions" in family.answers:
            return AllPositions(read_position_entries(params))
        case 2, 12 if "readOffsets" in family.answers:
            return Offsets(read_offsets(params))
        case 1, 2 if "readVersion" in family.answers and params[0] in SERVO_TYPES:
            return Version(SERVO_TYPES[params[0]], params[1])
    return None


def read_positions(params: bytes) -> tuple[ServoTarget, ...]:
    """Empty where the count is wrong."""
    if not params or len(params) != 1 + ENTRY * params[0]:
        return ()
    return read_position_entries(params[1:])


def read_position_entries(data: bytes) -> tuple[ServoTarget, ...]:
    """Signed: turned by hand, a bus servo can stand a little below 0."""
    entries = range(0, len(data), ENTRY)
    return tuple(ServoTarget(data[at], read_uint16(data, at + 1, signed=True)) for at in entries)


def read_offsets(params: bytes) -> tuple[ServoOffset, ...]:
    entries = zip(params[::2], params[1::2], strict=True)
    return tuple(ServoOffset(servo, int.from_bytes((byte,), signed=True)) for servo, byte in entries)
