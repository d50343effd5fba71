"""Hundreds of gateways for tests and benchmarks, in a few processes: real robot cores and connections on fake
ports. Only the thread that each connection has is missing: one event loop serves all sockets of a process.

A process reads its plan as the first line of its input, then questions of one line, and answers each with a
line of JSON. Times are those of `time.monotonic`, which the processes of a computer share.
"""

import asyncio
import itertools
import json
import logging
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
from paho.mqtt.enums import MQTTErrorCode

from servodeck.callers import THIS_COMPUTER
from servodeck.fleet.broker import Outgoing, parse_broker, send_at_once
from servodeck.fleet.gateway import FleetGateway
from tests.fleet import Fleet, Gateway
from tests.mosquitto import Mosquitto

IN_EACH = 250
MOVE, RUN, STOP = 3, 6, 7
MISC_S = 1.0
COUNT = re.compile(rb'"count":(\d+)')


class LightFleet:
    """The side of the test. `ask` gets what each process answers."""

    def __init__(
        self,
        mosquitto: Mosquitto,
        ahead_s: Mapping[str, float],
        port: int | None = None,
        *,
        apart: int = 0,
        in_each: int = IN_EACH,
    ) -> None:
        """Of these names; the clock of each is so far ahead. `port`: of what stands before the broker. The
        first ones, `apart` of them, share no process with the others; `in_each`: of those in one process.
        """
        self.names = names = list(ahead_s)
        self._processes = []
        begins = [*([0] if apart else []), *range(apart, len(names), in_each)]
        for begin, end in itertools.pairwise([*begins, len(names)]):
            process = subprocess.Popen(
                [sys.executable, "-m", "tests.light_fleet"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            )
            self._processes.append(process)
            mine = {name: ahead_s[name] for name in names[begin:end]}
            secrets = str(mosquitto.folder / "secrets")
            tell(process, json.dumps({"secrets": secrets, "port": port or mosquitto.port, "aheadS": mine}))
        for process in self._processes:
            hear(process)

    @property
    def pids(self) -> list[int]:
        return [process.pid for process in self._processes]

    def ask(self, question: str) -> list[Any]:
        for process in self._processes:
            tell(process, question)
        return [hear(process) for process in self._processes]

    def count(self, question: str) -> int:
        """Of all of them."""
        return sum(self.ask(question))

    def first_s(self, command: int, since_s: float) -> dict[str, float]:
        """When each that has done so has written its first such packet since then."""
        return {name: at_s for part in self.ask(f"first {command} {since_s}") for name, at_s in part.items()}

    def end(self) -> None:
        for process in self._processes:
            process.kill()
            process.communicate()


def tell(process: "subprocess.Popen[str]", line: str) -> None:
    assert process.stdin
    process.stdin.write(line + "\n")
    process.stdin.flush()


def hear(process: "subprocess.Popen[str]") -> Any:
    assert process.stdout
    return json.loads(process.stdout.readline())


@contextmanager
def light_fleet(mosquitto: Mosquitto, names: Sequence[str]) -> Iterator[LightFleet]:
    fleet = LightFleet(mosquitto, dict.fromkeys(names, 0.0))
    try:
        yield fleet
    finally:
        fleet.end()


def serve_on_loop(client: mqtt.Client) -> MQTTErrorCode:
    """In place of its method that starts a thread."""
    OnLoop(client)
    return MQTTErrorCode.MQTT_ERR_SUCCESS


class OnLoop:
    """Serves a client on the running event loop."""

    def __init__(self, client: mqtt.Client) -> None:
        self._client = client
        self._loop = asyncio.get_running_loop()
        self._lost = client.on_disconnect
        client.on_socket_open = self._opened
        client.on_socket_close = self._closes
        client.on_disconnect = self._disconnected
        self._connect()
        self._see_to_it()

    def _opened(self, client: mqtt.Client, data: Any, opened: Any) -> None:
        send_at_once(client, data, opened)
        self._loop.add_reader(opened, self._read)

    def _closes(self, _client: mqtt.Client, _data: Any, opened: Any) -> None:
        self._loop.remove_reader(opened)

    def _read(self) -> None:
        self._client.loop_read()
        self._write()

    def _write(self) -> None:
        """What was published meanwhile; otherwise the library writes it at once."""
        if self._client.want_write():
            self._client.loop_write()

    def _connect(self) -> None:
        try:
            self._client.reconnect()
        except OSError:
            assert self._client.on_connect_fail
            self._client.on_connect_fail(self._client, None)
            self._connect_later()

    def _disconnected(self, *how: Any) -> None:
        assert self._lost
        self._lost(*how)
        self._connect_later()

    def _connect_later(self) -> None:
        self._loop.call_later(self._client._reconnect_min_delay, self._connect)

    def _see_to_it(self) -> None:
        self._client.loop_misc()
        self._write()
        self._loop.call_later(MISC_S, self._see_to_it)


class Answers:
    """What a process says of its gateways."""

    def __init__(self, fleet: Fleet, gateways: Sequence[Gateway]) -> None:
        self._fleet = fleet
        self._gateways = gateways
        self._said: dict[str, dict[str, float]] = {}

    def connected(self) -> int:
        """Those that hear themselves over the broker."""
        return sum(gateway.door.status().problem is None for gateway in self._gateways)

    def latched(self) -> int:
        return sum(gateway.control.latch for gateway in self._gateways)

    def resume(self) -> int:
        """At each of them, as a person does on its own page."""

        def resumed() -> None:
            for gateway in self._gateways:
                gateway.control.resume(THIS_COMPUTER)

        self._fleet.call(resumed)
        return len(self._gateways)

    def motion(self) -> int:
        """How often motion was commanded."""
        return sum(gateway.count(MOVE) + gateway.count(RUN) for gateway in self._gateways)

    def first(self, command: str, since_s: str) -> dict[str, float]:
        return {
            gateway.name: at_s
            for gateway in self._gateways
            if (at_s := gateway.first_s(int(command), float(since_s))) is not None
        }

    def moves(self) -> dict[str, list[tuple[float, int]]]:
        """When each move was written, and the position of its last servo."""
        return {
            gateway.name: [
                (at_s, int.from_bytes(packet[-2:], "little"))
                for at_s, packet in gateway.board.written
                if packet[3] == MOVE
            ]
            for gateway in self._gateways
        }

    def note(self) -> int:
        """From now on `said` knows when each state was published."""
        for gateway in self._gateways:
            self._said[gateway.name] = noted_in(gateway.door)
        return len(self._gateways)

    def said(self) -> dict[str, dict[str, float]]:
        """By gateway and number of its state."""
        return self._said


def noted_in(door: FleetGateway) -> dict[str, float]:
    times_s: dict[str, float] = {}
    connection = door._connection
    publish = connection.publish

    def publishing(outgoing: Outgoing) -> bool:
        if outgoing.topic.endswith("/state") and (found := COUNT.search(outgoing.payload)):
            times_s[found[1].decode()] = time.monotonic()
        return publish(outgoing)

    connection.publish = publishing  # type: ignore[method-assign]
    return times_s


def say(answer: Any) -> None:
    sys.stdout.write(json.dumps(answer) + "\n")
    sys.stdout.flush()


def main() -> None:
    logging.disable(logging.WARNING)  # of brokers that come and go
    plan = json.loads(sys.stdin.readline())
    mqtt.Client.loop_start = serve_on_loop  # type: ignore[method-assign,assignment]
    fleet = Fleet()
    gateways = []
    for name, ahead_s in plan["aheadS"].items():
        secret = Path(plan["secrets"], name).read_text().strip()
        broker = parse_broker(f"mqtt://{name}@127.0.0.1:{plan['port']}", secret)
        gateways.append(fleet.add(name, broker, ahead_s))
    answers = Answers(fleet, gateways)
    say(True)
    for line in sys.stdin:
        question, *rest = line.split()
        answer: Callable[..., Any] = getattr(answers, question)
        say(answer(*rest))


if __name__ == "__main__":
    try:
        main()
    finally:
        sys.stderr.flush()
        os._exit(0)  # its loop runs on
