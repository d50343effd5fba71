"""docs/examples: the tutorial and each program run on a simulated board behind a real gateway."""

import csv
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, Run, ServoTarget
from tests.served_robot import Served, served
from tests.test_client import has
from tests.test_with_simulator import ROOT, Board, board, pytestmark

pytestmark = [*pytestmark]
fixtures = (board,)
EXAMPLES = ROOT / "docs" / "examples"
DOC = FAMILIES["doc"]


@pytest.fixture
def here(board: Board, tmp_path: Path) -> Iterator[Served]:
    with served(tmp_path, device=str(board.link)) as made:
        yield made


def started(here: Served, name: str, *arguments: str, keys: str = "") -> str:
    """What the program prints."""
    done = subprocess.run(
        [sys.executable, "-W", "error", str(EXAMPLES / name), *arguments],
        input=keys,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
            "SERVODECK_URL": here.url,
        },
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def got(board: Board) -> bytes:
    return bytes(byte for _, byte in board.taken())


def moved(time_ms: int, servo: int, position: int) -> bytes:
    return encode(Move(time_ms, (ServoTarget(servo, position),)), DOC)


@pytest.mark.exhaustive
def test_the_tutorial_runs_from_top_to_bottom(
    here: Served, board: Board, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SERVODECK_URL", here.url)
    notebook = json.loads((EXAMPLES / "tutorial.ipynb").read_text("utf-8"))
    names: dict[str, Any] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            assert (cell["outputs"], cell["execution_count"]) == ([], None)
            exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
    assert (names["problem"], names["refusal"]) == ("outOfRange", "latched")
    assert names["job"]["status"] == "done"
    assert here.running.control.driving.driver is None
    assert moved(1500, 1, 1800) in got(board)
    assert encode(Run(5, 1), DOC) in got(board)


@pytest.mark.exhaustive
def test_pick_and_place_carries_from_one_side_to_the_other(here: Served, board: Board) -> None:
    assert started(here, "pick_and_place.py", "--turn", "40") == "Done.\n"
    packets = [moved(1500, 1, 1900), moved(400, 3, 1650), moved(1500, 1, 1100), moved(400, 3, 1300)]
    places = [got(board).find(packet) for packet in packets]
    assert -1 not in places
    assert places == sorted(places)


@pytest.mark.exhaustive
def test_keys_turn_servos_stop_and_resume(here: Served, board: Board) -> None:
    said = started(here, "drive_by_keys.py", keys="aa s r wq")
    assert "{'Base': 6.0, 'Elbow': 0.0}" in said
    assert "Stopped" in said
    has(lambda: moved(150, 1, 1560) in got(board))


def test_the_battery_is_logged_as_csv(here: Served, tmp_path: Path) -> None:
    file = tmp_path / "battery.csv"
    started(here, "log_battery.py", str(file), "--rows", "1")
    [heads, row] = csv.reader(file.read_text().splitlines())
    assert heads == ["time", "volts"]
    assert 5 < float(row[1]) < 13


@pytest.mark.exhaustive
def test_it_dances_to_a_file(here: Served, board: Board, tmp_path: Path) -> None:
    file = tmp_path / "dance.json"
    file.write_text('[{"beats": 1, "Base": 30, "Elbow": 10}, {"beats": 0.5, "Base": -30}]')
    assert started(here, "dance.py", str(file), "--bpm", "150") == "Danced 0.6 s.\n"
    assert moved(200, 1, 1200) in got(board)
