"""Connections that say too little or too much of a request end soon; the others need not hurry."""

import asyncio
import json
import time
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from servodeck.access import addresses, connections, sockets
from servodeck.api import server
from tests.client import upgrade_at
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.test_clients import hear_until

pytestmark = pytest.mark.slow

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
        assert await ends_after_s(reader) <= connections.HEAD_S + MARGIN_S
        dripping.cancel()
        writer.close()


LARGE_HEADS = {
    "a long header": HEAD + b"X-Long: " + b"x" * 40_000 + b"\r\n\r\n",
    "long headers": HEAD + (b"X-Long: " + b"x" * 5_000 + b"\r\n") * 8 + b"\r\n",
    "many headers": HEAD + b"X: 1\r\n" * 5_000 + b"\r\n",
    "a long address": HEAD.replace(b" /", b" /?" + b"x" * 40_000) + b"\r\n",
}


@pytest.mark.parametrize("head", LARGE_HEADS.values(), ids=LARGE_HEADS.keys())
async def test_a_large_head_is_refused_with_its_reason(head: bytes) -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(head.replace(b"%s", gateway.host.encode()))
        answer = await asyncio.wait_for(reader.read(), connections.ANSWERED_S + MARGIN_S)
        assert answer.startswith(b"HTTP/1.1 431 Request Header Fields Too Large\r\n")
        assert json.loads(answer.partition(b"\r\n\r\n")[2])["code"] == "tooLarge"
        writer.transport.abort()


async def test_a_head_of_sane_size_is_answered() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        more = b"X-Long: " + b"x" * 30_000 + b"\r\n" + b"X: 1\r\n" * 90
        for _ in range(2):
            writer.write(HEAD % gateway.host.encode() + more + b"\r\n")
            await asyncio.wait_for(reader.readuntil(b"HTTP/1.1 200 OK\r\n"), MARGIN_S)
        writer.close()


async def test_a_body_that_no_route_needs_is_not_read() -> None:
    """A stop goes through first; what is announced behind it stays in the system's own small buffers."""
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        head = HEAD.replace(b"GET /api/health", b"POST /api/stop") % gateway.host.encode()
        writer.write(head + b"Content-Type: application/json\r\nContent-Length: 16000\r\n\r\n{")
        assert (await reader.readline()) == b"HTTP/1.1 200 OK\r\n"
        assert await ends_after_s(reader) <= connections.ANSWERED_S + MARGIN_S
        writer.close()


async def test_unauthenticated_connections_are_few_and_the_least_used_end_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(connections, "MOST_OF_ONE", 3)
    async with server_on(FakePorts(FakePort()), make_access=addresses.lan) as gateway:
        _, token = gateway.entrance.devices.admit("token", "Script", "viewer")
        authorization = b"Authorization: Bearer " + token.encode() + b"\r\n"
        known = await asyncio.open_connection(*gateway.address)
        known[1].write(HEAD % gateway.host.encode() + authorization + b"\r\n")
        await known[0].readuntil(b"\r\n\r\n")
        unknown = [await asyncio.open_connection(*gateway.address) for _ in range(3)]
        unknown[0][1].write(HEAD % gateway.host.encode() + b"\r\n")
        await unknown[0][0].readuntil(b"\r\n\r\n")
        unknown += [await asyncio.open_connection(*gateway.address) for _ in range(2)]
        await ends_after_s(unknown[1][0])
        await ends_after_s(unknown[2][0])
        assert [reader.at_eof() for reader, _ in unknown] == [False, True, True, False, False]
        assert not known[0].at_eof()
        for _, writer in (known, *unknown):
            writer.close()


async def test_a_head_without_end_is_not_collected() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(HEAD % gateway.host.encode() + b"X-Long: " + b"x" * 4 * connections.HEAD_BYTES)
        assert await ends_after_s(reader) <= MARGIN_S
        writer.close()


