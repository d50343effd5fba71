"""The gateway's decoder against the shared streams, three ways each, and what holds for any bytes."""

from collections.abc import Iterable, Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.protocol.decoder import (
    COMMAND_SHAPES,
    REPORT_SHAPES,
    Decoder,
    DecoderEvent,
    NoiseEvent,
    Packet,
    PacketEvent,
    Shapes,
)
from tests.vectors import load_vectors

SHAPES: dict[str, Shapes] = {"report": REPORT_SHAPES, "command": COMMAND_SHAPES}
IDLE, PAUSE = "idle", "pause"
Piece = bytes | str

both = pytest.mark.parametrize("shapes", SHAPES.values(), ids=SHAPES)


def streams() -> list[Any]:
    return [pytest.param(vector, id=vector["name"]) for vector in load_vectors("streams")]


def pieces(feed: list[str]) -> list[Piece]:
    return [piece if piece in (IDLE, PAUSE) else bytes.fromhex(piece) for piece in feed]


def decode(feed: Iterable[Piece], shapes: Shapes) -> list[DecoderEvent]:
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append, shapes)
    for piece in feed:
        if isinstance(piece, str):
            fall_silent(decoder, piece)
        else:
            decoder.push(piece)
    return events


def fall_silent(decoder: Decoder, silence: str) -> None:
    if silence == IDLE:
        decoder.idle()
    else:
        decoder.pause()


def bytewise(feed: Iterable[Piece]) -> Iterator[Piece]:
    for piece in feed:
        if isinstance(piece, str):
            yield piece
        else:
            yield from (bytes((byte,)) for byte in piece)


def in_one_piece(feed: Iterable[Piece]) -> Iterator[Piece]:
    """Everything between two silences at once."""
    gathered = b""
    for piece in feed:
        if isinstance(piece, str):
            yield gathered
            yield piece
            gathered = b""
        else:
            gathered += piece
    yield gathered


def as_json(events: Iterable[DecoderEvent]) -> list[dict[str, str]]:
    """Events as the vectors write them."""
    return [
        {"kind": "noise", "reason": event.reason, "bytes": event.bytes.hex(" ").upper()}
        if isinstance(event, NoiseEvent)
        else {"kind": "packet", "bytes": event.bytes.hex(" ").upper()}
        for event in events
    ]


@pytest.mark.parametrize("vector", streams())
def test_shared_streams_however_they_are_cut_and_behind_noise(vector: Any) -> None:
    feed, shapes, expected = pieces(vector["feed"]), SHAPES[vector["direction"]], vector["events"]
    assert as_json(decode(feed, shapes)) == expected
    assert as_json(decode(in_one_piece(feed), shapes)) == expected
    assert as_json(decode(bytewise(feed), shapes)) == expected
    noise = bytes(range(64))  # exactly one noise event, so what follows is as it was
    assert as_json(decode([noise, *feed], shapes)) == [*as_json([NoiseEvent("garbage", noise)]), *expected]


PACKETS = [
    bytes.fromhex(text)
    for text in (
        "55 55 02 06",
        "55 55 02 0F",
        "55 55 03 08 00",
        "55 55 04 0F 4C 1D",
        "55 55 05 06 55 55 00",
        "55 55 06 15 01 01 55 55",
        "55 55 08 03 01 E8 03 01 D0 07",
        "55 55 0E 02 01 02 55 55 02 07 03 00 04 00 05 00",
    )
]
# Whole and cut packets, header bytes and plain garbage in any mixture: the worst a line can say.
soup = st.lists(
    st.one_of(
        st.sampled_from(PACKETS),
        st.builds(lambda packet, cut: packet[:cut], st.sampled_from(PACKETS), st.integers(1, 12)),
        st.lists(st.sampled_from([0x55, 0x02, 0x04, 0x06, 0x0F, 0x15, 0xFD]), max_size=8).map(bytes),
        st.binary(max_size=80),
    ),
    max_size=20,
).map(b"".join)
feeds = st.lists(st.one_of(soup, soup, soup, st.sampled_from([IDLE, PAUSE])), max_size=6)


@both
@given(feed=feeds)
def test_the_events_do_not_depend_on_how_the_bytes_are_cut(shapes: Shapes, feed: list[Piece]) -> None:
    events = decode(feed, shapes)
    assert decode(bytewise(feed), shapes) == events
    assert decode(in_one_piece(feed), shapes) == events


@both
@given(feed=feeds)
def test_every_byte_is_emitted_once_in_order_and_few_are_buffered(shapes: Shapes, feed: list[Piece]) -> None:
    fed, heard = b"", bytearray()
    decoder = Decoder(lambda event: heard.extend(event.bytes), shapes)
    for piece in [*feed, IDLE]:
        if isinstance(piece, str):
            fall_silent(decoder, piece)
            assert piece == PAUSE or heard == fed
        else:
            decoder.push(piece)
            fed += piece
            assert len(fed) - len(heard) <= 512


@both
@given(garbage=soup)
def test_a_packet_after_garbage_and_silence_is_found(shapes: Shapes, garbage: bytes) -> None:
    stop = bytes.fromhex("55550207")
    assert decode([garbage, IDLE, stop], shapes)[-1] == PacketEvent(Packet(7, b""), stop)


def test_reset_forgets_a_half_packet_and_pending_noise() -> None:
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append)
    decoder.push(bytes.fromhex("01 02 55 55 04 0F"))
    decoder.reset()
    decoder.push(bytes.fromhex("55 55 02 19"))
    decoder.idle()
    assert as_json(events) == [{"kind": "packet", "bytes": "55 55 02 19"}]
