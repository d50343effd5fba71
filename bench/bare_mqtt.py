"""A publisher and a subscriber by the MQTT library alone, on a broker that others use meanwhile. Prints as
JSON how many milliseconds each message took.

Usage: bare_mqtt.py PORT SECRETS SECONDS BYTES
"""

import json
import sys
import threading
import time
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
from paho.mqtt.enums import CallbackAPIVersion

PERIOD_S = 0.01
# Topics that the rights of these two users let through.
SUBSCRIBER, PUBLISHER = "probe", "olga"
TOPIC = "sd/1/lab/probe/do/owner/olga/report"


def main() -> None:
    port, secrets, seconds, size = int(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
    ages_ms: list[float] = []
    is_ready = threading.Event()

    def heard(_client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        ages_ms.append((time.monotonic() - float(message.payload)) * 1000)

    subscriber, publisher = (connected(port, secrets, user) for user in (SUBSCRIBER, PUBLISHER))
    subscriber.on_message = heard
    subscriber.on_subscribe = lambda *_: is_ready.set()
    subscriber.subscribe(TOPIC)
    is_ready.wait()
    begun_s = time.monotonic()
    while (now_s := time.monotonic()) < begun_s + seconds:
        publisher.publish(TOPIC, str(now_s).ljust(size))
        time.sleep(PERIOD_S)
    json.dump(ages_ms, sys.stdout)


def connected(port: int, secrets: Path, user: str) -> mqtt.Client:
    client = mqtt.Client(CallbackAPIVersion.VERSION2, f"bare-{user}", protocol=mqtt.MQTTv5)
    client.username_pw_set(user, (secrets / user).read_text().strip())
    is_there = threading.Event()
    client.on_connect = lambda *_: is_there.set()
    client.connect("127.0.0.1", port)
    client.loop_start()
    is_there.wait()
    return client


if __name__ == "__main__":
    main()
