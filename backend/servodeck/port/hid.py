"""Boards on their own USB cable, which is HID: the devices as each system offers them, the names of boards,
and one of them as a port.

`hid:SERIAL` names a board for good, `hid` the only one that is there. Linux lists and opens devices by sysfs
and /dev/hidraw with the standard library, other systems by hidapi, which the extra `servodeck[hid]` brings.
A report carries one packet, padded with zeros; twin of frontend/src/robot/links/webHid.ts, and
shared/protocol/vectors/hid.json holds both. Knows no packet's meaning; every call but `write` may block.
"""

import errno
import os
import select
import sys
from collections import Counter
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Protocol, TypeVar

from servodeck.errors import (
    HidDeniedError,
    OtherDeviceError,
    PortError,
    PortLostError,
    PortMissingError,
)
from servodeck.port.whereabouts import SHARED_NUMBERS, UsbDevice, busy
from servodeck.protocol import load_shared
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
SYSFS = Path("/sys/class/hidraw")
DEV = Path("/dev")
USB_BUS = 3
READ_WAIT_S = 0.2
# Report number 0 goes before the bytes: the devices have no numbered reports.
REPORT_NUMBER = b"\0"
IS_LINUX = sys.platform == "linux"

T = TypeVar("T")


@value
class HidDevice:
    """`node` is what opens it; `serial` and `location` (the socket, `1-1.2`) may be empty."""

    node: str
    product: str
    serial: str = ""
    location: str = ""


class OpenDevice(Protocol):
    """Every failure is an OSError or a ValueError."""

    def fileno(self) -> int | None:
        """The descriptor to watch for reports; None where the system has none."""

    def read(self) -> bytes:
        """Waits a moment for a report; empty where none came."""

    def read_now(self) -> bytes:
        """The report that is there. Only after `fileno` was reported readable."""

    def write(self, report: bytes) -> None:
        """Returns when the device has taken it, which may be as late as the system gives it up."""

    def close(self) -> None: ...


class Hidraw:
    """One open node of Linux, for this program alone among those that lock it."""

    def __init__(self, node: str) -> None:
        # Without O_NOCTTY a node that is a terminal, as in tests, would become ours.
        self._descriptor = os.open(node, os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
        import fcntl  # not on Windows

        try:
            fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(self._descriptor)
            raise

    def fileno(self) -> int | None:
        return self._descriptor

    def read(self) -> bytes:
        ready, _, _ = select.select((self._descriptor,), (), (), READ_WAIT_S)
        return self.read_now() if ready else b""

    def read_now(self) -> bytes:
        report = os.read(self._descriptor, HID.report_bytes)
        if not report:
            raise OSError("the device has hung up")
        return report

    def write(self, report: bytes) -> None:
        os.write(self._descriptor, REPORT_NUMBER + report)

    def close(self) -> None:
        os.close(self._descriptor)


def hidraw_devices(vendor: int, product: int) -> list[HidDevice]:
    try:
        nodes = sorted(SYSFS.iterdir())
    except OSError:  # a kernel without HID
        return []
    found = (hidraw_device(node, vendor, product) for node in nodes)
    return [device for device in found if device]


def hidraw_device(node: Path, vendor: int, product: int) -> HidDevice | None:
    """None where it is another one, or goes while it is looked at."""
    try:
        facts = facts_in(node / "device/uevent")
        if facts.get("HID_ID") != f"{USB_BUS:04X}:{vendor:08X}:{product:08X}":
            return None
        # The HID device's parent is the USB interface, and that one's the device in the socket.
        usb = Path(os.path.realpath(node / "device")).parents[1]
        return HidDevice(
            str(DEV / facts_in(node / "uevent")["DEVNAME"]),
            text_in(usb / "product") or facts.get("HID_NAME", ""),
            facts.get("HID_UNIQ", ""),
            usb.name,
        )
    except (OSError, KeyError):
        return None


def facts_in(file: Path) -> dict[str, str]:
    return dict(line.split("=", 1) for line in file.read_text("utf-8").splitlines() if "=" in line)


def text_in(file: Path) -> str:
    try:
        return file.read_text("utf-8").strip()
    except OSError:
        return ""


class Hidapi:
    """One device that hidapi has opened; it hands reports only to a thread that waits for them."""

    def __init__(self, node: str) -> None:
        self._device: Any = import_module("hid").device()
        self._device.open_path(node.encode())

    def fileno(self) -> int | None:
        return None

    def read(self) -> bytes:
        return bytes(self._device.read(HID.report_bytes, round(READ_WAIT_S * 1000)))

    def read_now(self) -> bytes:
        return self.read()

    def write(self, report: bytes) -> None:
        if self._device.write(REPORT_NUMBER + report) < 0:
            raise OSError("the device took no report")

    def close(self) -> None:
        self._device.close()


def hidapi_devices(vendor: int, product: int) -> list[HidDevice]:
    """None without the extra."""
    try:
        listed: list[dict[str, Any]] = import_module("hid").enumerate(vendor, product)
    except ImportError:
        return []
    return [
        HidDevice(row["path"].decode(), row["product_string"] or "", row["serial_number"] or "")
        for row in listed
    ]


def has_hidapi() -> bool:
    try:
        import_module("hid")
    except ImportError:
        return False
    return True


def find_devices(vendor: int, product: int) -> list[HidDevice]:
    return hidraw_devices(vendor, product) if IS_LINUX else hidapi_devices(vendor, product)


def open_device(node: str) -> OpenDevice:
    return Hidraw(node) if IS_LINUX else Hidapi(node)


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
    devices = find_devices(VENDOR, PRODUCT)
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
    if not IS_LINUX and not has_hidapi():
        return "For a board's own USB cable this system needs hidapi: pip install 'servodeck[hid]'"
    which = "board on its own USB cable" if name == ANY else name
    return f"There is no {which}. Is the cable plugged in and the board switched on?"


def open_board(name: str) -> "HidPort":
    """Raises a PortError with a sentence."""
    board = find_board(name)
    try:
        return HidPort(board.name, open_device(board.device.node))
    except (OSError, ValueError) as error:
        raise explain(board, error) from error


def explain(board: HidBoard, error: Exception) -> PortError:
    number = getattr(error, "errno", None)
    name = f"{board.name} ({board.device.node})"
    if number in DENIED:
        return HidDeniedError(
            f"This account may not open {name}. Allow it once, then plug the cable in again: {ALLOW_HID}"
        )
    if number in BUSY or not IS_LINUX:
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
            return  # it is gone, as requested

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
