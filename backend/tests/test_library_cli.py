"""Poses, the library and erasing from the command line, as a person and as a shell script use them."""

import json
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest
from typer.testing import CliRunner

from servodeck.cli.main import app
from servodeck.cli.options import FAILURE
from tests.robots import robot_text, written
from tests.samples import ERASE
from tests.scripted import move
from tests.test_cli import Served, run
from tests.test_poses_api import POSES

pytestmark = pytest.mark.exhaustive

WAVE = {
    "kind": "group",
    "name": "Wave",
    "robot": "Arm",
    "tags": [],
    "updatedAtMs": 0,
    "frames": 2,
    "durationMs": 800,
    "unit": "us",
    "pose": [],
}


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served("--board", "doc", "--data", str(tmp_path), "--log-level", "error")
    yield made
    made.end()


def describe(served: Served) -> None:
    with httpx2.Client(base_url=served.url) as script:
        arm, wave = written(robot_text(poses=POSES)), written("{}", facts=WAVE)
        for name, document in (("arm", arm), ("wave", wave)):
            script.put(f"/api/library/{name}", json=document).raise_for_status()
        script.put("/api/robot", json={"id": "arm"}).raise_for_status()


def test_poses_are_listed_and_gone_to_by_name_or_number(served: Served) -> None:
    assert "no poses yet" in run("poses", "--url", served.url).stdout
    describe(served)
    assert run("poses", "--url", served.url).stdout.splitlines()[1:3] == ["  1  Greeting", "  2  Rest"]
    assert json.loads(run("poses", "--url", served.url, "--json").stdout)["robot"] == "Arm"
    gone = run("pose", "2", "--url", served.url)
    assert (gone.exit_code, gone.stdout) == (0, "Moving; ends in 1.5 s.\n")
    assert served.read(len(move(1500, s1=1500))) == move(1500, s1=1500)
    several = run("pose", "Rest", "--url", served.url)
    assert (several.exit_code, "2, 3" in several.stderr) == (FAILURE, True)
    nowhere = run("pose", "../stop", "--url", served.url)
    assert (nowhere.exit_code, nowhere.stdout) == (FAILURE, "")


def test_the_library_is_listed(served: Served) -> None:
    assert run("library", "--url", served.url).stdout == "The library is empty.\n"
    describe(served)
    lines = run("library", "--url", served.url).stdout.splitlines()
    assert sorted(lines) == ["arm  Arm  (robot)", "wave  Wave  (2 frames, 0.8 s)"]
    assert len(json.loads(run("library", "--url", served.url, "--json").stdout)["documents"]) == 2


def test_erasing_asks_first_and_reports_a_missing_answer(served: Served) -> None:
    refused = CliRunner().invoke(app, ["erase", "--url", served.url], input="n\n")
    assert refused.exit_code == 1
    silent = run("erase", "--yes", "--url", served.url)
    assert (silent.exit_code, "(noAnswer)" in silent.stderr) == (FAILURE, True)
    assert served.read(len(ERASE)) == ERASE
