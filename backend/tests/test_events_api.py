"""What happens as a stream for scripts, and what becomes of those who do not read it."""

import asyncio
import json
import socket
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any

from httpx2 import AsyncClient
from starlette.types import Message

from servodeck.access import addresses
from servodeck.access.connections import EXTENSION
from servodeck.api.app import create_app
from servodeck.api.robot import SILENCE_S
from servodeck.events import NoiseMessage
from servodeck.robot.control import Control
from servodeck.robot.hub import OUTBOX_MESSAGES
from tests.fake_port import FakePort, FakePorts
from tests.knocking import scope_of
from tests.running import DEVICE, NO_LIBRARY, PORT, entrance_to, server_on
from tests.samples import BATTERY_REPORT
from tests.test_gate import headers_of
from tests.virtual_time import in_virtual_time, now


@dataclass
class Listener:
    """One stream, as the server below the application sees it; `reads` False is a full socket."""

    reads: asyncio.Event = field(default_factory=asyncio.Event)
    gone: asyncio.Event = field(default_factory=asyncio.Event)
    sent: list[Message] = field(default_factory=list)
    aborted: bool = False
    ids: list[str] = field(default_factory=list)

    async def receive(self) -> Message:
        await self.gone.wait()
        return {"type": "http.disconnect"}

    async def send(self, message: Message) -> None:
        await self.reads.wait()
        self.sent.append(message)

    def know(self) -> None:
        """They may stay."""

    def abort(self) -> None:
        self.aborted = True

    def heard(self) -> list[dict[str, Any]]:
        """Every message since the last look."""
        lines = "".join(message["body"].decode() for message in self.sent if message.get("body")).split("\n")
        self.ids += [line.removeprefix("id: ") for line in lines if line.startswith("id: ")]
        self.sent.clear()
        return [json.loads(line.removeprefix("data: ")) for line in lines if line.startswith("data: ")]


@dataclass
class Stage:
    control: Control
    port: FakePort
    listener: Listener
    life: asyncio.Future[None]
    token_id: str


@asynccontextmanager
async def listening(*more: tuple[bytes, bytes]) -> AsyncIterator[Stage]:
    """A viewer's script that listens to a gateway on a LAN."""
    port, entrance = FakePort(), entrance_to(addresses.lan(PORT), now)
    device, token = entrance.devices.admit("token", "Dance", "viewer")
    control = Control(FakePorts(port), now, "doc")
    await control.use_port(DEVICE)
    listener = Listener()
    listener.reads.set()
    headers = [*headers_of(f"localhost:{PORT}", None), (b"authorization", f"Bearer {token}".encode())]
    headers += more
    scope = scope_of("http", "GET", "/api/events", headers) | {
        "extensions": {EXTENSION: {"connection": listener}}
    }
    app = create_app(control, NO_LIBRARY, entrance)
    life = asyncio.ensure_future(app(scope, listener.receive, listener.send))
    await asyncio.sleep(0.1)
    yield Stage(control, port, listener, life, device.id)
    listener.gone.set()
    listener.reads.set()
    await life
    assert len(control.hub) == 0
    await control.board.link.close()


@in_virtual_time
async def test_a_stream_begins_with_the_whole_state_and_continues_with_changes() -> None:
    async with listening() as here:
        assert (here.listener.sent[0]["status"], len(here.control.hub)) == (200, 1)
        [welcome] = here.listener.heard()
        assert (welcome["type"], welcome["port"]["status"], welcome["latch"]) == ("welcome", "open", False)
        await here.control.stop()
        here.port.say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
        messages = [message for message in here.listener.heard() if message["type"] != "left"]
        assert [message["type"] for message in messages] == ["state", "halted", "received", "battery"]
        assert messages[0]["latch"] is True
        assert messages[2]["bytes"] == BATTERY_REPORT.hex()


@in_virtual_time
async def test_each_event_has_an_id_and_a_reconnect_gets_a_gap() -> None:
    async with listening() as here:
        await here.control.stop()
        await asyncio.sleep(0.1)
        said = here.listener.heard()
        stream, _, first = here.listener.ids[0].partition("-")
        assert here.listener.ids == [f"{stream}-{number}" for number in range(1, len(said) + 1)]
        assert first == "1"
        last = here.listener.ids[-1]
    async with listening((b"last-event-id", last.encode())) as here:
        gap, welcome = here.listener.heard()
        assert gap == {"type": "gap", "after": last}
        assert welcome["type"] == "welcome"
        assert not here.listener.ids[0].startswith(stream)


@in_virtual_time
async def test_an_idle_stream_gets_a_line_now_and_then() -> None:
    async with listening() as here:
        await asyncio.sleep(0.2)  # the port was just opened: until then something might still move
        here.listener.sent.clear()
        await asyncio.sleep(2.5 * SILENCE_S)
        assert [message["body"] for message in here.listener.sent] == [b":\n\n"] * 2


@in_virtual_time
async def test_a_client_that_does_not_read_is_cut_and_the_others_lose_nothing() -> None:
    async with listening() as here:
        here.listener.reads.clear()
        for _ in range(OUTBOX_MESSAGES + 2):
            here.control.board.unattended.end()
            here.control.board_changed()
        await asyncio.sleep(1)
        assert here.life.done()
        assert here.listener.aborted
        assert len(here.control.hub) == 0


@in_virtual_time
async def test_a_disconnected_client_and_those_at_the_end_get_the_end() -> None:
    for is_revoked in (True, False):
        async with listening() as here:
            if is_revoked:
                here.control.disconnect(here.token_id, "Revoked.", "Olga")
            else:
                here.control.hub.close()
            await asyncio.sleep(0.1)
            assert here.life.done()
            assert here.listener.sent[-1] == {"type": "http.response.body", "body": b"", "more_body": False}
            assert not here.listener.aborted


async def test_over_a_real_socket_it_can_be_read_line_by_line_and_the_gateway_ends_in_time() -> None:
    async with (
        server_on(FakePorts(FakePort())) as running,
        AsyncClient(base_url=f"http://{running.host}") as client,
        client.stream("GET", "/api/events") as answer,
    ):
        assert answer.headers["content-type"].startswith("text/event-stream")
        lines = answer.aiter_lines()
        assert (await anext(lines)).startswith("id: ")
        assert json.loads((await anext(lines)).removeprefix("data: "))["type"] == "welcome"
        begun_s = time.monotonic()
        running.server.leave()
        rest = [line async for line in lines]
        assert time.monotonic() - begun_s < 1
        assert all(line.startswith(("id: ", "data: ")) for line in rest if line)


async def test_over_a_real_socket_a_listener_who_does_not_read_is_cut() -> None:
    async with server_on(FakePorts(FakePort())) as running:
        with socket.create_connection(running.address) as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.sendall(f"GET /api/events HTTP/1.1\r\nHost: {running.host}\r\n\r\n".encode())
            async with asyncio.timeout(10):
                while len(running.control.hub) == 0:  # noqa: ASYNC110 (nothing announces it)
                    await asyncio.sleep(0)
                while len(running.control.hub) > 0:
                    running.control.hub.send_all(NoiseMessage(reason="garbage", bytes="55" * 2048))
                    await asyncio.sleep(0)
                while running.server.server_state.connections:  # noqa: ASYNC110 (nothing announces it)
                    await asyncio.sleep(0)
