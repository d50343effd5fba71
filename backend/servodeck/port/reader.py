"""From an open port to packets: reads on the event loop, in the way that suits the platform, joins the pieces
of a report that come by radio, and notifies the decoder when the line has been silent.

Either the descriptor is watched (POSIX: half the CPU of a thread) or a thread waits in `read` (everywhere).
Knows a port, a loop and the decoder, no client.
"""

import asyncio
import contextlib
import threading
from collections.abc import Callable
from functools import partial

from servodeck.errors import PortLostError
from servodeck.port.ports import OpenPort
from servodeck.protocol.decoder import Decoder, DecoderEvent, ReportDecoder
from servodeck.protocol.timings import LINE

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

    def stop() -> None:
        loop.remove_reader(descriptor)

    return stop


def read_in_thread(port: OpenPort, received: Received, lost: Lost) -> Stop:
    loop = asyncio.get_running_loop()
    stopped = threading.Event()

    def deliver(call: Callable[[], None]) -> None:
        if not stopped.is_set():
            call()

    def run() -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed: the process is ending
            while not stopped.is_set():
                try:
                    data = port.read()
                except PortLostError as error:
                    loop.call_soon_threadsafe(deliver, partial(lost, error))
                    return
                if data:
                    loop.call_soon_threadsafe(deliver, partial(received, data))

    threading.Thread(target=run, name="serial reader", daemon=True).start()
    return stopped.set


class Gathered:
    """Joins the pieces of what the board sent at once: the decoder takes a long pause for its end. A piece of
    `whole_bytes` may have a next one, within `wait_s`.
    """

    def __init__(self, emit: Received, whole_bytes: int, wait_s: float) -> None:
        self._emit = emit
        self._whole_bytes = whole_bytes
        self._wait_s = wait_s
        self._pieces = b""
        self._timer: asyncio.TimerHandle | None = None

    def add(self, piece: bytes) -> None:
        if self._timer:
            self._timer.cancel()
        self._pieces += piece
        if len(piece) == self._whole_bytes:
            self._timer = asyncio.get_running_loop().call_later(self._wait_s, self._release)
        else:
            self._release()

    def _release(self) -> None:
        pieces, self._pieces = self._pieces, b""
        self._emit(pieces)


PAUSE_S = LINE.pause_ms / 1000
SILENCE_S = LINE.idle_ms / 1000


class Inbox:
    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._decoder = Decoder(emit)
        self._timers: list[asyncio.TimerHandle] = []

    def push(self, data: bytes) -> None:
        self.close()
        self._decoder.push(data)
        loop = asyncio.get_running_loop()
        self._timers = [
            loop.call_later(PAUSE_S, self._decoder.pause),
            loop.call_later(SILENCE_S, self._decoder.idle),
        ]

    def close(self) -> None:
        for timer in self._timers:
            timer.cancel()


def inbox_of(port: OpenPort, emit: Callable[[DecoderEvent], None]) -> Inbox | ReportDecoder:
    return ReportDecoder(emit) if port.in_reports else Inbox(emit)
