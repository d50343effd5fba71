"""Hundreds of gateways for tests and benchmarks, in a few processes: real robot cores and connections on fake
ports. Only the thread that each connection has is missing: one event loop serves all sockets of a process.

A process reads its plan as the first line of its input, then questions of one line, and answers each with a
line of JSON. Times are those of `time.monotonic`, which the processes of a computer share.
"""

import asyncio
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
from paho.mqtt.enums import MQTTErrorCode

from servodeck.fleet.broker import parse_broker, send_at_once
from tests.fleet import Fleet, Gateway
from tests.mosquitto import Mosquitto

IN_EACH = 250
MOVE, RUN, STOP = 3, 6, 7
MISC_S = 1.0


class LightFleet:
    """The side of the test. `ask` gets what each process answers."""

    def __init__(
        self,
        mosquitto: Mosquitto,
        ahead_s: Mapping[str, float],
        port: int | None = None,
        in_each: int = IN_EACH,
    ) -> None:
        """Of these names; the clock of each is so far ahead. `port`: of what stands before the broker."""
        names = list(ahead_s)
        self._processes = []
        for first in range(0, len(names), in_each):
            process = subprocess.Popen(
                [sys.executable, "-m", "tests.light_fleet"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            )
            self._processes.append(process)
            mine = {name: ahead_s[name] for name in names[first : first + in_each]}
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
        client.on_socket_register_write = self._wants_to_write
        client.on_socket_unregister_write = self._has_written
        client.on_disconnect = self._disconnected
        self._connect()
        self._see_to_it()

    def _opened(self, client: mqtt.Client, data: Any, opened: Any) -> None:
        send_at_once(client, data, opened)
        self._loop.add_reader(opened, client.loop_read)

    def _closes(self, _client: mqtt.Client, _data: Any, opened: Any) -> None:
        self._loop.remove_reader(opened)

    def _wants_to_write(self, client: mqtt.Client, _data: Any, opened: Any) -> None:
        self._loop.add_writer(opened, client.loop_write)

    def _has_written(self, _client: mqtt.Client, _data: Any, opened: Any) -> None:
        self._loop.remove_writer(opened)

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
        self._loop.call_later(MISC_S, self._see_to_it)


class Answers:
    """What a process says of its gateways."""

    def __init__(self, gateways: Sequence[Gateway]) -> None:
        self._gateways = gateways

    def connected(self) -> int:
        """Those that hear themselves over the broker."""
        return sum(gateway.door.status().problem is None for gateway in self._gateways)

    def latched(self) -> int:
        return sum(gateway.control.latch for gateway in self._gateways)

    def motion(self) -> int:
        """How often they were told to move."""
        return sum(gateway.count(MOVE) + gateway.count(RUN) for gateway in self._gateways)

    def first(self, command: str, since_s: str) -> dict[str, float]:
        return {
            gateway.name: at_s
            for gateway in self._gateways
            if (at_s := gateway.first_s(int(command), float(since_s))) is not None
        }


def say(answer: Any) -> None:
    sys.stdout.write(json.dumps(answer) + "\n")
    sys.stdout.flush()


def main() -> None:
    plan = json.loads(sys.stdin.readline())
    mqtt.Client.loop_start = serve_on_loop  # type: ignore[method-assign,assignment]
    fleet = Fleet()
    gateways = []
    for name, ahead_s in plan["aheadS"].items():
        secret = Path(plan["secrets"], name).read_text().strip()
        broker = parse_broker(f"mqtt://{name}@127.0.0.1:{plan['port']}", secret)
        gateways.append(fleet.add(name, broker, ahead_s))
    answers = Answers(gateways)
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
