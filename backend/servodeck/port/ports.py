"""Ports of this computer, serial or HID: lists them, opens one, and explains in a sentence why one cannot be
opened.

The only module that imports pyserial, so that another library can take its place. Knows no packet and no
event loop: every call here may block for a moment.
"""

import errno
import os
import re
import select
import socket
from collections.abc import Awaitable, Callable, Iterable
from pathlib import Path
from typing import Any, Final, Protocol, TypeVar

import serial
from serial.tools import list_ports

from servodeck.errors import PortDeniedError, PortError, PortLostError, PortMissingError
from servodeck.port import hid
from servodeck.port.whereabouts import SHARED_NUMBERS, UsbDevice, busy
from servodeck.protocol import load_shared
from servodeck.protocol.decoder import LONGEST_PACKET
from servodeck.protocol.families import Withheld
from servodeck.protocol.timings import LINE
from servodeck.value import value

POSIX = os.name == "posix"
READ_WAIT_S = 0.2
# No port stalls us longer than this. Windows waits for the last bit by itself unless the time-out is 0, and
# POSIX with 0 spins while the buffer is full.
WRITE_WAIT_S = 0.2 if POSIX else 0.0
READ_BYTES = 4096
# On these boards and on their cables, by vendor and product: `1a86:7523` is a CH340.
ADAPTERS: Final[dict[str, str]] = load_shared("usb")["adapters"]
LIKELY_VENDORS = frozenset(int(ids[:4], 16) for ids in ADAPTERS)
URL_SCHEME = "socket://"
LASTING = Path("/dev/serial")
# Ports of one interface share its place on the bus; only the system's name for their socket counts them.
FURTHER_PORT = re.compile(r"-(port[1-9][0-9]*)$")


class OpenPort(Protocol):
    """A port that is open. Every failure of it is a PortLostError."""

    longest_packet: int
    """In bytes."""
    shortest_s: float
    """Every packet takes at least that long."""
    in_reports: bool
    """It reads HID reports, with one packet in each; else bytes in pieces of any size."""
    withheld: frozenset[Withheld]

    def fileno(self) -> int | None:
        """The descriptor to watch for input; None where the platform has none."""

    def read(self) -> bytes:
        """Waits a moment for bytes and returns all there are, possibly none."""

    def read_now(self) -> bytes:
        """The bytes that are there. Only after `fileno` was reported readable."""

    def write(self, data: bytes) -> Awaitable[None] | None:
        """Hands it over; where that takes a while, returns what is done when it has been."""

    def close(self) -> None:
        """Never raises. May take a while."""


T = TypeVar("T")
Opener = Callable[[str], OpenPort]


@value
class PortInfo:
    device: str
    description: str
    likely: bool
    lasting: str | None = None
    """A name that leads to it after every start and replug, where the system keeps one."""


class SerialPort:
    """pyserial, with one exception in place of its many."""

    longest_packet = LONGEST_PACKET
    shortest_s = 0.0
    in_reports = False
    withheld: frozenset[Withheld] = frozenset()

    def __init__(self, device: str, port: serial.Serial) -> None:
        self._device = device
        self._port = port

    def fileno(self) -> int | None:
        return int(self._port.fileno()) if POSIX else None

    def read(self) -> bytes:
        return self._guarded(lambda: self._port.read(1) + self._port.read(self._port.in_waiting))

    def read_now(self) -> bytes:
        data = self._guarded(lambda: os.read(self._port.fileno(), READ_BYTES))
        if not data:
            raise self._lost()  # readable and empty is how a tty and a socket hang up
        return data

    def write(self, data: bytes) -> None:
        self._guarded(lambda: write_all(self._port.fileno(), data) if POSIX else self._port.write(data))

    def close(self) -> None:
        try:
            self._port.close()
        except (serial.SerialException, OSError):
            return  # it is gone, as requested

    def _guarded(self, action: Callable[[], T]) -> T:
        try:
            return action()
        except (serial.SerialException, OSError, TypeError) as error:
            # `in_waiting` of a hung-up pty raises OSError, and pyserial answers TypeError to a read that is
            # under way while another thread closes the port.
            raise self._lost() from error

    def _lost(self) -> PortLostError:
        return PortLostError(f"The connection to {self._device} broke off. Is the cable still plugged in?")


def write_all(descriptor: int, data: bytes) -> None:
    """Unlike pyserial's own, does not take a pause of this process, on a busy or sleeping computer, for a
    full port.
    """
    while data:
        _, ready, _ = select.select((), (descriptor,), (), WRITE_WAIT_S)
        if not ready:
            raise TimeoutError
        data = data[os.write(descriptor, data) :]


def open_port(device: str, baud: int = LINE.baud) -> OpenPort:
    """Opens a device path, `socket://HOST:PORT` or `hid:SERIAL`, for us alone. Raises a PortError with a
    sentence.
    """
    if hid.is_hid(device):
        return hid.open_board(device)
    refuse_other_schemes(device)
    try:
        port = serial.serial_for_url(
            device, baud, timeout=READ_WAIT_S, write_timeout=WRITE_WAIT_S, exclusive=True
        )
        send_at_once(port)
        return SerialPort(device, port)
    except (serial.SerialException, OSError, ValueError) as error:
        raise explain(device, error) from error


