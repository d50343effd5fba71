"""Tells systemd that we are ready, alive and ending, where it started us. Knows its datagrams, nothing else.

By hand, because it is one line of text on a socket; a failure to tell is never ours to fail by.
"""

import contextlib
import os
import socket
from collections.abc import Callable


def tell(state: str) -> None:
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
        return lambda: tell("WATCHDOG=1")
    return lambda: None
