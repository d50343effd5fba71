"""All that reaches the board of a real process, and when, over one life of that process after the other."""

import contextlib
import os
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest

from tests.samples import STOP
from tests.test_cli import Served
from tests.test_ports import Pty

READY_S = 3.0
# Others run on this machine, too.
MARGIN_S = 3.0
PATIENCE_S = 15.0
QUIET_S = 0.3


class Bus:
    def __init__(self, pty: Pty) -> None:
        self._pty = pty
        self._taken: list[tuple[float, bytes]] = []
        self._ended = threading.Event()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def since(self, begin_s: float) -> bytes:
        return b"".join(data for at_s, data in self._taken if at_s >= begin_s)

    def rest(self) -> None:
        """Until nothing has come for a while."""
        while self._taken and time.monotonic() - self._taken[-1][0] < QUIET_S:
            time.sleep(0.02)

    def until_stopped(self, begin_s: float, served: Served) -> None:
        while STOP not in self.since(begin_s):
            if time.monotonic() - begin_s > PATIENCE_S:
                pytest.fail(f"{self.since(begin_s)!r} {httpx2.get(f'{served.url}/api/status').text}")
            time.sleep(0.01)

    def end(self) -> None:
        self._ended.set()
        self._reader.join()

    def _read(self) -> None:
        while not self._ended.is_set():
            try:
                data = os.read(self._pty.board, 4096)
            except BlockingIOError:
                time.sleep(0.002)
            except OSError:  # between two openings of the port its other end is closed
                time.sleep(0.005)
            else:
                self._taken.append((time.monotonic(), data))


@contextlib.contextmanager
def bus_of_pty() -> Iterator[tuple[Pty, Bus]]:
    pty = Pty()
    os.set_blocking(pty.board, False)
    bus = Bus(pty)
    yield pty, bus
    bus.end()
    pty.unplug()


@contextlib.contextmanager
def serving(pty: Pty, folder: Path) -> Iterator[Served]:
    begun_s = time.monotonic()
    served = Served("--board", "doc", "--data", str(folder), pty=pty)
    try:
        assert time.monotonic() - begun_s - held_back_s(served.process.pid) <= READY_S
        yield served
    finally:
        served.process.kill()
        sys.stderr.write(served.process.communicate()[1])  # its log, beside what failed


def held_back_s(pid: int) -> float:
    """How long others had the processor while that process wanted it; a guess where the system does not
    say.
    """
    stat = Path(f"/proc/{pid}/schedstat")
    return int(stat.read_text().split()[1]) / 1e9 if stat.exists() else MARGIN_S
