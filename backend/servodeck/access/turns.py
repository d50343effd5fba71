"""What the unauthenticated ask waits for its turn: so many requests a second, all of them together. Whoever
leaves gives up their place at once, so that those who come and go fill no memory and cost no work.

Knows a rate and connections, no request.
"""

import asyncio
from collections.abc import Callable
from typing import Protocol

from servodeck.access.intake import Rate


class Connection(Protocol):
    def when_lost(self, lost: Callable[[], None]) -> None:
        """Once, and at once where it is lost already."""


class Turns:
    def __init__(self, rate: Rate) -> None:
        self._rate = rate
        # The one that came first comes first.
        self._waiting: dict[Connection, asyncio.Future[bool]] = {}
        self._timer: asyncio.TimerHandle | None = None

    async def wait(self, connection: Connection) -> bool:
        """In the order in which they came; false where it was lost before."""
        if not self._waiting and self._rate.take():
            return True
        turn: asyncio.Future[bool] = asyncio.get_running_loop().create_future()
        self._waiting[connection] = turn
        connection.when_lost(lambda: self._give(connection, is_there=False))
        self._call_later()
        return await turn

    def _give(self, connection: Connection, *, is_there: bool) -> None:
        turn = self._waiting.pop(connection, None)
        if turn is not None and not turn.done():
            turn.set_result(is_there)

    def _call_later(self) -> None:
        if self._waiting and self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(self._rate.wait_s, self._call)

    def _call(self) -> None:
        self._timer = None
        if self._waiting and self._rate.take():
            self._give(next(iter(self._waiting)), is_there=True)
        self._call_later()
