"""Packets to values and back, and what a board of a family can take: the gateway's door to the protocol.

Knows no port, no time and no client. What the packets are for is the page's affair (shared/src/protocol); the
gateway only has to judge what goes on the wire. shared/vectors holds both codecs to each other.
"""

from typing import Literal, assert_never

from servodeck.decoder import (
    COMMAND_SHAPES,
    HEADER,
    REPORT_SHAPES,
    Decoder,
    DecoderEvent,
    NoiseEvent,
    Packet,
    PacketEvent,
)
from servodeck.families import FAMILIES, CommandKind, Family, Range
from servodeck.limits import PacketError, check, check_range
from servodeck.values import (
    Battery,
    Command,
    Download,
    Erase,
    Erased,
    Frame,
    FrameStored,
    Move,
    ReadBattery,
    Report,
    Run,
    RunAccepted,
    RunFinished,
    RunStarted,
    RunStopped,
    ServoTarget,
    Stop,
    UnknownReport,
)

__all__ = [
    "COMMAND_SHAPES",
    "FAMILIES",
    "REPORT_SHAPES",
    "Battery",
    "Command",
    "Decoder",
    "DecoderEvent",
    "Family",
    "NoiseEvent",
    "Packet",
    "PacketError",
    "PacketEvent",
    "Report",
    "check_command",
    "describe",
    "encode",
    "parse_command",
    "parse_report",
]

COMMAND_NUMBER: dict[CommandKind, int] = {
    "move": 3,
    "run": 6,
    "stop": 7,
    "erase": 8,
    "readBattery": 15,
    "download": 25,
}
MIN_LENGTH = 2
# Count and time before the entries of a move or frame; slot, count and number before those of a download.
FRAME_HEAD, ENTRY, DOWNLOAD_HEAD = 3, 3, 3


def encode(command: Command, family: Family) -> bytes:
    """The whole packet. Raises PacketError where a board of this family cannot take the command."""
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
        case Stop() | ReadBattery():
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
    """The command that `packet` is. Raises PacketError unless it is exactly one that the family can take."""
    command = parse_command(packet)
    if command is None:
        raise PacketError("malformed", "The bytes are not exactly one well-formed command.")
    expected = encode(command, family)  # all limits, LEN among them
    if len(expected) != len(packet):
        raise PacketError("malformed", f"A board of this kind takes {command.kind} with LEN {expected[2]}.")
    return command


def whole_packet(packet: bytes) -> Packet | None:
    """The packet, if these bytes are exactly one, of whatever command."""
    if len(packet) < MIN_LENGTH + 2 or packet[:2] != bytes((HEADER, HEADER)):
        return None
    return Packet(packet[3], packet[4:]) if packet[2] + 2 == len(packet) else None


def parse_command(packet: bytes) -> Command | None:
    """The command, or None where the bytes are not exactly one of the six in shape. Judges no limits."""
    whole = whole_packet(packet)
    if whole is None:
        return None
    params = whole.params
    match whole.command, len(params):
        case 3, _:
            return read_move(params)
        case 6, 3:
            return Run(params[0], read_word(params, 1))
        case 7, 0:
            return Stop()
        case 8, 0 | 1:  # the reserved byte is not everywhere
            return Erase()
        case 15, 0:
            return ReadBattery()
        case 25, _:
            return read_download(params)
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
    targets = tuple(ServoTarget(params[at], read_word(params, at + 1)) for at in entries)
    return Frame(read_word(params, 1), targets)


def read_word(data: bytes, at: int) -> int:
    return int.from_bytes(data[at : at + 2], "little")


def parse_report(packet: Packet, family: Family) -> Report:
    """What the packet says when a board of this family sends it; unknown where none is known to."""
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
            return Battery(read_word(params, 0))
        case 6, 3 if family.run_reports_name_slot:
            return RunStarted(params[0], read_word(params, 1))
        case 8, 3 if family.run_reports_name_slot:
            return RunFinished(params[0])
    return None


def describe(packet: bytes, direction: Literal["command", "report"]) -> str:
    """One packet in plain English. Raises PacketError where the bytes are not exactly one packet."""
    whole = whole_packet(packet)
    if whole is None:
        raise PacketError("malformed", "The bytes are not exactly one packet: 55 55, LEN, CMD, LEN - 2 more.")
    if direction == "report":
        return describe_report(whole)
    command = parse_command(packet)
    return describe_command(command) if command else f"no known command: {whole_words(whole)}"


def describe_command(command: Command) -> str:
    match command:
        case Move(duration_ms, targets):
            return f"move {frame_words(Frame(duration_ms, targets))}"
        case Run(slot, times):
            return f"run group {slot} {times_words(times)}"
        case Stop():
            return "stop the running group after the frame in progress"
        case Erase():
            return "erase all groups"
        case ReadBattery():
            return "ask for the battery voltage"
        case Download(slot, frame_count, frame_index, frame):
            return (
                f"store frame {frame_index} (of {frame_count}, from 0) of group {slot}: {frame_words(frame)}"
            )
    assert_never(command)


def frame_words(frame: Frame) -> str:
    targets = ", ".join(f"servo {target.servo} to {target.position}" for target in frame.targets)
    return f"{targets or 'nothing'} in {frame.duration_ms} ms"


def times_words(times: int) -> str:
    return {0: "until stopped", 1: "once"}.get(times, f"{times} times")


def describe_report(packet: Packet) -> str:
    """Without a family, so what means opposite things says both."""
    params = packet.params
    match packet.command, len(params):
        case 6, 0:
            return "run command taken"
        case 6, 3:
            return f"group {params[0]} started, {times_words(read_word(params, 1))}"
        case 7, 0:
            return "the group ended by itself (OpenArm) or was stopped (LSC, bus servo boards)"
        case 8, 0:
            return "all groups erased"
        case 8, 3:
            return f"group {params[0]} ended by itself"
        case 15, 2:
            return f"battery {read_word(params, 0)} mV"
        case 25, 0:
            return "download frame handled"
    return f"no known report: {whole_words(packet)}"


def whole_words(packet: Packet) -> str:
    params = packet.params.hex(" ").upper()
    return f"CMD {packet.command}, {f'parameters {params}' if params else 'no parameters'}"
