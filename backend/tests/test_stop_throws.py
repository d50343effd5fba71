"""STOP throws no servo at any door of the gateway, at the pulses of the simulated board: it changes no pulse
outside the places between the pulse at the press and the target in travel, whether it says that the servo is
held or not. The page's session does the same: shared/src/robot/stopThrows.test.ts.
"""

import json
import random
import sys
from collections import Counter
from typing import Any

import pytest

from servodeck.protocol.families import FAMILIES
from tests.amount import IS_EXHAUSTIVE, named, seeds
from tests.lockstep import Simulator
from tests.stop_under_test import DOORS, Outcome, stopped
from tests.test_stop_says import BOARDS, own_seed
from tests.vectors import load_vectors

CASES = load_vectors("throws")
HISTORIES = 25
# Of each board; with these all boards together have three thousand each.
SEEDS = 120
# Of each situation, at each board that can be in it.
LEAST_OF_EACH = 100
SITUATIONS = {
    "unknown run",
    "after an unknown run",
    "first move",
    "two movers",
    "lost port",
    "noise",
    "unseen restart",
}
# A simulated LSC gives a servo no pulse before its first move, which is over at once.
NEVER_IN = {"lsc-6": {"first move"}}
# Rounded places, and what a servo goes in a tick under the slowest hold: 10 steps of a bus servo.
LIMIT_US, LIMIT_STEPS = 26, 10

pytestmark = [
    pytest.mark.slow,
]


def throws(outcome: Outcome, board: str) -> list[float]:
    position = FAMILIES[board].position
    limit = LIMIT_US if position.max - position.min > 1000 else LIMIT_STEPS
    return [by for by in outcome.thrown_by if by > limit]


@pytest.mark.parametrize("board", BOARDS)
def test_a_stop_throws_no_servo(simulator: Simulator, board: str, capsys: pytest.CaptureFixture[str]) -> None:
    met: Counter[str] = Counter()
    for seed in seeds(SEEDS, 1)[:SEEDS]:  # a long run tries no more
        drawn = own_seed(board, seed)
        doors = random.Random(drawn)
        for history in simulator.draw(board, drawn, HISTORIES, "situation"):
            door = doors.choice(sorted(DOORS))
            with named("test_stop_throws.py", seed, f"{board} at {door}: {json.dumps(history)}"):
                outcome = stopped(simulator, board, history, door)
                met.update(["histories", *outcome.met])
                assert throws(outcome, board) == []
    with capsys.disabled():
        sys.stderr.write(f"\n{board}: STOP met {dict(met)}\n")
    situations = SITUATIONS - NEVER_IN.get(board, set())
    assert not IS_EXHAUSTIVE or min(met[situation] for situation in situations) >= LEAST_OF_EACH


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_a_robot_at_rest_stands_still(simulator: Simulator, case: dict[str, Any], door: str) -> None:
    for board in case["boards"]:
        outcome = stopped(simulator, board, case["history"], door)
        assert throws(outcome, board) == [], board
        assert max(outcome.moved_s) < outcome.due_s, board
