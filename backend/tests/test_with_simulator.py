"""The gateway on the real simulated board behind a real pty: from a message to bytes on the bus and back.

Needs the simulator built by `npm run build` and Node; skipped, with the reason, where one is missing.
"""

import asyncio
import json
import os
import shutil
import subprocess
import sys
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import pytest
from httpx2 import AsyncClient, Client
from websockets.asyncio.client import ClientConnection, connect

from servodeck.cli.options import FAILURE
from servodeck.port.link import BackgroundPorts
from servodeck.protocol.decoder import COMMAND_AT
from tests.running import Running, server_on
from tests.samples import BATTERY, BATTERY_REPORT, MOVE, RUN, STOP
from tests.test_cli import Served, run
from tests.test_clients import drive, hear, hear_until, say
from tests.test_ports import Pty

ROOT = Path(__file__).parents[2]
POSITIONS = 21
SIMULATOR = ROOT / "build" / "simulator.mjs"
NODE = shutil.which("node")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not SIMULATOR.exists(), reason="the simulator is not built: npm run build"),
    pytest.mark.skipif(NODE is None, reason="Node is not installed"),
    pytest.mark.skipif(os.name != "posix", reason="a pty needs POSIX"),
]


@dataclass
class Board:
    """A simulated board on a serial device, and the log of all bytes on its bus."""

    link: Path
    log: Path
    name: str = "doc"
    process: subprocess.Popen[str] | None = None

    def plug(self) -> None:
        bridge = [sys.executable, str(ROOT / "scripts" / "pty_board.py"), "--link", str(self.link), "--"]
        board = [str(NODE), str(SIMULATOR), "--stdio", "--board", self.name, "--bus-log", str(self.log)]
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
        *lines, _half_written = self.log.read_text().split("\n")
        entries = [json.loads(line) for line in lines[1:]]
        return [(entry["atMs"], entry["byte"]) for entry in entries if entry["direction"] == "in"]

    async def packets_taken(self) -> list[tuple[float, bytes]]:
        """Each packet of which all has reached the board, with the time of its last byte."""
        taken, packets, at = self.taken(), [], 0
        # Behind its two first bytes comes the length of the rest.
        while at + 2 < len(taken) and (end := at + 2 + taken[at + 2][1]) <= len(taken):
            packets.append((taken[end - 1][0], bytes(byte for _, byte in taken[at:end])))
            at = end
        return packets


@pytest.fixture
def board(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Board]:
    made = Board(tmp_path / "board", tmp_path / "bus.jsonl", getattr(request, "param", "doc"))
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
        await say(client, type="packet", id=1, bytes=MOVE.hex(), nonce=nonce)
        await say(client, type="packet", id=2, bytes=BATTERY.hex())
        assert (await hear_until(client, "received"))["bytes"] == BATTERY_REPORT.hex()
        await say(client, type="packet", id=3, bytes=RUN.hex(), nonce=nonce)
        await say(client, type="stop")
        await hear_until(client, "halted")
        await asyncio.sleep(0.05)  # the board takes its last byte one byte time after we counted it
    got = bytes(byte for _, byte in board.taken())
    begin = MOVE + BATTERY
    opening, _, _ = got.partition(begin)
    assert opening == STOP * (len(opening) // len(STOP))
    begin = opening + begin
    assert got.startswith(begin)
    # The stop may overtake the run; where it does not, the board's word of it may bring more stops.
    behind = got.removeprefix(begin).removeprefix(RUN)
    assert behind.startswith(STOP)
    assert behind.count(STOP) >= 3


@pytest.mark.exhaustive
async def test_a_pulled_cable_is_reported_and_a_plugged_one_found_again(
    board: Board, gateway: Running
) -> None:
    async with connect(gateway.ws) as client:
        await hear_port(client, "open")
        board.pull()
        assert (await hear_port(client, "lost"))["latch"] is True
        board.plug()
        await hear_port(client, "open")
        await say(client, type="resume")
        await hear_until(client, "state")
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=MOVE.hex(), nonce=nonce)
        assert await hear_until(client, "done") == {
            "type": "done",
            "id": 1,
            "outcome": "sent",
            "batteryUnknown": False,
        }


@pytest.mark.parametrize("board", ["xarm"], indirect=True)
def test_without_a_page_and_without_an_option_the_command_line_finds_out_which_board_it_is(
    board: Board, tmp_path: Path
) -> None:
    for start in ("the first", "the next"):
        place = ("--serial", str(board.link), "--data", str(tmp_path / "data"))
        served = Served(*place, pty=Pty(), is_named=False, identifies_board=True)
        at = ("--url", served.url)
        if start == "the first":
            refused = run("move", "1=500", *at)
            assert refused.exit_code == FAILURE
            assert "It answers like: bus-ctrl, xarm. Name it: servodeck board FAMILY" in refused.stderr
            assert "It answers like: bus-ctrl, xarm." in run("board", *at).stdout
            assert "wrongBoard" in run("board", "learm-esp32", *at).stdout
            assert "board    xarm, ready" in run("board", "xarm", *at).stdout
        assert run("move", "1=500", *at).exit_code == 0, f"{start} start: it is remembered"
        served.end()
    kinds = {packet[COMMAND_AT] for _, packet in asyncio.run(board.packets_taken())}
    assert kinds == {STOP[COMMAND_AT], BATTERY[COMMAND_AT], MOVE[COMMAND_AT], POSITIONS}


