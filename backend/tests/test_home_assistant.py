"""What Home Assistant is told, and what its buttons do, on a real Mosquitto. Its place is taken by a client
of MQTT 3.1.1, as it connects by default, that renders its templates by Jinja.
"""

import json
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import paho.mqtt.client as mqtt
import pytest
from jinja2.sandbox import ImmutableSandboxedEnvironment
from paho.mqtt.enums import CallbackAPIVersion

from servodeck.fleet.broker_config import Listener, Plan, acl
from servodeck.fleet.gateway import FleetGateway
from servodeck.fleet.home_assistant import USER, HomeAssistant, config_topic, device_id, discovery
from servodeck.fleet.messages import About
from servodeck.snapshots import StoredGroup
from tests.fleet import Fleet, Gateway, console_of, eventually
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto
from tests.test_cli import Served
from tests.test_cli import run as run_cli

PREFIX = "homeassistant"
CONFIG = config_topic(PREFIX, "lab", "arm-1")
STATE, ONLINE = LAB.published("arm-1", "state"), LAB.published("arm-1", "online")
NASTY = 'Wave "}} {{ 1 / 0 }} 波'
ABOUT = About(
    name="arm-1",
    version="0.1.0",
    board="lsc",
    robot="Arm",
    servos=[],
    slots={"3": StoredGroup(version="a"), "4": StoredGroup(version="b", name=NASTY)},
    broken_slots=[3],
    page="http://192.0.2.7:8300",
    low_battery_mv=6400,
)
JINJA = ImmutableSandboxedEnvironment()

# As the pages of MQTT, Binary sensor, Sensor and Button of its documentation name them: required, and others
# that are used. An unknown key would be ignored without a word.
OF_ALL = {"platform", "unique_id", "name", "icon", "availability", "entity_category", "device_class"}
READ = {"state_topic", "value_template", "expire_after"}
REQUIRED = {"binary_sensor": {"state_topic"}, "sensor": {"state_topic"}, "button": {"command_topic"}}
ALLOWED = {
    "binary_sensor": READ | {"off_delay"},
    "sensor": READ | {"unit_of_measurement", "state_class", "suggested_display_precision"},
    "button": {"command_topic", "command_template", "payload_press", "qos", "enabled_by_default"}
    | {"json_attributes_topic", "json_attributes_template"},
}
DEVICE_CLASSES = {
    "binary_sensor": {"connectivity", "battery", "running"},
    "sensor": {"voltage"},
    "button": set[str](),
}


def rendered(template: str, **values: Any) -> str:
    return JINJA.from_string(template).render(**values)


def state_of(**changes: Any) -> dict[str, Any]:
    battery = {"kind": "read", "batteryMv": 7412, "ageMs": 800}
    at_rest = {"link": {"status": "ready"}, "latch": False, "driver": None, "running": None, "play": None}
    return {**at_rest, "battery": battery, **changes}


def test_each_component_has_what_is_required_and_nothing_unknown() -> None:
    found = discovery(LAB, ABOUT, {})
    assert found["device"]["identifiers"]
    assert found["origin"]["name"]
    assert re.fullmatch(r"homeassistant/device/[A-Za-z0-9_-]+/config", CONFIG)
    ids = [one["unique_id"] for one in found["components"].values()]
    assert len(set(ids)) == len(ids)
    for component in found["components"].values():
        platform = component["platform"]
        assert component.keys() >= REQUIRED[platform] | {"platform", "unique_id"}
        assert component.keys() <= ALLOWED[platform] | OF_ALL
        assert component.get("device_class") in {None, *DEVICE_CLASSES[platform]}


