"""The gateway on the real simulated board behind a real pty: from a message to bytes on the bus and back.

Needs the simulator built by `npm run build` and Node; skipped, with the reason, where one is missing.
"""

import asyncio
import json
import os
import shutil
import subprocess
import sys
from collections.abc import AsyncIterator, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import ClientConnection, connect

from servodeck.port.background import BackgroundPorts
from tests.running import Running, server_on
from tests.samples import BATTERY, BATTERY_REPORT, MOVE, MOVE_ELSEWHERE, RUN, STOP
from tests.test_clients import drive, hear, hear_until, say

ROOT = Path(__file__).parents[2]
HALT = STOP + MOVE_ELSEWHERE + STOP * 2 + MOVE_ELSEWHERE
SIMULATOR = ROOT / "build" / "simulator.mjs"
NODE = shutil.which("node")

pytestmark = [
    pytest.mark.skipif(not SIMULATOR.exists(), reason="the simulator is not built: npm run build"),
    pytest.mark.skipif(NODE is None, reason="Node is not installed"),
    pytest.mark.skipif(os.name != "posix", reason="a pty needs POSIX"),
]


@dataclass
class Board:
    """A simulated board on a serial device, and the log of all bytes on its bus."""

    link: Path
    log: Path
    process: subprocess.Popen[str] | None = None

    def plug(self) -> None:
        bridge = [sys.executable, str(ROOT / "scripts" / "pty_board.py"), "--link", str(self.link), "--"]
        board = [str(NODE), str(SIMULATOR), "--stdio", "--bus-log", str(self.log)]
        self.process = subprocess.Popen([*bridge, *board], stderr=subprocess.PIPE, text=True)
        assert self.process.stderr
        assert self.process.stderr.readline().startswith("pty ")

    def pull(self) -> None:
        if self.process:
            self.process.terminate()
            self.process.communicate(timeout=5)
            self.process = None

    def taken(self) -> list[tuple[float, int]]:
        """Each byte that reached the board, with its time in ms."""
        entries = [json.loads(line) for line in self.log.read_text().splitlines()[1:]]
        return [(entry["atMs"], entry["byte"]) for entry in entries if entry["direction"] == "in"]


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    made = Board(tmp_path / "board", tmp_path / "bus.jsonl")
    made.plug()
    yield made
    made.pull()


@pytest.fixture
async def gateway(board: Board) -> AsyncIterator[Running]:
    async with server_on(BackgroundPorts(), str(board.link)) as running:
        yield running


async def hear_port(client: ClientConnection, status: str) -> dict[str, Any]:
    """The first message that says so of the port: the welcome or a change."""
    while (message := await hear(client)).get("port", {}).get("status") != status:
        pass
    return message


async def test_moves_battery_and_stop_reach_the_board_in_order(board: Board, gateway: Running) -> None:
    async with connect(gateway.ws) as client:
        await hear_port(client, "open")
        nonce = await drive(client)
        await say(client, type="send", id=1, packet=MOVE.hex(), nonce=nonce)
        await say(client, type="send", id=2, packet=BATTERY.hex())
        assert (await hear_until(client, "received"))["packet"] == BATTERY_REPORT.hex()
        await say(client, type="send", id=3, packet=RUN.hex(), nonce=nonce)
        await say(client, type="stop", hold=MOVE_ELSEWHERE.hex())
        await hear_until(client, "halted")
        await asyncio.sleep(0.05)  # the board takes its last byte one byte time after we counted it
    got = bytes(byte for _, byte in board.taken())
    assert got in (
        STOP + MOVE + BATTERY + RUN + HALT,
        STOP + MOVE + BATTERY + HALT,
    )


async def test_a_pulled_cable_is_told_and_a_plugged_one_found_again(board: Board, gateway: Running) -> None:
    async with connect(gateway.ws) as client:
        await hear_port(client, "open")
        board.pull()
        assert (await hear_port(client, "lost"))["latch"] is True
        board.plug()
        await hear_port(client, "open")
        await say(client, type="resume")
        await hear_until(client, "state")
        nonce = await drive(client)
        await say(client, type="send", id=1, packet=MOVE.hex(), nonce=nonce)
        assert await hear_until(client, "sent") == {"type": "sent", "id": 1}
