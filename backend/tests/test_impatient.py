"""Connections that say too little or too much of a request end soon; the others need not hurry."""

import asyncio
import time

import pytest
from websockets.asyncio.client import connect

from servodeck.access import impatient
from servodeck.run import server
from tests.client import upgrade_at
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.test_clients import hear_until

# Slow machines run tests, too.
MARGIN_S = 1.0
HEAD = b"GET /api/health HTTP/1.1\r\nHost: %s\r\n"


async def ends_after_s(reader: asyncio.StreamReader) -> float:
    """How long the server keeps the connection; what it says before it ends is left unread."""
    begun_s = time.monotonic()
    try:
        while await reader.read(4096):
            pass
    except ConnectionError:
        pass
    return time.monotonic() - begun_s


async def drip(writer: asyncio.StreamWriter) -> None:
    """A header that never ends, a letter at a time."""
    while True:
        writer.write(b"x")
        await asyncio.sleep(0.05)


async def test_a_head_that_drips_in_is_not_waited_for() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(HEAD % gateway.host.encode() + b"X-Slow: ")
        dripping = asyncio.create_task(drip(writer))
        assert await ends_after_s(reader) <= impatient.HEAD_S + MARGIN_S
        dripping.cancel()
        writer.close()


async def test_a_head_without_end_is_not_collected() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(HEAD % gateway.host.encode() + b"X-Long: " + b"x" * 4 * impatient.HEAD_BYTES)
        assert await ends_after_s(reader) <= MARGIN_S
        writer.close()


@pytest.mark.parametrize(
    ("limit", "said"),
    [("FIRST_BYTE_S", b""), ("BODY_S", HEAD + b"Content-Length: 9\r\n\r\n")],
    ids=["nothing", "no body"],
)
async def test_what_never_comes_is_not_waited_for(
    monkeypatch: pytest.MonkeyPatch, limit: str, said: bytes
) -> None:
    monkeypatch.setattr(impatient, limit, 0.1)
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(said.replace(b"%s", gateway.host.encode()))
        assert await ends_after_s(reader) <= 0.1 + MARGIN_S
        writer.close()


async def test_many_slow_ones_keep_nobody_from_an_answer() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        slow = [await asyncio.open_connection(*gateway.address) for _ in range(200)]
        for _, writer in slow:
            writer.write(b"GET /")
        assert await asyncio.wait_for(status_of(gateway), MARGIN_S) == b"HTTP/1.1 200 OK\r\n"
        lasted_s = await asyncio.gather(*(ends_after_s(reader) for reader, _ in slow))
        assert max(lasted_s) <= impatient.HEAD_S + MARGIN_S
        for _, writer in slow:
            writer.close()


async def status_of(gateway: Running) -> bytes:
    reader, writer = await asyncio.open_connection(*gateway.address)
    writer.write(HEAD % gateway.host.encode() + b"\r\n")
    line = await reader.readline()
    writer.close()
    return line


async def test_who_has_its_answer_and_talks_on_is_not_listened_to() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(HEAD % gateway.host.encode() + b"Content-Length: 100000\r\n\r\n")
        assert await ends_after_s(reader) <= impatient.ANSWERED_S + MARGIN_S
        writer.close()


async def test_a_page_that_says_nothing_more_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    for limit in ("FIRST_BYTE_S", "HEAD_S", "BODY_S"):
        monkeypatch.setattr(impatient, limit, 0.2)
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        await hear_until(client, "welcome")
        await asyncio.sleep(0.4)
        await client.send('{"type":"stop","hold":null}')
        await hear_until(client, "halted")


async def test_who_answers_no_ping_is_gone_and_who_does_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "PING_S", 0.1)
    monkeypatch.setattr(server, "PONG_S", 0.3)
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(upgrade_at(gateway.host))
        assert await ends_after_s(reader) <= 0.4 + MARGIN_S
        writer.close()
        await client.send('{"type":"stop","hold":null}')
        await hear_until(client, "halted")


async def test_what_was_to_be_said_when_that_end_comes_is_no_mistake(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        await hear_until(client, "welcome")
        (seat,) = gateway.control.hub.seats
        (served,) = gateway.server.server_state.connections
        assert isinstance(served, impatient.ImpatientSocket)
        seat.put("{}")
        served.keepalive_timeout()
        await client.wait_closed()
    assert [record for record in caplog.records if record.levelname == "ERROR"] == []
