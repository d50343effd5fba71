"""One client of the MQTT library that speaks for many gateways: a state of each every second, and an answer
of each to a STOP for all, with the state that follows. What gateways do before they answer takes no time
here.

Each state has the time at which it left as its nonce, by `time.monotonic`.
Usage: fleet_stand_in.py PORT SECRETS ROBOTS STATE_FILE
"""

import json
import sys
import time
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import paho.mqtt.client as mqtt
from bare_mqtt import connected
from paho.mqtt.packettypes import PacketTypes

from servodeck.fleet.broker import properties_for
from servodeck.fleet.topics import ALL
from tests.mosquitto import LAB

STAND_IN = "stand-in"
STEPS_PER_S = 50


def main() -> None:
    port, secrets, robots, file = int(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4])
    names = [f"arm-{number + 1}" for number in range(robots)]
    state = json.loads(file.read_text())
    stops: SimpleQueue[tuple[str, bytes]] = SimpleQueue()
    client = connected(port, secrets, STAND_IN)

    def heard(_client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        asked: Any = message.properties
        stops.put((asked.ResponseTopic, asked.CorrelationData))

    client.on_message = heard
    client.subscribe(LAB.command(ALL, "driver", "anna", "stop"), 1)

    def say(name: str, *, latch: bool) -> None:
        said = state | {"instance": name, "nonce": str(time.monotonic()), "latch": latch}
        client.publish(LAB.published(name, "state"), json.dumps(said))

    answered: set[bytes] = set()
    step = 0
    while True:
        begun_s = time.monotonic()
        for name in names[step::STEPS_PER_S]:
            say(name, latch=False)
        step = (step + 1) % STEPS_PER_S
        while not stops.empty():
            reply_to, correlation = stops.get()
            if correlation not in answered:  # it is repeated
                answered.add(correlation)
                answer(client, reply_to, correlation, names)
                for name in names:
                    say(name, latch=True)
        time.sleep(max(0.001, begun_s + 1 / STEPS_PER_S - time.monotonic()))


def answer(client: mqtt.Client, reply_to: str, correlation: bytes, names: list[str]) -> None:
    properties = properties_for(PacketTypes.PUBLISH)
    properties.CorrelationData = correlation
    done: dict[str, Any] = {"v": 1, "kind": "done", "n": None, "nonce": "now", "epoch": 1, "drives": False}
    for name in names:
        client.publish(reply_to, json.dumps(done | {"gateway": name}), properties=properties)


if __name__ == "__main__":
    main()
