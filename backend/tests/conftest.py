"""How many inputs a property gets: `npm run test:long` tries ten times as many."""

from hypothesis import settings

from tests.amount import TIMES

# No deadline: a slow machine is no defect.
settings.register_profile("here", max_examples=100 * TIMES, deadline=None)
settings.load_profile("here")
