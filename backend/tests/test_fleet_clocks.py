"""What is known of another clock after some questions, whichever way the network held them up."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.fleet.clocks import Reading, offset_of

AHEAD_MS = st.floats(-1e7, 1e7)
DELAY_MS = st.floats(0, 1000)
DELAYS = st.lists(st.tuples(DELAY_MS, DELAY_MS), min_size=1, max_size=20)
ROUNDING_MS = 1e-6


def readings(ahead_ms: float, delays: list[tuple[float, float]]) -> list[Reading]:
    """Of a clock so far ahead; each question takes so long to it, and its answer so long back."""
    return [
        Reading(at_ms, at_ms + there_ms + ahead_ms, at_ms + there_ms + back_ms)
        for at_ms, (there_ms, back_ms) in enumerate(delays)
    ]


@given(AHEAD_MS, DELAYS)
def test_the_clock_is_not_further_from_the_offset_than_that_says(
    ahead_ms: float, delays: list[tuple[float, float]]
) -> None:
    offset = offset_of(readings(ahead_ms, delays))
    assert abs(offset.ahead_ms - ahead_ms) <= offset.uncertainty_ms + ROUNDING_MS


@given(AHEAD_MS, DELAYS)
def test_each_question_more_makes_it_surer_or_leaves_it(
    ahead_ms: float, delays: list[tuple[float, float]]
) -> None:
    asked = readings(ahead_ms, delays)
    sure_ms = [offset_of(asked[:count]).uncertainty_ms for count in range(1, len(asked) + 1)]
    assert all(later <= earlier for earlier, later in itertools.pairwise(sure_ms))


def test_a_quick_question_and_a_quick_answer_count_wherever_they_are() -> None:
    offset = offset_of(readings(500.0, [(1.0, 40.0), (40.0, 1.0)]))
    assert (offset.ahead_ms, offset.uncertainty_ms) == (500.0, 1.0)


def test_a_clock_that_drifts_across_the_bounds_is_sure() -> None:
    asked = [Reading(0.0, 100.0, 0.0), Reading(10.0, 110.1, 10.0)]
    offset = offset_of(asked)
    assert offset.ahead_ms == pytest.approx(100.05)
    assert offset.uncertainty_ms == 0.0
