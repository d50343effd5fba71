"""Properties try the same inputs each time; in `npm run test:all -- --long` new ones, ten times as many."""

from hypothesis import settings

from tests.amount import TIMES

# No deadline: a slow machine is no defect.
settings.register_profile("here", max_examples=100 * TIMES, deadline=None, derandomize=TIMES == 1)
settings.load_profile("here")
