"""What pages and the library say to each other over HTTP, as strict models.

The only description of it: `python -m servodeck.library.library_messages` prints the JSON
schema from which the page's types are generated. Knows no file and no route.
"""

import json
import sys
from typing import Annotated, Any, Literal

from pydantic import Field, TypeAdapter

from servodeck.schema import Message, schema_of
from servodeck.snapshots import Name, PoseTarget, RobotFacts, Whole

MAX_TEXT = 2 * 1024 * 1024

Id = Annotated[str, Field(pattern=r"^[A-Za-z0-9-]{1,64}$")]
Text = Annotated[
    str, Field(max_length=MAX_TEXT, description="The document as JSON; only the page knows what it means.")
]


class GroupFacts(Message):
    """What a list says of an action group without reading it; `pose` is its picture."""

    kind: Literal["group"]
    name: Name
    robot: Name
    tags: Annotated[list[Name], Field(max_length=20)]
    updated_at_ms: Whole
    frames: Whole
    duration_ms: Whole
    unit: Literal["us", "steps"]
    pose: Annotated[list[PoseTarget], Field(max_length=256)]


Facts = Annotated[GroupFacts | RobotFacts, Field(discriminator="kind")]
facts_of: TypeAdapter[GroupFacts | RobotFacts] = TypeAdapter(Facts)


def unknown_facts(document: str, kind: str) -> Facts:
    """Of a document whose own are damaged: it stays in the list, can be opened, and is written anew then."""
    facts: dict[str, Any] = {"kind": kind, "name": f"Damaged: {document}"[:64], "updatedAtMs": 0}
    if kind == "robot":
        return facts_of.validate_python(facts | {"board": "", "limits": [], "poses": []})
    empty = {"robot": "", "tags": [], "frames": 0, "durationMs": 0, "unit": "us", "pose": []}
    return facts_of.validate_python(facts | empty)


class ListedDocument(Message):
    id: Id
    revision: Whole
    is_removed: bool
    facts: Facts


class LibraryListing(Message):
    """`damagedFile` names a damaged file that was found and kept; `changesLost`: the last changes before the
    gateway's start may be missing.
    """

    documents: list[ListedDocument]
    damaged_file: str | None
    changes_lost: bool


class StoredDocument(Message):
    text: Text
    revision: Whole


class DocumentWrite(Message):
    """`expected` is the revision it was read at, 0 for a new one. With `isRemoved` it goes to the trash at
    once: several that shall appear together are written so and then restored together.
    """

    text: Text
    facts: Facts
    expected: Whole
    is_removed: bool


class DocumentWritten(Message):
    revision: Whole


class DocumentIds(Message):
    ids: Annotated[list[Id], Field(max_length=5000)]


class ListedVersion(Message):
    id: Id
    name: Name
    at_ms: Whole


class VersionText(Message):
    text: Text


class VersionWrite(Message):
    name: Name
    at_ms: Whole
    text: Text


if __name__ == "__main__":
    said = {"LibraryRequest": DocumentWrite | DocumentIds | VersionWrite}
    answered = {
        "LibraryAnswer": LibraryListing | StoredDocument | DocumentWritten | list[ListedVersion] | VersionText
    }
    json.dump(schema_of("Library", said, answered), sys.stdout, indent=2)
    sys.stdout.write("\n")
