"""Floods a gateway over its broker with moves, as fast as it may, until its input ends. Prints a line when it
has begun, and how many it has sent.

Usage: fleet_flood.py PORT FOLDER
"""

import logging
import sys
import threading
import time
from pathlib import Path

from servodeck.fleet.broker import Connection, Outgoing, parse_broker
from servodeck.fleet.rules import Received

TOPIC = "sd/1/lab/arm-0/do/driver/ben/move"
IN_EACH, PAUSE_S = 50, 0.005


class Unheard:
    def connected(self) -> None: ...

    def lost(self) -> None: ...

    def received(self, received: Received) -> None: ...


def main() -> None:
    logging.disable(logging.WARNING)  # of brokers that come and go
    port, folder = int(sys.argv[1]), Path(sys.argv[2])
    secret = (folder / "secrets" / "ben").read_text().strip()
    broker = parse_broker(f"mqtt://ben@127.0.0.1:{port}", secret)
    connection = Connection(broker, "flood", {}, Unheard(), time.monotonic)
    connection.start()
    has_ended = threading.Event()

    def wait() -> None:
        sys.stdin.read()
        has_ended.set()

    threading.Thread(target=wait).start()
    while not connection.is_connected:
        time.sleep(PAUSE_S)
    sys.stdout.write("begun\n")
    sys.stdout.flush()
    sent = 0
    while not has_ended.wait(PAUSE_S):
        for _ in range(IN_EACH):
            sent += connection.publish(Outgoing(TOPIC, b'{"v":1,"n":1,"nonce":"x.1-1","durationMs":50}'))
    connection.end()
    sys.stdout.write(str(sent))


if __name__ == "__main__":
    main()
