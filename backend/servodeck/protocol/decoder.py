"""Turns bytes into packets and noise, in pieces of any size and with any damage.

Bounded memory, never raises. Knows no meaning, no family and no time: the caller says with `pause` and `idle`
that the line has been silent. The rules of shared/src/codec/decoder.ts;
shared/protocol/vectors/streams.json holds both.
"""

from collections.abc import Callable, Iterator
from typing import Final, Literal

from servodeck.protocol.timings import DECODER, HID
from servodeck.value import value

RawBytes = bytes
Buffer = bytes | bytearray

HEADER: Final = 0x55
MAX_LENGTH: Final = 253
LONGEST_PACKET: Final = MAX_LENGTH + 2
# Two headers, LEN, CMD: a packet without parameters is no longer.
HEAD_SIZE: Final = 4
LENGTH_AT: Final = 2
COMMAND_AT: Final = 3
NOISE_SIZE: Final = DECODER.noise_bytes
MOST_SERVOS: Final = DECODER.most_servos

# Verdicts beside a size: no packet begins here; the bytes end before it is clear.
NO: Final = -1
WAIT: Final = 0


@value
class Packet:
    command: int
    params: bytes


@value
class PacketEvent:
    packet: Packet
    bytes: RawBytes


@value
class NoiseEvent:
    """`garbage` belongs to no packet; `truncated` began like one that the silence cut short."""

    reason: Literal["garbage", "truncated"]
    bytes: RawBytes


DecoderEvent = PacketEvent | NoiseEvent

# (CMD, LEN) of each packet there is: nothing else protects this wire. The value is where the count byte
# stands in the packet and what it must be, None for packets that do not grow with the number of servos.
CountByte = tuple[int, int]
Shapes = dict[tuple[int, int], CountByte | None]


def growing(
    command: int, length: int, per_servo: int, count_at: int, servos: range
) -> Iterator[tuple[tuple[int, int], CountByte]]:
    for count in servos:
        grown = length + per_servo * count
        if grown <= MAX_LENGTH:
            yield (command, grown), (HEAD_SIZE + count_at, count)


# Board to host, the union over all families (boards.md 2.3, 2.4).
REPORT_SHAPES: Final[Shapes] = {
    (1, 4): None,
    (2, 14): None,
    (5, 4): None,
    (6, 2): None,
    (6, 5): None,
    (7, 2): None,
    (8, 2): None,
    (8, 5): None,
    (11, 2): None,
    (13, 20): None,
    (15, 4): None,
    **dict(growing(21, 3, 3, 0, range(1, MOST_SERVOS + 1))),
    **dict(growing(23, 3, 2, 0, range(1, MOST_SERVOS + 1))),
    (25, 2): None,
}

# Host to board: the six commands of the protocol document, then what single families have.
COMMAND_SHAPES: Final[Shapes] = {
    **dict(growing(3, 5, 3, 0, range(83))),
    (6, 5): None,
    (7, 2): None,
    (8, 2): None,
    (8, 3): None,
    (15, 2): None,
    **dict(growing(25, 8, 3, 3, range(82))),
    (1, 2): None,
    (2, 2): None,
    (11, 5): None,
    (13, 2): None,
    **dict(growing(20, 3, 1, 0, range(1, MOST_SERVOS + 1))),
    **dict(growing(21, 3, 1, 0, range(1, MOST_SERVOS + 1))),
}


