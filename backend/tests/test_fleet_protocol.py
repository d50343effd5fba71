"""docs/fleet-protocol.md says what the models take: each of its examples is parsed by the model of its topic,
and each verb has its row. docs/adr/0048 names the tests of all faults: they exist.
"""

import re
from pathlib import Path

import pytest
from pydantic import TypeAdapter

from servodeck.fleet.messages import REPORTS, REQUESTS, Answer
from servodeck.fleet.rules import LEAST_ROLE
from servodeck.fleet.topics import VERBS, Command, Published, Reply, Site

DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "fleet-protocol.md").read_text("utf-8")
EXAMPLES = re.findall(r"^`(sd/1/[^`]+)`\n\n```json\n(.+?)^```$", TEXT, re.MULTILINE | re.DOTALL)
LAB = Site("lab")


def adapter_of(topic: str) -> TypeAdapter[object]:
    match LAB.parse(topic):
        case Published(_, kind):
            return TypeAdapter(REPORTS[kind])
        case Command(_, _, _, verb) if verb in VERBS:
            return TypeAdapter(REQUESTS[verb])
        case Reply():
            return TypeAdapter(Answer)
    raise AssertionError(topic)


@pytest.mark.parametrize(("topic", "text"), EXAMPLES, ids=[topic for topic, _ in EXAMPLES])
def test_an_example_is_of_its_model_and_has_all_its_fields(topic: str, text: str) -> None:
    adapter = adapter_of(topic)
    parsed = adapter.validate_json(text)
    again = adapter.validate_json(adapter.dump_json(parsed))
    assert again == parsed
    # A request may leave out what has a default.
    if not isinstance(LAB.parse(topic), Command):
        shown = adapter.dump_python(parsed, mode="json", exclude_unset=True)
        assert shown == adapter.dump_python(parsed, mode="json")


def test_every_report_and_request_has_an_example() -> None:
    shown = {topic.rpartition("/")[2] for topic, _ in EXAMPLES}
    assert shown >= {*REPORTS, *REQUESTS}


def test_the_table_has_each_verb_with_its_role() -> None:
    rows = dict(re.findall(r"^\| `(\w+)` +\| (\w+) ", TEXT, re.MULTILINE))
    assert rows == LEAST_ROLE


def test_each_fault_is_played_by_a_test() -> None:
    decision = (DOCS / "adr" / "0048-a-broker-as-a-door.md").read_text("utf-8")
    _, *rows = re.findall(r"^\|.+\|(.+)\|$", decision, re.MULTILINE)
    named = [re.findall(r"`(test_\w+)`", row) for row in rows[1:]]
    assert all(named)
    written = "".join(file.read_text("utf-8") for file in Path(__file__).parent.glob("test_fleet_*.py"))
    assert {name for names in named for name in names} <= set(re.findall(r"def (test_\w+)\(", written))


@pytest.mark.parametrize("name", ["", "a/b", "+", "#", "a b", "-a", "x" * 65])
def test_a_site_has_a_name_that_fits_into_a_topic(name: str) -> None:
    with pytest.raises(ValueError, match="no name of a site"):
        Site(name)


def test_topics_are_parsed_as_they_are_built() -> None:
    assert LAB.parse(LAB.published("arm-1", "state")) == Published("arm-1", "state")
    assert LAB.parse(LAB.command("all", "stopper", "anna", "stop")) == Command(
        "all", "stopper", "anna", "stop"
    )
    assert LAB.parse(LAB.reply("anna", "7c1d")) == Reply("anna", "7c1d")
    for foreign in ("sd/1/other/arm-1/state", "sd/1/lab/all/state", "sd/1/lab/arm-1/more", "home/lamp"):
        assert LAB.parse(foreign) is None
