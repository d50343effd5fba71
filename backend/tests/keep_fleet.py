"""Writes what a broker and a gateway keep of a fleet into a folder, by running one: `npm run keep`.

`fleet.json`: each retained message, with the user who may write it. `fleet-data`: the data folder of arm-1.
Two real gateways on simulated boards: arm-1 has a group and is announced to Home Assistant, arm-2 was killed,
and somebody has stopped all.
"""

import json
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from paho.mqtt import client as mqtt
from paho.mqtt.enums import CallbackAPIVersion

from servodeck.fleet.console import Console
from servodeck.fleet.home_assistant import USER as HOME_ASSISTANT
from servodeck.fleet.home_assistant import config_topic
from servodeck.fleet.identity import own_name
from tests.fleet import console_of, eventually
from tests.mosquitto import LAB, Mosquitto
from tests.real_fleet import real_fleet

NAMES = ("arm-1", "arm-2")
PREFIX = "homeassistant"
HOLD = LAB.hold("owner", "olga")
SITE_TOPICS = [f"sd/1/{LAB.name}/+/{kind}" for kind in ("about", "state", "online")]
FRAMES = [{"durationMs": 500, "positions": {"1": position}} for position in (1200, 1800)]
# A relative path, because the gateway stores the name of the port.
WORKSHOP = Path("build/kept-fleet")
# Stands for the fingerprint of this computer, which belongs into no file.
HARDWARE = "of no computer"


@contextmanager
def retained_at(mosquitto: Mosquitto, user: str, filters: Sequence[str]) -> Iterator[dict[str, str]]:
    """The text of each retained message that this user may read, by topic, as they come."""
    found: dict[str, str] = {}

    def take(_client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        if message.retain:
            found[message.topic] = message.payload.decode()

    def subscribe(client: mqtt.Client, *_: Any) -> None:
        client.subscribe([(topic, 0) for topic in filters])

    client = mqtt.Client(CallbackAPIVersion.VERSION2, f"keep-{user}")
    client.username_pw_set(user, (mosquitto.folder / "secrets" / user).read_text().strip())
    client.on_message = take
    client.on_connect = subscribe
    client.connect("127.0.0.1", mosquitto.port)
    client.loop_start()
    try:
        yield found
    finally:
        client.disconnect()
        client.loop_stop()


def store_a_group(anna: Console) -> None:
    def is_done() -> bool:
        robot = anna.robot("arm-1")
        return bool(robot and robot.state and robot.state.job and robot.state.job.status == "done")

    anna.ask("arm-1", "ask", action="request")
    anna.ask("arm-1", "download", groups=[{"slot": 3, "name": "Wave", "frames": FRAMES}])
    assert anna.until(is_done, 10)
    anna.ask("arm-1", "ask", action="release")


def kept_of_a_fleet(mosquitto: Mosquitto, folder: Path) -> list[dict[str, str]]:
    """`folder` takes the data of the gateways."""
    with real_fleet(mosquitto, NAMES, folder, "--home-assistant", PREFIX) as gateways:
        with console_of(mosquitto, "anna", *NAMES) as anna:
            assert anna.until(lambda: all(is_ready(name, anna) for name in NAMES), 10)
            store_a_group(anna)
            gateways[1].end()
            assert anna.until(lambda: not anna.is_present("arm-2"), 10)
        with console_of(mosquitto, "olga", "arm-1") as olga:
            olga.stop_all()
            assert olga.until(lambda: HOLD in olga.holds and says_all("arm-1", olga), 10)

        needed = {HOLD, *(LAB.published("arm-1", kind) for kind in ("about", "state", "online"))}
        needed |= {
            LAB.published("arm-2", "online"),
            *(config_topic(PREFIX, LAB.name, name) for name in NAMES),
        }
        with (
            retained_at(mosquitto, "olga", [*SITE_TOPICS, LAB.holds()]) as of_site,
            retained_at(mosquitto, HOME_ASSISTANT, [f"{PREFIX}/#"]) as of_home,
        ):
            assert eventually(lambda: needed <= of_site.keys() | of_home.keys())
            found = {**of_site, **of_home}
        return [{"by": writer_of(topic), "topic": topic, "payload": found[topic]} for topic in sorted(found)]


def is_ready(name: str, console: Console) -> bool:
    robot = console.robot(name)
    return bool(robot and robot.state and robot.state.link.status == "ready")


def says_all(name: str, console: Console) -> bool:
    """Whether its messages tell the stop and the stored group."""
    robot = console.robot(name)
    return bool(robot and robot.state and robot.state.latch and robot.about and robot.about.slots)


def writer_of(topic: str) -> str:
    return "olga" if topic == HOLD else next(name for name in NAMES if name in topic)


def main(folder: Path) -> None:
    shutil.rmtree(WORKSHOP, ignore_errors=True)
    WORKSHOP.mkdir(parents=True)
    with TemporaryDirectory() as scratch:
        mosquitto = Mosquitto(Path(scratch, "broker"), NAMES)
        mosquitto.plan = replace(mosquitto.plan, home_assistant=PREFIX)
        mosquitto.configure()
        with mosquitto:
            kept = kept_of_a_fleet(mosquitto, WORKSHOP)
    (folder / "fleet.json").write_text(json.dumps(kept, indent=2) + "\n")
    shutil.copytree(WORKSHOP / "arm-1.data", folder / "fleet-data")
    own_name(folder / "fleet-data", HARDWARE)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
