"""The beat of the event loop: how late it was lately, and that it goes on at all.

Everything waits for this loop, STOP too, so its delay is the gateway's own health. Knows time, nothing else.
"""

import asyncio
from collections import deque
from collections.abc import Callable

BEAT_S = 0.25
REMEMBERED_S = 15.0


class Pulse:
    def __init__(self, each_beat: Callable[[], None]) -> None:
        self._each_beat = each_beat
        self._delays_s: deque[float] = deque(maxlen=int(REMEMBERED_S / BEAT_S))

    @property
    def worst_s(self) -> float:
        """The longest that something due waited for the loop, of the last quarter of a minute."""
        return max(self._delays_s, default=0.0)

    async def run(self) -> None:
        loop = asyncio.get_running_loop()
        while True:
            due = loop.time() + BEAT_S
            await asyncio.sleep(BEAT_S)
            self._delays_s.append(max(0.0, loop.time() - due))
            self._each_beat()
