"""`servodeck play`, as a person and as a shell script use it."""

import json
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest

from servodeck.cli.options import FAILURE, USAGE
from tests.test_cli import Served, run
from tests.test_download_cli import file_in

FRAMES = [{"durationMs": 100, "positions": {"1": position}} for position in (1200, 1800)]


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served("--board", "doc", "--data", str(tmp_path / "data"), "--log-level", "error")
    yield made
    made.end()


@pytest.mark.exhaustive
def test_a_file_is_played_and_its_end_waited_for(served: Served, tmp_path: Path) -> None:
    wave = file_in(tmp_path, "wave.json", {"frames": FRAMES})
    done = run("play", wave, "--times", "2", "--url", served.url)
    assert (done.exit_code, done.stderr, done.stdout) == (0, "", "Played: 2 frames.\n")
    assert httpx2.get(f"{served.url}/api/status").json()["play"]["status"] == "done"


@pytest.mark.exhaustive
def test_one_that_may_continue_returns_at_once_and_a_stop_is_reported(served: Served, tmp_path: Path) -> None:
    wave = file_in(tmp_path, "wave.json", {"frames": FRAMES})
    begun = run("play", wave, "--times", "0", "--continue", "60", "--json", "--url", served.url)
    assert (begun.exit_code, json.loads(begun.stdout)["status"]) == (0, "playing")
    refused = run("play", wave, "--url", served.url)
    assert (refused.exit_code, "plays a group" in refused.stderr) == (FAILURE, True)
    run("stop", "--url", served.url)
    assert httpx2.get(f"{served.url}/api/status").json()["play"]["code"] == "latched"
    assert run("play", str(tmp_path / "none.json"), "--url", served.url).exit_code == USAGE
