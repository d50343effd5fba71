"""Opens and closes ports off the event loop.

Opening can take seconds (a network address that does not answer), closing too (a driver that waits for its
last bytes). Knows no packet and keeps no state.
"""

import asyncio
import contextlib

from servodeck.port.ports import OpenPort, list_usb, open_port
from servodeck.port.whereabouts import UsbDevice
from servodeck.threads import in_thread

CLOSE_WAIT_S = 1.0


class BackgroundPorts:
    """The ports of this computer, for a link."""

    async def open(self, device: str) -> OpenPort:
        """Raises a PortError. A port that opens after the caller was cancelled is closed again."""
        return await in_thread(lambda: open_port(device), undo=lambda port: port.close())

    async def list_usb(self) -> list[UsbDevice]:
        return await in_thread(list_usb)

    async def close(self, port: OpenPort) -> None:
        # Not wait_for: Python 3.11's swallows a cancellation that meets the result, and the link lived on.
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(CLOSE_WAIT_S):
                await in_thread(port.close)
