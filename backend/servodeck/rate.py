"""So many a second, and a burst after a rest. Knows numbers and time."""

from collections.abc import Callable

# A clock's rounding must not make a timer fire for ever at the same instant.
SHORTEST_WAIT_S = 0.001


class Rate:
    """So many a second, and `burst` at once after a rest."""

    def __init__(self, per_second: float, burst: int, now: Callable[[], float]) -> None:
        self._per_second = per_second
        self.burst = burst
        self._now = now
        self._left = float(burst)
        self._counted_at_s = now()

    def take(self) -> bool:
        self._count()
        if self._left < 1:
            return False
        self._left -= 1
        return True

    @property
    def wait_s(self) -> float:
        """Until one more may be taken."""
        self._count()
        return max(SHORTEST_WAIT_S, (1 - self._left) / self._per_second)

    def _count(self) -> None:
        now_s = self._now()
        self._left = min(self.burst, self._left + (now_s - self._counted_at_s) * self._per_second)
        self._counted_at_s = now_s
