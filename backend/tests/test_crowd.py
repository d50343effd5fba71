"""A class in front of one robot, at a process of its own: more knock than there are seats, some never read
(F10, F11). Each client that reads gets the last value of a drag, and any of them stops the robot.

How soon is measured by `npm run bench -- --only crowd`.
"""

import asyncio
import json
import socket
import time
from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from servodeck.access.connections import PING_S, PONG_S
from servodeck.protocol.packets import parse_command
from tests.amount import TIMES
from tests.bus import PATIENCE_S, Bus, bus_of_pty, serving
from tests.client import command_of, deaf_at
from tests.samples import MOVE, STOP
from tests.test_cli import Served
from tests.test_flood import rss_kib

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc"),
]

FULL = TIMES > 1
# With the driver one more than there are seats while the deaf ones sit, too.
READERS, DEAF = (199, 20) if FULL else (40, 4)
DRIVES_S = 30.0 if FULL else 3.0
PERIOD_S = 0.05
STOPS = 3
GROWTH_KIB = 20 * 1024
JOIN_AT_ONCE = 20


class Reader:
    """A viewer: records the last packet that left, and whether the robot is stopped."""

    def __init__(self, client: ClientConnection) -> None:
        self.client = client
        self.last: dict[str, Any] = {}
        self.latch = False
        self.task = asyncio.create_task(self._read())

    def has_seen(self, packet: bytes) -> bool:
        return self.last != {} and command_of(self.last) == parse_command(packet)

    async def _read(self) -> None:
        with suppress(ConnectionClosed):
            async for text in self.client:
                message = json.loads(text)
                if message["type"] == "left":
                    self.last = message["commands"][-1]
                if message["type"] == "state":
                    self.latch = message["latch"]


class Hand:
    """The driver's, 20 times a second somewhere else."""

    def __init__(self, client: ClientConnection) -> None:
        self._client = client
        self.nonce: str | None = None
        self.refused = 0
        self.sent = 0
        self.task = asyncio.create_task(self._listen())

    async def say(self, **message: object) -> None:
        await self._client.send(json.dumps(message))

    async def drive(self, for_s: float) -> None:
        until_s = time.monotonic() + for_s
        while time.monotonic() < until_s:
            await self.move(500 + self.sent % 2000)
            await asyncio.sleep(PERIOD_S)

    async def move(self, position: int) -> bytes:
        packet = MOVE[:8] + position.to_bytes(2, "little")
        self.sent += 1
        await self.say(type="packet", id=self.sent, bytes=packet.hex(), nonce=self.nonce)
        return packet

    async def _listen(self) -> None:
        with suppress(ConnectionClosed):
            async for text in self._client:
                message = json.loads(text)
                if message["type"] == "tick":
                    self.nonce = message["nonce"]
                    await self.say(type="heartbeat", nonce=self.nonce)
                self.refused += message["type"] == "refused"


class Crowd:
    def __init__(self, served: Served) -> None:
        self.host = served.url.removeprefix("http://")
        self.readers: list[Reader] = []
        self.deaf: list[socket.socket] = []
        self.hand: Hand
        self._doors = AsyncExitStack()

    async def enter(self) -> None:
        name, _, port = self.host.partition(":")
        self.deaf = [await deaf_at((name, int(port))) for _ in range(DEAF)]
        self.hand = Hand(await self._join())
        await self.hand.say(type="lease", action="request")
        await until(lambda: self.hand.nonce)
        await self.fill()

    async def fill(self) -> None:
        """As many readers as find a seat."""
        for begun in range(len(self.readers), READERS, JOIN_AT_ONCE):
            joining = (self._join() for _ in range(min(JOIN_AT_ONCE, READERS - begun)))
            for joined in await asyncio.gather(*joining, return_exceptions=True):
                if isinstance(joined, InvalidStatus):
                    continue
                assert isinstance(joined, ClientConnection), joined
                self.readers.append(Reader(joined))

    async def leave(self) -> None:
        for each in self.deaf:
            each.close()
        await self._doors.aclose()
        await asyncio.gather(self.hand.task, *(reader.task for reader in self.readers))

    async def see(self, packet: bytes) -> None:
        await until(lambda: all(reader.has_seen(packet) for reader in self.readers))

    async def _join(self) -> ClientConnection:
        ws = connect(f"ws://{self.host}/ws", max_queue=None, close_timeout=0)
        return await self._doors.enter_async_context(ws)


async def until(is_so: Callable[[], object]) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while not is_so():  # noqa: ASYNC110 (other tasks set it)
            await asyncio.sleep(0.01)


@asynccontextmanager
async def crowd_at(served: Served) -> AsyncIterator[Crowd]:
    crowd = Crowd(served)
    await crowd.enter()
    try:
        yield crowd
    finally:
        await crowd.leave()


async def test_a_class_with_some_who_never_read(tmp_path: Path) -> None:
    with bus_of_pty() as (pty, bus), serving(pty, tmp_path) as served:
        async with crowd_at(served) as crowd:
            presence_changed, before_kib = len(crowd.readers), rss_kib(served)
            for number in range(STOPS):
                await crowd.hand.drive(DRIVES_S / STOPS)
                await stop_by(crowd.readers[-1 - number], crowd, bus)
            assert rss_kib(served) - before_kib <= GROWTH_KIB
            assert not any(reader.task.done() for reader in crowd.readers)
            await crowd.see(await crowd.hand.move(2222))
            if DRIVES_S > PING_S + PONG_S:
                await crowd.fill()
                assert (presence_changed, len(crowd.readers)) == (195, READERS)
                await crowd.see(await crowd.hand.move(1111))


async def stop_by(reader: Reader, crowd: Crowd, bus: Bus) -> None:
    """During a drag: three stops, no move behind them, and all clients get the state."""
    pressed_s, refused = time.monotonic(), crowd.hand.refused
    await reader.client.send('{"type":"stop"}')
    await crowd.hand.drive(0.5)
    await until(lambda: bus.since(pressed_s).count(STOP) == 3)
    held = bus.since(pressed_s).partition(STOP)[2].replace(STOP, b"")
    assert len(held) in (0, 2 * len(MOVE))  # the pose that the stop holds
    await until(lambda: all(each.latch for each in crowd.readers))
    assert crowd.hand.refused > refused
    await reader.client.send('{"type":"resume"}')
    await until(lambda: not any(each.latch for each in crowd.readers))