@pytest.mark.parametrize(
    ("component", "changes", "value"),
    [
        ("battery", {}, "7.412"),
        ("battery", {"battery": {"kind": "unread"}}, "None"),
        ("low_battery", {}, "OFF"),
        ("low_battery", {"battery": {"kind": "read", "batteryMv": 6400}}, "ON"),
        ("low_battery", {"battery": {"kind": "silent", "lastMv": 6300}}, "None"),
        ("board", {}, "ON"),
        ("board", {"link": {"status": "lost"}}, "OFF"),
        ("gateway", {}, "ON"),
        ("running", {}, "OFF"),
        ("running", {"running": {"slot": 4}}, "ON"),
        ("running", {"play": {"status": "playing"}}, "ON"),
        ("running", {"play": {"status": "done"}}, "OFF"),
        ("group", {}, "None"),
        ("group", {"running": {"slot": 4}}, NASTY),
        ("group", {"running": {"slot": 9}}, "Group 9"),
        ("stopped", {"latch": True}, "ON"),
        ("driver", {"driver": "anna"}, "anna"),
    ],
)
def test_a_state_is_shown(component: str, changes: dict[str, Any], value: str) -> None:
    template = discovery(LAB, ABOUT, {})["components"][component]["value_template"]
    assert rendered(template, value_json=state_of(**changes)) == value


def test_a_group_has_a_button_that_is_off_and_none_allows_motion_again() -> None:
    components = discovery(LAB, ABOUT, {})["components"]
    buttons = {name: one for name, one in components.items() if one["platform"] == "button"}
    assert buttons.keys() == {"stop", "run_4"}  # the group of slot 3 is broken
    assert buttons["run_4"]["enabled_by_default"] is False
    assert "availability" not in buttons["stop"]


@pytest.mark.parametrize(("robot", "model"), [("Desk arm", "Desk arm (doc)"), ("", "doc")])
def test_the_model_is_robot_and_board(robot: str, model: str) -> None:
    about = ABOUT.model_copy(update={"robot": robot, "board": "doc"})
    assert discovery(LAB, about, {})["device"]["model"] == model


def test_what_is_gone_is_removed() -> None:
    empty = ABOUT.model_copy(update={"slots": {}, "low_battery_mv": None})
    components = discovery(LAB, empty, {"run_4": "button", "low_battery": "binary_sensor"})["components"]
    assert components["run_4"] == {"platform": "button"}
    assert components["low_battery"] == {"platform": "binary_sensor"}


def test_two_robots_are_never_one_device() -> None:
    names = ["arm.1", "arm_1", "arm-1", "arm@1", "arm_2e1", "arm__1"]
    ids = {device_id(site, name) for site in ("lab", "lab__arm") for name in names}
    assert len(ids) == 2 * len(names)
    assert all(re.fullmatch(r"[A-Za-z0-9_-]+", one) for one in ids)


def test_its_user_may_stop_and_press_and_nothing_else() -> None:
    plan = Plan("lab", ["arm-1"], {}, Listener(1883), home_assistant=PREFIX)
    written = re.findall(r"^topic write (.+)$", acl(plan).partition(f"user {USER}\n")[2], re.MULTILINE)
    assert written == [
        f"sd/1/lab/+/do/driver/{USER}/stop",
        f"sd/1/lab/+/do/driver/{USER}/press",
        f"{PREFIX}/status",
    ]
    with pytest.raises(ValueError, match="different names"):
        replace(plan, users={USER: "owner"}).check()
    with pytest.raises(ValueError, match="no prefix"):
        replace(plan, home_assistant="a/#").check()


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--home-assistant", "homeassistant"], "needs --mqtt"),
        (["--mqtt", "mqtt://broker", "--home-assistant", "a/#"], "is not valid"),
    ],
)
def test_options_that_cannot_be_are_explained(options: list[str], sentence: str, tmp_path: Path) -> None:
    result = run_cli("serve", "--listen", "127.0.0.1:0", "--data", str(tmp_path), "--no-open", *options)
    assert result.exit_code == 2
    assert sentence in result.stderr


