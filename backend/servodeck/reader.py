"""Gets bytes from an open port onto the event loop, on the way that suits the platform.

Knows a port and a loop, no packet. Two ways behind one call: watch the descriptor (POSIX: half the CPU of a
thread) or a thread that waits in `read` (everywhere).
"""

import asyncio
import threading
from collections.abc import Callable

from servodeck.errors import PortLostError
from servodeck.ports import OpenPort

Received = Callable[[bytes], None]
Lost = Callable[[PortLostError], None]
Stop = Callable[[], None]


def start_reading(port: OpenPort, received: Received, lost: Lost) -> Stop:
    """Calls `received` for all that comes and `lost` once at most; neither after the returned function was
    called.
    """
    descriptor = port.fileno()
    if descriptor is None:
        return read_in_thread(port, received, lost)
    return watch(descriptor, port, received, lost)


def watch(descriptor: int, port: OpenPort, received: Received, lost: Lost) -> Stop:
    loop = asyncio.get_running_loop()

    def on_readable() -> None:
        try:
            data = port.read_now()
        except PortLostError as error:
            loop.remove_reader(descriptor)  # a port that hung up stays readable for ever
            lost(error)
        else:
            received(data)

    loop.add_reader(descriptor, on_readable)
    return lambda: void(loop.remove_reader(descriptor))


def read_in_thread(port: OpenPort, received: Received, lost: Lost) -> Stop:
    loop = asyncio.get_running_loop()
    stopped = threading.Event()

    def on_loop(call: Callable[[], None]) -> None:
        if not loop.is_closed():
            loop.call_soon_threadsafe(lambda: None if stopped.is_set() else call())

    def run() -> None:
        while not stopped.is_set():
            try:
                data = port.read()
            except PortLostError as error:
                return on_loop(lambda error=error: lost(error))
            if data:
                on_loop(lambda data=data: received(data))
        return None

    threading.Thread(target=run, name="serial reader", daemon=True).start()
    return stopped.set


def void(_result: object) -> None:
    """Drops a result where a callback must have none."""
