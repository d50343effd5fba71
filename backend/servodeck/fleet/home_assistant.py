"""A robot as a device of Home Assistant: the retained message by which it finds a gateway's topics
(docs/adr/0050; format: https://www.home-assistant.io/integrations/mqtt/#device-discovery-payload).

Templates are Home Assistant's (Jinja). What was announced is remembered in a file, to be taken back later.
Publishes nothing itself.
"""

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field

from servodeck.files import BackgroundFile
from servodeck.fleet.broker import Outgoing
from servodeck.fleet.messages import About
from servodeck.fleet.topics import Site, is_name
from servodeck.schema import Message

FILE = "home-assistant.json"
USER = "homeassistant"
"""Its name on the broker: it presses buttons as that user, in the role of a driver."""
# A little longer than a state is believed, so that one late message changes nothing.
EXPIRES_S = 5
ATTRIBUTES = "{{ {'n': value_json.count, 'nonce': value_json.nonce} | tojson }}"
WRITTEN_OUT = re.compile(r"[^A-Za-z0-9-]")

Component = dict[str, Any]


def is_prefix(text: str) -> bool:
    return all(map(is_name, text.split("/")))


def device_id(site: str, gateway: str) -> str:
    """Topics may have letters, digits, - and _ here; no two gateways get the same."""
    parts = (WRITTEN_OUT.sub(lambda found: f"_{ord(found[0]):02x}", part) for part in (site, gateway))
    return "__".join(("servodeck", *parts))


def config_topic(prefix: str, site: str, gateway: str) -> str:
    return f"{prefix}/device/{device_id(site, gateway)}/config"


def components_of(site: Site, about: About) -> dict[str, Component]:
    """Each by its id, which must stay the same: settings of people depend on it."""
    gateway = about.name
    state = site.published(gateway, "state")
    is_online = "{{ 'online' if value_json.isOnline else 'offline' }}"
    reachable = [{"topic": site.published(gateway, "online"), "value_template": is_online}]

    def shown(platform: str, name: str, template: str, **more: Any) -> Component:
        return {
            "platform": platform,
            "name": name,
            "state_topic": state,
            "value_template": f"{{{{ {template} }}}}",
            "availability": reachable,
            "expire_after": EXPIRES_S,
            **more,
        }

    def is_so(name: str, condition: str, **more: Any) -> Component:
        return shown("binary_sensor", name, f"'ON' if {condition} else 'OFF'", **more)

    names = {slot: group.name or f"Group {slot}" for slot, group in about.slots.items()}
    run_name = f"{json.dumps(names, ensure_ascii=False)}.get(value_json.running.slot | string)"
    found = {
        # Fresh states alone prove that it is there.
        "gateway": {
            "platform": "binary_sensor",
            "name": "Gateway",
            "device_class": "connectivity",
            "entity_category": "diagnostic",
            "state_topic": state,
            "value_template": "{{ 'ON' }}",
            "off_delay": EXPIRES_S,
        },
        "board": is_so("Board", "value_json.link.status == 'ready'", device_class="connectivity"),
        "battery": shown(
            "sensor",
            "Battery",
            "value_json.battery.batteryMv / 1000 if value_json.battery.kind == 'read' else none",
            device_class="voltage",
            unit_of_measurement="V",
            state_class="measurement",
            suggested_display_precision=2,
        ),
        "running": is_so(
            "Running",
            "value_json.running or (value_json.play and value_json.play.status == 'playing')",
            device_class="running",
        ),
        "group": shown(
            "sensor",
            "Group",
            f"({run_name} or 'Group ' ~ value_json.running.slot) if value_json.running else none",
        ),
        "stopped": is_so("Stopped", "value_json.latch"),
        "driver": shown("sensor", "Driver", "value_json.driver"),
        # Without availability: a word about the gateway that is wrong must not take the button away.
        "stop": {
            "platform": "button",
            "name": "STOP",
            "icon": "mdi:stop-circle",
            "command_topic": site.command(gateway, "driver", USER, "stop"),
            "payload_press": "STOP",
            "qos": 1,
        },
    }
    if about.low_battery_mv is not None:
        low = f"value_json.battery.batteryMv <= {about.low_battery_mv}"
        template = f"('ON' if {low} else 'OFF') if value_json.battery.kind == 'read' else none"
        found["low_battery"] = shown("binary_sensor", "Low battery", template, device_class="battery")
    for slot, name in names.items():
        if int(slot) not in about.broken_slots:
            found[f"run_{slot}"] = {
                "platform": "button",
                "name": f"Run {name}",
                "icon": "mdi:play",
                "enabled_by_default": False,
                "command_topic": site.command(gateway, "driver", USER, "press"),
                "command_template": press_template(int(slot)),
                "json_attributes_topic": state,
                "json_attributes_template": ATTRIBUTES,
                "availability": reachable,
            }
    return found


def press_template(slot: int) -> str:
    """`this` is the button itself, whose attributes are of the newest state."""
    return (
        '{"v": 1, "n": {{ this.attributes.n }}, "nonce": "{{ this.attributes.nonce }}", '
        f'"slot": {slot}}}'
    )


def discovery(site: Site, about: About, known: Mapping[str, str]) -> dict[str, Any]:
    """`known`: the platforms of components that were announced before, by id."""
    identifier = device_id(site.name, about.name)
    components = {
        name: {**component, "unique_id": f"{identifier}_{name}"}
        for name, component in components_of(site, about).items()
    }
    return {
        "device": {
            "identifiers": [identifier],
            "name": about.name,
            "model": f"{about.robot} ({about.board})" if about.robot else about.board,
            "sw_version": about.version,
            **({"configuration_url": about.page} if about.page else {}),
        },
        "origin": {"name": "Servodeck", "sw_version": about.version},
        # One that has nothing but a platform is removed.
        "components": {name: {"platform": platform} for name, platform in known.items()} | components,
    }


class Announced(Message):
    """`components`: their platforms by id. An empty `topic`: nothing is announced."""

    topic: str = ""
    components: dict[str, str] = Field(default_factory=dict)


class HomeAssistant:
    def __init__(self, site: Site, gateway: str, prefix: str, folder: Path) -> None:
        """An empty `prefix`: it shall not be found, not even where it was announced before."""
        self._site = site
        self._topic = config_topic(prefix, site.name, gateway) if prefix else ""
        file = folder / FILE
        self._announced = announced_in(file)
        self._file = BackgroundFile(file, self._text)

    def _text(self) -> str:
        return self._announced.model_dump_json()

    def messages(self, about: About) -> list[Outgoing]:
        """What is to be published, for the gateway as it is now."""
        before, now, found = self._announced, Announced(), list[Outgoing]()
        if before.topic not in ("", self._topic):
            found.append(retained(before.topic, b""))
        if self._topic:
            known = before.components if before.topic == self._topic else {}
            config = discovery(self._site, about, known)
            found.append(retained(self._topic, json.dumps(config, ensure_ascii=False).encode()))
            # Those that are gone, too: a Home Assistant that is away now hears of it later.
            platforms = {name: one["platform"] for name, one in config["components"].items()}
            now = Announced(topic=self._topic, components=platforms)
        if now != before:
            self._announced = now
            self._file.save_soon()
        return found


def announced_in(file: Path) -> Announced:
    try:
        return Announced.model_validate_json(file.read_text("utf-8"))
    except (OSError, ValueError):
        return Announced()


def retained(topic: str, payload: bytes) -> Outgoing:
    return Outgoing(topic, payload, 1, is_retained=True)
