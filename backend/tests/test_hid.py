"""Boards on a HID cable: found by sysfs, named, opened, lost; and what is said where that fails."""

import errno
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from servodeck.errors import HidDeniedError, OtherDeviceError, PortBusyError, PortLostError, PortMissingError
from servodeck.port.hid import HidPort, explain, is_hid, list_boards, open_board
from servodeck.port.ports import PortInfo, is_same_port, list_devices, list_usb, open_port
from servodeck.port.whereabouts import UsbDevice, Whereabouts
from tests.hid_board import FakeHidraw

BATTERY = bytes.fromhex("5555020f")
ANSWER = bytes.fromhex("5555040f4c1d")
MOUSE = (0x046D, 0xC077)


@pytest.fixture
def hidraw(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[FakeHidraw]:
    made = FakeHidraw(tmp_path, monkeypatch)
    yield made
    made.unplug_all()


def names() -> list[str]:
    return [board.name for board in list_boards()]


@pytest.mark.parametrize(
    ("device", "expected"), [("hid", True), ("hid:12", True), ("/dev/hidraw0", False), ("hidden", False)]
)
def test_which_names_are_of_hid(device: str, expected: bool) -> None:
    assert is_hid(device) is expected


def test_a_board_is_called_by_its_serial_number(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1.2")
    (board,) = list_boards()
    assert board.name == "hid:497223563535"
    assert board.is_likely
    assert board.device.product == "LOBOT"
    assert board.usb_device == UsbDevice(
        "hid:497223563535", 0x0483, 0x5750, serial="497223563535", location="1-1.2"
    )


@pytest.mark.parametrize("serial", ["", "0001"])
def test_a_board_without_a_number_of_its_own_is_called_by_its_socket(hidraw: FakeHidraw, serial: str) -> None:
    hidraw.plug("1-1.2", serial=serial)
    assert names() == ["hid:1-1.2"]


def test_boards_that_share_a_number_are_distinguished_by_their_sockets(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1")
    hidraw.plug("1-2", node="hidraw1")
    assert names() == ["hid:1-1", "hid:1-2"]


def test_other_devices_are_left_out(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1", ids=MOUSE)
    assert names() == []


def test_a_device_that_shares_the_numbers_alone_is_listed_but_not_likely(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1", product="Joystick")
    assert [board.is_likely for board in list_boards()] == [False]


def test_a_computer_without_hid_has_no_boards(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("servodeck.port.hid.SYSFS", tmp_path / "none")
    assert names() == []


async def test_a_packet_leaves_as_a_padded_report_and_reports_come_in(hidraw: FakeHidraw) -> None:
    board = hidraw.plug()
    port = open_board("hid")
    await port.write(BATTERY)
    assert board.heard() == b"\0" + BATTERY + bytes(60)
    board.say(ANSWER)
    assert port.read_now() == ANSWER + bytes(58)
    board.say(ANSWER)
    assert port.read() == ANSWER + bytes(58)
    port.close()


def test_a_board_that_says_nothing_is_waited_for_a_moment(hidraw: FakeHidraw) -> None:
    hidraw.plug()
    port = open_board("hid:497223563535")
    assert port.read() == b""
    port.close()


def test_a_second_opener_learns_that_the_board_is_busy(hidraw: FakeHidraw) -> None:
    hidraw.plug()
    port = open_board("hid")
    with pytest.raises(PortBusyError, match="Another program uses hid:497223563535"):
        open_board("hid")
    port.close()
    open_board("hid").close()


HOLDS = (
    "import fcntl, sys; node = open(sys.argv[1]); fcntl.flock(node, fcntl.LOCK_EX); "
    "print(flush=True); sys.stdin.read()"
)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell")
def test_the_program_that_has_the_board_is_named(hidraw: FakeHidraw) -> None:
    node = hidraw.plug().node
    with subprocess.Popen(
        [sys.executable, "-c", HOLDS, node], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout
        other.stdout.readline()
        with pytest.raises(PortBusyError, match=rf"is open in python\S* \({other.pid}\). Close it there."):
            open_board("hid")
        other.communicate(b"")


async def test_an_unplugged_board_is_lost_at_any_call(hidraw: FakeHidraw) -> None:
    board = hidraw.plug()
    port = open_board("hid")
    board.unplug()
    with pytest.raises(PortLostError, match="cable"):
        port.read_now()
    with pytest.raises(PortLostError):
        port.read()
    with pytest.raises(PortLostError):
        await port.write(BATTERY)
    port.close()


async def test_a_board_that_takes_nothing_in_time_is_lost(
    hidraw: FakeHidraw, monkeypatch: pytest.MonkeyPatch
) -> None:
    hidraw.plug()
    port, goes_on = open_board("hid"), threading.Event()
    # In real time, shortened: the virtual clock waits for threads.
    monkeypatch.setattr("servodeck.port.hid.TAKEN_WITHIN_S", 0.02)
    monkeypatch.setattr(port._device, "write", lambda _report: goes_on.wait())
    with pytest.raises(PortLostError):
        await port.write(BATTERY)
    goes_on.set()
    port.close()


def test_a_board_without_permission_says_what_allows_it(
    hidraw: FakeHidraw, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(node: str) -> None:
        raise PermissionError(errno.EACCES, "denied", node)

    hidraw.plug()
    monkeypatch.setattr("servodeck.port.hid.open_device", refuse)
    with pytest.raises(HidDeniedError) as refused:
        open_board("hid")
    assert refused.value.detail.endswith(f"sudo {sys.executable} -m servodeck udev-rule --install")


@pytest.mark.parametrize("name", ["hid", "hid:497223563535"])
def test_a_board_that_is_not_plugged_in_is_missing(hidraw: FakeHidraw, name: str) -> None:
    with pytest.raises(PortMissingError, match=r"There is no .* switched on"):
        open_board(name)


def test_the_only_board_is_distinguished_from_devices_with_its_ids(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1", product="Joystick", serial="7")
    hidraw.plug("1-2", product="Hiwonder", node="hidraw1")
    port = open_board("hid")
    port.close()


def test_one_of_two_boards_must_be_named(hidraw: FakeHidraw) -> None:
    hidraw.plug("1-1", serial="A")
    hidraw.plug("1-2", serial="B", node="hidraw1")
    with pytest.raises(OtherDeviceError, match="hid:A, hid:B"):
        open_board("hid")
    open_board("hid:B").close()


def test_a_node_that_cannot_be_opened_otherwise_is_missing(hidraw: FakeHidraw) -> None:
    hidraw.plug()
    (board,) = list_boards()
    assert isinstance(explain(board, OSError(errno.ENODEV, "gone")), PortMissingError)


def test_boards_are_listed_beside_serial_ports_and_requested_by_name(hidraw: FakeHidraw) -> None:
    hidraw.plug()
    ports = [port for port in list_devices("hid", "hid:497223563535") if is_hid(port.device)]
    assert ports == [PortInfo("hid:497223563535", "LOBOT, USB cable of the board", likely=True)]
    assert list_usb() == [board.usb_device for board in list_boards()]
    assert isinstance(open_port("hid"), HidPort)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("hid", "hid:A", True),
        ("hid:A", "hid", True),
        ("hid:A", "hid:A", True),
        ("hid:A", "hid:B", False),
        ("hid", "/dev/ttyUSB0", False),
    ],
)
def test_the_name_of_the_only_board_is_that_of_any(one: str, other: str, expected: bool) -> None:
    assert is_same_port(one, other) is expected


def test_the_only_board_is_found_again_by_its_number_under_another_node(hidraw: FakeHidraw) -> None:
    whereabouts = Whereabouts("hid")
    board = hidraw.plug("1-1")
    whereabouts.opened("hid", list_usb())
    assert (whereabouts.path, whereabouts.lasting) == ("hid:497223563535", "0483:5750 497223563535")
    board.unplug()
    whereabouts.note_others(list_usb())
    hidraw.plug("1-2", serial="another", node="hidraw1")
    with pytest.raises(PortMissingError):
        whereabouts.find(list_usb())
    hidraw.plug("1-3", node="hidraw2")
    assert whereabouts.find(list_usb()) == "hid:497223563535"


class FakeHidapi(SimpleNamespace):
    """The library of the extra, with one board; it fails with the given error."""

    def __init__(self) -> None:
        super().__init__()
        self.written: list[bytes] = []
        self.answers: list[list[int]] = []
        self.opens: list[bytes] = []
        self.takes = 65
        self.is_gone = False

    def enumerate(self, vendor: int, product: int) -> list[dict[str, Any]]:
        return [{"path": b"DevSrvsID:7", "product_string": "LOBOT", "serial_number": None}]

    def device(self) -> "FakeHidapi":
        return self

    def open_path(self, path: bytes) -> None:
        if self.is_gone:
            raise OSError("open failed")
        self.opens.append(path)

    def read(self, size: int, timeout_ms: int) -> list[int]:
        if self.is_gone:
            raise OSError("read error")
        return self.answers.pop(0) if self.answers else []

    def write(self, report: bytes) -> int:
        self.written.append(report)
        return self.takes

    def close(self) -> None:
        if self.is_gone:
            raise ValueError("not open")


@pytest.fixture
def hidapi(monkeypatch: pytest.MonkeyPatch) -> FakeHidapi:
    library = FakeHidapi()
    monkeypatch.setitem(sys.modules, "hid", library)
    monkeypatch.setattr("servodeck.port.hid.IS_LINUX", False)
    return library


async def test_elsewhere_the_library_carries_the_same_reports(hidapi: FakeHidapi) -> None:
    assert names() == ["hid:DevSrvsID:7"]
    port: HidPort = open_board("hid")
    assert hidapi.opens == [b"DevSrvsID:7"]
    assert port.fileno() is None
    await port.write(BATTERY)
    assert hidapi.written == [b"\0" + BATTERY + bytes(60)]
    hidapi.answers = [[*ANSWER, *bytes(58)]]
    assert [port.read(), port.read_now()] == [ANSWER + bytes(58), b""]
    port.close()


async def test_elsewhere_a_board_that_goes_is_lost(hidapi: FakeHidapi) -> None:
    port = open_board("hid")
    hidapi.takes = -1
    with pytest.raises(PortLostError):
        await port.write(BATTERY)
    hidapi.is_gone = True
    with pytest.raises(PortLostError):
        port.read()
    port.close()
    with pytest.raises(PortBusyError, match="Another program uses hid:DevSrvsID:7"):
        open_board("hid")


def test_elsewhere_the_extra_is_named_where_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "hid", None)
    monkeypatch.setattr("servodeck.port.hid.IS_LINUX", False)
    assert names() == []
    with pytest.raises(PortMissingError, match=r"servodeck\[hid\]"):
        open_board("hid")
