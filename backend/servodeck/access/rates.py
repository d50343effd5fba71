"""How fast one may ask over HTTP: each paired device and each token (docs/adr/0013), and all unauthenticated
callers together, who wait in a queue.

Knows who asks and the time; no request. This computer's own page and scripts share one name and are never
counted: a script that runs away would shut the page out. Those who leave give up their place in the queue at
once.
"""

import asyncio
from collections.abc import Callable
from typing import Protocol

from servodeck.access.devices import MAX_DEVICES, Device
from servodeck.callers import Role
from servodeck.errors import TooManyError
from servodeck.rate import Rate


class Connection(Protocol):
    def when_lost(self, lost: Callable[[], None]) -> None:
        """Once, and at once where it is lost already."""


class RequestQueue:
    def __init__(self, rate: Rate) -> None:
        self._rate = rate
        # The one that came first comes first.
        self._waiting: dict[Connection, asyncio.Future[bool]] = {}
        self._timer: asyncio.TimerHandle | None = None

    async def wait(self, connection: Connection) -> bool:
        """In the order in which they came; false where it was lost before."""
        if not self._waiting and self._rate.take():
            return True
        place: asyncio.Future[bool] = asyncio.get_running_loop().create_future()
        self._waiting[connection] = place
        connection.when_lost(lambda: self._give(connection, is_there=False))
        self._call_later()
        return await place

    def _give(self, connection: Connection, *, is_there: bool) -> None:
        place = self._waiting.pop(connection, None)
        if place is not None and not place.done():
            place.set_result(is_there)

    def _call_later(self) -> None:
        if self._waiting and self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(self._rate.wait_s, self._call)

    def _call(self) -> None:
        self._timer = None
        if self._waiting and self._rate.take():
            self._give(next(iter(self._waiting)), is_there=True)
        self._call_later()


# Requests a second, and at once after a rest.
OF_DRIVERS, OF_VIEWERS = (30.0, 60), (2.0, 10)
# A page that opens reads each robot of the library at once: 57 requests were counted with 50 of them.
PAGE_BURST = 200


class Rates:
    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._rates: dict[tuple[str, Role], Rate] = {}

    def take(self, device: Device) -> None:
        """One more request of theirs. Raises TooManyError."""
        rate = self._rate_of(device)
        if not rate.take():
            raise TooManyError(
                f"{device.name} sends too many requests: try again in {rate.wait_s:.1f} s.", rate.wait_s
            )

    def _rate_of(self, device: Device) -> Rate:
        key = device.id, device.role
        if key not in self._rates:
            if len(self._rates) >= 2 * MAX_DEVICES:  # whoever was revoked meanwhile
                del self._rates[next(iter(self._rates))]
            per_second, burst = OF_DRIVERS if device.caller.may("driver") else OF_VIEWERS
            is_page = device.kind == "device"
            self._rates[key] = Rate(per_second, PAGE_BURST if is_page else burst, self._now)
        return self._rates[key]
