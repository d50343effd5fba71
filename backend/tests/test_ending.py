"""The end of the real process, for all states of its clients, disk, port and supervisor."""

import contextlib
import json
import os
import signal
import socket
import sqlite3
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import httpx2
import pytest
from websockets.sync.client import connect

from servodeck.api.server import FORCED
from servodeck.library.library_file import FILE
from tests.client import lease_of
from tests.samples import BATTERY, MOVE, STOP
from tests.test_cli import END_S, Served
from tests.test_library_api import body

pytestmark = [
    pytest.mark.exhaustive,
    pytest.mark.skipif(os.name != "posix", reason="signals and ptys need POSIX"),
]


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served("--data", str(tmp_path))
    yield made
    made.end()


def end_in_time(served: Served, code: int = 0) -> None:
    begun_s = time.monotonic()
    served.process.send_signal(signal.SIGTERM)
    # What was asked before may have left before: the battery, as soon as a client is connected, and the moves
    # of one that drives.
    received = served.read_until_stops(1)
    left_before = received[: received.index(STOP)]
    assert left_before.replace(BATTERY, b"").replace(MOVE, b"") == b""
    served.process.wait(END_S)
    assert time.monotonic() - begun_s <= END_S
    assert served.process.returncode == code


def raw(served: Served, text: str) -> socket.socket:
    """A connection that has sent this and reads nothing."""
    host, _, port = served.url.removeprefix("http://").rpartition(":")
    connection = socket.create_connection((host, int(port)))
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1024)
    connection.sendall(text.replace("HOST", f"{host}:{port}").replace("\n", "\r\n").encode())
    return connection


UPGRADE = """GET /ws HTTP/1.1
Host: HOST
Connection: Upgrade
Upgrade: websocket
Sec-WebSocket-Version: 13
Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==

"""
PUT = "PUT /api/library/b HTTP/1.1\nHost: HOST\nContent-Type: application/json\n"
WRITE = json.dumps(body())
HANDED_OVER = {
    "a client that never closes": UPGRADE,
    "a client that never reads": "GET /openapi.json HTTP/1.1\nHost: HOST\n\n" * 200,
    "half a request": f"{PUT}Content-Length: 900\n\n{{",
    "no request at all": "",
}


@pytest.mark.parametrize("text", HANDED_OVER.values(), ids=HANDED_OVER.keys())
def test_no_client_puts_the_end_off(served: Served, text: str) -> None:
    with raw(served, text):
        time.sleep(0.2)  # what it sent has arrived and fills what it does not read
        end_in_time(served)
    assert served.process.stderr
    said = served.process.stderr.read()
    assert "ending" in said
    assert ("ERROR" in said, "Traceback" in said) == (False, False), said


def test_the_description_of_the_interface_does_not_put_the_stop_off(tmp_path: Path) -> None:
    """It is made when it is asked for first, which took more than a second on a busy computer."""
    hang = "openapi.get_openapi = lambda **_: threading.Event().wait()"
    imports = "import threading; from servodeck.api import openapi; from servodeck.cli.main import main"
    served = Served("--data", str(tmp_path), program=["-c", f"{imports}; {hang}; main()"])
    with raw(served, "GET /openapi.json HTTP/1.1\nHost: HOST\n\n"):
        time.sleep(0.2)  # it is being made
        end_in_time(served)
    served.end()


def test_clients_that_talk_on_do_not_put_it_off(served: Served) -> None:
    with connect(f"ws{served.url.removeprefix('http')}/ws", close_timeout=0) as client:
        nonce = lease_of(client)
        for number in range(30):
            client.send(json.dumps({"type": "packet", "id": number, "bytes": MOVE.hex(), "nonce": nonce}))
        end_in_time(served)


def test_a_port_that_takes_nothing_does_not_put_it_off(served: Served) -> None:
    filler = os.open(served.pty.device, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(filler, b"\0" * 4096)
    begun_s = time.monotonic()
    served.process.send_signal(signal.SIGTERM)
    served.process.wait(END_S)
    assert time.monotonic() - begun_s <= END_S
    os.close(filler)


def test_a_library_that_another_program_holds_does_not_put_it_off(served: Served, tmp_path: Path) -> None:
    assert httpx2.put(f"{served.url}/api/library/a", json=body()).status_code == 200
    with closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        with raw(served, f"{PUT}Content-Length: {len(WRITE)}\n\n{WRITE}"):
            time.sleep(0.2)  # the library waits for the other program
            end_in_time(served)


HANGING = {
    "a thread": ("threading.Thread(target=threading.Event().wait).start()", 0),
    "the end of the library": ("library.Library.close = lambda _: threading.Event().wait()", FORCED),
}


@pytest.mark.parametrize(("hang", "code"), HANGING.values(), ids=HANGING.keys())
def test_what_hangs_for_ever_does_not_put_it_off(hang: str, code: int) -> None:
    imports = "import threading; from servodeck.library import library; from servodeck.cli.main import main"
    served = Served(program=["-c", f"{imports}; {hang}; main()"])
    end_in_time(served, code)
    served.end()


@pytest.mark.parametrize("again", ["SIGTERM", "SIGINT", "SIGHUP", "end of stdin"])
def test_a_second_request_to_end_changes_nothing(tmp_path: Path, again: str) -> None:
    served = Served("--data", str(tmp_path), "--exit-with-stdin", "--log-level", "warning")
    assert served.process.stdin
    with raw(served, UPGRADE):
        if again == "end of stdin":
            served.process.stdin.close()
            served.process.stdin = None
        else:
            served.process.send_signal(signal.Signals[again])
        end_in_time(served)
    assert served.process.stderr
    assert served.process.stderr.read() == ""
    served.end()
