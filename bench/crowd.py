"""A class in front of one robot: viewers on the WebSocket, some of whom never read, and one who drives. Then
another of them presses STOP again and again, while it drives on.

What leaves the wire is told to everybody. Prints what it took from the driver's word to each reader's copy,
when STOP was pressed, and what the gateway spent.
Usage: crowd.py HOST PORT PID READERS NON_READERS SECONDS PRESSES
"""

import asyncio
import base64
import json
import os
import random
import re
import socket
import sys
import time
from pathlib import Path

from websockets.asyncio.client import ClientConnection, connect

SERVOS = 6
# Moves count up from 0.
BOARD_ID = 2**53 - 1
PERIOD_S = 0.05
JOIN_AT_ONCE = 20
# Between Resume and the next press: at any moment of the driver's.
PAUSE_S = (0.060, 0.110)
FIRST_POSITION = 500
# The first servo's position in the last move of a message.
LEFT = re.compile(r'^\{"type":"left",.*"targets":\[\{"servo":1,"position":(\d+)')
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n"
)


class Driver:
    def __init__(self, client: ClientConnection) -> None:
        self._client = client
        self._nonce: str | None = None
        self.drives = asyncio.Event()
        self.said_s: list[float] = []
        self.listening = asyncio.create_task(self._listen())
        self.moving: asyncio.Task[None] | None = None

    async def begin(self) -> None:
        await self._say(type="board", id=BOARD_ID, board="doc")
        await self._say(type="lease", action="request")
        await self.drives.wait()
        self.moving = asyncio.create_task(self._move())

    async def _move(self) -> None:
        begun_s = time.perf_counter()
        for number in range(1_000_000):
            await asyncio.sleep(max(0.0, begun_s + number * PERIOD_S - time.perf_counter()))
            self.said_s.append(time.perf_counter())
            packet = move_to(FIRST_POSITION + number).hex()
            await self._say(type="packet", id=number, bytes=packet, nonce=self._nonce)

    async def _listen(self) -> None:
        async for text in self._client:
            message = json.loads(text)
            if message["type"] == "tick":
                self._nonce = message["nonce"]
                await self._say(type="heartbeat", nonce=self._nonce)
                self.drives.set()
            if message["type"] == "refused" and message["id"] == BOARD_ID:
                sys.stderr.write(message["detail"])
                os._exit(1)

    async def _say(self, **message: object) -> None:
        await self._client.send(json.dumps(message))


async def main() -> None:
    host, port, pid, readers, non_readers, seconds, presses = sys.argv[1], *map(int, sys.argv[2:])
    address = f"{host}:{port}"
    deaf = [never_reading(host, port, address) for _ in range(non_readers)]
    driver, presser = Driver(await joined(address)), await joined(address)
    clients: list[ClientConnection] = []
    while len(clients) < readers:
        joining = min(JOIN_AT_ONCE, readers - len(clients))
        clients += await asyncio.gather(*(joined(address) for _ in range(joining)))
    ages_ms: list[float] = []
    reading = [asyncio.create_task(watch(client, driver.said_s, ages_ms)) for client in clients]
    cpu_s, rss_kib, begun_s = cpu_of(pid), rss_of(pid), time.perf_counter()
    await driver.begin()
    await asyncio.sleep(seconds)
    driving_ms = [*ages_ms]
    cpu_share = (cpu_of(pid) - cpu_s) / (time.perf_counter() - begun_s)
    pressed_ms = [await press(presser) for _ in range(presses)]
    if any(task.done() for task in reading):
        raise SystemExit("The gateway closed a client that reads.")
    json.dump(
        {
            "agesMs": driving_ms,
            "pressedMs": pressed_ms,
            "endedMs": time.time() * 1000,
            "cpuShare": cpu_share,
            "rssGrowthMiB": (rss_of(pid) - rss_kib) / 1024,
        },
        sys.stdout,
    )
    sys.stdout.flush()
    for connection in deaf:
        connection.close()
    os._exit(0)  # nobody waits for 200 goodbyes


def joined(address: str) -> connect:
    return connect(f"ws://{address}/ws", max_queue=None)


async def watch(client: ClientConnection, said_s: list[float], ages_ms: list[float]) -> None:
    """Notes how old the newest of what has left is when it is read."""
    async for text in client:
        now_s = time.perf_counter()
        found = LEFT.search(str(text))
        if found:
            number = int(found[1]) - FIRST_POSITION
            if 0 <= number < len(said_s):
                ages_ms.append((now_s - said_s[number]) * 1000)


async def press(client: ClientConnection) -> float:
    """Until the whole sequence has left. When it was, in milliseconds since the epoch."""
    await asyncio.sleep(random.uniform(*PAUSE_S))
    pressed_ms = time.time() * 1000
    await client.send('{"type":"stop"}')
    async for text in client:
        if json.loads(text)["type"] == "halted":
            break
    await client.send('{"type":"resume"}')
    return pressed_ms


def move_to(position: int) -> bytes:
    targets = b"".join(bytes([servo]) + position.to_bytes(2, "little") for servo in range(1, SERVOS + 1))
    return b"\x55\x55" + bytes([5 + len(targets), 3, SERVOS]) + (50).to_bytes(2, "little") + targets


def never_reading(host: str, port: int, address: str) -> socket.socket:
    connection = socket.create_connection((host, port))
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
    key = base64.b64encode(os.urandom(16)).decode()
    connection.sendall(UPGRADE.format(host=address, key=key).encode())
    return connection


def cpu_of(pid: int) -> float:
    """Seconds of a core."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def rss_of(pid: int) -> int:
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))


if __name__ == "__main__":
    asyncio.run(main())