class Decoder:
    def __init__(self, emit: Callable[[DecoderEvent], None], shapes: Shapes = REPORT_SHAPES) -> None:
        self._emit = emit
        self._shapes = shapes
        self._lengths = frozenset(length for _, length in shapes)
        self._pending = bytearray()
        self._noise = bytearray()

    def push(self, data: bytes) -> None:
        pending = self._pending
        pending += data
        at = 0
        while at < len(pending):
            size = self._judge(pending, at)
            if size == WAIT:
                break
            at = self._drop(pending, at) if size == NO else self._take(pending, at, size)
        del pending[:at]

    def pause(self) -> None:
        """The line has paused, yet may continue: what is complete is believed, half packets wait."""
        at = 0
        while at < len(self._pending) and (size := self._judge_last(self._pending, at)) > 0:
            at = self._take(self._pending, at, size)
        del self._pending[:at]

    def idle(self) -> None:
        """The line is silent: what is complete is believed, the rest is noise. Harmless at any time."""
        pending, self._pending = self._pending, bytearray()
        at = 0
        while at < len(pending):
            size = self._judge_last(pending, at)
            if size > 0:
                at = self._take(pending, at, size)
            elif size == WAIT and at + 1 < len(pending):
                at = self._truncate(pending, at)
            else:
                at = self._drop(pending, at)
        self._emit_noise()

    def reset(self) -> None:
        """Forgets everything, silently: a new connection."""
        self._pending = bytearray()
        self._noise.clear()

    def _take(self, data: Buffer, at: int, size: int) -> int:
        self._emit_noise()
        packet = bytes(data[at : at + size])
        self._emit(PacketEvent(Packet(packet[3], packet[HEAD_SIZE:]), packet))
        return at + size

    def _drop(self, data: Buffer, at: int) -> int:
        """Drops the byte at `at` and all behind it that cannot begin a packet. Returns where it stopped."""
        stop = data.find(HEADER, at + 1)
        if stop < 0:
            stop = len(data)
        self._noise += data[at:stop]
        while len(self._noise) >= NOISE_SIZE:
            self._emit_noise()
        return stop

    def _emit_noise(self) -> None:
        """Noise is reported in pieces, so that a line of pure noise is noticed."""
        if self._noise:
            piece = bytes(self._noise[:NOISE_SIZE])
            del self._noise[:NOISE_SIZE]
            self._emit(NoiseEvent("garbage", piece))

    def _truncate(self, data: Buffer, at: int) -> int:
        """Emits what began like a packet and never ended, up to the next whole one. Returns where that is."""
        stop = at + 1
        while stop < len(data) and self._judge_last(data, stop) <= 0:
            stop += 1
        self._emit_noise()
        self._emit(NoiseEvent("truncated", bytes(data[at:stop])))
        return stop

    def _judge(self, data: Buffer, at: int) -> int:
        """The size of the packet at `at`, NO or WAIT.

        An empty packet is believed at once, unless its number equals its LEN: that may be any packet whose
        LEN was doubled. Such a one and a packet with parameters are believed when the next byte begins
        another packet: one byte too few or too many inside it shows there, and only there. The answer never
        depends on bytes beyond those that settle it, so it is the same however the bytes arrive.
        """
        size = self._size(data, at, len(data))
        if size < HEAD_SIZE or (size == HEAD_SIZE and data[at + COMMAND_AT] != data[at + LENGTH_AT]):
            return size
        following = at + size
        for seen in range(following + 1, len(data) + 1):
            neighbour = self._size(data, following, seen)
            if neighbour == NO:
                return NO
            if neighbour > 0 or not self._straddled(data, at, following, seen):
                return size
        return WAIT

    def _judge_last(self, data: Buffer, at: int) -> int:
        """Like `_judge` where nothing more will come: what is complete is believed, WAIT means cut short."""
        verdict = self._judge(data, at)
        if verdict != WAIT:
            return verdict
        size = self._size(data, at, len(data))
        return WAIT if at + size > len(data) else size

    def _size(self, data: Buffer, at: int, end: int) -> int:
        """The size that the header at `at` announces, NO where it is none, WAIT while it is only a part."""
        if data[at] != HEADER or (at + 1 < end and data[at + 1] != HEADER):
            return NO
        # Also drops the first of three headers: no packet has LEN 0x55 (a board falls for it, S4).
        if at + 2 < end and data[at + 2] not in self._lengths:
            return NO
        if at + 3 >= end:
            return WAIT
        shape = (data[at + 3], data[at + 2])
        if shape not in self._shapes:
            return NO
        count = self._shapes[shape]
        if count and at + count[0] < end and data[at + count[0]] != count[1]:
            return NO
        return data[at + 2] + 2

    def _straddled(self, data: Buffer, at: int, following: int, seen: int) -> bool:
        """Could a packet begin inside and run past the end? Then the outer one may have lost bytes and eaten
        its neighbour's.
        """
        inner = data.find(HEADER, at + HEAD_SIZE, following)
        while inner >= 0:
            size = self._size(data, inner, seen)
            if size == WAIT or inner + size > following:
                return True
            inner = data.find(HEADER, inner + 1, following)
        return False


def split_report(report: bytes) -> tuple[bytes, bytes]:
    """The packet at the beginning, empty where none is, and what else is in it, without its padding.

    A second packet in the same report is not believed: it may be left over from the report before.
    """
    size = report[LENGTH_AT] + 2 if report[:2] == bytes((HEADER, HEADER)) and len(report) > LENGTH_AT else 0
    is_whole = HEAD_SIZE <= size <= min(len(report), HID.report_bytes)
    end = size if is_whole else 0
    return report[:end], report[end:].rstrip(b"\0")


class ReportDecoder:
    """The same for HID reports, each of which carries one packet and is complete: it waits for no silence."""

    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._emit = emit
        self._decoder = Decoder(emit)

    def push(self, report: bytes) -> None:
        packet, rest = split_report(report)
        self._decoder.push(packet)
        self._decoder.idle()
        if rest:
            self._emit(NoiseEvent("garbage", rest))
