"""Real ports: which open, which do not, and the sentences for the person. A pty stands for the device."""

import contextlib
import errno
import itertools
import json
import os
import shutil
import socket
import tty
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

import pytest
from serial.serialutil import Timeout
from serial.tools import list_ports
from typer.testing import CliRunner

from servodeck.cli.main import app
from servodeck.errors import PortBusyError, PortDeniedError, PortError, PortLostError, PortMissingError
from servodeck.port.ports import explain, is_same_port, kind_of, list_devices, list_usb, open_port
from servodeck.port.whereabouts import Whereabouts

NOBODY = 65534


class Pty:
    """Under a name of its own: numbers are given again, and who still looks for one would find another's."""

    def __init__(self) -> None:
        self.board, slave = os.openpty()
        tty.setraw(slave)
        self._folder = TemporaryDirectory()
        link = Path(self._folder.name, "board")
        link.symlink_to(os.ttyname(slave))
        self.device = str(link)
        os.close(slave)

    def unplug(self) -> None:
        if self.board >= 0:
            os.close(self.board)
        self.board = -1
        self._folder.cleanup()


@pytest.fixture
def pty() -> Iterator[Pty]:
    made = Pty()
    yield made
    made.unplug()


def test_bytes_go_both_ways(pty: Pty) -> None:
    port = open_port(pty.device)
    port.write(b"\x55\x55\x02\x07")
    assert os.read(pty.board, 100) == b"\x55\x55\x02\x07"
    os.write(pty.board, b"\x55\x55\x02\x08")
    assert port.read() == b"\x55\x55\x02\x08"
    port.close()


def test_a_second_opener_learns_that_the_port_is_busy(pty: Pty) -> None:
    port = open_port(pty.device)
    with pytest.raises(PortBusyError, match="Another program uses"):
        open_port(pty.device)
    port.close()
    open_port(pty.device).close()


def test_an_unplugged_port_is_lost_at_any_call(pty: Pty) -> None:
    port = open_port(pty.device)
    pty.unplug()
    with pytest.raises(PortLostError, match="cable"):
        port.read_now()
    with pytest.raises(PortLostError):
        port.read()
    with pytest.raises(PortLostError):
        port.write(b"\x55")
    port.close()


def test_a_pause_of_the_gateway_amid_a_write_is_no_lost_port(
    pty: Pty, monkeypatch: pytest.MonkeyPatch
) -> None:
    pauses = itertools.count()
    monkeypatch.setattr(Timeout, "TIME", lambda: float(next(pauses)))
    port = open_port(pty.device)
    port.write(b"\x55\x55\x02\x07")
    assert os.read(pty.board, 100) == b"\x55\x55\x02\x07"
    port.close()


def test_a_port_that_takes_nothing_more_is_lost(pty: Pty) -> None:
    port = open_port(pty.device)
    with pytest.raises(PortLostError):
        port.write(bytes(400_000))
    port.close()


def test_a_port_that_is_not_there_is_missing() -> None:
    with pytest.raises(PortMissingError, match="There is no /dev/ttyUSB99"):
        open_port("/dev/ttyUSB99")


def test_a_file_is_no_serial_port(tmp_path: Path) -> None:
    path = tmp_path / "notes"
    path.write_text("")
    with pytest.raises(PortMissingError, match="not a serial port"):
        open_port(str(path))


@pytest.mark.parametrize(
    ("error", "expected"),
    [
        (OSError(errno.ENOENT, "gone"), PortMissingError),
        (OSError(errno.ENODEV, "gone"), PortMissingError),
        (OSError(errno.EIO, "hung up"), PortMissingError),
        (OSError(errno.EACCES, "denied"), PortDeniedError),
        (OSError(errno.EPERM, "denied"), PortDeniedError),
        (OSError(errno.EBUSY, "busy"), PortBusyError),
        (OSError(errno.EAGAIN, "locked"), PortBusyError),
        (OSError("could not open port 'COM3': PermissionError(13, 'Access is denied.')"), PortBusyError),
        (OSError("could not open port 'COM3': FileNotFoundError(2, 'not found')"), PortMissingError),
        (ValueError("not a port"), PortMissingError),
    ],
)
def test_each_error_of_the_system_has_its_code(error: Exception, expected: type[PortError]) -> None:
    explained = explain("/dev/ttyUSB99", error)
    assert type(explained) is expected
    assert "/dev/ttyUSB99" in explained.detail


