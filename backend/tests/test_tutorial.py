"""docs/scripts.md says what is true: each of its pieces of code runs, in order, on a simulated board."""

import asyncio
import os
import re
import shutil
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from servodeck.library.library import Library
from servodeck.port.link import BackgroundPorts
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, Run, ServoTarget
from tests.running import Running, server_on
from tests.served_robot import ROBOT, describe_robot
from tests.test_with_simulator import ROOT, Board, board, pytestmark

pytestmark = [
    pytest.mark.exhaustive,
    *pytestmark,
    pytest.mark.skipif(shutil.which("curl") is None, reason="curl is not installed"),
]
fixtures = (board,)

PIECE = re.compile(r"^```(sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROGRAMS = {"sh": ["sh", "-eu"], "python": [sys.executable, "-W", "error", "-"]}
PLACE = "http://127.0.0.1:8300"
DOC = FAMILIES["doc"]


@pytest.fixture
async def gateway(board: Board, tmp_path: Path) -> AsyncIterator[Running]:
    library = Library(tmp_path / "data")
    async with server_on(BackgroundPorts(), None, library=library) as running:
        await running.control.use_port(str(board.link))
        describe_robot(library)
        await running.control.robot.put(ROBOT, None)
        yield running
    library.close()


def pieces() -> list[tuple[str, str]]:
    return PIECE.findall((ROOT / "docs" / "scripts.md").read_text("utf-8"))


def variables(url: str, folder: Path) -> dict[str, str]:
    """With this project's own command first in the path."""
    command = folder / "servodeck"
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m servodeck "$@"\n')
    command.chmod(0o755)
    return {
        "PATH": f"{folder}:{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
        "SERVODECK_URL": url,
        "SERVODECK_TOKEN": "",
    }


async def at_rest(gateway: Running) -> None:
    """As for a reader: first moves and groups last longer than the commands that began them."""
    async with asyncio.timeout(20):
        while not gateway.control.board.is_idle():  # noqa: ASYNC110 (nothing announces it)
            await asyncio.sleep(0.02)


async def test_each_piece_of_the_tutorial_runs(board: Board, gateway: Running, tmp_path: Path) -> None:
    url = f"http://{gateway.host}"
    environment = variables(url, tmp_path)
    assert {language for language, _ in pieces()} == set(PROGRAMS)
    for language, text in pieces():
        await at_rest(gateway)
        done = await asyncio.to_thread(
            subprocess.run,
            PROGRAMS[language],
            input=text.replace(PLACE, url),
            text=True,
            capture_output=True,
            env=environment,
            cwd=tmp_path,
            timeout=30,
        )
        assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"
    await asyncio.sleep(0.05)
    got = bytes(byte for _, byte in board.taken())
    for position, time_ms in ((1500, 1500), (1200, 400), (1800, 400), (1700, 1500)):
        assert encode(Move(time_ms, (ServoTarget(1, position),)), DOC) in got
    assert got.count(encode(Run(5, 2), DOC)) == 2
    assert got.count(bytes.fromhex("55550b190502")) == 2
