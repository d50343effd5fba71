"""Asks for the battery when a board becomes ready, soon after something has ended, and every few seconds
while nothing moves: on some boards any packet disturbs what runs, and under load the voltage sags anyway. A
board that stayed silent is asked again only by a person. Twin of frontend/src/stores/battery/batteryPoll.ts.

Knows when; not how the battery is asked.
"""

import asyncio
import contextlib
from collections.abc import Awaitable, Callable

from servodeck.errors import GatewayError
from servodeck.protocol.timings import BATTERY


class BatteryPoll:
    def __init__(self, may_ask: Callable[[], bool], ask: Callable[[], Awaitable[object]]) -> None:
        self._may_ask = may_ask
        self._ask = ask
        self._timer: asyncio.TimerHandle | None = None
        self._asking: asyncio.Task[None] | None = None

    def begin(self) -> None:
        """A board is ready."""
        self._tick()

    def end(self) -> None:
        if self._timer:
            self._timer.cancel()
        self._timer = None

    def looked_at(self) -> None:
        """Somebody begins to look on."""
        if self._timer:
            self._tick()

    def has_ended(self) -> None:
        """Something that moved or was being stored."""
        if self._timer:
            self._ask_in(BATTERY.after_run_ms)

    def _ask_in(self, ms: float) -> None:
        self.end()
        self._timer = asyncio.get_running_loop().call_later(ms / 1000, self._tick)

    def _tick(self) -> None:
        self._ask_in(BATTERY.every_ms)
        if self._may_ask():
            self._asking = asyncio.create_task(self._read())

    async def _read(self) -> None:
        with contextlib.suppress(GatewayError):  # what the board did not say is counted where it is asked
            await self._ask()
