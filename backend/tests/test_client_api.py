"""What the Python client sends and reads is in the description that the gateway gives of itself."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest
from jsonschema_rs import validator_for

from servodeck.api.examples import EXAMPLES
from servodeck.client.errors import BY_CODE, TimedOutError, UnreachableError, error_of
from servodeck.client.gateway import Call, Pause, Steps, Welcome
from servodeck.client.vocabulary import Vocabulary
from servodeck.errors import BusyError, GatewayError, MovingError, PortBusyError, TooManyError
from tests.client import Client, gateway_on
from tests.served_robot import FILE
from tests.test_openapi import SCHEMA
from tests.virtual_time import in_virtual_time

FRAMES: list[tuple[float, dict[str, float]]] = [(0.5, {"Base": 10}), (0.5, {"Base": 0})]
METHODS: dict[str, Callable[[Vocabulary], Steps[Any]]] = {
    "move": lambda said: said.move({"Base": 30}, "deg", 1.5, wait=True, timeout=None),
    "pose": lambda said: said.pose("Greeting", 1.5, wait=True, timeout=None),
    "run": lambda said: said.run(3, 1, wait=True, timeout=None, alone=60),
    "play": lambda said: said.play(FRAMES, "deg", 2, 1, wait=True, timeout=3, alone=60),
    "beats": lambda said: said.beats(),
    "download": lambda said: said.download(5, FRAMES, "deg", "Wave", "v1", wait=True, timeout=1),
    "erase": lambda said: said.erase(),
    "stop": lambda said: said.stop(),
    "resume": lambda said: said.resume(),
    "request_lease": lambda said: said.request_lease(),
    "snapshot": lambda said: said.snapshot(),
    "status": lambda said: said.status(),
    "battery": lambda said: said.battery(),
    "poses": lambda said: said.poses(),
    "servos": lambda said: said.servos(),
}
MOST_STEPS = 60


class Clock:
    now_s = 0.0

    def now(self) -> float:
        return self.now_s


async def welcome() -> dict[str, Any]:
    """As a gateway sends it, with a robot on its board."""
    async with gateway_on() as control:
        client = Client(control)
        [first, *_] = await client.heard()
        return {**first, "robot": {"id": "arm", "revision": 1}}


def template_of(path: str) -> str:
    templates = [each for each in SCHEMA["paths"] if re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", each), path)]
    exact = [each for each in templates if each == path] or templates
    assert len(exact) == 1, path
    return str(exact[0])


def judge(call: Call, template: str) -> None:
    operation = SCHEMA["paths"][template][call.method.lower()]
    content = operation.get("requestBody", {}).get("content", {}).get("application/json")
    if call.body is not None:
        schema = content["schema"] | {"components": SCHEMA["components"]}
        assert list(validator_for(schema).iter_errors(json.loads(json.dumps(call.body)))) == []
    assert call.body is not None or not operation.get("requestBody", {}).get("required")
    headers = {each["name"].lower() for each in operation.get("parameters", ())}
    assert ("idempotency-key" in headers) == call.is_keyed


def walk(steps: Steps[Any], clock: Clock, first: dict[str, Any]) -> list[str]:
    """The routes of its requests, each answered by the example in the description."""
    routes: list[str] = []
    answer: Any = None
    try:
        for _ in range(MOST_STEPS):
            step = steps.send(answer)
            answer = None
            if isinstance(step, Pause):
                clock.now_s += step.seconds
            elif isinstance(step, Welcome):
                routes.append("GET /api/events")
                answer = first
            else:
                template = template_of(step.path)
                judge(step, template)
                routes.append(f"{step.method} {template}")
                answer = EXAMPLES[step.method, template].response
                if template == "/api/library/{document}":
                    answer = answer | {"text": json.dumps(FILE)}
    except (StopIteration, TimedOutError):
        pass
    return routes


@in_virtual_time
async def test_every_request_of_every_method_is_described() -> None:
    first = await welcome()
    seen: set[str] = set()
    for name, begin in METHODS.items():
        clock = Clock()
        said = Vocabulary(clock.now, take=False)
        found = walk(begin(said), clock, first) + walk(said.release(), clock, first)
        assert found, name
        seen |= set(found)
    assert {"POST /api/move", "POST /api/play", "DELETE /api/jobs/{job}", "POST /api/lease"} <= seen
    assert {route.partition(" ")[2] for route in seen} <= set(SCHEMA["paths"])
    assert "Last-Event-ID".lower() in {
        each["name"].lower() for each in SCHEMA["paths"]["/api/events"]["get"]["parameters"]
    }


def test_every_code_of_the_gateway_is_an_error_of_its_own_and_no_other() -> None:
    described = set(SCHEMA["components"]["schemas"]["Problem"]["properties"]["code"]["enum"])
    assert {code for code, _ in BY_CODE} | {GatewayError.code} == described
    for code in described:
        error = error_of(code, "Why.")
        assert (error.code, str(error)) == (code, "Why.")


@pytest.mark.parametrize(
    ("code", "status", "kind"),
    [("busy", 429, BusyError), ("busy", 409, MovingError), ("tooMany", 429, TooManyError)],
)
def test_the_status_tells_two_errors_of_one_code_apart(
    code: str, status: int, kind: type[GatewayError]
) -> None:
    assert type(error_of(code, "Why.", status)) is kind


def test_an_error_has_all_that_the_gateway_said_of_it() -> None:
    busy = error_of("portBusy", "Why.", held_by=("cura (7)",))
    assert isinstance(busy, PortBusyError)
    assert busy.held_by == ("cura (7)",)
    assert error_of("tooMany", "Why.", wait_s=2).headers == {"Retry-After": "2"}
    newer = error_of("unheardOf", "Why.")
    assert (type(newer), str(newer)) == (GatewayError, "Why. (unheardOf)")
    assert (UnreachableError.code, TimedOutError.code) == ("noAnswer", "noAnswer")
