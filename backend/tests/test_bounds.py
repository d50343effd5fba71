"""What one peer can make the gateway hold has a bound in bytes: a real server on real sockets."""

import asyncio
import gc
import socket
import weakref
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress

import pytest
from websockets.frames import Frame, Opcode

from servodeck.access import addresses, connections, sockets
from servodeck.access.connections import ImpatientProtocol, Unread
from servodeck.access.sockets import Socket
from servodeck.api.intake import DRIVER_RATE, VIEWER_RATE
from servodeck.callers import THIS_COMPUTER, Role
from servodeck.robot import hub
from servodeck.robot.hub import Session
from tests.client import upgrade_at
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.test_cli import Served

pytestmark = pytest.mark.slow

PATIENCE_S = 5.0
TOO_MANY = 1008
NOT_UTF8 = 1007
LITTLE = 4096
PING = b"p" * 125
BEGINNING = b'{"type":"st'
PUT = (
    b"PUT /api/library/x HTTP/1.1\r\nHost: %s\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
)


def frame(opcode: Opcode, data: bytes = b"", *, is_last: bool = True) -> bytes:
    return Frame(opcode, data, is_last).serialize(mask=True)


@pytest.fixture
async def gateway() -> AsyncIterator[Running]:
    async with server_on(FakePorts(FakePort()), make_access=addresses.lan) as running:
        yield running


