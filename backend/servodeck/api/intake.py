"""The rate at which one client's messages are acted on: above it the newest message waits and replaces older
ones; far above it the session ends. Stops are taken at once.

Knows time and order; no socket, and no meaning of a message.

"""

import asyncio
from collections.abc import Callable

from servodeck.callers import Caller, Rate
from servodeck.intents import AnyClientMessage, MoveMessage

# Messages a second, and at once. A page sends the newest values every 8 ms during a drag: values that wait
# longer in the page would be older when the wire is free.
DRIVER_RATE = (150.0, 300)
VIEWER_RATE = (2.0, 10)


class Intake:
    def __init__(
        self,
        rate: Rate,
        take: Callable[[AnyClientMessage], None],
        merged: Callable[[AnyClientMessage, AnyClientMessage], AnyClientMessage | None],
        replaced: Callable[[AnyClientMessage], None],
        overrun: Callable[[], None],
    ) -> None:
        """`merged` joins an older and a newer message; None where the newer one replaces the older one."""
        self._rate = rate
        self._take = take
        self._merged = merged
        self._replaced = replaced
        self._overrun = overrun
        self._excess = 0
        self._waiting: AnyClientMessage | None = None
        self._timer: asyncio.TimerHandle | None = None

    def take_at_once(self, message: AnyClientMessage) -> None:
        """The waiting message is dropped."""
        self._replace(None)
        self._take(message)

    def offer(self, message: AnyClientMessage) -> None:
        if self._waiting is None and self._may_take():
            self._take(message)
            return
        if self._waiting is not None:
            self._exceed()
            if together := self._merged(self._waiting, message):
                self._waiting = together
                return
        self._replace(message)

    def count(self) -> bool:
        """Whether the rate allows one more message, which does not wait."""
        if self._may_take():
            return True
        self._exceed()
        return False

    def close(self) -> None:
        if self._timer:
            self._timer.cancel()
        self._waiting = self._timer = None

    def _may_take(self) -> bool:
        """Each message within the rate makes up for one above it."""
        if not self._rate.take():
            return False
        self._excess = max(0, self._excess - 1)
        return True

    def _exceed(self) -> None:
        self._excess += 1
        if self._excess > self._rate.burst:
            self._overrun()

    def _replace(self, message: AnyClientMessage | None) -> None:
        before, self._waiting = self._waiting, message
        if before is not None:
            self._replaced(before)
        if message is not None and self._timer is None:
            self._wait()

    def _wait(self) -> None:
        self._timer = asyncio.get_running_loop().call_later(self._rate.wait_s, self._ready)

    def _ready(self) -> None:
        self._timer = None
        if self._waiting is None:
            return
        if not self._may_take():  # rounding, or an unreadable message took it
            self._wait()
            return
        message, self._waiting = self._waiting, None
        self._take(message)


def rate_of(caller: Caller, now: Callable[[], float]) -> Rate:
    return Rate(*(DRIVER_RATE if caller.may("driver") else VIEWER_RATE), now)


def merged(before: AnyClientMessage, message: AnyClientMessage) -> AnyClientMessage | None:
    """Two moves as one, so that the value of a servo that the newer one does not name is not lost."""
    if not (isinstance(before, MoveMessage) and isinstance(message, MoveMessage)):
        return None
    if before.duration_ms != message.duration_ms:
        return None
    newest = {target.servo: target for target in (*before.targets, *message.targets)}
    return message.model_copy(update={"targets": list(newest.values())})
