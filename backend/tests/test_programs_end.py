"""However a program ends that moves a robot, its servo stands within two seconds: real processes, and what
leaves for the board.
"""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.samples import STOP
from tests.scripted import move
from tests.served_robot import Served
from tests.test_client import BoardPort, has, here, port, sent
from tests.test_client_direct import heard, moved
from tests.test_told_to_end import needs_simulator
from tests.test_with_simulator import Board, board

pytestmark = [pytest.mark.slow, pytest.mark.skipif(os.name != "posix", reason="signals need POSIX")]
fixtures = (here, port, board)

SILENT_S = 2.0
# The stop's way through a busy computer.
LATE_S = 0.3
# The first second of ten from 600 to 2400.
PART_MS, PART_TO = 1000, 780
MOVE = 3
PROGRAM = """
import os, sys, threading, time
from servodeck import Robot
where, end, waits = sys.argv[1:4]
robot = Robot(where, board=None if where.startswith("http") else "doc")
robot.move({1: 600}, units="board")
if waits:  # the end comes from elsewhere
    print("begins", flush=True)
    robot.move({1: 2400}, units="board", seconds=10)
robot.move({1: 2400}, units="board", seconds=10, wait=False)
print("moves", flush=True)
time.sleep(1.2)
exec(end)
"""
AWAITS_A_SIGNAL = "time.sleep(60)"
rarely = pytest.mark.exhaustive
ENDS = [
    pytest.param("pass", id="an ordinary end"),
    pytest.param("raise RuntimeError", id="an exception", marks=rarely),
    pytest.param("sys.exit(3)", id="sys.exit", marks=rarely),
    pytest.param("os._exit(3)", id="os._exit"),
]
SIGNALS = [
    ("SIGKILL", True),
    ("SIGTERM", False),
    pytest.param("SIGKILL", False, marks=rarely),
    pytest.param("SIGINT", True, marks=rarely),
]


def program(where: str, end: str, *, waits: bool = False) -> "subprocess.Popen[str]":
    begun = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, where, end, "waits" * waits],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
    )
    assert begun.stdout
    begun.stdout.readline()
    return begun


def ended_s(begun: "subprocess.Popen[str]") -> float:
    begun.wait(15)
    at_s = time.monotonic()
    begun.communicate()
    return at_s


def stands_in_time(port: BoardPort, gone_s: float) -> None:
    """It was held on its way."""
    before = sent(port).index(move(PART_MS, s1=PART_TO))
    has(lambda: sent(port)[before:].count(STOP) >= 3)
    stopped_s = next(at_s for at_s, packet in port.written[before + 2 :] if packet == STOP)
    assert stopped_s <= gone_s + SILENT_S + LATE_S
    behind = sent(port)[before:]
    hold = next(packet for packet in behind[behind.index(STOP) :] if packet[3] == MOVE)
    assert 600 < int.from_bytes(hold[8:10], "little") < 1400


@pytest.mark.parametrize("end", ENDS)
def test_over_http_its_move_ends_with_it(here: Served, port: BoardPort, end: str) -> None:
    stands_in_time(port, ended_s(program(here.url, end)))
    # It said good-bye, or a person has to look.
    assert here.running.control.latch is end.startswith("os._exit")


@pytest.mark.parametrize(("name", "waits"), SIGNALS)
def test_over_http_a_signal_ends_its_move_too(here: Served, port: BoardPort, name: str, waits: bool) -> None:
    begun = program(here.url, AWAITS_A_SIGNAL, waits=waits)
    time.sleep(1.2)
    begun.send_signal(signal.Signals[name])
    stands_in_time(port, ended_s(begun))


def behind_the_move(board: Board) -> bytes:
    """Without its later parts."""
    left = heard(board).partition(moved(PART_MS, 1, PART_TO))[2]
    while left[3:4] == bytes([MOVE]):
        left = left[2 + left[2] :]
    return left


@pytest.mark.parametrize("end", ENDS[:2])
@needs_simulator
def test_on_its_own_port_it_stops_before_it_ends(board: Board, end: str) -> None:
    ended_s(program(str(board.link), end))
    has(lambda: behind_the_move(board).count(STOP) >= 3)
    assert behind_the_move(board).startswith(STOP)


@pytest.mark.parametrize(
    "name", ["SIGTERM", *(pytest.param(name, marks=rarely) for name in ("SIGHUP", "SIGQUIT", "SIGINT"))]
)
@needs_simulator
def test_on_its_own_port_a_signal_stops_first_and_then_has_its_usual_effect(board: Board, name: str) -> None:
    begun = program(str(board.link), AWAITS_A_SIGNAL)
    begun.send_signal(signal.Signals[name])
    ended_s(begun)
    assert behind_the_move(board).count(STOP) >= 3
    assert begun.returncode == -signal.Signals[name]


@needs_simulator
def test_on_its_own_port_a_second_ctrl_c_takes_no_stop_away(board: Board) -> None:
    begun = program(str(board.link), AWAITS_A_SIGNAL)
    for _ in range(2):
        begun.send_signal(signal.SIGINT)
        time.sleep(0.05)  # a person's two presses, of another process
    ended_s(begun)
    assert behind_the_move(board).count(STOP) >= 3


@needs_simulator
def test_a_handler_of_the_program_stays_the_only_one(board: Board) -> None:
    own = "signal.signal(signal.SIGTERM, lambda *_: print('own', flush=True))"
    begun = subprocess.Popen(
        [sys.executable, "-c", f"import signal; {own}\n{PROGRAM}", str(board.link), AWAITS_A_SIGNAL, ""],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
    )
    assert begun.stdout
    begun.stdout.readline()
    begun.terminate()
    assert begun.stdout.readline() == "own\n"
    assert STOP not in behind_the_move(board)
    begun.kill()
    begun.communicate()
