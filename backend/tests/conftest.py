"""Properties try the same inputs each time; in `npm run test:all -- --long` new ones, ten times as many.
Simulated boards in virtual time: one process for the tests of a file.
"""

from collections.abc import Iterator

import pytest
from hypothesis import settings

from tests.amount import TIMES
from tests.lockstep import ENTRY, NODE, Simulator

# No deadline: a slow machine is no defect.
settings.register_profile("here", max_examples=100 * TIMES, deadline=None, derandomize=TIMES == 1)
settings.load_profile("here")


@pytest.fixture(scope="module")
def simulator() -> Iterator[Simulator]:
    if NODE is None:
        pytest.skip("Node is not installed")
    if not ENTRY.exists():
        pytest.skip("the simulator is not built: npm run build")
    made = Simulator()
    yield made
    made.end()
