"""What STOP says at each door of the gateway, against what the simulated board does: over generated
histories, "all is held" means that no pulse changes later than 150 ms after the last byte, and what is named
is all that moves, for no longer than is said. The page's session does the same:
shared/src/robot/stopSays.test.ts.
"""

import json
import random
from collections.abc import Iterator
from typing import Any

import pytest

from tests.amount import named, seeds
from tests.lockstep import ENTRY, NODE, Simulator
from tests.stop_under_test import DOORS, Outcome, stopped
from tests.vectors import load_vectors

CASES = load_vectors("stops")
BOARDS = ["doc", "openarm-old", "openarm-new", "lsc-6", "bus-ctrl", "xarm", "learm-esp32", "learm-esp32-bus"]
HISTORIES = 30
# Least share: without it, "may move on" for ever would be right.
LEAST_HELD = 0.2

pytestmark = [
    pytest.mark.skipif(not ENTRY.exists(), reason="the simulator is not built: npm run build"),
    pytest.mark.skipif(NODE is None, reason="Node is not installed"),
]


@pytest.fixture(scope="module")
def simulator() -> Iterator[Simulator]:
    made = Simulator()
    yield made
    made.end()


@pytest.mark.parametrize("board", BOARDS)
def test_the_robot_does_what_stop_says(simulator: Simulator, board: str) -> None:
    outcomes: list[Outcome] = []
    for seed in seeds(1):
        doors = random.Random(seed)
        for history in simulator.draw(board, seed, HISTORIES):
            door = doors.choice(sorted(DOORS))
            with named("test_stop_says.py", seed, f"{board} at {door}: {json.dumps(history)}"):
                outcomes.append(stopped(simulator, board, history, door))
                assert outcomes[-1].broken() == []
    said = [outcome.said[0] for outcome in outcomes if outcome.said]
    assert sum(one.unheld is None for one in said) >= LEAST_HELD * len(said)
    assert any(outcome.moved_on for outcome in outcomes if outcome.said)


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
def test_where_it_did_not(simulator: Simulator, case: dict[str, Any], door: str) -> None:
    for board in case["boards"]:
        assert stopped(simulator, board, case["history"], door).broken() == [], board