def test_a_refusal_names_the_group_to_join() -> None:
    assert "usermod -aG dialout" in explain("/dev/ttyUSB99", OSError(errno.EACCES, "denied")).detail


@contextlib.contextmanager
def as_an_account_without_rights() -> Iterator[None]:
    """Root may open everything, so it becomes another account meanwhile."""
    before = os.geteuid()
    if before == 0:
        os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(before)


def test_a_port_without_permission_is_denied(pty: Pty) -> None:
    Path(pty.device).chmod(0)
    with as_an_account_without_rights(), pytest.raises(PortDeniedError):
        open_port(pty.device)


def test_a_board_behind_a_socket_is_a_port_like_any_other() -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = open_port(f"socket://127.0.0.1:{listener.getsockname()[1]}")
        board, _ = listener.accept()
        with board:
            port.write(b"\x55\x55\x02\x07")
            assert board.recv(100) == b"\x55\x55\x02\x07"
            board.sendall(b"\x55\x55\x02\x08")
            assert port.read_now() == b"\x55\x55\x02\x08"
        with pytest.raises(PortLostError):
            port.read_now()
        port.close()


def test_a_socket_without_an_answer_is_missing() -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        device = f"socket://127.0.0.1:{listener.getsockname()[1]}"
    with pytest.raises(PortMissingError, match="Nothing answers"):
        open_port(device)


@pytest.mark.parametrize(
    "device",
    ["spy:///dev/ttyUSB0?file=/tmp/x", "alt:///dev/ttyUSB0?class=x", "loop://", "hwgrep://.*", "http://x"],
)
def test_no_other_scheme_of_the_library_is_reachable(device: str) -> None:
    with pytest.raises(PortMissingError, match="neither a device nor"):
        open_port(device)


def test_the_list_offers_a_port_known_by_name_alone_once_and_first() -> None:
    devices = [port.device for port in list_devices("/tmp/board", None, "/tmp/board")]
    assert devices[0] == "/tmp/board"
    assert len(devices) == len(set(devices))


class FakeDev:
    """A tree as udev keeps it, with the names of two moments: before and after the adapters came back."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder = folder
        self._ports: list[SimpleNamespace] = []
        monkeypatch.setattr("servodeck.port.ports.LASTING", folder / "serial")
        monkeypatch.setattr(list_ports, "comports", lambda: self._ports)

    def plug(
        self, name: str, by_id: str, by_path: str, number: str | None = None, location: str | None = None
    ) -> str:
        """Later links of the same name win, as with udev. The device's path."""
        device = self.folder / name
        device.touch()
        for kind, link in (("by-id", by_id), ("by-path", by_path)):
            path = self.folder / "serial" / kind / link
            path.parent.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
            path.symlink_to(device)
        self._ports.append(
            SimpleNamespace(
                device=str(device),
                name=device.name,
                description=by_id,
                vid=0x1A86,
                pid=0x7523,
                serial_number=number,
                location=location,
            )
        )
        return str(device)

    def pull_all(self) -> None:
        self._ports.clear()
        shutil.rmtree(self.folder / "serial")


