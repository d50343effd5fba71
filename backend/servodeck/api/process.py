"""The process itself: how late its event loop is, its descriptors, and what systemd is told of it.

Everything waits for the event loop, STOP too, so its delay is the gateway's own health. systemd's datagrams
are written by hand, because one is a line of text on a socket. Knows nothing of the robot.
"""

import asyncio
import contextlib
import os
import socket
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


def notify_systemd(state: str) -> None:
    """`READY=1`, `WATCHDOG=1`, `STOPPING=1`."""
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address or not hasattr(socket, "AF_UNIX"):
        return
    if address.startswith("@"):
        address = f"\0{address[1:]}"  # Linux's names without a file
    with contextlib.suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as telling:
        telling.setblocking(False)
        telling.connect(address)
        telling.send(state.encode())


def sign_of_life() -> Callable[[], None]:
    """To be called at each beat of the event loop: systemd starts us anew when it stays away."""
    is_awaited = os.environ.get("WATCHDOG_PID", str(os.getpid())) == str(os.getpid())
    if "WATCHDOG_USEC" in os.environ and is_awaited:
        return lambda: notify_systemd("WATCHDOG=1")
    return lambda: None


# pyserial waits with select(), which takes no descriptor of a higher number.
WANTED = 1024


def allow_descriptors() -> None:
    """As many as are wanted, or as the system lets us have."""
    if os.name != "posix":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = WANTED if hard == resource.RLIM_INFINITY else min(WANTED, hard)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