class Peer:
    """Sends bytes as it likes, and reads when it is told to."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader, self.writer = reader, writer

    async def send(self, data: bytes) -> None:
        self.writer.write(data)
        await self.writer.drain()

    async def end(self) -> tuple[int, bytes]:
        """Reads until the gateway has closed: the code and all bytes. 0 where there was no code."""
        heard = b""
        try:
            async with asyncio.timeout(PATIENCE_S):
                while chunk := await self.reader.read(1 << 16):
                    heard += chunk
        except ConnectionError:
            return 0, heard
        for code in (TOO_MANY, NOT_UTF8, 1000):
            if b"\x88" in heard and code.to_bytes(2, "big") in heard[heard.rindex(b"\x88") :]:
                return code, heard
        return 0, heard


@asynccontextmanager
async def stranger_at(gateway: Running, window: int | None = None) -> AsyncIterator[Peer]:
    opened = socket.socket()
    if window:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, window)
    opened.setblocking(False)
    await asyncio.get_running_loop().sock_connect(opened, gateway.address)
    reader, writer = await asyncio.open_connection(sock=opened)
    try:
        yield Peer(reader, writer)
    finally:
        writer.transport.abort()
        with suppress(ConnectionError):
            await writer.wait_closed()


def bearer_of(gateway: Running, role: Role) -> bytes:
    _, token = gateway.entrance.devices.admit("token", role, role)
    return b"Authorization: Bearer " + token.encode() + b"\r\n\r\n"


@asynccontextmanager
async def client_at(gateway: Running, role: Role, window: int | None = None) -> AsyncIterator[Peer]:
    """A paired one, on the WebSocket."""
    async with stranger_at(gateway, window) as peer:
        await peer.send(upgrade_at(gateway.host).removesuffix(b"\r\n") + bearer_of(gateway, role))
        await peer.reader.readuntil(b"\r\n\r\n")
        yield peer


async def until(is_so: Callable[[], object]) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while not is_so():  # noqa: ASYNC110 (nothing says so)
            await asyncio.sleep(0.01)


FLOODS = {
    "pings": frame(Opcode.PING, PING),
    "pongs": frame(Opcode.PONG, PING),
    "empty fragments": frame(Opcode.CONT, is_last=False),
}
BURSTS: dict[Role, int] = {"viewer": VIEWER_RATE[1], "driver": DRIVER_RATE[1], "owner": DRIVER_RATE[1]}


@pytest.mark.parametrize("role", BURSTS)
@pytest.mark.parametrize("flood", FLOODS)
async def test_control_frames_and_fragments_count_as_messages_do(
    gateway: Running, flood: str, role: Role
) -> None:
    async with client_at(gateway, role) as peer:
        begun = frame(Opcode.TEXT, BEGINNING, is_last=False) if "fragments" in flood else b""
        peer.writer.write(begun + FLOODS[flood] * 20_000)
        code, heard = await peer.end()
    assert code == TOO_MANY
    assert heard.count(PING) <= 2 * BURSTS[role] + 1 + sockets.PIECE_BYTES // len(PING)


async def test_a_process_of_its_own_has_another_loop_and_the_same_bounds() -> None:
    """uvloop, where there is one."""
    served = Served("--board", "doc", "--log-level", "error")
    try:
        host, port = served.url.removeprefix("http://").split(":")
        reader, writer = await asyncio.open_connection(host, int(port))
        writer.write(upgrade_at(f"{host}:{port}"))
        await reader.readuntil(b"\r\n\r\n")
        writer.write(frame(Opcode.TEXT, b'{"type":"stop"}') + FLOODS["pings"] * 20_000)
        assert (await Peer(reader, writer).end())[0] == TOO_MANY
        writer.transport.abort()
        await asyncio.to_thread(served.read_until_stops, 3)
    finally:
        served.end()


@pytest.mark.parametrize("role", BURSTS)
async def test_some_pings_and_fragments_are_as_good_as_messages(gateway: Running, role: Role) -> None:
    async with client_at(gateway, role) as peer:
        parts = frame(Opcode.TEXT, BEGINNING, is_last=False) + frame(Opcode.PING, PING)
        await peer.send(parts + frame(Opcode.CONT, b'op"}'))
        assert (await peer.reader.readuntil(PING))[-127:-125] == b"\x8a\x7d"
        await until(lambda: gateway.control.latch)


async def test_a_stop_is_heard_though_its_sender_has_left_before_it_was_parsed(gateway: Running) -> None:
    async with client_at(gateway, "driver") as peer:
        before = frame(Opcode.TEXT, b'{"type":"resume"}') * 200
        assert len(before) > sockets.PIECE_BYTES
        await peer.send(before + frame(Opcode.TEXT, b'{"type":"stop"}'))
    await until(lambda: gateway.control.latch)


async def test_who_reads_nothing_is_cut_off_before_much_waits_for_it(
    gateway: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Within its rate, for as long as it likes."""
    monkeypatch.setattr("servodeck.api.websocket.rate_of", lambda *_: Unlimited())
    async with client_at(gateway, "driver", LITTLE) as peer:
        [served] = [one for one in gateway.server.server_state.connections if isinstance(one, Socket)]
        little_is_held_of(served.transport)
        peer.writer.transport.pause_reading()  # type: ignore[attr-defined]
        sizes: list[int] = []
        with suppress(ConnectionError):
            async with asyncio.timeout(PATIENCE_S):
                while not served.transport.is_closing():
                    peer.writer.write(FLOODS["pings"] * 100)
                    await asyncio.sleep(0)
                    sizes.append(served.transport.get_write_buffer_size())
    assert sockets.UNREAD_BYTES / 2 < max(sizes) <= sockets.UNREAD_BYTES + sockets.PIECE_BYTES


def little_is_held_of(ours: asyncio.BaseTransport) -> None:
    """By the system, of what the gateway sends: it would hold megabytes."""
    ours.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, LITTLE)


class Unlimited:
    burst = 1 << 40
    wait_s = 0.0

    def take(self) -> bool:
        return True


async def test_bytes_that_are_not_text_end_the_connection_without_a_word_in_the_log(
    gateway: Running, caplog: pytest.LogCaptureFixture
) -> None:
    async with client_at(gateway, "viewer") as peer:
        await peer.send(frame(Opcode.TEXT, b"\xff\xfe"))
        assert (await peer.end())[0] == NOT_UTF8
    assert [each for each in caplog.records if each.levelname == "ERROR"] == []


