"""The text of a robot document: its facts, or what is wrong with it, as the page reads it."""

import json
from typing import Any

import pytest

from servodeck.robot.document import RobotFlawError, robot_facts
from tests.vectors import load_vectors

VECTORS = load_vectors("robots")


def text_of(case: dict[str, Any]) -> str:
    robot = {"format": "servodeck-robot", "version": 1, "robot": VECTORS["robot"] | case.get("robot", {})}
    poses = {"format": "servodeck-poses", "version": 1, "content": case.get("poses", VECTORS["posesBook"])}
    kit = {
        "robot": case.get("robotText", json.dumps(case.get("robotFile", robot))),
        "poses": case.get("posesText", json.dumps(case.get("posesFile", poses))),
        "buttons": "anything",
        "pad": None,
    }
    return str(case.get("kitText", json.dumps({"format": "servodeck-robot-kit", "version": 1, "kit": kit})))


@pytest.mark.parametrize("case", VECTORS["cases"], ids=lambda case: case["what"])
def test_says_the_same_as_the_page(case: dict[str, Any]) -> None:
    if "facts" in case:
        assert robot_facts(text_of(case), 7).model_dump() == VECTORS["facts"] | case["facts"]
    else:
        with pytest.raises(RobotFlawError) as refused:
            robot_facts(text_of(case), 7)
        assert refused.value.flaw == case["flaw"].split()[0]
        field = case["flaw"].split()[1:]
        assert all(name in refused.value.detail for name in field)


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 900 + "1" + "}" * 900, "{}" + "\0"])
def test_nests_as_deep_as_it_likes(text: str) -> None:
    with pytest.raises(RobotFlawError):
        robot_facts(text, 7)


def test_a_flood_of_values_is_refused_unparsed() -> None:
    robot = json.dumps({"format": "servodeck-robot", "version": 1, "robot": [[]] * 300_000})
    kit = {"robot": robot, "poses": None, "buttons": None, "pad": None}
    with pytest.raises(RobotFlawError, match="no servodeck-robot"):
        robot_facts(json.dumps({"format": "servodeck-robot-kit", "version": 1, "kit": kit}), 7)
