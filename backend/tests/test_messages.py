"""The messages as models, as JSON and as a schema; and that no text harms the gateway or moves anything."""

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from servodeck.api.websocket import intake_of, take_text
from servodeck.callers import THIS_COMPUTER
from servodeck.events import DoneMessage, GatewayMessage, StateMessage, encode, json_schema
from servodeck.intents import MoveMessage, PacketMessage, ResumeMessage, StopMessage, Target, client_message
from servodeck.protocol.families import FAMILIES
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from servodeck.snapshots import IdentityState, LinkState, NoiseEvidence, PortState
from tests.amount import TIMES
from tests.fake_port import FakePort, FakePorts
from tests.samples import BATTERY, MOVE, RUN, STOP
from tests.virtual_time import in_virtual_time, now


def test_each_client_message_is_read_as_what_it_is() -> None:
    assert client_message.validate_json(
        '{"type":"packet","id":7,"bytes":"55550207","nonce":null}'
    ) == PacketMessage(type="packet", id=7, bytes="55550207", nonce=None)
    assert client_message.validate_json(
        '{"type":"move","id":7,"targets":[{"servo":1,"position":1500}],"durationMs":0,"nonce":"1-1"}'
    ) == MoveMessage(type="move", id=7, targets=[Target(servo=1, position=1500)], duration_ms=0, nonce="1-1")
    assert client_message.validate_json('{"type":"stop"}') == StopMessage(type="stop")
    assert client_message.validate_json('{"type":"resume"}') == ResumeMessage(type="resume")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "nonsense",
        "[]",
        "null",
        "{}",
        '{"type":"dance"}',
        '{"type":"packet","id":1}',
        '{"type":"packet","id":"1","bytes":"55550207","nonce":null}',
        '{"type":"packet","id":1.5,"bytes":"55550207","nonce":null}',
        '{"type":"packet","id":-1,"bytes":"55550207","nonce":null}',
        '{"type":"packet","id":true,"bytes":"55550207","nonce":null}',
        '{"type":"packet","id":1,"bytes":["55"],"nonce":null}',
        '{"type":"packet","id":1,"bytes":"55550207","nonce":null,"more":0}',
        '{"type":"packet","id":1,"bytes":"' + "5" * 600 + '","nonce":null}',
        '{"type":"move","id":1,"targets":[],"durationMs":0,"nonce":"1-1"}',
        '{"type":"move","id":1,"targets":[{"servo":0,"position":1500}],"durationMs":0,"nonce":"1-1"}',
        '{"type":"move","id":1,"targets":[{"servo":1,"position":-1}],"durationMs":0,"nonce":"1-1"}',
        '{"type":"move","id":1,"targets":[{"servo":1,"position":1500}],"durationMs":30001,"nonce":"1-1"}',
        '{"type":"resume","hold":null}',
        "[" * 5000,
    ],
)
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(ValidationError):
        client_message.validate_json(text)


def test_names_on_the_wire_are_camel_case() -> None:
    port = PortState(device="/dev/board", status="lost", code="lost", detail="Gone.", retry_in_ms=250)
    state_message = StateMessage(
        board="doc",
        port=port,
        link=LinkState(status="lost", code="lost", detail="Gone."),
        identity=IdentityState(evidence=[NoiseEvidence(byte_count=3)], candidates=[]),
        latch=True,
        latched_by="person",
        stopped_by="Anna",
        clients=2,
        unattended=None,
        broken_slots=[],
        slot_versions={},
        waiting_to_start=[],
        may_be_running=False,
    )
    state = json.loads(encode(state_message))
    assert state["port"]["retryInMs"] == 250
    assert state["identity"]["evidence"] == [{"kind": "noise", "byteCount": 3}]
    assert json.loads(encode(DoneMessage(id=3, outcome="sent"))) == {
        "type": "done",
        "id": 3,
        "outcome": "sent",
        "batteryUnknown": False,
    }
    message: TypeAdapter[Any] = TypeAdapter(GatewayMessage)
    assert message.validate_json(encode(DoneMessage(id=3, outcome="sent"))) == DoneMessage(
        id=3, outcome="sent"
    )


