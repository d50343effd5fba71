"""Real ports: what opens, what does not and what the person is told. A pty stands for the device."""

import contextlib
import errno
import os
import socket
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest

from servodeck.errors import PortBusyError, PortDeniedError, PortError, PortLostError, PortMissingError
from servodeck.ports import explain, list_devices, open_port

NOBODY = 65534


class Pty:
    def __init__(self) -> None:
        self.board, slave = os.openpty()
        tty.setraw(slave)
        self.device = os.ttyname(slave)
        os.close(slave)

    def unplug(self) -> None:
        if self.board >= 0:
            os.close(self.board)
        self.board = -1


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


def test_a_second_opener_is_told_that_the_port_is_busy(pty: Pty) -> None:
    port = open_port(pty.device)
    with pytest.raises(PortBusyError, match="Another program uses"):
        open_port(pty.device)
    port.close()
    open_port(pty.device).close()


def test_an_unplugged_port_is_lost_whatever_is_done_with_it(pty: Pty) -> None:
    port = open_port(pty.device)
    pty.unplug()
    with pytest.raises(PortLostError, match="cable"):
        port.read_now()
    with pytest.raises(PortLostError):
        port.read()
    with pytest.raises(PortLostError):
        port.write(b"\x55")
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
def as_somebody_without_rights() -> Iterator[None]:
    """Root may open everything, so it becomes somebody else meanwhile."""
    before = os.geteuid()
    if before == 0:
        os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(before)


def test_a_port_without_permission_is_denied(pty: Pty) -> None:
    Path(pty.device).chmod(0)
    with as_somebody_without_rights(), pytest.raises(PortDeniedError):
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


def test_a_socket_that_nobody_answers_is_missing() -> None:
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
