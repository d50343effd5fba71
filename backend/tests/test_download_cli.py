"""`servodeck download`, as a person and as a shell script use it, with a board that answers."""

import json
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx2
import pytest

from servodeck.cli.options import FAILURE, USAGE
from servodeck.protocol.timings import wire_s
from tests.samples import DOWNLOAD
from tests.test_cli import Served, run

FRAMES = [{"durationMs": 400, "positions": {"1": position}} for position in (1200, 1800)]
FLASH_S = 0.02
STORED = bytes.fromhex("55550219")


class Board:
    """Says "stored" to each frame; behind `silent_after` of them it calls `silent` instead."""

    def __init__(self, board: int) -> None:
        self.stored: list[tuple[int, int]] = []
        self.silent_after: int | None = None
        self.silent: Callable[[], object] = lambda: None
        self._board = os.dup(board)  # its number may be another's when the test has ended
        threading.Thread(target=self._answer, daemon=True).start()

    def _answer(self) -> None:
        data = b""
        with suppress(OSError):  # the gateway has let go of the port
            while True:
                data += os.read(self._board, 1000)
                while len(data) > 3 and len(data) >= data[2] + 2:
                    packet, data = data[: data[2] + 2], data[data[2] + 2 :]
                    if packet[3] == DOWNLOAD[3]:
                        self._take(packet)
        os.close(self._board)

    def _take(self, packet: bytes) -> None:
        if len(self.stored) == self.silent_after:
            self.silent_after = -1
            self.silent()
        if self.silent_after == -1:
            return
        time.sleep(wire_s(len(packet)) + FLASH_S)  # a pty is quicker than a line
        self.stored.append((packet[4], packet[6]))
        os.write(self._board, STORED)


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served("--board", "doc", "--data", str(tmp_path / "data"), "--log-level", "error")
    yield made
    made.end()


@pytest.fixture
def board(served: Served) -> Board:
    return Board(served.pty.board)


def file_in(folder: Path, name: str, text: Any) -> str:
    (folder / name).write_text(text if isinstance(text, str) else json.dumps(text), "utf-8")
    return str(folder / name)


@pytest.mark.exhaustive
def test_several_files_go_to_their_slots(served: Served, board: Board, tmp_path: Path) -> None:
    wave = file_in(tmp_path, "wave.json", {"frames": FRAMES})
    bow = file_in(tmp_path, "bow.json", {"name": "Deep bow", "frames": FRAMES[:1]})
    done = run("download", f"5={wave}", f"7={bow}", "--url", served.url)
    assert (done.exit_code, done.stderr) == (0, "")
    assert done.stdout.splitlines() == [
        "Slot 5 is stored.",
        "Slot 7 is stored.",
        "2 of 2 groups are stored.",
    ]
    assert board.stored == [(5, 0), (5, 1), (7, 0)]
    assert run("download", f"7={bow}", "--url", served.url).stdout.endswith("\n1 of 1 group is stored.\n")
    job = json.loads(run("download", f"5={wave}", "--url", served.url, "--json").stdout)
    assert (job["status"], job["name"]) == ("done", "wave")


@pytest.mark.exhaustive
def test_it_may_continue_without_the_command(served: Served, board: Board, tmp_path: Path) -> None:
    wave = file_in(tmp_path, "wave.json", {"frames": FRAMES * 20})
    begun = run("download", f"5={wave}", "--no-wait", "--url", served.url)
    assert begun.exit_code == 0
    assert begun.stdout.startswith("Begun: job ")
    assert begun.stdout.endswith(", 1 group, 40 frames.\n")
    second = run("download", f"6={wave}", "--url", served.url)
    assert (second.exit_code, "(busy)" in second.stderr) == (FAILURE, True)
    assert run("stop", "--url", served.url).exit_code == 0
    assert {slot for slot, _ in board.stored} <= {5}


@pytest.mark.exhaustive
def test_what_one_request_does_not_take_goes_in_several_as_one_job(
    served: Served, board: Board, tmp_path: Path
) -> None:
    frame = {"durationMs": 400, "positions": {str(servo): 1500 for servo in range(1, 33)}}
    long = file_in(tmp_path, "long.json", {"frames": [frame] * 255})
    slots = range(5)
    files = [f"{slot}={long}" for slot in slots]
    begun = run("download", *files, "--no-wait", "--url", served.url, "--json")
    assert (begun.exit_code, begun.stderr) == (0, "")
    job = json.loads(begun.stdout)
    assert (job["slots"], job["frameCount"]) == (list(slots), 5 * 255)
    assert run("stop", "--url", served.url).exit_code == 0


@pytest.mark.exhaustive
def test_an_early_end_is_reported_with_the_stored_groups(
    served: Served, board: Board, tmp_path: Path
) -> None:
    wave = file_in(tmp_path, "wave.json", {"frames": FRAMES})
    board.silent_after = 3
    stopping = threading.Thread(target=lambda: httpx2.post(f"{served.url}/api/stop", json={}))
    board.silent = stopping.start
    ended = run("download", f"5={wave}", f"7={wave}", "--url", served.url)
    stopping.join()
    assert (ended.exit_code, ended.stderr) == (FAILURE, "")
    assert ended.stdout.splitlines()[0] == "Slot 5 is stored."
    assert ended.stdout.splitlines()[-1].startswith("1 of 2 groups are stored. STOP ended")


def test_what_a_group_has_not_and_what_is_given_twice_is_refused_by_name(tmp_path: Path) -> None:
    frames = '"frames": [{"durationMs": 500, "positions": {"1": 1500, "1": 900}}]'
    for text, why in (
        (f"{{{frames}}}", "has 1 twice"),
        ('{"frames": [], "times": 3}', "has times, which a group has not"),
        ('{"frames": [], "units": "deg"}', "has units, which a group has not"),
    ):
        file = tmp_path / "wave.json"
        file.write_text(text)
        for command in (["download", f"5={file}"], ["play", str(file)]):
            refused = run(*command, "--url", "http://127.0.0.1:9")
            assert (refused.exit_code, why in refused.stderr) == (USAGE, True), refused.stderr


@pytest.mark.parametrize(
    ("argument", "text"),
    [
        ("wave.json", "{}"),
        ("x=wave.json", "{}"),
        ("5=other.json", "{}"),
        ("5=wave.json", "{"),
        ("5=wave.json", "[]"),
        ("5=wave.json", '{"format": "servodeck-group", "frames": []}'),
    ],
)
def test_an_invalid_group_is_explained_before_any_request(
    argument: str, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    file_in(tmp_path, "wave.json", text)
    refused = run("download", argument, "--url", "http://127.0.0.1:9")
    assert (refused.exit_code, refused.stdout) == (USAGE, "")
    assert refused.stderr.strip()
