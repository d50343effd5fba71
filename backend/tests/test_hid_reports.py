"""Packets in HID reports: the shared cases, and that a cable with reports says what a serial line says."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.port.hid import report_of
from servodeck.protocol.decoder import Decoder, DecoderEvent, PacketEvent, ReportDecoder, split_report
from servodeck.protocol.timings import HID
from tests.vectors import load_vectors

CASES = [pytest.param(case, id=case["name"]) for case in load_vectors("hid")]
PACKETS = [bytes.fromhex(vector["hex"]) for vector in load_vectors("reports")]


@pytest.mark.parametrize("case", CASES)
def test_a_report_is_cut_to_the_packet_at_its_beginning(case: dict[str, Any]) -> None:
    packet, rest = split_report(bytes.fromhex(case["report"]))
    assert (packet.hex(" "), rest.hex(" ")) == (case["packet"], case["rest"])


def test_a_packet_is_padded_to_a_whole_report() -> None:
    assert report_of(b"\x55\x55\x02\x07") == b"\x55\x55\x02\x07" + bytes(60)
    longest = bytes(range(64))
    assert report_of(longest) == longest


def test_a_packet_longer_than_a_report_is_never_split() -> None:
    with pytest.raises(ValueError, match="65 bytes do not fit"):
        report_of(bytes(65))


def heard(reports: list[bytes]) -> list[DecoderEvent]:
    events: list[DecoderEvent] = []
    decoder = ReportDecoder(events.append)
    for report in reports:
        decoder.push(report)
    return events


@given(st.lists(st.sampled_from(PACKETS).filter(lambda packet: len(packet) <= HID.report_bytes)), st.data())
def test_any_padding_gives_the_packets_that_a_serial_line_gives(
    packets: list[bytes], data: st.DataObject
) -> None:
    serial: list[DecoderEvent] = []
    decoder = Decoder(serial.append)
    for packet in packets:
        line = packet
        while line:
            size = data.draw(st.integers(1, len(line)))
            decoder.push(line[:size])
            line = line[size:]
        decoder.idle()
    padded = [
        packet.ljust(data.draw(st.integers(len(packet), HID.report_bytes)), b"\0") for packet in packets
    ]
    assert heard(padded) == serial
    assert all(isinstance(event, PacketEvent) for event in serial)


@given(st.lists(st.binary(max_size=HID.report_bytes)))
def test_no_report_is_an_error_and_none_gives_two_packets(reports: list[bytes]) -> None:
    for report in reports:
        events = heard([report])
        assert sum(isinstance(event, PacketEvent) for event in events) <= 1
        heard_bytes = b"".join(event.bytes for event in events)
        assert heard_bytes.rstrip(b"\0") == report.rstrip(b"\0")
