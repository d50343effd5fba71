"""A client of a broker that sends what it likes, for what a console would never do."""

import json
import queue
import secrets
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from servodeck.fleet.broker import Broker, Connection, Interest, Outgoing
from servodeck.fleet.rules import Received
from tests.fleet import WAIT_S, eventually

TARGETS = [{"servo": 1, "position": 1500}]
FOR_ARM = "sd/1/lab/arm-1/do/driver/anna/"
REPLY = "sd/1/lab/reply/anna/raw"


class Raw:
    """A client that sends what it likes, as one user of the broker."""

    def __init__(self, broker: Broker) -> None:
        interest = Interest(1, wants_retained=True, as_published=True)
        interests = {REPLY: interest} if broker.user == "anna" else {}
        self.heard: queue.Queue[dict[str, Any]] = queue.Queue()
        self.connections = 0
        self.connection = Connection(broker, secrets.token_hex(4), interests, self, time.monotonic)
        self.connection.start()

    def connected(self) -> None:
        self.connections += 1

    def lost(self) -> None:
        """It comes back."""

    def received(self, received: Received) -> None:
        self.heard.put(json.loads(received.payload))

    def say(
        self,
        topic: str,
        payload: bytes | dict[str, Any],
        *,
        is_retained: bool = False,
        qos: Any = 1,
        correlation: bytes | None = None,
    ) -> None:
        data = payload if isinstance(payload, bytes) else json.dumps(payload).encode()
        assert eventually(lambda: self.connection.is_connected)
        outgoing = Outgoing(topic, data, qos, is_retained, reply_to=REPLY, correlation=correlation)
        self.connection.publish(outgoing)

    def answer(self) -> dict[str, Any]:
        return self.heard.get(timeout=WAIT_S)


@contextmanager
def raw_client(broker: Broker) -> Iterator[Raw]:
    made = Raw(broker)
    try:
        yield made
    finally:
        made.connection.end()


def move(n: int, nonce: str) -> dict[str, Any]:
    return {"v": 1, "n": n, "nonce": nonce, "targets": TARGETS, "durationMs": 1500}


def driving(raw: Raw) -> str:
    """Gets the lease; the newest nonce."""
    raw.say(FOR_ARM + "report", {"v": 1, "n": 1})
    raw.say(FOR_ARM + "ask", {"v": 1, "n": 2, "nonce": raw.answer()["nonce"], "action": "request"})
    done = raw.answer()
    assert done["drives"]
    nonce: str = done["nonce"]
    return nonce
