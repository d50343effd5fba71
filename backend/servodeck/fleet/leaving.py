"""Takes a gateway that will not come back off the broker, so that nobody counts on it any more: what it had
said and the broker keeps is removed. Only its own user may.
"""

import secrets
import threading
import time

from servodeck.fleet.broker import Broker, Connection, Outgoing
from servodeck.fleet.rules import Received
from servodeck.fleet.topics import Kind, Site

WITHIN_S = 5.0
SAID: tuple[Kind, ...] = ("state", "online", "about")


class Leaving:
    """The connection, as its user; waits until it is there."""

    def __init__(self, broker: Broker) -> None:
        self._is_there = threading.Event()
        self.connection = Connection(broker, f"leaving-{secrets.token_hex(4)}", {}, self, time.monotonic)
        self.connection.start()

    def connected(self) -> None:
        self._is_there.set()

    def lost(self) -> None:
        """It comes back."""

    def received(self, received: Received) -> None:
        """Nothing was subscribed to."""

    def is_there(self) -> bool:
        return self._is_there.wait(WITHIN_S)


def take_off(broker: Broker, site: Site, name: str) -> str | None:
    """Blocks. None where it is done, else why it is not."""
    leaving = Leaving(broker)
    *first, last = [Outgoing(site.published(name, kind), b"", 1, True) for kind in SAID]
    if not leaving.is_there():
        problem = leaving.connection.problem
        leaving.connection.end()
        return problem
    for each in first:
        leaving.connection.publish(each)
    is_answered = leaving.connection.end(last)
    if leaving.connection.was_denied:
        return f"The broker does not let {broker.user} do that."
    return None if is_answered else f"The broker has not confirmed it: {name} may still be on the lists."
