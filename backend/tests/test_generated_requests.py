"""Requests generated from the description of the HTTP interface, against a real gateway: for each of them,
the answer is one that the description tells, no defect, and the robot still hears a stop.
"""

import asyncio
import json
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from urllib.request import Request, urlopen

import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from schemathesis import Case, GenerationMode
from schemathesis.checks import (
    content_type_conformance,
    negative_data_rejection,
    response_schema_conformance,
    status_code_conformance,
)
from schemathesis.schemas import APIOperation

from servodeck.errors import PortBusyError
from servodeck.library.library import Library
from servodeck.port.ports import OpenPort
from servodeck.port.whereabouts import UsbDevice
from tests.amount import TIMES
from tests.fake_port import FakePort
from tests.running import DEVICE, Running, server_on
from tests.samples import BATTERY, BATTERY_REPORT, ERASE, STOP
from tests.test_openapi import SCHEMA

pytestmark = pytest.mark.slow

# Without these a second of each example would pass in waiting.
ANSWERS = {BATTERY: BATTERY_REPORT, ERASE: bytes.fromhex("55550208")}
RUN_TAKEN, RUN_COMMAND = bytes.fromhex("55550206"), 6
ENDLESS = "/api/events"
DEFECT = 500
# Also a refusal, if the body is too large to be read.
TOO_LARGE = 413
EXAMPLES = 3 * TIMES
Operation = APIOperation[Any, Any, Any, Any]
AnyCase = Case[Any]
CHECKS = [content_type_conformance, response_schema_conformance, status_code_conformance]


class AnsweringPort(FakePort):
    def write(self, data: bytes) -> None:
        super().write(data)
        answer = RUN_TAKEN if data[3] == RUN_COMMAND else ANSWERS.get(data)
        if answer:
            asyncio.get_running_loop().call_later(0.02, self.say, answer)


class OnePlace:
    """A board that can be opened again and again; every other request is taken."""

    def __init__(self) -> None:
        self.opened: list[AnsweringPort] = []

    async def open(self, device: str) -> AnsweringPort:
        if device != DEVICE:
            raise PortBusyError("Another program uses it.")
        self.opened.append(AnsweringPort())
        return self.opened[-1]

    async def close(self, port: OpenPort) -> None:
        port.close()

    async def list_usb(self) -> list[UsbDevice]:
        return []

    async def find_rate(self, device: str) -> None:
        """Nothing that can be read arrives there."""


@dataclass
class Gateway:
    """In a thread of its own: schemathesis waits for each answer."""

    running: Running
    ports: OnePlace

    @property
    def url(self) -> str:
        return f"http://{self.running.host}"

    def ask(self, method: str, path: str, body: object = None) -> Any:
        text = None if body is None else json.dumps(body).encode()
        request = Request(self.url + path, text, {"Content-Type": "application/json"}, method=method)
        with urlopen(request, timeout=5) as answer:
            return json.load(answer)

    def settle(self) -> None:
        """The port is open and motion allowed, after any request before."""
        if self.ask("GET", "/api/status")["port"]["status"] != "open":
            self.ask("PUT", "/api/port", {"device": DEVICE, "board": "doc"})
        self.ask("POST", "/api/resume")


@pytest.fixture(scope="module")
def gateway(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Gateway]:
    ports, library = OnePlace(), Library(tmp_path_factory.mktemp("data"))
    started: list[Running] = []
    is_ready, may_end = threading.Event(), threading.Event()

    async def live() -> None:
        async with server_on(ports, library=library) as running:
            started.append(running)
            is_ready.set()
            await asyncio.to_thread(may_end.wait)

    thread = threading.Thread(target=lambda: asyncio.run(live()))
    thread.start()
    assert is_ready.wait(10)
    yield Gateway(started[0], ports)
    may_end.set()
    thread.join(10)
    library.close()


def operations() -> list[Operation]:
    found = [result.ok() for result in schemathesis.openapi.from_dict(SCHEMA).get_all_operations()]  # type: ignore[union-attr]
    return [operation for operation in found if operation.path != ENDLESS]


def cases() -> Iterator[Any]:
    """Each operation with right requests, and with wrong ones where anything of it can be wrong."""
    for operation in operations():
        yield pytest.param(operation, GenerationMode.POSITIVE, id=f"{operation.label}-right")
        if operation.body or operation.path_parameters:
            yield pytest.param(operation, GenerationMode.NEGATIVE, id=f"{operation.label}-wrong")


@pytest.mark.parametrize(("operation", "mode"), [*cases()])
def test_every_answer_is_one_that_is_described(
    gateway: Gateway, operation: Operation, mode: GenerationMode
) -> None:
    gateway.settle()

    @settings(max_examples=EXAMPLES, suppress_health_check=list(HealthCheck))
    @given(case=operation.as_strategy(mode))
    def ask(case: AnyCase) -> None:
        answer = case.call(base_url=gateway.url)
        assert answer.status_code != DEFECT
        is_wrong = mode is GenerationMode.NEGATIVE and answer.status_code != TOO_LARGE
        checks = [*CHECKS, negative_data_rejection] if is_wrong else CHECKS
        case.validate_response(answer, checks=checks)

    ask()


def test_after_all_of_it_a_stop_is_heard_and_motion_may_be_allowed(gateway: Gateway) -> None:
    gateway.settle()
    gateway.ask("POST", "/api/stop")  # with those of a port just opened, which another press would join
    port = gateway.ports.opened[-1]
    before = len(port.written)
    stopped = gateway.ask("POST", "/api/stop")
    assert (stopped["latch"], stopped["halted"]) == (True, True)
    assert [packet for _, packet in port.written[before:]].count(STOP) >= 3
    assert gateway.ask("POST", "/api/resume")["latch"] is False
