"""The examples for Node-RED and ROS 2: their form, and that what they publish makes a gateway run and stop.
Their own code builds the messages from a real gateway's state.
"""

import ast
import json
import re
import runpy
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from servodeck.fleet.topics import Command, Published, Site
from tests.fleet import Gateway, eventually
from tests.mosquitto import Mosquitto, needs_mosquitto
from tests.test_home_assistant import PREFIX, RUN, STATE, Home, announced, is_at_rest, store_a_group

EXAMPLES = Path(__file__).resolve().parents[2] / "docs" / "examples"
FLOW: list[dict[str, Any]] = json.loads((EXAMPLES / "node-red-flow.json").read_text("utf-8"))
NODES = {node["id"]: node for node in FLOW}
ROS = EXAMPLES / "ros2"
NODE = shutil.which("node")
LAB = Site("lab")

# What Node-RED gives to a function node: https://nodered.org/docs/user-guide/writing-functions
# A context takes names and paths of properties as keys, and no other text.
RUN_FUNCTION = r"""
const { code, msg, flow, env } = JSON.parse(require('node:fs').readFileSync(0, 'utf8'));
const name = (key) => {
  if (/^[A-Za-z_$][\w$]*$/.test(key)) return key;
  throw new Error(`Invalid property expression: ${key}`);
};
const context = { get: (key) => flow[name(key)], set: (key, value) => { flow[name(key)] = value; } };
const words = [];
const node = { warn: (text) => words.push(text), status: ({ text }) => words.push(text) };
const variables = { get: (key) => env[key] };
const result = new Function('msg', 'flow', 'env', 'node', code)(msg, context, variables, node);
process.stdout.write(JSON.stringify({ result, flow, words }));
"""


class Function:
    """Function nodes of the flow, with their context."""

    def __init__(self, name: str) -> None:
        self.env = {**{one["name"]: one["value"] for one in NODES["sd-tab"]["env"]}, "NAME": name}
        self.flow: dict[str, Any] = {}
        self.words: list[str] = []

    def __call__(self, node: str, msg: dict[str, Any]) -> dict[str, Any] | None:
        assert NODE
        given = {"code": NODES[node]["func"], "msg": msg, "flow": self.flow, "env": self.env}
        output = subprocess.run(
            [NODE, "-e", RUN_FUNCTION], input=json.dumps(given), capture_output=True, text=True, check=True
        ).stdout
        answer = json.loads(output)
        self.flow, self.words = answer["flow"], answer["words"]
        result: dict[str, Any] | None = answer["result"]
        return result


def injected(node: str) -> dict[str, Any]:
    payload: dict[str, Any] = json.loads(NODES[node]["payload"])
    return {"payload": payload}


def test_the_flow_can_be_imported() -> None:
    assert len(NODES) == len(FLOW)
    for node in FLOW:
        assert {target for wire in node.get("wires", []) for target in wire} <= NODES.keys()
        assert {node[key] for key in ("z", "broker") if key in node and node["type"] != "mqtt-broker"} <= set(
            NODES
        )
    states = NODES["sd-in"]
    assert states["topic"] == LAB.published("+", "state")
    broker = NODES[states["broker"]]
    assert (broker["usetls"], broker["tls"]) == (True, "sd-tls")
    assert NODES["sd-out"]["topic"] == NODES["sd-out"]["qos"] == NODES["sd-out"]["retain"] == ""


def params() -> dict[str, Any]:
    text = (ROS / "params.yaml").read_text("utf-8")
    found: dict[str, Any] = import_module("yaml").safe_load(text)["mqtt_client"]["ros__parameters"]
    return found


