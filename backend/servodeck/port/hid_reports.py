"""Packets in USB HID reports: one packet a report, zero-padded; of a report from the board the packet at its
beginning.

Pure: knows bytes and the decoder, no device. Twin of frontend/src/robot/links/webHid.ts;
shared/protocol/vectors/hid.json holds both.
"""

from collections.abc import Callable

from servodeck.protocol.decoder import HEAD_SIZE, HEADER, LENGTH_AT, Decoder, DecoderEvent, NoiseEvent
from servodeck.protocol.timings import HID

REPORT_BYTES = HID.report_bytes


def report_of(packet: bytes) -> bytes:
    """The report that carries it. Raises ValueError where it does not fit."""
    if len(packet) > REPORT_BYTES:
        raise ValueError(f"{len(packet)} bytes do not fit into a report of {REPORT_BYTES}")
    return packet.ljust(REPORT_BYTES, b"\0")


def split_report(report: bytes) -> tuple[bytes, bytes]:
    """The packet at the beginning, empty where none is, and what else is in it, without its padding.

    A second packet in the same report is not believed: it may be left over from the report before.
    """
    size = report[LENGTH_AT] + 2 if report[:2] == bytes((HEADER, HEADER)) and len(report) > LENGTH_AT else 0
    is_whole = HEAD_SIZE <= size <= min(len(report), REPORT_BYTES)
    end = size if is_whole else 0
    return report[:end], report[end:].rstrip(b"\0")


class ReportInbox:
    """Reports in, packets and noise out: each report is complete, so nothing waits for time to pass."""

    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._emit = emit
        self._decoder = Decoder(emit)

    def push(self, report: bytes) -> None:
        packet, rest = split_report(report)
        self._decoder.push(packet)
        self._decoder.idle()
        if rest:
            self._emit(NoiseEvent("garbage", rest))

    def close(self) -> None:
        """Nothing is under way."""
