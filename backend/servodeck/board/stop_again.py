"""Has a stop said once more that the board may not have heard: while it works on its flash it keeps one
packet and drops the others (S9, S41, S53), so a group could begin behind three stops.

Knows time; until when the board may be deaf and how it is stopped is told.
"""

import asyncio
from collections.abc import Callable


class StopAgain:
    def __init__(
        self, now: Callable[[], float], deaf_until_s: Callable[[], float], stop: Callable[[], object]
    ) -> None:
        self._now = now
        self._deaf_until_s = deaf_until_s
        self._stop = stop
        self._timer: asyncio.TimerHandle | None = None

    def stopped(self, at_s: float) -> None:
        """A stop leaves; its last bit then."""
        if at_s < self._deaf_until_s():
            self._plan()
        else:
            self.void()

    def heard(self) -> None:
        """The board has said something: it may hear from now on."""
        if self._timer:
            self._plan()

    def void(self) -> None:
        """Something else has begun since, or the board is another one."""
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _plan(self) -> None:
        self.void()
        delay_s = max(0.0, self._deaf_until_s() - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._due)

    def _due(self) -> None:
        self._timer = None
        self._stop()
