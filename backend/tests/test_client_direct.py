"""`servodeck.Robot` straight on a port, without a gateway's server: on the simulated board behind a pty."""

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

from servodeck import AsyncRobot, Robot
from servodeck.errors import LatchedError, NotFoundError, OutOfRangeError, PortMissingError
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, Run, ServoTarget
from tests.samples import STOP
from tests.served_robot import FILE
from tests.test_client import has
from tests.test_with_simulator import Board, board, pytestmark

pytestmark = [*pytestmark]
fixtures = (board,)
XARM = FAMILIES["xarm"]

PROGRAM = """
import sys
from servodeck import Robot
robot = Robot(sys.argv[1], board="doc")
robot.move({1: 2000}, units="board", seconds=20, wait=False)
"""


def moved(time_ms: int, servo: int, position: int, board: str = "doc") -> bytes:
    return encode(Move(time_ms, (ServoTarget(servo, position),)), FAMILIES[board])


def heard(board: Board) -> bytes:
    return bytes(byte for _, byte in board.taken())


def behind(board: Board, packet: bytes) -> bytes:
    """What the board got after it."""
    return heard(board).partition(packet)[2]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    made = tmp_path / "arm.json"
    made.write_text(json.dumps(FILE))
    return made


def test_the_same_methods_and_rules_hold_on_a_port(board: Board, file: Path) -> None:
    with Robot(str(board.link), board="doc", robot=file) as robot:
        with pytest.raises(OutOfRangeError, match="timeMs is 100, allowed 1500"):
            robot.move({"Base": 30}, units="deg", seconds=0.1)
        with pytest.raises(OutOfRangeError, match=r"Base \(servo 1\): position is 2450"):
            robot.move({"Base": 95}, units="deg")
        with pytest.raises(NotFoundError, match="No servo is called Wrist"):
            robot.move({"Wrist": 0}, units="deg")
        robot.move({"Base": 30}, units="deg")
        robot.play([(0.5, {"Base": 20}), (0.2, {"Base": 10})], units="deg")
        assert robot.poses() == {0: "home"}
        assert robot.battery() > 0
        events = robot.events(seconds=5)
        assert next(events).type == "welcome"
        events.close()
        robot.stop()
        with pytest.raises(LatchedError):
            robot.pose("home")
    got = heard(board)
    assert got.startswith(STOP)
    assert got.index(moved(1500, 1, 1800)) < got.index(moved(200, 1, 1600))
    assert STOP in behind(board, moved(200, 1, 1600))


def test_a_group_is_stored_run_by_its_name_and_stopped_at_the_end(board: Board) -> None:
    with Robot(str(board.link), board="doc") as robot:
        wave = [(0.3, {1: 1200}), (0.3, {1: 1800})]
        assert robot.download(5, wave, units="board", name="Wave")["status"] == "done"
        begun_s = time.monotonic()
        robot.run("Wave", times=2)
        assert 1 < time.monotonic() - begun_s < 10
        robot.run("Wave", times=0, wait=False)
    has(lambda: STOP in behind(board, encode(Run(5, 0), FAMILIES["doc"])))


@pytest.mark.exhaustive
@pytest.mark.parametrize("board", ["xarm"], indirect=True)
async def test_asyncio_has_it_too_and_degrees_are_of_the_usual_servos_of_the_board(board: Board) -> None:
    async with AsyncRobot(str(board.link), board="xarm") as robot:
        await robot.move({1: 12}, units="deg")
        async for event in robot.events(seconds=5):
            assert event.data["board"] == "xarm"
            break
    assert moved(1500, 1, XARM.centre + 50, "xarm") in heard(board)


@pytest.mark.exhaustive
def test_a_program_that_ends_without_closing_it_stops_its_robot(board: Board) -> None:
    subprocess.run([sys.executable, "-c", PROGRAM, str(board.link)], check=True, timeout=30)
    has(lambda: STOP in behind(board, moved(20_000, 1, 2000)))


def test_a_port_that_is_not_there_and_a_board_that_is_unknown_are_errors() -> None:
    with pytest.raises(PortMissingError):
        Robot("/dev/none", board="doc")
    with pytest.raises(OutOfRangeError, match="board is arm"):
        Robot("/dev/none", board="arm")
