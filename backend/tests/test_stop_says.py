"""What STOP says at each door of the gateway, against what the simulated board does: over generated
histories, "all is held" means that no pulse changes later than 150 ms after the last byte, and what is named
is all that moves, for no longer than is said. The page's session does the same:
shared/src/robot/stopSays.test.ts.
"""

import json
import random
from typing import Any

import pytest

from servodeck.protocol.timings import ESTIMATE, MOVE
from servodeck.snapshots import UnheldServos
from tests.amount import named, seeds
from tests.lockstep import SERVOS, Simulator
from tests.stop_under_test import DOORS, Outcome, stopped
from tests.vectors import load_vectors

CASES = load_vectors("stops")
BOARDS = ["doc", "openarm-old", "openarm-new", "lsc-6", "bus-ctrl", "xarm", "learm-esp32", "learm-esp32-bus"]
HISTORIES = 30
# As many as make hundreds over all boards.
PLAIN_HISTORIES = 40
# A hold of a servo whose position is unknown takes as long as a first move; the last leaves 160 ms behind the
# press.
SLOWEST_HOLD_MS = 1_800
FIRST_MOVE_MS = MOVE.first_ms
# Least share: without it, "may move on" for ever would be right.
LEAST_HELD = 0.2

pytestmark = [
    pytest.mark.slow,
]


def own_seed(board: str, seed: int) -> int:
    """One seed draws much the same for every board: each board gets seeds of its own."""
    return seed * len(BOARDS) + BOARDS.index(board)


@pytest.mark.parametrize("board", BOARDS)
def test_the_robot_does_what_stop_says(simulator: Simulator, board: str) -> None:
    outcomes: list[Outcome] = []
    for seed in seeds(1):
        drawn = own_seed(board, seed)
        doors = random.Random(drawn)
        for history in simulator.draw(board, drawn, HISTORIES):
            door = doors.choice(sorted(DOORS))
            with named("test_stop_says.py", seed, f"{board} at {door}: {json.dumps(history)}"):
                outcomes.append(stopped(simulator, board, history, door))
                assert outcomes[-1].broken() == []
    said = [outcome.said[0] for outcome in outcomes if outcome.said]
    assert sum(one.unheld is None for one in said) >= LEAST_HELD * len(said)
    assert any(outcome.moved_on for outcome in outcomes if outcome.said)


def too_much(history: dict[str, Any], unheld: UnheldServos | None) -> list[str]:
    """What is named though nothing that the history knows can move it, or can move it that long."""
    if unheld is None:
        return []
    if unheld.servos is None or unheld.for_ms is None:
        return ["any servo"]
    steps = history["steps"]
    is_run = any(step["kind"] == "run" for step in steps)
    moves = [step for step in steps if step["kind"] == "move"]
    asked = [*moves, *(history["known"] if is_run else [])]
    movable = {*SERVOS[:2], *(target["servo"] for each in asked for target in each["targets"])}
    is_deaf = any(step["kind"] == "read" for step in steps)
    longest_ms = max([FIRST_MOVE_MS, *(each["durationMs"] for each in asked)])
    limit_ms = longest_ms + SLOWEST_HOLD_MS + (ESTIMATE.longest_deafness_ms if is_deaf else 0)
    named_too = [f"servo {servo} was not asked to move" for servo in unheld.servos if servo not in movable]
    too_long = [f"for {unheld.for_ms} ms, longest {limit_ms}"] if unheld.for_ms > limit_ms else []
    return named_too + too_long


@pytest.mark.parametrize("board", BOARDS)
def test_it_names_no_more_than_what_may_move(simulator: Simulator, board: str) -> None:
    """Where all that moves the robot is known."""
    for seed in seeds(1):
        drawn = own_seed(board, seed)
        doors = random.Random(drawn)
        for history in simulator.draw(board, drawn, PLAIN_HISTORIES, "plain"):
            door = doors.choice(sorted(DOORS))
            with named("test_stop_says.py", seed, f"{board} at {door}: {json.dumps(history)}"):
                outcome = stopped(simulator, board, history, door)
                assert [wrong for said in outcome.said for wrong in too_much(history, said.unheld)] == []
                assert outcome.broken() == []


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_where_it_did_not(simulator: Simulator, case: dict[str, Any], door: str) -> None:
    for board in case["boards"]:
        assert stopped(simulator, board, case["history"], door).broken() == [], board
