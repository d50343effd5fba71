"""A class in front of one robot: viewers on the WebSocket, some of whom never read; one asks the board.

Each answer goes to everybody. Prints what it took from the question to each reader's copy, and what the
gateway spent. Usage: crowd.py HOST PORT PID READERS NON_READERS QUESTIONS PERIOD_MS
"""

import asyncio
import base64
import json
import os
import socket
import sys
import time
from pathlib import Path

from websockets.asyncio.client import ClientConnection, connect

BATTERY = "5555020f"
JOIN_AT_ONCE = 20
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n"
)


async def main() -> None:
    host, port, pid, readers, non_readers, questions, period_ms = sys.argv[1], *map(int, sys.argv[2:])
    address = f"{host}:{port}"
    deaf = [never_reading(host, port, address) for _ in range(non_readers)]
    clients: list[ClientConnection] = []
    while len(clients) < readers:
        joining = min(JOIN_AT_ONCE, readers - len(clients))
        clients += await asyncio.gather(*(connect(f"ws://{address}/ws") for _ in range(joining)))
    asked: list[float] = []
    reading = [asyncio.create_task(answers(client, questions)) for client in clients]
    cpu_s, rss_kib, begun = cpu_of(pid), rss_of(pid), time.perf_counter()
    for number in range(questions):
        asked.append(time.perf_counter())
        message = {"type": "send", "id": number, "packet": BATTERY, "nonce": None}
        await clients[0].send(json.dumps(message))
        await asyncio.sleep(period_ms / 1000)
    async with asyncio.timeout(10):
        heard = await asyncio.gather(*reading)
    spent = cpu_of(pid) - cpu_s
    json.dump(
        {
            "latenciesMs": [
                (at - when) * 1000 for each in heard for at, when in zip(each, asked, strict=True)
            ],
            "cpuShare": spent / (time.perf_counter() - begun),
            "rssGrowthMiB": (rss_of(pid) - rss_kib) / 1024,
        },
        sys.stdout,
    )
    for connection in deaf:
        connection.close()


async def answers(client: ClientConnection, count: int) -> list[float]:
    """When each of the board's answers came."""
    times: list[float] = []
    async for text in client:
        if json.loads(text)["type"] == "received":
            times.append(time.perf_counter())
        if len(times) == count:
            return times
    raise SystemExit("The gateway closed a client that reads.")


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
