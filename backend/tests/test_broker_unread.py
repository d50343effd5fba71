"""A broker that reads nothing: what is said to it has a bound in bytes, and a STOP is said all the same."""

import socket
import threading
import time
from collections.abc import Iterator

import pytest

from servodeck.fleet.broker import UNSENT_BYTES, Connection, Outgoing, parse_broker
from servodeck.fleet.rules import Received
from tests.fleet import WAIT_S, eventually

pytestmark = pytest.mark.slow

# CONNACK of MQTT 5: a new session, success, no properties.
WELCOME = bytes([0x20, 3, 0, 0, 0])
PAYLOAD = bytes(10_000)
# What the systems at both ends hold of a connection on one computer.
HELD_BYTES = 12 * 1024 * 1024


class Nothing:
    def connected(self) -> None:
        """As `is_connected` says."""

    def lost(self) -> None:
        """The test ends before."""

    def received(self, received: Received) -> None:
        """It says nothing."""


@pytest.fixture
def deaf() -> Iterator[int]:
    """The port of a broker that reads its greeting only."""
    listener = socket.create_server(("127.0.0.1", 0))
    has_ended = threading.Event()

    def serve() -> None:
        client, _ = listener.accept()
        with client:
            client.recv(4096)
            client.sendall(WELCOME)
            has_ended.wait()

    serving = threading.Thread(target=serve, daemon=True)
    serving.start()
    yield listener.getsockname()[1]
    has_ended.set()
    serving.join()
    listener.close()


@pytest.mark.parametrize("qos", [0, 1])
def test_what_it_does_not_read_is_refused_beyond_a_bound_but_a_stop(deaf: int, qos: int) -> None:
    connection = Connection(
        parse_broker(f"mqtt://127.0.0.1:{deaf}"), "gateway", {}, Nothing(), time.monotonic
    )
    connection.start()
    try:
        assert eventually(lambda: connection.is_connected, WAIT_S)
        outgoing = Outgoing("sd/1/lab/arm-1/state", PAYLOAD, 1 if qos else 0)
        sent = next(n for n in range(10_000) if not connection.publish(outgoing))
        assert UNSENT_BYTES <= sent * len(PAYLOAD) <= UNSENT_BYTES + HELD_BYTES
        assert connection.publish(Outgoing("sd/1/lab/all/do/driver/anna/stop", b"", 1))
    finally:
        connection.end()
