"""Packets in plain English, for `servodeck decode`: the packets among bytes, and the meaning of each, from a
host and from a board. Knows the meaning of the bytes on every board.
"""

from collections.abc import Iterator
from typing import assert_never

from servodeck.protocol.decoder import COMMAND_AT, HEADER, LENGTH_AT, Packet
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import (
    parse_command,
    parse_report,
    read_offsets,
    read_position_entries,
    read_positions,
    read_uint16,
    whole_packet,
)
from servodeck.protocol.values import (
    Command,
    Download,
    Erase,
    Frame,
    Move,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Release,
    Report,
    Run,
    ServoTarget,
    SetSpeed,
    Stop,
    UnknownReport,
)
from servodeck.value import value

SERVOS = {1: "PWM servos", 2: "bus servos"}


HEADERS = bytes((HEADER, HEADER))


@value
class Piece:
    """A packet with its meanings, or bytes that belong to none. `reports`: of the families that send it."""

    data: bytes
    command: Command | None
    reports: tuple[Report, ...]
    text: str
    is_packet: bool = True


def pieces_of(data: bytes) -> Iterator[Piece]:
    """Packets in either direction, and the bytes between them. Nothing more is to come. Not by the Decoder,
    which knows the packets of one direction and takes unknown ones for noise.
    """
    noise_from = at = 0
    while at < len(data):
        piece = packet_at(data, at)
        if piece is None:
            at += 1
            continue
        if noise_from < at:
            yield noise(data[noise_from:at])
        yield piece
        noise_from = at = at + len(piece.data)
    if noise_from < at:
        yield noise(data[noise_from:at])


def noise(data: bytes) -> Piece:
    return Piece(data, None, (), f"no packet: {data.hex(' ').upper()}", is_packet=False)


def packet_at(data: bytes, at: int) -> Piece | None:
    """One with a known meaning, or an unknown one that is followed by another or by nothing."""
    if data[at : at + 2] != HEADERS or at + COMMAND_AT >= len(data):
        return None
    end = at + data[at + LENGTH_AT] + 2
    packet = whole_packet(data[at:end])
    if packet is None:
        return None
    piece = explained(data[at:end], packet)
    is_known = piece.command is not None or describe_report(packet) is not None
    return piece if is_known or data[end : end + 2] in (b"", HEADERS[:1], HEADERS) else None


def explained(data: bytes, packet: Packet) -> Piece:
    command = parse_command(data)
    reports = (parse_report(packet, family) for family in FAMILIES.values())
    known = tuple(dict.fromkeys(one for one in reports if not isinstance(one, UnknownReport)))
    from_board = describe_report(packet)
    from_host = describe_command(command) if command else None
    if from_host and from_board:
        text = f"{from_host}; from a board: {from_board}"
    else:
        text = from_host or from_board or f"unknown: {whole_words(packet)}"
    return Piece(data, command, known, text)


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
        case SetSpeed() | Release() | ReadPositions() | ReadVersion() | ReadAllPositions() | ReadOffsets():
            return describe_family_command(command)
    assert_never(command)


def describe_family_command(
    command: SetSpeed | Release | ReadPositions | ReadVersion | ReadAllPositions | ReadOffsets,
) -> str:
    match command:
        case SetSpeed(slot, percent):
            groups = "all groups" if slot is None else f"group {slot}"
            return f"set the speed of {groups} to {percent} %"
        case Release(servos):
            return f"take the torque off {servo_words(servos)}"
        case ReadPositions(servos):
            return f"ask for the position of {servo_words(servos)}"
        case ReadVersion():
            return "ask for the version"
        case ReadAllPositions():
            return "ask for the positions of all servos"
        case ReadOffsets():
            return "ask for the offsets"
    assert_never(command)


def frame_words(frame: Frame) -> str:
    return f"{target_words(frame.targets) or 'nothing'} in {frame.duration_ms} ms"


def target_words(targets: tuple[ServoTarget, ...]) -> str:
    return ", ".join(f"servo {target.servo} to {target.position}" for target in targets)


def position_words(positions: tuple[ServoTarget, ...]) -> str:
    return ", ".join(f"servo {at.servo} is at {at.position}" for at in positions)


def servo_words(servos: tuple[int, ...]) -> str:
    return ", ".join(f"servo {servo}" for servo in servos)


def times_words(times: int) -> str:
    return {0: "until stopped", 1: "once"}.get(times, f"{times} times")


def describe_report(packet: Packet) -> str | None:
    """Without a family, so what means opposite things says both. None where no board sends it."""
    params = packet.params
    match packet.command, len(params):
        case 6, 0:
            return "run command taken"
        case 6, 3:
            return f"group {params[0]} started, {times_words(read_uint16(params, 1))}"
        case 7, 0:
            return "the group ended by itself (OpenArm) or was stopped (LSC, bus servo boards)"
        case 8, 0:
            return "all groups erased"
        case 8, 3:
            return f"group {params[0]} ended by itself"
        case 15, 2:
            return f"battery {read_uint16(params, 0)} mV"
        case 25, 0:
            return "download frame handled"
    return describe_family_report(packet)


def describe_family_report(packet: Packet) -> str | None:
    params = packet.params
    match packet.command, len(params):
        case 1, 2:
            return f"version {params[1]}, {SERVOS.get(params[0], f'servos of type {params[0]}')}"
        case 21, _ if positions := read_positions(params):
            return position_words(positions)
        case 13, 18:
            return position_words(read_position_entries(params))
        case 2, 12:
            return ", ".join(f"servo {one.servo} has offset {one.offset}" for one in read_offsets(params))
    return None


def whole_words(packet: Packet) -> str:
    params = packet.params.hex(" ").upper()
    return f"CMD {packet.command}, {f'parameters {params}' if params else 'no parameters'}"
