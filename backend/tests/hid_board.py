"""A board on a HID cable for tests: a sysfs tree like that of Linux, and a pty for its node."""

import os
import shutil
import tty
from pathlib import Path

import pytest

VENDOR, PRODUCT = 0x0483, 0x5750
REPORT_BYTES = 64


class FakeHidraw:
    """The devices of one computer. Its folders take the place of `/sys/class/hidraw` and `/dev`."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self._folder = folder
        self._boards: list[FakeBoard] = []
        (folder / "class").mkdir()
        (folder / "dev").mkdir()
        monkeypatch.setattr("servodeck.port.hid.SYSFS", folder / "class")
        monkeypatch.setattr("servodeck.port.hid.DEV", folder / "dev")
        monkeypatch.setattr("servodeck.port.hid.IS_LINUX", True)

    def plug(
        self,
        socket: str = "1-1",
        *,
        product: str = "LOBOT",
        serial: str = "497223563535",
        ids: tuple[int, int] = (VENDOR, PRODUCT),
        node: str = "hidraw0",
    ) -> "FakeBoard":
        usb = self._folder / "devices" / socket
        hid = usb / f"{socket}:1.0" / "0003:0483:5750.0001"
        raw = hid / "hidraw" / node
        raw.mkdir(parents=True)
        (usb / "product").write_text(f"{product}\n")
        (hid / "uevent").write_text(
            f"HID_ID=0003:{ids[0]:08X}:{ids[1]:08X}\nHID_NAME=MyUSB_HID {product}\nHID_UNIQ={serial}\n"
        )
        (raw / "uevent").write_text(f"MAJOR=240\nMINOR=0\nDEVNAME={node}\n")
        (raw / "device").symlink_to(hid)
        (self._folder / "class" / node).symlink_to(raw)
        board = FakeBoard(self._folder / "dev" / node, (usb, self._folder / "class" / node))
        self._boards.append(board)
        return board

    def unplug_all(self) -> None:
        for board in self._boards:
            board.unplug()


class FakeBoard:
    def __init__(self, node: Path, in_sysfs: tuple[Path, Path]) -> None:
        self.node = node
        self._in_sysfs = in_sysfs
        self._board, self._slave = os.openpty()
        tty.setraw(self._slave)
        node.symlink_to(os.ttyname(self._slave))
        self._is_plugged = True

    def heard(self) -> bytes:
        """One report with its number, as the system passes it on."""
        return os.read(self._board, 1 + REPORT_BYTES)

    def say(self, packet: bytes) -> None:
        os.write(self._board, packet.ljust(REPORT_BYTES, b"\0"))

    def unplug(self) -> None:
        if not self._is_plugged:
            return
        self._is_plugged = False
        tree, link = self._in_sysfs
        link.unlink()
        shutil.rmtree(tree)
        self.node.unlink()
        os.close(self._slave)
        os.close(self._board)
