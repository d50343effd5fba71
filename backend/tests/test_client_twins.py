"""The client says the same words as the one for TypeScript: shared/protocol/client.json, which
shared/src/client/twins.test.ts reads, too.
"""

import inspect
import json
from collections.abc import Callable
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
from pydantic.alias_generators import to_camel

from servodeck import client
from servodeck.client import AsyncRobot, Robot, Servo, Snapshot
from servodeck.errors import GatewayError

WORDS = json.loads((Path(__file__).parents[2] / "shared/protocol/client.json").read_text("utf-8"))
# Of a port of this computer, which only Python opens.
OF_A_PORT = {"board", "robot"}


def words_of(method: Callable[..., Any]) -> dict[str, list[str]]:
    taken = [each for each in inspect.signature(method).parameters.values() if each.name != "self"]
    named = {each.name for each in taken if each.kind is each.KEYWORD_ONLY}
    return {
        "arguments": [to_camel(each.name) for each in taken if each.name not in named],
        "options": [to_camel(each.name) for each in taken if each.name in named - OF_A_PORT],
    }


@pytest.mark.parametrize("robot", [Robot, AsyncRobot])
def test_each_method_takes_the_arguments_and_options_of_its_twin(robot: type) -> None:
    methods = {name: method for name, method in vars(robot).items() if not name.startswith("_")}
    assert {to_camel(name): words_of(method) for name, method in methods.items()} == WORDS["methods"]
    assert words_of(vars(robot)["__init__"]) == WORDS["opening"]


@pytest.mark.parametrize("value", [Servo, Snapshot])
def test_values_have_the_fields_of_their_twins(value: type) -> None:
    assert [to_camel(field.name) for field in fields(value)] == WORDS["values"][value.__name__]


def test_the_errors_have_the_names_of_their_twins() -> None:
    names = {GatewayError.__name__, *(name for name in client.__all__ if name.endswith("Error"))}
    assert names == set(WORDS["errors"])
