"""Looks at a port of this computer from outside: who may open it, who has it open, what a board on it says.

Sends one harmless query, for the battery. Knows no gateway and no terminal.
"""

import os
import time
from collections.abc import Awaitable
from dataclasses import dataclass, field

from servodeck.port.hid import find_board, is_hid
from servodeck.port.ports import OpenPort, group_of, open_port
from servodeck.port.whereabouts import holders_of, is_bluetooth
from servodeck.protocol.decoder import Decoder, DecoderEvent, PacketEvent, ReportDecoder
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import DECODER, LINE
from servodeck.protocol.values import ReadBattery
from servodeck.value import value

BATTERY = 15
PRINTABLE = frozenset(range(0x20, 0x7F)) | {0x0A, 0x0D}
# At another speed bits run together: one run of ones beside one of zeros.
RUNS = frozenset((0xFF << zeros) & 0xFF for zeros in range(9)) | frozenset(0xFF >> ones for ones in range(9))


@value
class Access:
    may_open: bool
    group: str
    """Whose members may."""
    held_by: tuple[str, ...]
    """Programs that have it open, so far as this account may see: "name (process number)"."""


@dataclass(slots=True)
class Heard:
    battery_mv: int | None = None
    answered_ms: float | None = None
    """From the question to its answer, where the battery was read."""
    packets: int = 0
    noise: bytearray = field(default_factory=bytearray)
    """What is no packet."""

    def take(self, event: DecoderEvent) -> None:
        if not isinstance(event, PacketEvent):
            self.noise += event.bytes
            return
        self.packets += 1
        if event.packet.command == BATTERY:
            self.battery_mv = int.from_bytes(event.packet.params[:2], "little")


def access_to(device: str) -> Access:
    """`device` is the path of a serial port, or the name of a board on a HID cable. Raises a PortError where
    that is not there.
    """
    path = find_board(device).device.node if is_hid(device) else device
    return Access(os.access(path, os.R_OK | os.W_OK), group_of(path), tuple(holders_of(path)))


def listen(device: str) -> Heard:
    """Opens the port, reads the battery and listens for a second. Raises a PortError with a sentence."""
    port = open_port(device)
    try:
        asked_s = time.monotonic()
        if leaving := port.write(encode(ReadBattery(), FAMILIES["doc"])):
            import asyncio  # of all commands only this one needs a loop

            asyncio.run(until_left(leaving))
        heard = heard_on(port)
        if heard.battery_mv is not None:
            heard.answered_ms = (time.monotonic() - asked_s) * 1000
        return heard
    finally:
        port.close()


async def until_left(leaving: Awaitable[None]) -> None:
    await leaving


def has_rates(device: str) -> bool:
    """It is a serial port of this computer."""
    return not (is_hid(device) or is_bluetooth(device) or "://" in device)


def find_rate(device: str) -> tuple[int, Heard] | None:
    """The first other speed at which what arrives can be read, and what that is. Writes nothing. Raises a
    PortError with a sentence.
    """
    for baud in LINE.other_rates:
        port = open_port(device, baud)
        try:
            heard = heard_on(port)
        finally:
            port.close()
        if heard.packets or (heard.noise and looks_like(heard.noise) == "text"):
            return baud, heard
    return None


def heard_on(port: OpenPort) -> Heard:
    heard = Heard()
    decoder = Decoder(heard.take)
    inbox = ReportDecoder(heard.take) if port.in_reports else decoder
    until_s = time.monotonic() + LINE.listen_ms / 1000
    while time.monotonic() < until_s and heard.battery_mv is None:
        if data := port.read():
            inbox.push(data)
    decoder.idle()
    return heard


def looks_like(noise: bytes | bytearray) -> str:
    """`text` of a program that prints, `rate` for bytes at another speed, else `other`.

    Twin of kindOfNoise in frontend/src/features/connect/doctor.ts; vectors/noise.json holds both.
    """
    if share(noise, PRINTABLE) >= DECODER.noise_share:
        return "text"
    return "rate" if share(noise, RUNS) >= DECODER.noise_share else "other"


def share(noise: bytes | bytearray, of: frozenset[int]) -> float:
    return sum(byte in of for byte in noise) / len(noise)
