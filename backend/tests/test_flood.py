"""Clients that say or open too much, at a process of its own: they go, it stays as small as it was, and
a STOP meanwhile is served (F9).
"""

import asyncio
import os
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import pytest
from httpx2 import AsyncClient
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException

from tests.amount import TIMES
from tests.bus import held_back_s
from tests.test_cli import Served
from tests.test_clients import hear_until, say

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc"),
]

FLOODERS = 10 if TIMES > 1 else 2
LASTS_S = 20.0 if TIMES > 1 else 3.0
MESSAGES_PER_S = 1_000
BURSTS_PER_S = 20
CLOSED_WITHIN_S = 3.0
TOO_MANY = 1008
GROWTH_KIB = 50 * 1024
# Slow machines run tests, too, and the flooders are on this one.
ANSWERED_WITHIN_S = 3.0


def rss_kib(served: Served) -> int:
    lines = Path(f"/proc/{served.process.pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))


async def for_a_while(act: Callable[[], Awaitable[None]]) -> None:
    until_s = time.monotonic() + LASTS_S
    while time.monotonic() < until_s:
        await act()


class Flooders:
    def __init__(self, served: Served) -> None:
        self.ws = f"ws{served.url.removeprefix('http')}/ws"
        self.host = served.url.removeprefix("http://")
        self.ends: list[tuple[float, int | None]] = []
        self.knocks = 0
        self._pids = (served.process.pid, os.getpid())

    async def shout(self) -> None:
        """Until it is sent away."""
        begun_s = self._now_s()
        async with connect(self.ws, max_queue=None) as client:
            listening = asyncio.create_task(drain(client))
            with suppress(ConnectionClosed):
                while self._now_s() - begun_s < 2 * CLOSED_WITHIN_S:
                    for _ in range(MESSAGES_PER_S // BURSTS_PER_S):
                        await say(client, type="calibrate", servo=None)
                    await asyncio.sleep(1 / BURSTS_PER_S)
            await client.close()  # unless it was sent away
            await listening
            self.ends.append((self._now_s() - begun_s, client.close_code))

    async def knock(self) -> None:
        """A handshake: of a page of another site, of our own, or given up half-way."""
        kind = self.knocks = self.knocks + 1
        headers = {"Origin": "http://evil.example"} if kind % 3 == 0 else {}
        with suppress(WebSocketException, OSError, TimeoutError):
            if kind % 3 == 1:
                _, writer = await asyncio.open_connection(*self.host.split(":"))
                writer.write(b"GET /ws HTTP/1.1\r\n")
                writer.close()
                return
            async with connect(self.ws, additional_headers=headers, open_timeout=ANSWERED_WITHIN_S):
                pass

    def _now_s(self) -> float:
        """Without the time that both waited for other processes, or for each other on a single core."""
        return time.monotonic() - sum(held_back_s(pid) for pid in self._pids)


async def drain(client: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        async for _ in client:
            pass


@asynccontextmanager
async def responsive(served: Served) -> AsyncIterator[None]:
    """Meanwhile a client stops the robot and reads its state, again and again, and memory does not grow."""
    before_kib = rss_kib(served)
    ended = asyncio.Event()
    looking = asyncio.create_task(look(served, ended))
    yield
    ended.set()
    assert await looking >= 3
    assert rss_kib(served) - before_kib <= GROWTH_KIB
    assert served.process.poll() is None


async def look(served: Served, ended: asyncio.Event) -> int:
    ws = f"ws{served.url.removeprefix('http')}/ws"
    rounds = 0
    async with connect(ws, max_queue=None) as calm, AsyncClient(base_url=served.url) as asking:
        while not ended.is_set() or rounds < 3:
            async with asyncio.timeout(ANSWERED_WITHIN_S):
                await say(calm, type="stop")
                await hear_until(calm, "halted")
                assert (await asking.get("/api/status")).status_code == 200
            rounds += 1
    return rounds


@pytest.fixture
def served() -> Iterator[Served]:
    made = Served("--board", "doc", "--log-level", "error")
    os.set_blocking(made.pty.board, False)
    yield made
    made.end()


async def test_who_says_too_much_is_sent_away(served: Served) -> None:
    flooders = Flooders(served)
    async with responsive(served):
        await asyncio.gather(*(for_a_while(flooders.shout) for _ in range(FLOODERS)))
    assert {code for _, code in flooders.ends} == {TOO_MANY}
    assert max(lasted_s for lasted_s, _ in flooders.ends) <= CLOSED_WITHIN_S


async def test_refused_connections_keep_no_client_out(served: Served) -> None:
    flooders = Flooders(served)
    async with responsive(served):
        await asyncio.gather(*(for_a_while(flooders.knock) for _ in range(FLOODERS)))
    assert flooders.knocks >= 10 * LASTS_S
