"""Strict models (unknown fields are refused), the JSON schemas from which the page's types are generated, and
checks of large JSON before Python makes objects of it.

Large JSON is parsed by SQLite: Python's own parser keeps every other thread waiting until it is through (3 MB
of empty lists: 0.6 s, in which a stop waits); SQLite's does not. Knows no message.
"""

import sqlite3
import warnings
from contextlib import closing
from typing import Any

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError
from pydantic.alias_generators import to_camel
from pydantic.json_schema import GenerateJsonSchema
from pydantic.warnings import UnsupportedFieldAttributeWarning

# The framework gives a body its parameter's name, and hushes this where it builds it itself.
warnings.filterwarnings("ignore", category=UnsupportedFieldAttributeWarning)


class Message(BaseModel):
    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        frozen=True,
        alias_generator=to_camel,
        populate_by_name=True,
        serialize_by_alias=True,
        json_schema_serialization_defaults_required=True,
        defer_build=True,  # a start sends few of them; building all was a sixth of its time
    )


def first_problem(error: ValidationError) -> str:
    """One line: where and what; never the input itself."""
    problem = error.errors(include_url=False, include_context=False, include_input=False)[0]
    where = ".".join(str(part) for part in problem["loc"])
    return f"{where}: {problem['msg']}" if where else problem["msg"]


class PlainSchema(GenerateJsonSchema):
    """Without a title for each field, which would become a type name of its own in TypeScript."""

    def field_title_should_be_set(self, _schema: Any) -> bool:
        return False


def schema_of(title: str, read: dict[str, Any], written: dict[str, Any]) -> dict[str, Any]:
    """One schema whose $defs hold those named types and all they consist of."""
    types = [(name, "validation", TypeAdapter(each)) for name, each in read.items()]
    types += [(name, "serialization", TypeAdapter(each)) for name, each in written.items()]
    names, definitions = TypeAdapter.json_schemas(
        types,  # type: ignore[arg-type]
        ref_template="#/$defs/{model}",
        schema_generator=PlainSchema,
    )
    unions = {name: {**schema, "title": name} for (name, _mode), schema in names.items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "oneOf": [{"$ref": f"#/$defs/{name}"} for name in unions],
        "$defs": {**definitions["$defs"], **unions},
    }


def is_object(text: str) -> bool:
    """Whether it is a JSON object as RFC 8259 has it."""
    if "\0" in text:  # SQLite ends there
        return False
    try:
        # json_type takes no text that json_valid refuses.
        query = "SELECT json_valid(?1) AND CASE WHEN json_valid(?1) THEN json_type(?1) END = 'object'"
        return bool(answer_to(query, text))
    except UnicodeEncodeError:
        return False


def has_more_values(text: str, most: int) -> bool:
    """Whether it has more values than `most`, at all depths. Raises ValueError where it is no JSON."""
    try:
        return int(answer_to("SELECT count(*) FROM json_tree(?)", text)) > most
    except sqlite3.OperationalError as error:
        raise ValueError(str(error)) from error


def text_member(text: str, name: str) -> str | None:
    """That member of a JSON object, where it is a text."""
    if not is_object(text):
        return None
    query = "SELECT value FROM json_each(?) WHERE key = ? AND type = 'text'"
    with closing(sqlite3.connect(":memory:")) as db:
        row = db.execute(query, (text, name)).fetchone()
    return str(row[0]) if row else None


def answer_to(question: str, text: str) -> int:
    with closing(sqlite3.connect(":memory:")) as db:
        return int(db.execute(question, (text,)).fetchone()[0] or 0)
