"""Opens and closes ports off the event loop, in threads that never keep the process from ending.

Opening can take seconds (a network address that does not answer), closing too (a driver that waits for its
last bytes). Knows no packet and keeps no state.
"""

import asyncio
import contextlib
import threading
from collections.abc import Callable
from functools import partial
from typing import TypeVar

from servodeck.port.ports import OpenPort, list_usb, open_port
from servodeck.port.whereabouts import UsbDevice

CLOSE_WAIT_S = 1.0
T = TypeVar("T")


class BackgroundPorts:
    """The ports of this computer, for a link."""

    async def open(self, device: str) -> OpenPort:
        """Raises a PortError. A port that opens after the caller was cancelled is closed again."""
        return await in_thread(lambda: open_port(device), undo=lambda port: port.close())

    async def list_usb(self) -> list[UsbDevice]:
        return await in_thread(list_usb, undo=lambda _: None)

    async def close(self, port: OpenPort) -> None:
        # Not wait_for: Python 3.11's swallows a cancellation that meets the result, and the link lived on.
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(CLOSE_WAIT_S):
                await in_thread(port.close, undo=lambda _: None)


async def in_thread(action: Callable[[], T], undo: Callable[[T], None]) -> T:
    """What `action`, which may block, gives or raises; `undo` gets the result where nobody waits any more."""
    loop = asyncio.get_running_loop()
    outcome: asyncio.Future[T] = loop.create_future()

    def hand_over(result: T) -> None:
        if outcome.done():
            threading.Thread(target=undo, args=(result,), daemon=True).start()
        else:
            outcome.set_result(result)

    def refuse(error: Exception) -> None:
        if not outcome.done():
            outcome.set_exception(error)

    def run() -> None:
        try:
            told = partial(hand_over, action())
        except Exception as error:  # noqa: BLE001 (whatever it is, somebody waits for it)
            told = partial(refuse, error)
        with contextlib.suppress(RuntimeError):  # the loop is closed: the process is ending
            loop.call_soon_threadsafe(told)

    threading.Thread(target=run, name="serial port", daemon=True).start()
    return await outcome
