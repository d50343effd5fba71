"""Ends what expired tokens hold at the instant of their expiry, as a revocation does.

Knows the list of devices and how one is disconnected; no request. The clock of the list may jump, so it is
looked at again every second while a token waits for its expiry.
"""

import asyncio
import contextlib
from typing import Protocol

from servodeck.access.audit import Audit
from servodeck.access.devices import EXPIRED, Device, Devices
from servodeck.callers import SHORTEST_WAIT_S
from servodeck.errors import StorageError

LOOK_S = 1.0


class Disconnect(Protocol):
    async def __call__(self, caller_id: str, reason: str, by: str) -> None: ...


class Expiry:
    def __init__(self, devices: Devices, disconnect: Disconnect, audit: Audit) -> None:
        self._devices = devices
        self._audit = audit
        self._disconnect = disconnect
        self._timer: asyncio.TimerHandle | None = None
        self._ending: set[asyncio.Task[None]] = set()

    def plan(self) -> None:
        """Called at the start, and when a token was made."""
        if self._timer:
            self._timer.cancel()
        left_ms = self._devices.next_expiry_ms
        if left_ms is None:
            self._timer = None
            return
        delay_s = min(max(SHORTEST_WAIT_S, left_ms / 1000), LOOK_S)
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._look)

    def end(self) -> None:
        if self._timer:
            self._timer.cancel()

    def _look(self) -> None:
        over = self._devices.expire()
        self.plan()
        if over:
            task = asyncio.create_task(self._end(over))
            self._ending.add(task)
            task.add_done_callback(self._ending.discard)

    async def _end(self, over: list[Device]) -> None:
        for device in over:
            self._audit.note("tokenExpired", None, whom=device.name)
            await self._disconnect(device.id, EXPIRED, f"{device.name} (token expired)")
        with contextlib.suppress(StorageError):  # its time is stored already
            await self._devices.save()
