"""Clients without a credential, at a process of its own whose descriptors are few: they get no memory and no
descriptor that a stop needs, and a STOP meanwhile is served at once.

The amounts of the issue and all figures: PROPERTY_RUNS=1000 .venv/bin/python -m pytest -s THIS_FILE
"""

import asyncio
import os
import select
import subprocess
import sys
import threading
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import quantiles

import pytest
from httpx2 import AsyncClient
from websockets.asyncio.client import ClientConnection, connect

from servodeck.access.devices import DeviceFile, Devices
from servodeck.library.library import wall_clock_ms
from tests.amount import TIMES
from tests.bus import held_back_s
from tests.samples import STOP
from tests.test_cli import Served
from tests.test_clients import hear_until
from tests.test_flood import rss_kib
from tests.test_library_api import body
from tests.test_ports import Pty

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc"),
]

FLOOD = Path(__file__).parents[2] / "bench" / "unauthenticated.py"
FULL = TIMES > 1
STOPS = 200 if FULL else 3
GROWTH_KIB = 20 * 1024
# On a machine that does nothing else; the tests' run on busy ones, with the flood beside them.
STOPPED_WITHIN_S = 0.05 if FULL else 1.0
SETTLES_S = 1.0
PATIENCE_S = 10.0
# Those that took the most before; the others say the same in more ways.
FEW = {"idle": 1100, "half-body": 1000, "many-headers": 100, "upgrade": 100}
ALL = ("half-head", "half-body", "whole-body", "long-head", "many-headers", "upgrade", "page")
KINDS = {"idle": 1100, **dict.fromkeys(ALL, 1000)} if FULL else FEW


class Wire:
    """When each stop sequence has begun at the board's end."""

    def __init__(self, pty: Pty) -> None:
        self._pty = pty
        self.bytes = b""
        self.came_s = 0.0
        self._came = threading.Event()
        threading.Thread(target=self._read, daemon=True).start()

    def clear(self) -> None:
        self._came.clear()
        self.bytes = b""

    async def stopped_s(self) -> float:
        assert await asyncio.to_thread(self._came.wait, PATIENCE_S), self.bytes
        return self.came_s

    def _read(self) -> None:
        while True:
            try:
                select.select([self._pty.board], [], [])
                self.bytes += os.read(self._pty.board, 4096)
            except (OSError, ValueError):
                return
            if STOP in self.bytes and not self._came.is_set():
                self.came_s = time.monotonic()
                self._came.set()


@contextmanager
def flooded(served: Served, kind: str, clients: int) -> Iterator[None]:
    host, _, port = served.url.removeprefix("http://").rpartition(":")
    flood = subprocess.Popen([sys.executable, str(FLOOD), host, port, kind, str(clients)])
    try:
        yield
    finally:
        flood.kill()
        flood.wait()


@pytest.fixture
def token(tmp_path: Path) -> str:
    devices = Devices(DeviceFile(tmp_path), wall_clock_ms)
    _, credential = devices.admit("token", "Script", "owner")
    devices.close()
    return credential


@pytest.fixture
def served(tmp_path: Path, token: str) -> Iterator[Served]:
    few = ("sh", "-c", 'ulimit -Sn 256; exec "$@"', "sh")
    made = Served("--lan", "--board", "doc", "--data", str(tmp_path), "--log-level", "error", before=few)
    yield made
    made.end()


@pytest.mark.parametrize("kind", KINDS)
async def test_a_stop_is_heard_at_once_and_the_gateway_stays_small(
    served: Served, token: str, kind: str
) -> None:
    headers = {"Authorization": f"Bearer {token}"}
    wire = Wire(served.pty)
    async with connect(f"ws{served.url.removeprefix('http')}/ws", additional_headers=headers) as page:
        await hear_until(page, "welcome")
        reading = asyncio.create_task(beat(page))
        before_kib, cpu_s = rss_kib(served), cpu_of(served)
        with flooded(served, kind, KINDS[kind]):
            await asyncio.sleep(SETTLES_S)
            posted = await stops(served, wire, lambda: post(served, token))
            pressed = await stops(served, wire, lambda: page.send('{"type":"stop"}'))
            async with AsyncClient(base_url=served.url, headers=headers) as client:
                saved = await client.put("/api/library/a", json=body())
                opened = await client.put("/api/port", json={"device": served.pty.device, "board": "doc"})
            grown_kib = rss_kib(served) - before_kib
        reading.cancel()
    sys.stdout.write(
        f"{kind}: {KINDS[kind]} clients, RSS {before_kib} + {grown_kib} KiB, POST {figures(posted)}, "
        f"WebSocket {figures(pressed)}, {cpu_of(served) - cpu_s:.1f} s of processor\n"
    )
    assert (saved.status_code, opened.status_code) == (200, 200)
    assert grown_kib <= GROWTH_KIB
    assert p99(posted) <= STOPPED_WITHIN_S
    assert p99(pressed) <= STOPPED_WITHIN_S


async def beat(page: ClientConnection) -> None:
    async for _ in page:
        pass


async def post(served: Served, token: str) -> None:
    """On a connection of its own, without what a client of a library takes to begin."""
    host = served.url.removeprefix("http://")
    reader, writer = await asyncio.open_connection(*host.split(":"))
    writer.write(f"POST /api/stop HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\n\r\n".encode())
    assert await reader.readline() == b"HTTP/1.1 200 OK\r\n"
    writer.close()


async def stops(served: Served, wire: Wire, stop: Callable[[], Awaitable[None]]) -> list[float]:
    """How long each took from the press to its first packet at the board, without what the gateway and this
    test have waited for other processes.
    """
    took_s = []
    for _ in range(STOPS):
        wire.clear()
        pressed_s, waited_s = time.monotonic(), waited_for_others_s(served)
        sending = asyncio.ensure_future(stop())
        stopped_s = await wire.stopped_s()
        took_s.append(max(0.0, stopped_s - pressed_s - (waited_for_others_s(served) - waited_s)))
        await sending
        await asyncio.sleep(0.3)  # the rest of the sequence
    return took_s


def waited_for_others_s(served: Served) -> float:
    return held_back_s(served.process.pid) + held_back_s(os.getpid())


def p99(took_s: list[float]) -> float:
    return quantiles(took_s, n=100, method="inclusive")[98]


def figures(took_s: list[float]) -> str:
    p50 = quantiles(took_s, n=2, method="inclusive")[0]
    return f"{len(took_s)} stops p50 {p50 * 1000:.1f} ms p99 {p99(took_s) * 1000:.1f} ms"


def cpu_of(served: Served) -> float:
    fields = Path(f"/proc/{served.process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