class Home:
    """Its client on the broker, or one of another user."""

    def __init__(self, mosquitto: Mosquitto, user: str = USER) -> None:
        self.heard: dict[str, bytes] = {}
        self._ready = threading.Event()
        self._client = mqtt.Client(CallbackAPIVersion.VERSION2, f"home-{user}", protocol=mqtt.MQTTv311)
        self._client.username_pw_set(user, (mosquitto.folder / "secrets" / user).read_text().strip())
        self._client.on_message = self._on_message
        self._client.on_subscribe = lambda *_: self._ready.set()
        self._client.connect("127.0.0.1", mosquitto.port)
        self._client.loop_start()
        self._client.subscribe([(f"{PREFIX}/#", 0), (STATE, 0), (ONLINE, 0)])
        assert self._ready.wait(10)

    def _on_message(self, _client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        self.heard[message.topic] = bytes(message.payload)

    def json_of(self, topic: str) -> Any:
        return json.loads(self.heard[topic])

    def components(self) -> dict[str, Any]:
        found: dict[str, Any] = self.json_of(CONFIG)["components"] if self.heard.get(CONFIG) else {}
        return found

    def press(
        self, name: str, *, attributes: dict[str, Any] | None = None, is_retained: bool = False
    ) -> None:
        """As its button does, with the attributes of the newest state."""
        button = self.components()[name]
        payload = button.get("payload_press", "PRESS")
        if template := button.get("command_template"):
            attributes = attributes or self.attributes(name)
            payload = rendered(template, value=payload, this={"attributes": attributes})
        self.say(button["command_topic"], payload, button.get("qos", 0), is_retained=is_retained)

    def attributes(self, name: str) -> dict[str, Any]:
        button = self.components()[name]
        state = self.json_of(button["json_attributes_topic"])
        found: dict[str, Any] = json.loads(rendered(button["json_attributes_template"], value_json=state))
        return found

    def say(self, topic: str, payload: str, qos: int = 1, *, is_retained: bool = False) -> None:
        self._client.publish(topic, payload, qos, is_retained).wait_for_publish(10)

    def end(self) -> None:
        self._client.disconnect()
        self._client.loop_stop()


@contextmanager
def announced(mosquitto: Mosquitto, folder: Path, prefix: str = PREFIX) -> Iterator[tuple[Fleet, Gateway]]:
    """A gateway that says to Home Assistant what it is."""
    broker, fleet = mosquitto.broker_for("arm-1"), Fleet()
    gateway = Gateway("arm-1", broker)

    async def start() -> None:
        says = HomeAssistant(LAB, "arm-1", prefix, folder).messages
        gateway.door = FleetGateway(gateway.control, broker, LAB, "arm-1", announced=says)
        await gateway.start()

    try:
        fleet.do(start())
        yield fleet, gateway
    finally:
        fleet.do(gateway.end())
        fleet.end()


@pytest.fixture(scope="module")
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    made = Mosquitto(tmp_path_factory.mktemp("broker"), ["arm-1"])
    made.plan = replace(made.plan, home_assistant=PREFIX)
    made.configure()
    made.start()
    yield made
    made.kill()


@pytest.fixture
def home(mosquitto: Mosquitto) -> Iterator[Home]:
    made = Home(mosquitto)
    yield made
    made.end()


def store_a_group(mosquitto: Mosquitto) -> None:
    with console_of(mosquitto, "anna", "arm-1") as console:
        frames = [{"durationMs": 500, "positions": {"1": 1500}}]
        console.ask("arm-1", "ask", action="request")
        console.ask("arm-1", "download", groups=[{"slot": 4, "name": "Wave", "frames": frames}])

        def is_done() -> bool:
            robot = console.robot("arm-1")
            return bool(robot and robot.state and robot.state.job and robot.state.job.status == "done")

        assert console.until(is_done, 10)
        console.ask("arm-1", "ask", action="release")


def is_ready(home: Home, gateway: Gateway) -> bool:
    return "run_4" in home.components() and is_at_rest(home, gateway)


def is_at_rest(home: Home, gateway: Gateway) -> bool:
    """It has heard a state of this gateway, not of an earlier one, and nobody drives."""
    if STATE not in home.heard:
        return False
    state, job = home.json_of(STATE), gateway.control.board.jobs.latest
    return bool(job and state["job"] and state["job"]["id"] == job.id and state["driver"] is None)


def refused(gateway: Gateway, code: str) -> Callable[[], bool]:
    return lambda: gateway.door.status().refused.get(code, 0) > 0


RUN, MOVE, STOP = 6, 3, 7


@pytest.mark.slow
@needs_mosquitto
def test_its_buttons_run_a_group_once_and_stop(mosquitto: Mosquitto, home: Home, tmp_path: Path) -> None:
    with announced(mosquitto, tmp_path) as (_, gateway):
        store_a_group(mosquitto)
        assert eventually(lambda: is_ready(home, gateway))
        assert home.components()["run_4"]["name"] == "Run Wave"
        is_online = home.components()["run_4"]["availability"][0]["value_template"]
        assert rendered(is_online, value_json=home.json_of(ONLINE)) == "online"

        attributes = home.attributes("run_4")
        home.press("run_4", attributes=attributes)
        home.press("run_4", attributes=attributes)
        assert eventually(lambda: gateway.count(RUN) == 1)
        assert eventually(lambda: (home.json_of(STATE)["unattended"] or {}).get("by") == USER)

        home.press("stop")
        assert eventually(lambda: gateway.control.latch and gateway.count(STOP) >= 3)
        assert gateway.control.stopped_by == USER
        assert gateway.count(RUN) == 1


@pytest.mark.slow
@needs_mosquitto
def test_presses_that_do_not_count(mosquitto: Mosquitto, home: Home, tmp_path: Path) -> None:
    with announced(mosquitto, tmp_path) as (_, gateway):
        store_a_group(mosquitto)
        assert eventually(lambda: is_ready(home, gateway))
        press = home.components()["run_4"]["command_topic"]
        home.press("run_4", is_retained=True)
        assert eventually(refused(gateway, "retained"))
        home.say(press, "", is_retained=True)
        home.press("run_4", attributes={"n": 1, "nonce": "of another start"})
        assert eventually(refused(gateway, "expired"))
        home.say(press, "PRESS")
        assert eventually(refused(gateway, "malformed"))
        with console_of(mosquitto, "ben", "arm-1") as console:
            console.ask("arm-1", "ask", action="request")
            assert eventually(lambda: home.json_of(STATE)["driver"] == "ben")
            home.press("run_4")
            console.ask("arm-1", "report")
        for verb in ("run", "move", "resume", "download"):
            topic = LAB.command("arm-1", "driver", USER, "press").replace("press", verb)
            home.say(topic, json.dumps({"v": 1, "n": 10**6, "slot": 4, **home.attributes("run_4")}))
        home.press("stop")  # comes behind them
        assert eventually(lambda: gateway.control.latch)
        assert gateway.count(RUN) == gateway.count(MOVE) == 0


@pytest.mark.slow
@needs_mosquitto
def test_it_is_taken_back_when_the_option_is_gone(mosquitto: Mosquitto, home: Home, tmp_path: Path) -> None:
    with announced(mosquitto, tmp_path):
        assert eventually(lambda: "stop" in home.components())
        assert eventually((tmp_path / "home-assistant.json").exists)
    with announced(mosquitto, tmp_path, ""):
        assert eventually(lambda: home.heard[CONFIG] == b"")
    late = Home(mosquitto)
    try:
        assert CONFIG not in late.heard
    finally:
        late.end()


@pytest.mark.exhaustive
@needs_mosquitto
def test_the_option_announces_and_its_absence_takes_back(
    mosquitto: Mosquitto, home: Home, tmp_path: Path
) -> None:
    secret, data = mosquitto.folder / "secrets" / "arm-1", tmp_path / "data"
    options = ["--mqtt", f"mqtt://arm-1@127.0.0.1:{mosquitto.port}", "--mqtt-site", "lab"]
    options += ["--mqtt-password-file", str(secret), "--data", str(data)]
    served = Served(*options, "--home-assistant", PREFIX)
    try:
        assert eventually(lambda: "stop" in home.components())
        assert eventually((data / "home-assistant.json").exists)
        home.press("stop")
        served.read_until_stops(3)
    finally:
        served.end()
    served = Served(*options)
    try:
        assert eventually(lambda: home.heard[CONFIG] == b"")
    finally:
        served.end()


@pytest.mark.exhaustive
@needs_mosquitto
def test_a_group_goes_on_when_the_lease_behind_a_button_has_ended(
    mosquitto: Mosquitto, home: Home, tmp_path: Path
) -> None:
    with announced(mosquitto, tmp_path) as (_, gateway):
        store_a_group(mosquitto)
        assert eventually(lambda: is_ready(home, gateway))
        stops = gateway.count(STOP)
        home.press("run_4")
        assert eventually(lambda: home.json_of(STATE)["driver"] == USER)
        assert eventually(lambda: home.json_of(STATE)["driver"] is None)
        assert gateway.count(RUN) == 1
        assert gateway.count(STOP) == stops
