"""What `servodeck doctor` finds on real ports, and what it says to do."""

import os
import subprocess
import sys
import termios
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from servodeck.cli.main import app
from servodeck.port.diagnosis import looks_like
from tests.hid_board import FakeHidraw
from tests.samples import BATTERY_REPORT
from tests.test_ports import Pty
from tests.vectors import load_vectors

pytestmark = pytest.mark.slow

NO_GATEWAY = "http://127.0.0.1:1"


@pytest.fixture
def pty() -> Iterator[Pty]:
    made = Pty()
    yield made
    made.unplug()


def diagnosed(pty: Pty, answer: bytes) -> tuple[int, str]:
    """With a board that sends `answer` once it has been asked for its battery."""
    # Nothing can be read while the other end is closed.
    cable = os.open(pty.device, os.O_RDWR | os.O_NOCTTY)
    board = threading.Thread(target=lambda: os.read(pty.board, 100) and os.write(pty.board, answer))
    board.start()
    result = CliRunner().invoke(app, ["doctor", "--url", NO_GATEWAY, "--port", pty.device])
    board.join()
    os.close(cable)
    return result.exit_code, result.stdout


def test_a_board_that_answers_is_in_order(pty: Pty) -> None:
    code, said = diagnosed(pty, b"\x55\x55\x04\x0f\x38\x1d")
    assert "ms; its battery has 7.48 V" in said
    assert code == 0


@pytest.mark.parametrize(
    ("answer", "advice"),
    [
        (b"rst:0x1 (POWERON_RESET),boot:1", "press K1"),
        (bytes((0, 255, 254, 128, 224, 0, 248, 0)), "another speed"),
        (bytes((0x12, 0x9A, 0x34, 0xD1, 7, 0xC3)), "wiring"),
    ],
)
def test_bytes_that_are_no_packets_are_explained(pty: Pty, answer: bytes, advice: str) -> None:
    code, said = diagnosed(pty, answer)
    assert advice in said
    assert answer.hex(" ") in said
    assert code == 1


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell")
def test_a_port_that_a_program_has_open_names_the_program(pty: Pty) -> None:
    other = subprocess.Popen(["sleep", "60"], stdin=(cable := os.open(pty.device, os.O_RDWR | os.O_NOCTTY)))
    os.close(cable)
    result = CliRunner().invoke(app, ["doctor", "--url", NO_GATEWAY, "--port", pty.device])
    other.kill()
    other.wait()
    assert f"is open in sleep ({other.pid}): close it there." in result.stdout


@pytest.mark.parametrize(
    ("answers", "said"),
    [
        (True, "A board answers on hid:497223563535 (LOBOT, USB cable of the board) after"),
        (False, "switch it on"),
    ],
)
def test_a_board_on_its_own_usb_cable_is_asked_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, answers: bool, said: str
) -> None:
    hidraw = FakeHidraw(tmp_path, monkeypatch)
    board = hidraw.plug()

    def answer() -> None:
        if board.heard() and answers:
            board.say(BATTERY_REPORT)

    answering = threading.Thread(target=answer)
    answering.start()
    result = CliRunner().invoke(app, ["doctor", "--url", NO_GATEWAY, "--port", "hid"])
    answering.join()
    hidraw.unplug_all()
    assert said in result.stdout
    assert "TX" not in result.stdout


def test_without_a_gateway_it_says_how_to_start_one(pty: Pty) -> None:
    _, said = diagnosed(pty, b"")
    assert f"No gateway answers at {NO_GATEWAY}" in said
    assert "Nothing answers on" in said


@pytest.mark.parametrize(
    ("said", "advice"),
    [
        (BATTERY_REPORT, "At 115200 baud packets arrive"),
        pytest.param(b"rst:0x1 (POWERON_RESET)", "At 115200 baud text arrives", marks=pytest.mark.exhaustive),
    ],
)
def test_a_board_at_another_speed_is_found_on_request(pty: Pty, said: bytes, advice: str) -> None:
    cable = os.open(pty.device, os.O_RDWR | os.O_NOCTTY)
    is_done = threading.Event()

    def speak() -> None:
        while not is_done.wait(0.01):
            if termios.tcgetattr(pty.board)[5] == termios.B115200:
                os.write(pty.board, said)
                return

    board = threading.Thread(target=speak)
    board.start()
    result = CliRunner().invoke(app, ["doctor", "--url", NO_GATEWAY, "--port", pty.device, "--rates"])
    is_done.set()
    board.join()
    os.close(cable)
    assert "Nothing answers on" in result.stdout
    assert advice in result.stdout


@pytest.mark.parametrize("case", load_vectors("noise"), ids=lambda case: str(case["name"]))
def test_what_noise_looks_like(case: dict[str, str]) -> None:
    assert looks_like(bytes.fromhex(case["hex"])) == case["kind"]
