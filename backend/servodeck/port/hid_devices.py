"""USB HID devices as each system offers them: Linux by sysfs and /dev/hidraw with the standard library, other
systems by hidapi, which the extra `servodeck[hid]` brings.

Knows reports as bytes; no packet, no board and no event loop: every call may block for a moment.
"""

import os
import select
import sys
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

from servodeck.protocol.timings import HID
from servodeck.value import value

SYSFS = Path("/sys/class/hidraw")
DEV = Path("/dev")
USB_BUS = 3
READ_WAIT_S = 0.2
# Report number 0 goes before the bytes: the devices have no numbered reports.
REPORT_NUMBER = b"\0"


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


IS_LINUX = sys.platform == "linux"


def find_devices(vendor: int, product: int) -> list[HidDevice]:
    return hidraw_devices(vendor, product) if IS_LINUX else hidapi_devices(vendor, product)


def open_device(node: str) -> OpenDevice:
    return Hidraw(node) if IS_LINUX else Hidapi(node)
