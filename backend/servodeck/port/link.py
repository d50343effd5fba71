"""Keeps one serial port open: opens it, waits for its loss, tries again with growing pauses, publishes its
state.

Knows ports and time, no packet and no client. It never changes the device by itself: it follows the chosen
device to another name, and never opens another device under the old name.
"""

import asyncio
import contextlib
import logging
from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from typing import Any, Protocol

from servodeck.errors import (
    CancelledError,
    ClosedError,
    NotOnThisCableError,
    NotSupportedError,
    PortBusyError,
    PortError,
    PortLostError,
)
from servodeck.port.bluetooth import this_computer
from servodeck.port.diagnosis import Heard, find_rate, has_rates
from servodeck.port.ports import OpenPort, list_usb, open_port
from servodeck.port.whereabouts import UsbDevice, Whereabouts, is_bluetooth
from servodeck.port.wire import Wire, fail, settle
from servodeck.protocol.decoder import LONGEST_PACKET
from servodeck.protocol.families import Withheld
from servodeck.protocol.packets import CommandPacket
from servodeck.protocol.timings import LINE
from servodeck.snapshots import PortState
from servodeck.threads import in_thread

RETRIES_S = tuple(ms / 1000 for ms in LINE.reconnect_ms)
STEADY_S = 5.0  # a port that stayed open that long was no false start: begin with short pauses again

CLOSED = PortState(device=None, status="closed")
log = logging.getLogger("servodeck.port")


class Ports(Protocol):
    async def open(self, device: str) -> OpenPort: ...

    async def close(self, port: OpenPort) -> None: ...

    async def list_usb(self) -> list[UsbDevice]:
        """What is on the bus now. Never raises."""

    async def find_rate(self, device: str) -> tuple[int, Heard] | None:
        """As in diagnosis.py."""


class LinkEvents(Protocol):
    def port_opened(self, wire: Wire) -> asyncio.Task[None] | None:
        """Before anything else is sent on that wire. Done when what is sent at first has left."""

    def port_lost(self, unfinished: CommandPacket | None) -> None:
        """It was open and was lost; that packet was on its way."""

    def port_changed(self) -> None:
        """`state` has changed."""


@dataclass(slots=True)
class BackOff:
    """The pauses between attempts: the last one repeats."""

    attempts: int = 0

    @property
    def next_s(self) -> float:
        return RETRIES_S[min(self.attempts, len(RETRIES_S) - 1)]

    def take(self) -> float:
        pause_s = self.next_s
        self.attempts += 1
        return pause_s