@pytest.mark.exhaustive
@pytest.mark.parametrize("board", ["xarm"], indirect=True)
def test_behind_npm_start_another_port_is_identified_before_anything_moves(
    board: Board, tmp_path: Path
) -> None:
    simulated = Board(tmp_path / "simulated", tmp_path / "simulated.jsonl")
    simulated.plug()
    place = ("--serial", str(simulated.link), "--data", str(tmp_path / "data"))
    served = Served(*place, "--simulated", pty=Pty(), is_named=False, identifies_board=True)
    at = ("--url", served.url)
    try:
        assert run("move", "1=1500", *at).exit_code == 0
        assert run("battery", *at).stdout.startswith("7.")
        for device in (board.link, simulated.link):
            with Client(base_url=served.url) as client:
                assert client.put("/api/port", json={"device": str(device)}).is_success
            assert " V" not in run("status", *at).stdout
            if device == board.link:
                refused = run("move", "1=500", *at)
                assert "It answers like: bus-ctrl, xarm." in refused.stderr
        assert run("move", "1=1500", *at).exit_code == 0
    finally:
        served.end()
        simulated.pull()
    assert MOVE[COMMAND_AT] not in {packet[COMMAND_AT] for _, packet in asyncio.run(board.packets_taken())}


SLOT, START, END, FRAME_MS = 5, 1000, 2000, 4000
PATIENCE_S = 5
Answer = TypeVar("Answer")
RUN_SLOT = bytes.fromhex("55550506050100")
# A tick, what the board says, and the way of the bytes through two more processes: 400 ms of it.
LEEWAY = 100
GROUP = {"slot": SLOT, "frames": [{"durationMs": FRAME_MS, "positions": {"1": END}}]}


async def ask_until(ask: Callable[[], Awaitable[Answer]], is_it: Callable[[Answer], bool]) -> Answer:
    async with asyncio.timeout(PATIENCE_S):
        while not is_it(answer := await ask()):  # noqa: ASYNC110 (nothing announces it)
            await asyncio.sleep(0.05)
    return answer


async def ask_at_rest(client: AsyncClient, path: str, **body: Any) -> dict[str, Any]:
    """As soon as the robot does not move any more."""
    answer = await ask_until(
        lambda: client.post(f"/api/{path}", json=body), lambda answer: answer.status_code != 409
    )
    assert answer.is_success, answer.text
    said: dict[str, Any] = answer.json()
    return said


@pytest.mark.exhaustive
@pytest.mark.parametrize("door", ["HTTP", "command line"])
@pytest.mark.parametrize("board", ["openarm-old"], indirect=True)
async def test_a_group_that_the_gateway_stored_is_held_where_its_frame_has_the_servo(
    board: Board, gateway: Running, door: str
) -> None:
    async with AsyncClient(base_url=f"http://{gateway.host}") as client:
        await client.put("/api/port", json={"device": str(board.link), "board": board.name})
        await ask_at_rest(client, "move", timeMs=1500, positions={"1": START})
        job = (await ask_at_rest(client, "download", groups=[GROUP]))["id"]
        state = await ask_until(
            lambda: client.get(f"/api/jobs/{job}"), lambda answer: answer.json()["status"] != "running"
        )
        assert state.json()["status"] == "done"
        await ask_at_rest(client, f"slots/{SLOT}/run", continueForMs=60_000)
        await asyncio.sleep(1)
        if door == "HTTP":
            assert (await ask_at_rest(client, "stop"))["unheld"] is None
        else:
            result = await asyncio.to_thread(run, "stop", "--url", f"http://{gateway.host}")
            assert result.stdout.startswith("Stopped. ")
    taken = await ask_until(
        board.packets_taken, lambda packets: [packet for _, packet in packets][-6:-5] == [RUN_SLOT]
    )
    [(begun_ms, _), (_, first), (held_ms, hold), *repeats, (_, again)] = taken[-6:]
    assert [first, *(packet for _, packet in repeats)] == [STOP] * 3
    target, ran_ms = int.from_bytes(hold[8:10], "little"), held_ms - begun_ms
    assert START < target < END
    assert START + (END - START) * ran_ms / FRAME_MS == pytest.approx(target, abs=LEEWAY)
    assert again[:5] == hold[:5]
    assert again[7:] == hold[7:]