@pytest.fixture
def dev(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FakeDev:
    return FakeDev(tmp_path, monkeypatch)


def shown(device: str) -> str | None:
    """The lasting name that `servodeck ports` tells."""
    ports = json.loads(CliRunner().invoke(app, ["ports", "--json"]).stdout)
    (lasting,) = [port["lasting"] for port in ports if port["device"] == device]
    return lasting and str(lasting)


NUMBERED, TWIN = "usb-FTDI_A1-if00-port0", "usb-1a86_USB_Serial-if00-port0"
LEFT, RIGHT = "platform-usb-0:1.1:1.0-port0", "platform-usb-0:1.2:1.0-port0"


def test_an_adapter_with_a_number_of_its_own_goes_by_it_into_any_socket(dev: FakeDev) -> None:
    lasting = shown(dev.plug("ttyUSB0", NUMBERED, LEFT, "A1"))
    assert lasting == str(dev.folder / "serial" / "by-id" / NUMBERED)
    dev.pull_all()
    dev.plug("ttyUSB0", TWIN, LEFT)
    device = dev.plug("ttyUSB1", NUMBERED, RIGHT, "A1")
    assert os.path.realpath(lasting) == device


@pytest.mark.parametrize("number", [None, "", "0001"])
def test_indistinguishable_adapters_go_by_their_socket(dev: FakeDev, number: str | None) -> None:
    left = shown(dev.plug("ttyUSB0", TWIN, LEFT, number))
    right = shown(dev.plug("ttyUSB1", TWIN, RIGHT, number))
    assert (left, right) == tuple(str(dev.folder / "serial" / "by-path" / one) for one in (LEFT, RIGHT))
    dev.pull_all()
    assert right == shown(device := dev.plug("ttyUSB0", TWIN, RIGHT, number))
    assert os.path.realpath(str(right)) == device


@pytest.mark.parametrize(
    ("ends", "locations"),
    [(("if00-port0", "if01-port0"), ("1-1:1.0", "1-1:1.1")), (("if00-port0", "if00-port1"), ("1-1", "1-1"))],
    ids=["an interface each", "one interface"],
)
def test_two_ports_of_one_adapter_with_a_number_are_distinguished(
    dev: FakeDev, ends: tuple[str, str], locations: tuple[str, str]
) -> None:
    rows = [
        (f"usb-Two_A1-{end}", f"pci-usb-0:1:{end}", "A1", location)
        for end, location in zip(ends, locations, strict=True)
    ]

    def plug(*names: str) -> list[str]:
        return [dev.plug(name, *row) for name, row in zip(names, rows, strict=True)]

    first, second = plug("ttyUSB0", "ttyUSB1")
    assert [shown(first), shown(second)] == [str(dev.folder / "serial" / "by-id" / row[0]) for row in rows]
    ours = Whereabouts(second)
    ours.opened(second, list_usb())
    other = Whereabouts(first)
    other.opened(first, list_usb())
    assert ours.lasting != other.lasting
    ours.note_others([])
    dev.pull_all()
    swapped = plug("ttyUSB1", "ttyUSB0")
    assert [other.find(list_usb()), ours.find(list_usb())] == swapped


def test_a_port_known_by_its_lasting_name_is_the_one_that_is_listed(dev: FakeDev) -> None:
    device = dev.plug("ttyUSB0", NUMBERED, LEFT, "A1")
    other = dev.plug("ttyUSB1", TWIN, RIGHT)
    lasting = str(dev.folder / "serial" / "by-id" / NUMBERED)
    assert {port.device for port in list_devices(lasting)} == {device, other}
    assert is_same_port(lasting, device)
    assert not is_same_port(lasting, other)


def test_where_the_system_has_no_lasting_names_none_is_given(dev: FakeDev) -> None:
    device = dev.plug("ttyUSB0", TWIN, LEFT)
    shutil.rmtree(dev.folder / "serial")
    assert shown(device) is None
    assert "lasting name" not in CliRunner().invoke(app, ["ports"]).stdout


def test_the_list_for_people_names_it_too(dev: FakeDev) -> None:
    dev.plug("ttyUSB0", TWIN, LEFT)
    assert f"lasting name: {dev.folder}/serial/by-path/{LEFT}" in CliRunner().invoke(app, ["ports"]).stdout


def test_a_known_chip_gives_the_port_a_name_that_people_know(dev: FakeDev) -> None:
    device = dev.plug("ttyUSB0", TWIN, LEFT)
    (port,) = [port for port in list_devices() if port.device == device]
    assert port.description == "CH340 USB serial adapter"
    assert port.likely


@pytest.mark.parametrize(
    ("description", "ids", "name"),
    [
        ("ttyUSB0", (0x1234, 0x5678), "USB serial adapter (id 1234:5678)"),
        ("Sim Board", (0x1234, 0x5678), "Sim Board"),
        ("ttyS0", None, "Serial port"),
        ("n/a", None, "Serial port"),
    ],
)
def test_a_path_or_a_number_is_no_name(description: str, ids: tuple[int, int] | None, name: str) -> None:
    vid, pid = ids or (None, None)
    end = description if description.startswith("tty") else "ttyUSB0"
    port = SimpleNamespace(name=end, description=description, vid=vid, pid=pid)
    assert kind_of(port) == name