def refuse_other_schemes(device: str) -> None:
    """pyserial's other schemes can write files and load modules: not with a name that came from outside."""
    if "://" in device and not device.lower().startswith(URL_SCHEME):
        raise PortMissingError(f"{device} is neither a device nor an address like socket://HOST:PORT.")


def send_at_once(port: Any) -> None:
    """A socket would hold a small packet back until the one before it is acknowledged."""
    connection = getattr(port, "_socket", None)
    if isinstance(connection, socket.socket):
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)


MISSING = frozenset({errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.EIO, errno.ENOTDIR})
BUSY = frozenset({errno.EBUSY, errno.EAGAIN, errno.EWOULDBLOCK})
DENIED = frozenset({errno.EACCES, errno.EPERM})


def explain(device: str, error: Exception) -> PortError:
    """The error's class and the sentence for the person."""
    number = getattr(error, "errno", None)
    if device.lower().startswith(URL_SCHEME):
        return PortMissingError(f"Nothing answers at {device}.")
    # Windows gives no number: the name of the cause stands in the text, and "denied" means that it is in use.
    if number in BUSY or (number is None and "PermissionError" in str(error)):
        return busy(device, device, "another Servodeck, a serial monitor, a browser tab")
    if number in DENIED:
        return PortDeniedError(
            f"This account may not open {device}. On Linux add it to the group: "
            f"sudo usermod -aG {group_of(device)} $USER, then log in again."
        )
    if number in MISSING or (number is None and "FileNotFoundError" in str(error)):
        return PortMissingError(f"There is no {device}. Is the cable plugged in and the board switched on?")
    return PortMissingError(f"{device} is not a serial port.")


def group_of(device: str) -> str:
    """The group that may use the device; most systems call it dialout."""
    try:
        return Path(device).group()
    except (OSError, KeyError, NotImplementedError):
        return "dialout"


def list_devices(*also: str | None) -> list[PortInfo]:
    """All ports of this computer, the likely ones first, and `also` those known by name alone."""
    found = [*map(describe, list_ports.comports()), *map(describe_hid, hid.list_boards())]
    extra = [
        PortInfo(name, "Port at an address" if "://" in name else "Port", likely=True)
        for name in dict.fromkeys(also)
        if name and not any(is_same_port(name, port.device) for port in found)
    ]
    return extra + sorted(found, key=lambda port: (not port.likely, port.device))


def is_same_port(one: str, other: str) -> bool:
    """Under any of its names."""
    if hid.is_hid(one) or hid.is_hid(other):
        return one == other or (hid.ANY in (one, other) and hid.is_hid(one) and hid.is_hid(other))
    return one == other or os.path.realpath(one) == os.path.realpath(other)


def list_usb() -> list[UsbDevice]:
    """The ports on the USB bus, as far as the system tells them apart."""
    serial_ports = [usb_device(port) for port in list_ports.comports() if port.vid is not None]
    return serial_ports + [board.usb_device for board in hid.list_boards()]


def usb_device(port: Any) -> UsbDevice:
    """`port` as in `describe`."""
    device, location = str(port.device), port.location or ""
    further = FURTHER_PORT.search(lasting_name(device, has_number=False) or "")
    if location and further:
        location = f"{location}:{further[1]}"
    return UsbDevice(device, port.vid, port.pid, serial=port.serial_number or "", location=location)


def describe(port: Any) -> PortInfo:
    """`port` is pyserial's ListPortInfo, whose fields its stubs leave half typed."""
    device = str(port.device)
    has_number = (port.serial_number or "") not in SHARED_NUMBERS
    lasting = lasting_name(device, has_number=has_number)
    return PortInfo(device, kind_of(port), likely=port.vid in LIKELY_VENDORS, lasting=lasting)


def kind_of(port: Any) -> str:
    """By its chip, else as it calls itself. Twin of portLabel in frontend/src/robot/links/serialPorts.ts."""
    # pyserial gives the end of the path where a device has no name of its own.
    own_name = "" if port.description in (None, "n/a", port.name) else str(port.description)
    if port.vid is None:
        return own_name or "Serial port"
    ids = f"{port.vid:04x}:{port.pid:04x}"
    chip = ADAPTERS.get(ids)
    return f"{chip} USB serial adapter" if chip else own_name or f"USB serial adapter (id {ids})"


def describe_hid(board: hid.HidBoard) -> PortInfo:
    """Its name is a lasting one."""
    product = board.device.product or "HID device"
    return PortInfo(board.name, f"{product}, USB cable of the board", likely=board.is_likely)


def lasting_of(device: str, found: Iterable[PortInfo]) -> str:
    """A name that leads there after the next start, too, where the system has one."""
    real = os.path.realpath(device)
    return next((port.lasting for port in found if port.device == real and port.lasting), device)


def lasting_name(device: str, *, has_number: bool) -> str | None:
    """By its serial number, which goes with it into another socket; without one by its socket, because such
    adapters share a placeholder.
    """
    kinds = ("by-id", "by-path") if has_number else ("by-path",)
    links = (link for kind in kinds for link in links_in(LASTING / kind))
    return next((str(link) for link in links if os.path.realpath(link) == device), None)


def links_in(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:  # no such folder: another system, or no adapter
        return []
