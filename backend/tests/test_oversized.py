"""Requests and messages that are too large, or would be once they are unpacked, at a process of its own: each
is ended at once, and none of it is held in memory (F13). What drips in is test_impatient.py.
"""

import asyncio
import gzip
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from tests.test_cli import Served
from tests.test_flood import rss_kib

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc"),
]

ENDED_WITHIN_S = 1.0
# Slow machines run tests, too.
MARGIN_S = 2.0
GROWTH_KIB = 10 * 1024
MIB = 1024 * 1024
CHUNK_BYTES = 64 * 1024
UPGRADE = (
    b"GET /ws HTTP/1.1\r\nHost: %s\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Sec-WebSocket-Version: 13\r\n"
    b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Extensions: permessage-deflate\r\n\r\n"
)
PUT = b"PUT /api/library/a HTTP/1.1\r\nHost: %s\r\nContent-Type: application/json\r\n"
TEXT, MORE, LAST, PACKED = 0x01, 0x00, 0x80, 0x40
BLANKS = b" " * 64 * MIB
BOMB = zlib.compressobj(9, zlib.DEFLATED, -15)
ZIPPED_BLANKS = gzip.compress(BLANKS)
PACKED_BLANKS = BOMB.compress(BLANKS) + BOMB.flush(zlib.Z_SYNC_FLUSH)


def frame(first: int, payload: bytes) -> bytes:
    return bytes((first, 0x80 | 127)) + len(payload).to_bytes(8, "big") + bytes(4) + payload


HEAVY: dict[str, list[bytes]] = {
    "a message of 64 MiB": [UPGRADE, frame(LAST | TEXT, BLANKS)],
    "a message in a thousand pieces": [UPGRADE, frame(TEXT, b"["), *[frame(MORE, b" " * 1000)] * 1000],
    "a message that is announced": [UPGRADE, frame(LAST | TEXT, BLANKS)[:14]],
    "a packed message, though that was not agreed": [UPGRADE, frame(LAST | PACKED | TEXT, PACKED_BLANKS)],
    "a body of 64 MiB": [PUT + b"Content-Length: %d\r\n\r\n" % len(BLANKS), BLANKS],
    "a body in pieces without end": [
        PUT + b"Transfer-Encoding: chunked\r\n\r\n",
        *[b"10000\r\n" + b" " * 0x10000 + b"\r\n"] * 1000,
    ],
    "a packed body": [
        PUT
        + b"Connection: close\r\nContent-Encoding: gzip\r\nContent-Length: %d\r\n\r\n" % len(ZIPPED_BLANKS),
        ZIPPED_BLANKS,
    ],
}


@pytest.fixture(scope="module")
def served() -> Iterator[Served]:
    made = Served("--board", "doc", "--log-level", "error")
    yield made
    made.end()


@pytest.mark.parametrize("heavy", HEAVY)
async def test_it_is_ended_at_once_and_nothing_of_it_stored(served: Served, heavy: str) -> None:
    host = served.url.removeprefix("http://")
    before_kib = rss_kib(served)
    reader, writer = await asyncio.open_connection(*host.split(":"))
    head, *parts = HEAVY[heavy]
    writer.write(head.replace(b"%s", host.encode()))
    said = await reader.readuntil(b"\r\n\r\n") if head is UPGRADE else b""
    saying = asyncio.create_task(say_all(writer, parts))
    async with asyncio.timeout(ENDED_WITHIN_S + MARGIN_S):
        said += await all_said(reader)
    saying.cancel()
    writer.transport.abort()  # what is still to be said would keep it open
    with suppress(ConnectionError):
        await writer.wait_closed()
    assert b"permessage-deflate" not in said
    assert rss_kib(served) - before_kib <= GROWTH_KIB
    assert served.process.poll() is None


async def say_all(writer: asyncio.StreamWriter, parts: list[bytes]) -> None:
    with suppress(ConnectionError):
        for part in parts:
            for start in range(0, len(part), CHUNK_BYTES):
                writer.write(part[start : start + CHUNK_BYTES])
                await writer.drain()


async def all_said(reader: asyncio.StreamReader) -> bytes:
    """Until the connection ends."""
    said = b""
    with suppress(ConnectionError):
        while data := await reader.read(65_536):
            said += data
    return said