def test_the_schema_names_both_directions_and_leaves_nothing_open() -> None:
    definitions = json_schema()["$defs"]
    assert {"ClientMessage", "GatewayMessage", "PortState"} <= set(definitions)
    assert len(definitions["ClientMessage"]["oneOf"]) == 18
    assert len(definitions["GatewayMessage"]["oneOf"]) == 17
    for name, definition in definitions.items():
        if "properties" in definition:
            assert definition.get("additionalProperties") is False or name == "StopMessage", name
            optional = {key for key, field in definition["properties"].items() if "default" in field}
            assert set(definition["required"]) | optional == set(definition["properties"]), name


packets = st.one_of(
    st.sampled_from([packet.hex() for packet in (MOVE, RUN, STOP, BATTERY)]),
    st.binary(max_size=20).map(bytes.hex),
    st.text(max_size=20),
)
scalars = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=20), packets)


def some_of(message: dict[str, Any]) -> st.SearchStrategy[dict[str, Any]]:
    """With the fields that such a message has, and perhaps others."""
    fields = {
        "run": {"slot", "times", "nonce"},
        "stopGroup": set[str](),
        "erase": {"nonce"},
        "setSpeed": {"slot", "percent", "nonce"},
        "release": {"servos", "nonce"},
    }[message["type"]]
    own = {key: value for key, value in message.items() if key in fields | {"type", "id"}}
    return st.sampled_from([own, own, message])


messages = st.one_of(
    st.fixed_dictionaries(
        {"type": st.just("packet"), "id": st.integers() | scalars, "bytes": packets, "nonce": scalars}
    ),
    st.fixed_dictionaries(
        {
            "type": st.just("move"),
            "id": st.integers() | scalars,
            "targets": st.lists(st.fixed_dictionaries({"servo": scalars, "position": scalars}), max_size=2)
            | scalars
            | st.just([{"servo": 1, "position": 1500}]),
            "durationMs": st.just(0) | scalars,
            "nonce": scalars,
        }
    ),
    st.fixed_dictionaries(
        {
            "type": st.sampled_from(["run", "stopGroup", "erase", "setSpeed", "release"]),
            "id": st.integers(min_value=0, max_value=9) | scalars,
            "slot": st.integers(0, 9) | scalars,
            "times": st.just(1) | scalars,
            "percent": st.just(100) | scalars,
            "servos": st.lists(st.integers(1, 6) | scalars, max_size=2),
            "nonce": scalars,
        }
    ).flatmap(some_of),
    st.fixed_dictionaries({"type": st.just("stop"), "why": st.just("battery") | scalars}),
    st.fixed_dictionaries(
        {"type": st.just("board"), "id": scalars, "board": st.sampled_from(list(FAMILIES)) | scalars}
    ),
    st.dictionaries(st.sampled_from(["type", "id", "packet", "hold", "x"]), scalars),
    st.recursive(scalars, lambda inner: st.lists(inner, max_size=3), max_leaves=6),
)
texts = st.one_of(st.text(max_size=200), messages.map(json.dumps))


@settings(max_examples=100 * TIMES)
@given(st.lists(texts, max_size=5))
def test_no_text_harms_the_gateway_and_a_stopped_robot_stays_stopped(asked: list[str]) -> None:
    say_while_latched(asked)


@in_virtual_time
async def say_while_latched(asked: list[str]) -> None:
    port = FakePort()
    control = Control(FakePorts(port), now, "doc")
    await control.use_port("/dev/board")
    await control.stop()
    session = Session(THIS_COMPUTER)
    control.join(session)
    for text in asked:
        take_text(text, session, intake_of(session, control))
    answers: list[dict[str, Any]] = [json.loads(await session.next()) for _ in range(session.waiting)]
    await control.shut_down()
    assert {answer["type"] for answer in answers} <= {"welcome", "state", "refused"}
    assert set(port.packets()) <= {STOP, BATTERY}