def served_at(gateway: Running) -> list[ImpatientProtocol]:
    return [one for one in gateway.server.server_state.connections if isinstance(one, ImpatientProtocol)]


async def test_what_a_stranger_sends_is_gone_with_its_connection(gateway: Running) -> None:
    """At once, not when the garbage of all connections is collected."""
    gc.collect()
    gc.disable()
    try:
        made: list[weakref.ref[ImpatientProtocol]] = []
        for _ in range(3):
            async with stranger_at(gateway) as peer:
                await peer.send(PUT % (gateway.host.encode(), 3_000_000) + bytes(6_000))
                await peer.reader.readuntil(b"\r\n\r\n")
                made += map(weakref.ref, served_at(gateway))
        assert len(made) >= 3
        await until(lambda: not any(each() for each in made))
    finally:
        gc.enable()


async def test_what_is_read_of_a_stranger_fits_its_window(gateway: Running) -> None:
    size = 15_000  # no larger than a body may be
    async with stranger_at(gateway) as peer:
        await peer.send(PUT.replace(b"library/x", b"stop") % (gateway.host.encode(), size) + bytes(size - 1))
        await peer.reader.readuntil(b"\r\n\r\n")
        bodies = [len(served.cycle.body) for served in served_at(gateway)]
    assert len(bodies) == 1
    assert bodies[0] <= 2 * connections.RECEIVED_BYTES


async def test_a_pipeline_without_end_is_cut(gateway: Running, caplog: pytest.LogCaptureFixture) -> None:
    async with stranger_at(gateway) as peer:
        one = b"GET /api/health HTTP/1.1\r\nHost: " + gateway.host.encode() + b"\r\n\r\n"
        peer.writer.write(one * 2_000)
        _, heard = await peer.end()
    assert heard.count(b" 200 OK\r\n") <= connections.PIPELINED + 1
    assert [each for each in caplog.records if each.levelname == "ERROR"] == []


async def test_an_answer_that_nobody_reads_is_not_kept(
    gateway: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "UNREAD_S", 0.3)
    asked = b"GET /openapi.json HTTP/1.1\r\nHost: " + gateway.host.encode() + b"\r\n"
    async with stranger_at(gateway, LITTLE) as peer:
        peer.writer.transport.pause_reading()  # type: ignore[attr-defined]
        await until(lambda: served_at(gateway))
        [served] = served_at(gateway)
        little_is_held_of(served.transport)
        for _ in range(connections.PIPELINED):
            await peer.send(asked + bearer_of(gateway, "owner"))
        await until(lambda: served.flow.write_paused)
        await until(served.transport.is_closing)


class Link:
    def __init__(self) -> None:
        self.has_ended = False

    def abort(self) -> None:
        self.has_ended = True


def test_of_all_unread_answers_the_one_that_waits_longest_ends_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "UNREAD_BYTES", 100)
    unread, links = Unread(), [Link() for _ in range(4)]
    unread.add(links[0], 60)
    unread.add(links[1], 40)
    unread.remove(links[0])
    unread.add(links[2], 60)
    unread.add(links[3], 20)
    assert [link.has_ended for link in links] == [False, True, False, False]
    unread.add(links[2], 101)
    assert [link.has_ended for link in links] == [False, True, True, False]


def test_an_outbox_has_a_bound_in_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hub, "OUTBOX_BYTES", 1_000)
    session = Session(THIS_COMPUTER)
    session.put("x" * 5_000)  # one fits always
    assert not session.ended.is_set()
    session.put("x")
    assert session.close_reason == hub.CloseReason(1013, "This client does not read its messages.")


async def test_an_outbox_that_is_read_takes_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hub, "OUTBOX_BYTES", 1_000)
    session = Session(THIS_COMPUTER)
    for _ in range(10):
        session.put("x" * 600)
        assert await session.next() == "x" * 600
    assert not session.ended.is_set()
