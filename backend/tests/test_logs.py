"""The log lines of the real process, and of a process whose output is not read."""

import json
import logging
import os
import signal
import socket
import time
from collections.abc import Iterator
from typing import Any

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from servodeck.cli.terminal import LINES_WAITING, SparseFilter, facts_of, set_up_logs
from tests.client import lease_of
from tests.samples import MOVE
from tests.test_cli import Served

LEVELS = ("debug", "info", "warning", "error")


@pytest.fixture
def json_served() -> Iterator[Served]:
    made = Served("--log-format", "json", "--log-level", "debug")
    yield made
    made.end()


def lines_of(served: Served) -> list[dict[str, Any]]:
    """Ends it and reads each line as JSON."""
    served.process.send_signal(signal.SIGTERM)
    _, errors = served.process.communicate(timeout=5)
    return [json.loads(line) for line in errors.splitlines()]


def send_garbage(served: Served) -> None:
    host, _, port = served.url.removeprefix("http://").rpartition(":")
    with socket.create_connection((host, int(port))) as client:
        client.sendall(b"this is no HTTP\r\n\r\n")
        client.recv(1000)


@pytest.mark.exhaustive
def test_each_line_is_an_object_also_those_of_the_libraries(json_served: Served) -> None:
    send_garbage(json_served)
    json_served.pty.unplug()
    until = time.monotonic() + 5
    while time.monotonic() < until and "lost" not in status_of(json_served):
        time.sleep(0.02)
    lines = lines_of(json_served)
    assert [line["event"] for line in lines if line["logger"].startswith("servodeck")][:4] == [
        "port opening",
        "ready",
        "port open",
        "port lost",
    ]
    warnings = [line for line in lines if line["event"] == "port lost" and line["level"] == "warning"]
    # A slow machine sees the first retry fail, too, which is news of another code.
    (lost,) = [line for line in warnings if line["code"] == "lost"]
    assert lost["device"] == json_served.pty.device
    assert any(line["logger"] == "uvicorn.error" and line["level"] == "warning" for line in lines)
    assert all(line["level"] in LEVELS and line["time"].endswith("+00:00") for line in lines)


@pytest.mark.exhaustive
def test_refusals_cost_few_log_lines_and_no_error(json_served: Served) -> None:
    ws = f"ws{json_served.url.removeprefix('http')}/ws"
    for _ in range(30):
        with pytest.raises(InvalidStatus, match="403"), connect(ws, origin=Origin("http://evil.example")):
            pass
        send_garbage(json_served)
    lines = lines_of(json_served)
    refused = [line for line in lines if line["event"] == "refused"]
    garbage = [line for line in lines if "Invalid HTTP" in line["event"]]
    assert 0 < len(refused) <= 8
    assert 0 < len(garbage) <= 8
    assert [line for line in lines if line["level"] == "error"] == []
    first = {name: value for name, value in refused[0].items() if name != "time"}
    assert first == {
        "level": "info",
        "logger": "servodeck.access",
        "event": "refused",
        "from": "127.0.0.1",
        "type": "websocket",
        "path": "/ws",
        "code": "forbidden",
        "reason": "Requests from other sites are refused: the Origin header names another address.",
    }


@pytest.mark.usefixtures("logging_as_before")
def test_a_line_says_how_many_were_left_out_and_other_loggers_lose_none() -> None:
    now_s = 0.0
    sparse = SparseFilter(lambda: now_s)

    def passes(logger: str) -> bool:
        record = logging.LogRecord(logger, logging.INFO, "", 0, "refused", (), None)
        said.append(record)
        return bool(sparse.filter(record))

    said: list[logging.LogRecord] = []
    assert [passes("servodeck.access") for _ in range(8)] == [True] * 5 + [False] * 3
    assert all(passes("servodeck.server") for _ in range(8))
    now_s = 10.0
    assert passes("servodeck.access")
    assert facts_of(said[-1]) == {"leftOut": 3}


def status_of(served: Served) -> str:
    with connect(f"ws{served.url.removeprefix('http')}/ws") as client:
        return str(json.loads(client.recv())["port"]["status"])


@pytest.mark.exhaustive
def test_no_packet_stands_in_the_log_at_any_level(json_served: Served) -> None:
    with connect(f"ws{json_served.url.removeprefix('http')}/ws") as client:
        client.send(json.dumps({"type": "board", "id": 1, "board": "doc"}))
        nonce = lease_of(client)
        client.send(json.dumps({"type": "packet", "id": 1, "bytes": MOVE.hex(), "nonce": nonce}))
        while json.loads(client.recv())["type"] != "done":
            pass
    assert MOVE.hex() not in json.dumps(lines_of(json_served))


@pytest.fixture
def logging_as_before() -> Iterator[None]:
    root = logging.getLogger()
    handlers, level = root.handlers[:], root.level
    yield
    root.handlers[:] = handlers
    root.setLevel(level)


@pytest.mark.usefixtures("logging_as_before")
def test_lines_for_people_tell_the_same() -> None:
    reading, writing = os.pipe()
    handler = set_up_logs("info", "text", writing)
    log = logging.getLogger("servodeck.test")
    log.debug("hidden")
    log.info("port %s", "open", extra={"facts": {"device": "/dev/a b", "code": None}})
    handler.close()
    os.close(writing)
    with os.fdopen(reading) as lines:
        assert lines.read().partition("INFO")[2].strip() == 'port open  device="/dev/a b"'


@pytest.mark.usefixtures("logging_as_before")
def test_a_reader_who_does_not_read_costs_lines_and_no_time() -> None:
    reading, writing = os.pipe()
    handler = set_up_logs("info", "json", writing)
    log = logging.getLogger("servodeck.test")
    begun_s = time.monotonic()
    for _ in range(3 * LINES_WAITING):
        log.info("x" * 1000)  # a pipe takes 64 KiB
    handler.close()
    assert time.monotonic() - begun_s < 3
    os.close(reading)  # wakes the thread that waits
    os.close(writing)
