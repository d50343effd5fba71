"""Runs the gateway on a socket until it is requested to end, and ends it in order: the robot first, then the
clients.

Knows uvicorn and signals, no message and no packet.
"""

import asyncio
import contextlib
import logging
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any

import uvicorn

from servodeck import __version__
from servodeck.access.connections import (
    IDLE_S,
    PING_S,
    PONG_S,
    RECEIVED_BYTES,
    ImpatientProtocol,
    State,
)
from servodeck.access.guard import Guard
from servodeck.access.sockets import Socket
from servodeck.api.health import notify_systemd
from servodeck.errors import PortError
from servodeck.protocol.timings import PLAY
from servodeck.robot.control import Control

# Connections that are open then are cut off. Later, uvicorn would cancel their requests and log an error.
LEAVE_S = 1.0
CANCEL_S = 2
END_S = 2.5
FORCED = 1
log = logging.getLogger("servodeck.server")
# SIGHUP: the terminal was closed. SIGBREAK, on Windows: Ctrl-Break.
ENDING = ("SIGINT", "SIGTERM", "SIGQUIT", "SIGHUP", "SIGBREAK")


class Server(uvicorn.Server):
    """Calls `ready` when it answers; at the end stops the robot before it disconnects clients."""

    def __init__(self, app: Guard, control: Control, device: str | None, ready: Callable[[], None]) -> None:
        super().__init__(
            uvicorn.Config(
                app,
                http=ImpatientProtocol,
                ws=Socket,
                ws_ping_interval=PING_S,
                ws_ping_timeout=PONG_S,
                ws_max_size=PLAY.message_bytes,
                timeout_keep_alive=IDLE_S,
                timeout_graceful_shutdown=CANCEL_S,
                log_config=None,  # ours
                log_level="warning",
                access_log=False,
                server_header=False,
                proxy_headers=False,
            )
        )
        self.server_state = State(app.may_upgrade)
        self._control = control
        self._device = device
        self._ready = ready
        self._leave = asyncio.Event()
        self._loop: asyncio.AbstractEventLoop | None = None

    def leave(self) -> None:
        """Begins the end; may be called from any thread and from a signal handler."""
        self.should_exit = True
        if self._loop:
            with contextlib.suppress(RuntimeError):  # the loop is closed: it has ended
                self._loop.call_soon_threadsafe(self._leave.set)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        self._loop = asyncio.get_running_loop()
        self._opening = asyncio.create_task(self._open_port())
        for listener in sockets or ():  # each connection begins with what its listener has
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVED_BYTES)
        await super().startup(sockets)
        if self.started:
            log.info("ready", extra={"facts": {"version": __version__}})
            notify_systemd("READY=1")
            self._ready()

    async def main_loop(self) -> None:
        # uvicorn looks for the end ten times a second only; the robot must not move on that long.
        ticking = asyncio.create_task(super().main_loop())
        leaving = asyncio.create_task(self._leave.wait())
        await asyncio.wait({ticking, leaving}, return_when=asyncio.FIRST_COMPLETED)
        self.should_exit = True
        leaving.cancel()
        ticking.cancel()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        log.info("ending")
        notify_systemd("STOPPING=1")
        self._opening.cancel()
        await self._control.shut_down()
        asyncio.get_running_loop().call_later(LEAVE_S, self._cut_off)
        await super().shutdown(sockets)

    def _cut_off(self) -> None:
        for connection in tuple(self.server_state.connections):
            connection.transport.abort()

    async def _open_port(self) -> None:
        if self._device:
            with contextlib.suppress(PortError):  # the state says so, and the link tries again
                await self._control.use_port(self._device)

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        # Without uvicorn's second raise of the signal: a requested end is a success.
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.signal(number, self._on_signal) for number in ending_signals()}
        has_ended = threading.Event()
        watch_console(self._told_to_end, has_ended)
        try:
            yield
        finally:
            has_ended.set()
            for number, handler in before.items():
                signal.signal(number, handler)

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        """A second signal, or one after the end of stdin, changes nothing: it ends soon, and in order."""
        self._told_to_end()

    def _told_to_end(self) -> None:
        end_for_sure()
        self.leave()


def ending_signals() -> list[signal.Signals]:
    """The signals of this system that request an end. SIGHUP that was ignored at the start stays ignored:
    `nohup` says that the program outlives its terminal.
    """
    known = [signal.Signals[name] for name in ENDING if name in signal.Signals.__members__]
    return [each for each in known if each.name != "SIGHUP" or signal.getsignal(each) is not signal.SIG_IGN]


def ignore_signals() -> None:
    """The process is about to end: the shell of a closed terminal may send its signal again."""
    for number in ending_signals():
        signal.signal(number, signal.SIG_IGN)


# Events of a Windows console behind which the process ends as soon as they are handled: its window was
# closed, the user logs off, the system shuts down. Python makes no signal of them in time.
CONSOLE_CLOSED = (2, 5, 6)


def watch_console(end: Callable[[], None], has_ended: threading.Event) -> None:
    """Calls `end` where a Windows console ends, and keeps the process until the robot is stopped. No other
    system has such events.
    """
    if sys.platform == "win32":
        import ctypes

        handler = ctypes.WINFUNCTYPE(ctypes.c_int, ctypes.c_uint)(console_handler(end, has_ended))
        KEPT.append(handler)
        ctypes.WinDLL("kernel32").SetConsoleCtrlHandler(handler, 1)


KEPT: list[Any] = []
"""Handlers that the system calls, for as long as the process lives."""


def console_handler(end: Callable[[], None], has_ended: threading.Event) -> Callable[[int], bool]:
    """Windows calls it in a thread of its own; False leaves the event to Python, which makes a signal of
    it.
    """

    def handle(event: int) -> bool:
        if event not in CONSOLE_CLOSED:
            return False
        end()
        has_ended.wait(END_S)
        return True

    return handle


def end_for_sure() -> None:
    """Ends the process a while later, even if something blocks it. The robot is stopped long before, and
    saved documents survive.
    """
    last_resort = threading.Timer(END_S, os._exit, (FORCED,))
    last_resort.daemon = True
    last_resort.start()


def leave_with_stdin(leave: Callable[[], None]) -> None:
    """Calls `leave` when the parent process has closed our stdin, or is gone."""

    def wait() -> None:
        with contextlib.suppress(OSError, ValueError):
            while os.read(sys.stdin.fileno(), 4096):
                pass
        end_for_sure()
        leave()

    threading.Thread(target=wait, name="stdin", daemon=True).start()
