"""A serial port whose other end is the test: records what was written and when; the test has it send bytes or
get lost.
"""

import asyncio
import socket
from collections.abc import Awaitable, Callable

from servodeck.errors import PortError, PortLostError, PortMissingError
from servodeck.port.diagnosis import Heard
from servodeck.port.hid import HidPort
from servodeck.port.ports import OpenPort
from servodeck.port.whereabouts import UsbDevice
from servodeck.protocol import timings
from servodeck.protocol.decoder import COMMAND_AT, LONGEST_PACKET
from servodeck.protocol.families import Withheld
from servodeck.protocol.packets import DOWNLOAD, RUN

STOP = bytes.fromhex("55550207")
# Behind the row of stops that ends what others left on the line.
STOPS_AT_OPENING = 3
# While motion is latched, a board that confirms nothing is told again so long behind the last packet.
REMINDED_S = (1.0, 1.05)
# From the last piece of a row to the one stop that is left of it: the piece's time on the wire, and a gap.
ROW_END_S = 0.11
WHOLE_PIECES = 6


def is_row(data: bytes) -> bool:
    """Stop packets back to back."""
    return len(data) > len(STOP) and data == STOP * (len(data) // len(STOP))


def is_reminder(after_s: float) -> bool:
    return REMINDED_S[0] <= after_s <= REMINDED_S[1]


class FakePort:
    """Bytes to us come through a real socket pair, so that the event loop sees them as it sees a port's.
    `written` begins with the last stop of the opening, where it is no return; what left before is in
    `opening`. Stops in a row, and those that are said again while motion is latched, are in `rows` alone.
    """

    longest_packet = LONGEST_PACKET
    shortest_s = 0.0
    in_reports = False
    withheld: frozenset[Withheld] = frozenset()
    is_return = False

    def __init__(self) -> None:
        self._ours, self._boards = socket.socketpair()
        self.opening: list[tuple[float, bytes]] = []
        self.rows: list[tuple[float, bytes]] = []
        self.written: list[tuple[float, bytes]] = []
        self.refuses_writes = False
        self.is_open = True
        self._wrote = asyncio.Event()

    def fileno(self) -> int | None:
        return self._ours.fileno()

    def read(self) -> bytes:
        return self.read_now()

    def read_now(self) -> bytes:
        data = self._ours.recv(4096)
        if not data:
            raise PortLostError("The board is gone.")
        return data

    def write(self, data: bytes) -> Awaitable[None] | None:
        if self.refuses_writes:
            raise PortLostError("The board takes nothing.")
        now = asyncio.get_running_loop().time()
        is_opening = (self.rows or self.in_reports) and not (self.written or self.is_return)
        if is_opening and data == STOP and len(self.opening) < STOPS_AT_OPENING - 1:
            self.opening.append((now, data))
        elif is_row(data) or (data == STOP and self.rows and self._goes_on(now)):
            self.rows.append((now, data))
        else:
            self.written.append((now, data))
            self._wrote.set()
        return None

    def _goes_on(self, now: float) -> bool:
        """The end of a row that is no whole number of its pieces, or a stop that is said again."""
        last_s, last = max((*self.rows[-1:], *self.written[-1:]))
        pieces = [len(row) for _, row in self.rows[-WHOLE_PIECES:]]
        if is_row(last) and now - last_s < ROW_END_S:
            return pieces == [timings.STOP.stray_bytes] * WHOLE_PIECES
        is_latched = len(self.rows) > 1 or self.is_return
        return is_latched and last[COMMAND_AT] not in (RUN, DOWNLOAD) and is_reminder(now - last_s)

    def close(self) -> None:
        self.is_open = False
        self._ours.close()
        self._boards.close()

    def say(self, data: bytes) -> None:
        self._boards.sendall(data)

    def unplug(self) -> None:
        self._boards.shutdown(socket.SHUT_RDWR)

    async def until_written(self, count: int) -> None:
        """Until that many packets were written since the port opened."""
        while len(self.written) < count:
            self._wrote.clear()
            await self._wrote.wait()

    def everything(self) -> list[tuple[float, bytes]]:
        """In the order in which it was written."""
        return sorted((*self.opening, *self.rows, *self.written))

    def packets(self) -> list[bytes]:
        return [packet for _, packet in self.written]

    def times_ms(self) -> list[float]:
        """When each packet's first byte was written."""
        return [round(at_s * 1000, 3) for at_s, _ in self.written]


class FakeHidPort(FakePort):
    """A cable with reports: what the board says comes padded, and it takes its time to take a packet."""

    longest_packet = HidPort.longest_packet
    shortest_s = HidPort.shortest_s
    in_reports = True
    withheld = HidPort.withheld
    takes_s = 0.0

    def read_now(self) -> bytes:
        return self._ours.recv(self.longest_packet)

    def write(self, data: bytes) -> Awaitable[None]:
        super().write(data)
        return asyncio.sleep(self.takes_s)

    def say(self, data: bytes) -> None:
        super().say(data.ljust(self.longest_packet, b"\0"))


class FakePorts:
    """Opens with the given outcomes, one after the other; the last one repeats."""

    at_other_rates: tuple[int, Heard] | PortError | None = None
    """What listening there finds, after five seconds."""

    def __init__(self, *outcomes: PortError | FakePort) -> None:
        self._outcomes = list(outcomes)
        self._was_opened = False
        self.attempts: list[tuple[float, str]] = []
        self.listened: list[str] = []

    async def open(self, device: str) -> FakePort:
        self.attempts.append((round(asyncio.get_running_loop().time(), 3), device))
        outcome = self._outcomes.pop(0) if len(self._outcomes) > 1 else self._outcomes[0]
        if isinstance(outcome, PortError):
            raise outcome
        outcome.is_return, self._was_opened = self._was_opened, True
        return outcome

    async def close(self, port: OpenPort) -> None:
        port.close()

    async def list_usb(self) -> list[UsbDevice]:
        return []

    async def find_rate(self, device: str) -> tuple[int, Heard] | None:
        self.listened.append(device)
        await asyncio.sleep(5)
        if isinstance(self.at_other_rates, PortError):
            raise self.at_other_rates
        return self.at_other_rates


class FakeBus:
    """Ports of devices that are plugged in and pulled, each under the name that it has at the moment."""

    def __init__(self, *plugged: UsbDevice) -> None:
        self.plugged = list(plugged)
        self.opened: list[UsbDevice] = []
        self.when_opened: Callable[[], object] = lambda: None
        self._ports: list[FakePort] = []

    async def open(self, device: str) -> FakePort:
        found = next((one for one in self.plugged if one.path == device), None)
        if found is None:
            raise PortMissingError(f"There is no {device}.")
        self.opened.append(found)
        self._ports.append(FakePort())
        self.when_opened()
        return self._ports[-1]

    async def close(self, port: OpenPort) -> None:
        port.close()

    async def list_usb(self) -> list[UsbDevice]:
        return list(self.plugged)

    async def find_rate(self, device: str) -> None:
        """Nothing that can be read arrives there."""

    def replug(self, *plugged: UsbDevice) -> None:
        """Another set of devices; the port that was open is gone."""
        self.plugged = list(plugged)
        self._ports[-1].unplug()

    @property
    def open_ports(self) -> int:
        return sum(port.is_open for port in self._ports)