def test_each_topic_of_the_bridge_is_one_of_the_protocol() -> None:
    bridge = params()["bridge"]
    inward, outward = bridge["mqtt2ros"], bridge["ros2mqtt"]
    assert inward.keys() == {"mqtt_topics", *inward["mqtt_topics"]}
    assert outward.keys() == {"ros_topics", *outward["ros_topics"]}
    assert [LAB.parse(topic) for topic in inward["mqtt_topics"]] == [Published("arm-1", "state")]
    commands = [LAB.parse(outward[topic]["mqtt_topic"]) for topic in outward["ros_topics"]]
    assert commands == [
        Command("arm-1", "driver", "ros", "stop"),
        Command("arm-1", "driver", "ros", "press"),
        Command("all", "driver", "ros", "stop"),
    ]
    named = {inward[topic]["ros_topic"] for topic in inward["mqtt_topics"]} | set(outward["ros_topics"])
    shown = set(re.findall(r"/servodeck/[\w/]+", (ROS / "README.md").read_text("utf-8")))
    assert shown - named == {"/servodeck/arm_1/run"}  # of press.py


@pytest.mark.parametrize("file", ["servodeck.launch.py", "press.py"])
def test_files_of_ros_are_valid_python(file: str) -> None:
    tree = ast.parse((ROS / file).read_text("utf-8"))
    launch = [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]
    assert launch[0] in ("generate_launch_description", "press_of")


@pytest.fixture(scope="module")
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    made = Mosquitto(tmp_path_factory.mktemp("broker"), ["arm-1"])
    users = {**made.plan.users, "nodered": "driver", "ros": "driver"}
    made.plan = replace(made.plan, home_assistant=PREFIX, users=users)
    made.configure()
    made.start()
    yield made
    made.kill()


@pytest.fixture
def gateway(mosquitto: Mosquitto, tmp_path: Path) -> Iterator[Gateway]:
    """With a group in slot 4."""
    with announced(mosquitto, tmp_path) as (_, made):
        store_a_group(mosquitto)
        yield made


def publish(home: Home, message: dict[str, Any] | None) -> None:
    """As its node for MQTT does."""
    assert message
    payload = message["payload"]
    text = payload if isinstance(payload, str) else json.dumps(payload)
    home.say(message["topic"], text, message["qos"], is_retained=message["retain"])


@pytest.mark.slow
@needs_mosquitto
@pytest.mark.skipif(NODE is None, reason="Node is not installed")
def test_the_flow_shows_runs_and_stops(mosquitto: Mosquitto, gateway: Gateway) -> None:
    home, function = Home(mosquitto, "nodered"), Function("nodered")
    wanted = injected("sd-run")
    wanted["payload"]["slot"] = 4
    try:
        assert function("sd-press", wanted) is None
        assert function.words == ["arm-1 has said nothing yet."]
        assert eventually(lambda: is_at_rest(home, gateway))
        shown = function("sd-remember", {"topic": STATE, "payload": home.json_of(STATE)})
        assert shown
        assert shown["payload"] | {"volts": None} == {
            "robot": "arm-1",
            "link": "ready",
            "isStopped": False,
            "driver": None,
            "slot": None,
            "volts": None,
        }
        assert function.words == ["arm-1: rests"]
        publish(home, function("sd-press", wanted))
        assert eventually(lambda: gateway.count(RUN) == 1)
        publish(home, function("sd-stop", injected("sd-stop-all")))
        assert eventually(lambda: gateway.control.latch)
        assert gateway.control.stopped_by == "nodered"
        one = function("sd-stop", injected("sd-stop-one"))
        assert one
        assert LAB.parse(one["topic"]) == Command("arm-1", "driver", "nodered", "stop")
    finally:
        home.end()


@pytest.mark.slow
@needs_mosquitto
def test_the_node_of_ros_presses(mosquitto: Mosquitto, gateway: Gateway) -> None:
    home, press_of = Home(mosquitto, "ros"), runpy.run_path(str(ROS / "press.py"))["press_of"]
    bridge = params()["bridge"]["ros2mqtt"]
    try:
        assert eventually(lambda: is_at_rest(home, gateway))
        home.say(bridge["/servodeck/arm_1/press"]["mqtt_topic"], press_of(home.heard[STATE].decode(), 4), 0)
        assert eventually(lambda: gateway.count(RUN) == 1)
        home.say(bridge["/servodeck/stop"]["mqtt_topic"], "stop")
        assert eventually(lambda: gateway.control.latch)
    finally:
        home.end()
