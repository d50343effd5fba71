"""A flood of one kind at a gateway, and a person who presses STOP again and again meanwhile.

Prints when STOP was pressed, and the memory of the gateway before, during and a while after the flood.
Usage: floods.py HOST PORT PID TOKEN KIND PRESSES AFTER_S
"""

import asyncio
import json
import random
import sys
import time
from pathlib import Path

# The program, what it calls the kind, and how many clients.
KINDS = {
    "bodies": ("unauthenticated.py", "whole-body", 200),
    "strangers": ("unauthenticated.py", "half-body", 1000),
    "heads": ("unauthenticated.py", "long-head", 100),
    "slow": ("unauthenticated.py", "half-head", 300),
    "page": ("unauthenticated.py", "page", 100),
    "pings": ("paired_flood.py", "pings", 5),
    "fragments": ("paired_flood.py", "fragments", 5),
    "unread": ("paired_flood.py", "unread", 8),
    "camera": ("paired_flood.py", "camera", 20),
}
SETTLES_S = 2.0
PAUSE_S = (0.05, 0.15)
# The stops of a press have left, and those that go on end with Resume.
SEQUENCE_S = 0.25
SAMPLE_S = 0.05


class Gateway:
    def __init__(self, host: str, port: str, pid: str, token: str) -> None:
        self.host, self.port, self.token = host, port, token
        self._status = Path(f"/proc/{pid}/status")

    def rss_mib(self) -> float:
        lines = self._status.read_text().splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024

    async def ask(self, method: str, path: str) -> None:
        """On a connection of its own."""
        reader, writer = await asyncio.open_connection(self.host, int(self.port))
        bearer = f"Authorization: Bearer {self.token}\r\n\r\n"
        writer.write(f"{method} {path} HTTP/1.1\r\nHost: {self.host}:{self.port}\r\n{bearer}".encode())
        line = await reader.readline()
        writer.transport.abort()
        if b" 200 " not in line:
            raise SystemExit(f"{path}: {line!r}")


async def main() -> None:
    host, port, pid, token, kind, presses, after_s = sys.argv[1:]
    gateway = Gateway(host, port, pid, token)
    for path in ("/", "/api/library", "/api/cameras"):  # what is loaded with the first requests is no growth
        await gateway.ask("GET", path)
    await press(gateway)
    rest_mib = gateway.rss_mib()
    program, name, clients = KINDS[kind]
    script = str(Path(__file__).with_name(program))
    credential = [token] if program == "paired_flood.py" else []
    command = [sys.executable, script, host, port, name, str(clients), *credential]
    flood = await asyncio.create_subprocess_exec(*command)
    watching = asyncio.create_task(peak_mib(gateway))
    try:
        await asyncio.sleep(SETTLES_S)
        pressed_ms = [await press(gateway) for _ in range(int(presses))]
        if flood.returncode is not None:
            raise SystemExit("The flood has ended by itself.")
    finally:
        flood.kill()
        await flood.wait()
    watching.cancel()
    peak = max(peaks)
    await asyncio.sleep(float(after_s))
    json.dump(
        {
            "pressedMs": pressed_ms,
            "grownMiB": peak - rest_mib,
            "leftMiB": gateway.rss_mib() - rest_mib,
        },
        sys.stdout,
    )


peaks: list[float] = []


async def peak_mib(gateway: Gateway) -> None:
    while True:
        peaks.append(gateway.rss_mib())
        await asyncio.sleep(SAMPLE_S)


async def press(gateway: Gateway) -> float:
    """When it was, in milliseconds since the epoch."""
    await asyncio.sleep(random.uniform(*PAUSE_S))
    pressed_ms = time.time() * 1000
    await gateway.ask("POST", "/api/stop")
    await asyncio.sleep(SEQUENCE_S)
    await gateway.ask("POST", "/api/resume")
    return pressed_ms


if __name__ == "__main__":
    asyncio.run(main())