@pytest.mark.parametrize(
    ("limit", "said"),
    [("IDLE_S", b""), ("BODY_S", HEAD + b"Content-Length: 9\r\n\r\n")],
    ids=["nothing", "no body"],
)
async def test_what_never_comes_is_not_waited_for(
    monkeypatch: pytest.MonkeyPatch, limit: str, said: bytes
) -> None:
    monkeypatch.setattr(connections, limit, 0.1)
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(said.replace(b"%s", gateway.host.encode()))
        assert await ends_after_s(reader) <= 0.1 + MARGIN_S
        writer.close()


async def test_many_slow_connections_keep_no_client_from_an_answer() -> None:
    async with server_on(FakePorts(FakePort())) as gateway:
        slow = [await asyncio.open_connection(*gateway.address) for _ in range(200)]
        for _, writer in slow:
            writer.write(b"GET /")
        assert await asyncio.wait_for(status_of(gateway), MARGIN_S) == b"HTTP/1.1 200 OK\r\n"
        lasted_s = await asyncio.gather(*(ends_after_s(reader) for reader, _ in slow))
        assert max(lasted_s) <= connections.HEAD_S + MARGIN_S
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
        assert await ends_after_s(reader) <= connections.ANSWERED_S + MARGIN_S
        writer.close()


async def test_a_page_that_says_nothing_more_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    for limit in ("IDLE_S", "HEAD_S", "BODY_S"):
        monkeypatch.setattr(connections, limit, 0.2)
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        await hear_until(client, "welcome")
        await asyncio.sleep(0.4)
        await client.send('{"type":"stop"}')
        await hear_until(client, "halted")


async def test_who_answers_no_ping_is_gone_and_who_does_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "PING_S", 0.1)
    monkeypatch.setattr(server, "PONG_S", 0.3)
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        reader, writer = await asyncio.open_connection(*gateway.address)
        writer.write(upgrade_at(gateway.host))
        assert await ends_after_s(reader) <= 0.4 + MARGIN_S
        writer.close()
        await client.send('{"type":"stop"}')
        await hear_until(client, "halted")


async def test_an_upgrade_that_is_refused_costs_no_more_than_a_request(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made: list[sockets.Socket] = []

    class NotedSocket(sockets.Socket):
        def __init__(self, *more: Any, **named: Any) -> None:
            super().__init__(*more, **named)
            made.append(self)

    monkeypatch.setattr(server, "Socket", NotedSocket)
    async with server_on(FakePorts(FakePort()), make_access=addresses.lan) as gateway:
        _, token = gateway.entrance.devices.admit("token", "Script", "viewer")
        origin = {"Origin": "http://evil.example"}
        for headers, status in ((None, 401), ({"Authorization": "Bearer forged"}, 401), (origin, 403)):
            with pytest.raises(InvalidStatus, match=str(status)) as refused:
                await connect(gateway.ws, additional_headers=headers)
            assert refused.value.response.headers["Connection"] == "close"
            assert json.loads(refused.value.response.body)["code"]
        assert made == []
        async with connect(gateway.ws, additional_headers={"Authorization": f"Bearer {token}"}) as client:
            await hear_until(client, "welcome")
        assert len(made) == 1


async def test_what_was_to_be_said_when_that_end_comes_is_no_mistake(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async with server_on(FakePorts(FakePort())) as gateway, connect(gateway.ws) as client:
        await hear_until(client, "welcome")
        (session,) = gateway.control.hub.sessions
        (served,) = gateway.server.server_state.connections
        assert isinstance(served, sockets.Socket)
        session.put("{}")
        served.abort()
        await client.wait_closed()
    assert [record for record in caplog.records if record.levelname == "ERROR"] == []


async def test_who_is_known_may_ask_again_on_the_same_connection(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "IDLE_S", 0.1)
    async with server_on(FakePorts(FakePort())) as gateway:
        reader, writer = await asyncio.open_connection(*gateway.address)
        for _ in range(2):
            writer.write(HEAD % gateway.host.encode() + b"\r\n")
            assert await reader.readline() == b"HTTP/1.1 200 OK\r\n"
            while not (await reader.read(4096)).endswith(b"}"):
                pass
            await asyncio.sleep(0.4)
        writer.close()
