"""The seat of a script: who asks by requests that come one by one, and which of them are under way.

Knows seats and tasks; not what a request does.
"""

import asyncio
from collections.abc import Coroutine
from typing import Any, TypeVar

from servodeck.access.hub import Seat
from servodeck.errors import CancelledError

T = TypeVar("T")


class ScriptSeat(Seat):
    """Nobody is there to be told anything."""

    def put(self, text: str) -> None:
        """Unread."""

    async def do(self, work: Coroutine[Any, Any, T]) -> T:
        """What `work` gives or raises; CancelledError where this seat ended before."""
        try:
            return await self.begin(work)
        except asyncio.CancelledError:
            if self.farewell:
                raise CancelledError(self.farewell.reason) from None
            raise

    async def end_pending(self) -> None:
        """Returns when nothing of it is under way any more."""
        if pending := self.drop_pending():
            await asyncio.wait(pending)
