"""The location of a device that a person chose by its name, because names of ports move from one device to
another; and the programs that have it open.

Knows the USB bus and, on Linux, /proc; opens nothing. Devices that the bus does not distinguish (a pty, a
socket, a port of the mainboard) go by their name alone.
"""

import os
from collections.abc import Iterable
from pathlib import Path

from servodeck.errors import OtherDeviceError, PortBusyError, PortMissingError
from servodeck.value import value

PROCESSES = Path("/proc")
# The name of the only board on a HID cable; the names of single ones begin with it.
HID = "hid"
BLUETOOTH = "ble:"
# None, and what adapters bear as they come from the factory.
SHARED_NUMBERS = frozenset({"", "0", "0001"})


def is_bluetooth(device: str) -> bool:
    return device.lower().startswith(BLUETOOTH)


@value
class UsbDevice:
    """A port on the USB bus. `serial` and `location` (the socket, `1-1.2:1.0`) may be empty."""

    path: str
    vendor: int
    product: int
    serial: str = ""
    location: str = ""

    @property
    def kind(self) -> tuple[int, int, str, str]:
        """All that it says of itself; one adapter may carry several ports, which differ behind the colon."""
        return self.vendor, self.product, self.serial, self.interface

    @property
    def interface(self) -> str:
        """Its port within the device; empty where there is only one."""
        return self.location.partition(":")[2]

    @property
    def number(self) -> str:
        """No other port has it; empty where there is none."""
        return "" if self.serial in SHARED_NUMBERS else f"{self.serial} {self.interface}".rstrip()

    @property
    def place(self) -> tuple[int, int, str, str]:
        """With where it is: no two devices share that. Without a socket the name stands for it."""
        return self.vendor, self.product, self.serial, self.location or self.path


class Whereabouts:
    def __init__(self, name: str) -> None:
        self.path = name
        """Its name: the chosen one while it leads to it, else its present one."""
        self._name = name
        self._ours: UsbDevice | None = None
        self._others: set[tuple[int, int, str, str]] = set()

    @property
    def is_known(self) -> bool:
        """It was open, and the bus tells it from others."""
        return self._ours is not None

    @property
    def lasting(self) -> str:
        """Its own number where the bus tells one, else its socket, else the name it was chosen by."""
        ours = self._ours
        own = ours and (ours.number or ours.location)
        return f"{ours.vendor:04x}:{ours.product:04x} {own}" if ours and own else self._name

    def find(self, listed: Iterable[UsbDevice]) -> str:
        """The path to open. Raises a PortError where it is not there, or where only a person can tell."""
        ours = self._ours
        if ours is None:
            return self._name
        devices = list(listed)
        for device in devices:
            if device.place == ours.place:
                return self._called(device)
        newcomers = [one for one in devices if one.kind == ours.kind and one.place not in self._others]
        if ours.serial and len(newcomers) == 1:
            return self._called(newcomers[0])
        if newcomers:
            raise OtherDeviceError(
                f"{names(newcomers)} may be the device that was at {self.path}, or another of the same kind. "
                "Choose the port again."
            )
        if any(device.path == ours.path for device in devices):
            raise OtherDeviceError(f"{ours.path} is another device now. Choose the port again.")
        raise PortMissingError(
            f"The device that was at {self.path} is gone. Is the cable plugged in and the board switched on?"
        )

    def opened(self, path: str, listed: Iterable[UsbDevice]) -> None:
        """Raises where something else came in between: what was opened must be closed again."""
        devices = list(listed)
        real = os.path.realpath(path)
        device = next((one for one in devices if one.path in (path, real)), None) or only_hid(path, devices)
        if self._ours and (device is None or device.kind != self._ours.kind):
            raise OtherDeviceError(f"{path} is another device now. Choose the port again.")
        self._ours = device
        self.path = device.path if device and path == HID else path
        self._others = set()
        self.note_others(devices)

    def note_others(self, listed: Iterable[UsbDevice]) -> None:
        """Devices beside ours, or present when ours has just gone, cannot be ours later."""
        if self._ours:
            self._others |= {device.place for device in listed} - {self._ours.place}

    def _called(self, device: UsbDevice) -> str:
        return self._name if os.path.realpath(self._name) == device.path else device.path


def only_hid(path: str, devices: Iterable[UsbDevice]) -> UsbDevice | None:
    """The device that `hid` has opened. None where there is none or several."""
    found = [one for one in devices if path == HID and one.path.startswith(f"{HID}:")]
    return found[0] if len(found) == 1 else None


def names(devices: Iterable[UsbDevice]) -> str:
    return " or ".join(sorted(device.path for device in devices))


def holders_of(device: str) -> list[str]:
    """ "name (process number)" of each program but this one. Linux lists those of this account, or all for
    root; empty on other systems.
    """
    real = os.path.realpath(device)
    return [
        f"{name_of(process)} ({process.name})"
        for process in PROCESSES.glob("[0-9]*")
        if process.name != str(os.getpid()) and has_open(process, real)
    ]


def busy(name: str, device: str, likely: str) -> PortBusyError:
    """Of a device that another program has; `likely`: what that may be where the system does not say."""
    holders = holders_of(device)
    if holders:
        return PortBusyError(f"{name} is open in {', '.join(holders)}. Close it there.", holders)
    return PortBusyError(f"Another program uses {name}. Close it: {likely}.")


def has_open(process: Path, real: str) -> bool:
    try:
        return any(os.path.realpath(link) == real for link in (process / "fd").iterdir())
    except OSError:  # another account's, or gone by now
        return False


def name_of(process: Path) -> str:
    try:
        return (process / "comm").read_text().strip()
    except OSError:
        return "a program"
