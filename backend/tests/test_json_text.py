"""What SQLite finds in a text is what Python finds there."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.schema import has_more_values, is_object
from tests.amount import TIMES

VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=12,
)
PIECES = st.sampled_from([*'{}[]",:\\ 0-1.e', "null", "true", "\n", "\0", "\ufeff", "\ud800", '"x"', '"a":'])


@st.composite
def texts(draw: st.DrawFn) -> str:
    """JSON in one of its spellings, and often with something that does not belong there."""
    indent, is_ascii = draw(st.sampled_from([None, 1])), draw(st.booleans())
    text = json.dumps(draw(VALUES), indent=indent, ensure_ascii=is_ascii)
    at = draw(st.integers(0, len(text)))
    wrong: list[str] = [text[:at] + draw(PIECES) + text[at:], text[:at] + text[at + 1 :]]
    return draw(st.sampled_from([text, *wrong]))


def refuse_constant(name: str) -> None:
    raise ValueError(name)


def python_finds_object(text: str) -> bool:
    try:
        text.encode()
        return isinstance(json.loads(text, parse_constant=refuse_constant), dict)
    except ValueError:
        return False


def count_of(value: object) -> int:
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + sum(map(count_of, inner))


@settings(max_examples=300 * TIMES)
@given(text=st.one_of(texts(), st.lists(PIECES, max_size=8).map("".join)))
def test_it_takes_for_an_object_what_python_does(text: str) -> None:
    assert is_object(text) == python_finds_object(text)


@settings(max_examples=100 * TIMES)
@given(value=VALUES)
def test_it_counts_every_value(value: object) -> None:
    text, count = json.dumps(value), count_of(value)
    assert (has_more_values(text, count - 1), has_more_values(text, count)) == (True, False)


@pytest.mark.parametrize("text", ["", "[", "[1,]", f"[{math.nan}]", "[" * 100_000])
def test_what_is_no_json_has_no_count(text: str) -> None:
    with pytest.raises(ValueError, match="JSON"):
        has_more_values(text, 1)
