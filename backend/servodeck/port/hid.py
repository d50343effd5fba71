"""Boards on their own USB cable, which is HID: which there are, how they are called, one of them as a port.

`hid:SERIAL` names a board for good, `hid` the only one that is there. A report carries one packet, padded
with zeros; twin of frontend/src/robot/links/webHid.ts, and shared/protocol/vectors/hid.json holds both. Knows
no packet's meaning; hid_devices.py knows the systems.
"""

import errno
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final, TypeVar

from servodeck.errors import (
    HidDeniedError,
    OtherDeviceError,
    PortError,
    PortLostError,
    PortMissingError,
)
from servodeck.port import hid_devices
from servodeck.port.hid_devices import HidDevice, OpenDevice
from servodeck.port.whereabouts import SHARED_NUMBERS, UsbDevice, busy
from servodeck.protocol import load_shared
from servodeck.protocol.decoder import HEAD_SIZE, HEADER, LENGTH_AT, Decoder, DecoderEvent, NoiseEvent
from servodeck.protocol.families import Withheld
from servodeck.protocol.timings import HID
from servodeck.value import value

ANY = "hid"
PREFIX = "hid:"
BOARD: Final[dict[str, Any]] = load_shared("usb")["hid"]
VENDOR, PRODUCT = int(BOARD["vendorId"]), int(BOARD["productId"])
UDEV_RULE = str(BOARD["rule"])
UDEV_RULE_FILE = Path(BOARD["ruleFile"])
# By the interpreter: `sudo` finds no program of a virtual environment, be it of pipx or of a checkout.
ALLOW_HID = f"sudo {sys.executable} -m servodeck udev-rule --install"
DENIED = frozenset({errno.EACCES, errno.EPERM})
BUSY = frozenset({errno.EBUSY, errno.EAGAIN, errno.EWOULDBLOCK})

TAKEN_WITHIN_S = HID.send_timeout_ms / 1000

T = TypeVar("T")


@value
class HidBoard:
    name: str
    device: HidDevice

    @property
    def is_likely(self) -> bool:
        return any(name in self.device.product.lower() for name in BOARD["names"])

    @property
    def usb_device(self) -> UsbDevice:
        return UsbDevice(self.name, VENDOR, PRODUCT, self.device.serial, self.device.location)


def is_hid(name: str) -> bool:
    return name == ANY or name.startswith(PREFIX)


def list_boards() -> list[HidBoard]:
    devices = hid_devices.find_devices(VENDOR, PRODUCT)
    numbers = Counter(device.serial for device in devices)
    return [HidBoard(PREFIX + own_name(device, numbers), device) for device in devices]


def own_name(device: HidDevice, numbers: Counter[str]) -> str:
    """Its serial number where that is its own, else its socket, else its node."""
    is_own = device.serial not in SHARED_NUMBERS and numbers[device.serial] == 1
    return device.serial if is_own else device.location or device.node


def find_board(name: str) -> HidBoard:
    """Raises a PortError where it is not there, or where `hid` may be one of several."""
    boards = list_boards()
    if name != ANY:
        found = [board for board in boards if board.name == name]
    else:
        found = [board for board in boards if board.is_likely] or boards
    if len(found) > 1:
        names = ", ".join(board.name for board in found)
        raise OtherDeviceError(f"Several boards are plugged in. Name one of them: {names}.")
    if not found:
        raise PortMissingError(missing(name))
    return found[0]


def missing(name: str) -> str:
    if not hid_devices.IS_LINUX and not hid_devices.has_hidapi():
        return "For a board's own USB cable this system needs hidapi: pip install 'servodeck[hid]'"
    which = "board on its own USB cable" if name == ANY else name
    return f"There is no {which}. Is the cable plugged in and the board switched on?"


def open_board(name: str) -> "HidPort":
    """Raises a PortError with a sentence."""
    board = find_board(name)
    try:
        return HidPort(board.name, hid_devices.open_device(board.device.node))
    except (OSError, ValueError) as error:
        raise explain(board, error) from error


def explain(board: HidBoard, error: Exception) -> PortError:
    number = getattr(error, "errno", None)
    name = f"{board.name} ({board.device.node})"
    if number in DENIED:
        return HidDeniedError(
            f"This account may not open {name}. Allow it once, then plug the cable in again: {ALLOW_HID}"
        )
    if number in BUSY or not hid_devices.IS_LINUX:
        return busy(name, board.device.node, "another Servodeck, the maker's program")
    return PortMissingError(f"{name} cannot be opened. Is the cable plugged in and the board switched on?")


class HidPort:
    """An open board with the face of a serial port."""

    longest_packet = HID.report_bytes
    shortest_s = HID.shortest_ms / 1000
    in_reports = True
    # Commands of their own do these on HID, and only others' programs tell of those (boards.md chapter 6).
    withheld: frozenset[Withheld] = frozenset({"download", "erase"})

    def __init__(self, name: str, device: OpenDevice) -> None:
        self._name = name
        self._device = device

    def fileno(self) -> int | None:
        return self._device.fileno()

    def read(self) -> bytes:
        return self._guarded(self._device.read)

    def read_now(self) -> bytes:
        return self._guarded(self._device.read_now)

    async def write(self, packet: bytes) -> None:
        """In a thread: the system returns when the device has polled for the report, or after seconds."""
        import asyncio  # which a small command does without

        from servodeck.threads import in_thread

        report = report_of(packet)
        try:
            async with asyncio.timeout(TAKEN_WITHIN_S):
                await in_thread(lambda: self._guarded(lambda: self._device.write(report)))
        except TimeoutError:
            raise self._lost() from None

    def close(self) -> None:
        try:
            self._device.close()
        except (OSError, ValueError):
            return  # it is gone; that is what was asked for

    def _guarded(self, action: Callable[[], T]) -> T:
        try:
            return action()
        except (OSError, ValueError) as error:
            raise self._lost() from error

    def _lost(self) -> PortLostError:
        return PortLostError(f"The connection to {self._name} broke off. Is the cable still plugged in?")


def report_of(packet: bytes) -> bytes:
    """The report that carries it. Raises ValueError where it does not fit."""
    if len(packet) > HidPort.longest_packet:
        raise ValueError(f"{len(packet)} bytes do not fit into a report of {HidPort.longest_packet}")
    return packet.ljust(HidPort.longest_packet, b"\0")


def split_report(report: bytes) -> tuple[bytes, bytes]:
    """The packet at the beginning, empty where none is, and what else is in it, without its padding.

    A second packet in the same report is not believed: it may be left over from the report before.
    """
    size = report[LENGTH_AT] + 2 if report[:2] == bytes((HEADER, HEADER)) and len(report) > LENGTH_AT else 0
    is_whole = HEAD_SIZE <= size <= min(len(report), HidPort.longest_packet)
    end = size if is_whole else 0
    return report[:end], report[end:].rstrip(b"\0")


class ReportInbox:
    """Reports in, packets and noise out: each report is complete, so nothing waits for time to pass."""

    def __init__(self, emit: Callable[[DecoderEvent], None]) -> None:
        self._emit = emit
        self._decoder = Decoder(emit)

    def push(self, report: bytes) -> None:
        packet, rest = split_report(report)
        self._decoder.push(packet)
        self._decoder.idle()
        if rest:
            self._emit(NoiseEvent("garbage", rest))

    def close(self) -> None:
        """Nothing is under way."""
