"""By how much another clock is ahead of ours, from readings of it over a network. Knows no network."""

from collections.abc import Sequence

from servodeck.value import value


@value
class Reading:
    """In ms: when it was asked for and when it was heard, by our clock; between them, the other clock."""

    asked_ms: float
    clock_ms: float
    heard_ms: float


@value
class Offset:
    """By how many ms the other clock is ahead, and how far from that it can be."""

    ahead_ms: float
    uncertainty_ms: float


def offset_of(readings: Sequence[Reading]) -> Offset:
    """Each reading was made after it was asked for and before it was heard, and so bounds the offset from
    both sides. The closest bounds may be those of two readings: of one that was asked for quickly, and of one
    that was answered quickly.
    """
    least_ms = max(one.clock_ms - one.heard_ms for one in readings)
    most_ms = min(one.clock_ms - one.asked_ms for one in readings)
    # Clocks that drift may cross the bounds by microseconds.
    return Offset((least_ms + most_ms) / 2, max(0.0, (most_ms - least_ms) / 2))