class Link:
    def __init__(
        self,
        ports: Ports,
        make_wire: Callable[[OpenPort], Wire],
        events: LinkEvents,
        now: Callable[[], float],
    ) -> None:
        self._ports = ports
        self._make_wire = make_wire
        self._events = events
        self._now = now
        self._wire: Wire | None = None
        self._whereabouts: Whereabouts | None = None
        self._task: asyncio.Task[None] | None = None
        self._changing = asyncio.Lock()
        self.state = CLOSED

    @property
    def place(self) -> str:
        """The key under which the board on it is remembered."""
        return self._whereabouts.lasting if self._whereabouts else ""

    @property
    def longest_packet(self) -> int:
        """In bytes, of the port that is open."""
        return self._wire.longest_packet if self._wire else LONGEST_PACKET

    @property
    def withheld(self) -> frozenset[Withheld]:
        """Commands that the open port does not carry."""
        return self._wire.withheld if self._wire else frozenset()

    def judge_carried(self, kind: Withheld) -> None:
        """Raises NotOnThisCableError where no hardware has confirmed how the cable carries it."""
        if kind in self.withheld:
            raise NotOnThisCableError(
                f"The board's own USB cable carries no {kind} yet: no hardware has confirmed how. "
                "Use its serial header with an adapter, or Bluetooth."
            )

    def wire(self) -> Wire:
        """The open wire. Raises the reason why there is none."""
        if self._wire:
            return self._wire
        if self.state.status == "lost":
            raise PortLostError(self.state.detail or "The serial port is lost.")
        raise ClosedError("No serial port is open.")

    async def use(self, device: str) -> None:
        """Changes to that device; returns when the stops have left that an opening begins with. Raises the
        PortError of the first attempt; later attempts continue all the same.
        """
        first: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        whereabouts = Whereabouts(device)
        await self._begin(device, whereabouts, first, lambda: self._keep_open(whereabouts, first))
        await first

    async def find_rate(self) -> tuple[int, Heard] | None:
        """Gives up the serial port in use, listens on it at other speeds, and opens it again. Raises a
        PortError, or ClosedError where none is in use.
        """
        device, whereabouts = self.state.device, self._whereabouts
        if device is None or whereabouts is None:
            raise ClosedError("No serial port is in use.")
        if not has_rates(device):
            raise NotSupportedError(f"Only a serial port of this computer has other speeds, not {device}.")
        found: asyncio.Future[tuple[int, Heard] | None] = asyncio.get_running_loop().create_future()

        async def listen() -> None:
            try:
                found.set_result(await self._ports.find_rate(device))
            except PortError as error:
                fail(found, error)
            await self._keep_open(whereabouts, asyncio.get_running_loop().create_future())

        await self._begin(device, whereabouts, found, listen)
        return await found

    async def _begin(
        self,
        device: str,
        whereabouts: Whereabouts,
        outcome: asyncio.Future[Any],
        work: Callable[[], Coroutine[Any, Any, None]],
    ) -> None:
        """`work` in place of what is done with a port so far."""
        async with self._changing:
            await self._end()
            self._whereabouts = whereabouts
            self._show(PortState(device=device, status="opening"))
            self._task = asyncio.create_task(work())
            # Not in the task itself: one that is cancelled before its first step runs no line of its own.
            self._task.add_done_callback(lambda _: fail(outcome, replaced()))

    async def close(self) -> None:
        """Closes the port and stays closed."""
        async with self._changing:
            await self._end()
            self._whereabouts = None
            self._show(CLOSED)

    async def _end(self) -> None:
        task, self._task = self._task, None
        if task:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task

    async def _keep_open(self, whereabouts: Whereabouts, first: asyncio.Future[None]) -> None:
        back_off = BackOff()
        while True:
            try:
                await self._serve(whereabouts, first, back_off)
            except PortError as error:
                self._show_lost(whereabouts.path, error, back_off)
                fail(first, error)
                await asyncio.sleep(back_off.take())

    async def _serve(self, whereabouts: Whereabouts, first: asyncio.Future[None], back_off: BackOff) -> None:
        """One life of the port; ends by the PortError that ended it, or cancelled."""
        port = await self._open(whereabouts)
        opened_at, wire = self._now(), self._make_wire(port)
        try:
            self._wire = wire
            stops = self._events.port_opened(wire)
            self._show(PortState(device=whereabouts.path, status="open"))
            if stops:
                stops.add_done_callback(lambda _: self._settle(first, wire))
            else:
                settle(first)
            await wire.run()
        except PortError as error:
            self._wire = None
            if self._now() - opened_at >= STEADY_S:
                back_off.attempts = 0
            self._events.port_lost(wire.unfinished)
            # Before closing, which may take a while.
            self._show_lost(whereabouts.path, error, back_off)
            whereabouts.note_others(await self._ports.list_usb())
            raise
        finally:
            self._wire = None
            await self._ports.close(port)

    def _settle(self, first: asyncio.Future[None], wire: Wire) -> None:
        if self._wire is wire:
            settle(first)

    async def _open(self, whereabouts: Whereabouts) -> OpenPort:
        """Opens the device, also under a new name; nothing is sent before it is certain to be the same
        one.
        """
        path = whereabouts.find(await self._ports.list_usb() if whereabouts.is_known else ())
        port = await self._ports.open(path)
        try:
            whereabouts.opened(path, await self._ports.list_usb())
        except BaseException:
            await self._ports.close(port)
            raise
        return port

    def _show_lost(self, device: str, error: PortError, back_off: BackOff) -> None:
        retry_in_ms = round(back_off.next_s * 1000)
        self._show(
            PortState(
                device=device,
                status="lost",
                code=error.code,
                detail=error.detail,
                held_by=list(error.held_by) if isinstance(error, PortBusyError) else [],
                retry_in_ms=retry_in_ms,
            )
        )

    def _show(self, state: PortState) -> None:
        if state != self.state:
            log_change(self.state, state)
            self.state = state
            self._events.port_changed()


def log_change(before: PortState, now: PortState) -> None:
    """A repeated failure is logged for debugging only."""
    is_change = (now.status, now.code) != (before.status, before.code)
    level = (logging.WARNING if now.status == "lost" else logging.INFO) if is_change else logging.DEBUG
    facts = {"device": now.device or before.device, "code": now.code, "detail": now.detail}
    log.log(level, "port %s", now.status, extra={"facts": facts})


def replaced() -> CancelledError:
    return CancelledError("The port was closed or changed in the meantime.")


CLOSE_WAIT_S = 1.0


class BackgroundPorts:
    """The ports of this computer, for a link."""

    async def open(self, device: str) -> OpenPort:
        """Raises a PortError. A port that opens after the caller was cancelled is closed again."""
        return await in_thread(lambda: open_any(device), undo=lambda port: port.close())

    async def list_usb(self) -> list[UsbDevice]:
        return await in_thread(list_usb)

    async def find_rate(self, device: str) -> tuple[int, Heard] | None:
        return await in_thread(lambda: find_rate(device))

    async def close(self, port: OpenPort) -> None:
        # Not wait_for: Python 3.11's swallows a cancellation that meets the result, and the link lived on.
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(CLOSE_WAIT_S):
                await in_thread(port.close)


def open_any(device: str) -> OpenPort:
    """By the name's form: Bluetooth, or what pyserial opens."""
    return this_computer().open(device) if is_bluetooth(device) else open_port(device)
