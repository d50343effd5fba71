"""The library over HTTP, and the choice of the robot on the board.

Translates between messages, `library` and `control`; decides only what text is a document, and
computes the facts of a robot. The library waits for a disk: in threads, where STOP does not wait for it.
"""

import json
import logging
import secrets
from typing import Annotated, Any, Literal

from fastapi import Depends, Path
from pydantic import Field, TypeAdapter
from starlette.concurrency import run_in_threadpool
from starlette.requests import HTTPConnection

from servodeck.api.routes import DRIVER, OWNER, VIEWER, Controlled, leaves, routes
from servodeck.callers import Caller, as_script
from servodeck.errors import GatewayError, MalformedError, NotDrivingError, OutOfRangeError
from servodeck.library.library import Library, Listed, Version, wall_clock_ms
from servodeck.robot.control import Control
from servodeck.robot.document import KIT_FORMAT, is_kit, robot_facts
from servodeck.robot.profile import ReadFacts
from servodeck.schema import Message, is_object
from servodeck.snapshots import Name, PoseTarget, RobotFacts, Whole

MAX_TEXT = 2 * 1024 * 1024
DRAFT = "draft"
"""The tag of a group that was proposed and that a person has not taken yet."""
MAX_DRAFTS = 20
GROUP_FORMAT = "servodeck-group"
MAX_NAME = 64
log = logging.getLogger("servodeck.library")

Id = Annotated[str, Field(pattern=r"^[A-Za-z0-9-]{1,64}$")]
Text = Annotated[
    str, Field(max_length=MAX_TEXT, description="The document as JSON; only the page knows what it means.")
]


class GroupFacts(Message):
    """The entry of an action group in a list, known without reading its text; `pose` is its picture."""

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
    """Stands in for damaged facts of a document: it stays in the list, can be opened, and is rewritten
    then.
    """
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
    """`damagedFile` names a damaged file that was found and set apart; `changesLost`: the last changes before
    the gateway's start may be missing.
    """

    documents: list[ListedDocument]
    damaged_file: str | None
    changes_lost: bool


class StoredDocument(Message):
    text: Text
    revision: Whole


class DocumentWrite(Message):
    """`expected` is the revision at which it was read, 0 for a new one. `isRemoved` writes it to the trash:
    several documents that are to appear together are written so, and then restored together. `facts` are
    those of a group; a robot's are computed from its text, whatever is said here.

    """

    text: Text
    facts: Facts | None = None
    expected: Whole
    is_removed: bool


class DocumentWritten(Message):
    revision: Whole


class Draft(Message):
    """A group that is to be looked at before it is played. Its tags are the gateway's: `draft`, and who
    proposes it.
    """

    text: Text
    facts: GroupFacts


class DraftStored(Message):
    id: Id


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


async def library_of(connection: HTTPConnection) -> Library:
    library = connection.app.state.library
    assert isinstance(library, Library)
    return library


def robots_in(library: Library) -> ReadFacts:
    """Reads the facts of robots from their texts, for the robot on the board. The stored ones stand in for
    a text that cannot be read: a version of before stored any.
    """

    def read(document: str) -> tuple[RobotFacts, int]:
        stored, revision = library.facts_of(document, "robot")
        facts = RobotFacts.model_validate_json(stored)
        try:
            text, revision_of_text = library.read(document)
            return robot_facts(text, facts.updated_at_ms), revision_of_text
        except GatewayError as error:
            log.warning("robot not read from its text", extra={"facts": {"detail": error.detail}})
            return facts, revision

    return read


OfLibrary = Annotated[Library, Depends(library_of)]
IdInPath = Annotated[str, Path(pattern=r"^[A-Za-z0-9-]{1,64}$")]
library_api = routes("/api/library", "library")


@library_api.get("", dependencies=[VIEWER])
def list_documents(library: OfLibrary) -> LibraryListing:
    """Every document, also those in the trash."""
    documents = [
        ListedDocument(
            id=one.id,
            revision=one.revision,
            is_removed=one.is_removed,
            facts=facts_of.validate_json(one.facts) if one.facts else unknown_facts(one.id, one.kind),
        )
        for one in library.list()
    ]
    return LibraryListing(
        documents=documents, damaged_file=library.damaged_file, changes_lost=library.changes_lost
    )


@library_api.post("/remove", status_code=204, dependencies=[OWNER, leaves("libraryRemoved")])
async def remove(documents: DocumentIds, library: OfLibrary, control: Controlled) -> None:
    """Puts them into the trash for 30 days: all or none."""
    await run_in_threadpool(library.remove, documents.ids)
    control.robot.removed(documents.ids)


@library_api.post("/restore", status_code=204, dependencies=[DRIVER, leaves("libraryRestored")])
def restore(documents: DocumentIds, library: OfLibrary) -> None:
    """Takes them out of the trash: all or none."""
    library.restore(documents.ids)


@library_api.post("/drafts", dependencies=[leaves("librarySaved")])
def propose(draft: Draft, library: OfLibrary, caller: Annotated[Caller, VIEWER]) -> DraftStored:
    """Adds a group as a draft. It changes nothing that is there and plays nothing, so viewers may; a person
    opens it on the page. 20 drafts at most.
    """
    tags = [DRAFT, f"by {as_script(caller).name}"[:MAX_NAME]]
    text = tagged(draft.text, tags)
    if sum(is_draft(one) for one in library.list()) >= MAX_DRAFTS:
        raise OutOfRangeError(f"There are {MAX_DRAFTS} drafts, which is the limit. Delete some first.")
    document = f"draft-{secrets.token_hex(8)}"
    library.write(document, text, draft.facts.model_copy(update={"tags": tags}).model_dump_json(), 0)
    return DraftStored(id=document)


def tagged(text: str, tags: list[str]) -> str:
    """The text of an action group with these tags, whatever it claimed. Raises MalformedError."""
    check_document(text)
    document = json.loads(text)
    if document.get("format") != GROUP_FORMAT or not isinstance(document.get("content"), dict):
        raise MalformedError("A draft is an action group: docs/group.schema.json.")
    document["content"]["tags"] = tags
    return json.dumps(document, ensure_ascii=False)


def is_draft(one: Listed) -> bool:
    return not one.is_removed and one.facts is not None and DRAFT in json.loads(one.facts).get("tags", ())


@library_api.get("/{document}", dependencies=[VIEWER])
def read(document: IdInPath, library: OfLibrary) -> StoredDocument:
    """The text of a document, also of one in the trash."""
    text, revision = library.read(document)
    return StoredDocument(text=text, revision=revision)


@library_api.put("/{document}", dependencies=[leaves("librarySaved")])
async def write(
    document: IdInPath,
    wanted: DocumentWrite,
    library: OfLibrary,
    control: Controlled,
    caller: Annotated[Caller, DRIVER],
) -> DocumentWritten:
    """Stores a text. 412, without a change, where the document has another revision and another text. While a
    client drives, only that client and owners may change the limits of the robot on the board.

    """
    facts = await run_in_threadpool(facts_in, wanted)
    judge_limits(document, facts, control, caller)
    revision = await run_in_threadpool(keep, document, wanted, facts, library, caller)
    if isinstance(facts, RobotFacts):
        control.robot.written(document, revision, facts)
    return DocumentWritten(revision=revision)


def facts_in(wanted: DocumentWrite) -> Facts:
    """What the text says of itself counts. Raises MalformedError. Takes a while."""
    check_document(wanted.text)
    facts = wanted.facts
    if is_kit(wanted.text):
        if isinstance(facts, GroupFacts):
            raise MalformedError("facts: they describe a group, and the text is a robot")
        return robot_facts(wanted.text, facts.updated_at_ms if facts else wall_clock_ms())
    if isinstance(facts, GroupFacts):
        return facts
    raise MalformedError(
        "facts: those of a group are missing"
        if facts is None
        else f"text: a robot of the library is a {KIT_FORMAT}, as a page stores it"
    )


def judge_limits(document: str, facts: Facts, control: Control, caller: Caller) -> None:
    is_ruled = isinstance(facts, RobotFacts) and control.robot.changes_limits(document, facts)
    if is_ruled and not control.driving.may_rule(caller):
        raise NotDrivingError("Another client drives: only the driver or an owner may change the limits.")


def keep(document: str, wanted: DocumentWrite, facts: Facts, library: Library, caller: Caller) -> int:
    """Waits for the disk."""
    if wanted.is_removed and not caller.may("owner"):
        library.require_removed(document)
    return library.write(
        document,
        wanted.text,
        facts.model_dump_json(),
        wanted.expected,
        kind=facts.kind,
        is_removed=wanted.is_removed,
    )


@library_api.get("/{document}/versions", dependencies=[VIEWER])
def list_versions(document: IdInPath, library: OfLibrary) -> list[ListedVersion]:
    """Its named versions, oldest first."""
    return [ListedVersion(id=one.id, name=one.name, at_ms=one.at_ms) for one in library.versions(document)]


@library_api.get("/{document}/versions/{version}", dependencies=[VIEWER])
def read_version(document: IdInPath, version: IdInPath, library: OfLibrary) -> VersionText:
    """The text that was saved under that version's name."""
    return VersionText(text=library.read_version(document, version))


@library_api.put(
    "/{document}/versions/{version}", status_code=204, dependencies=[DRIVER, leaves("librarySaved")]
)
def keep_version(document: IdInPath, version: IdInPath, wanted: VersionWrite, library: OfLibrary) -> None:
    """Saves a text as a named version of the document."""
    check_document(wanted.text)
    library.keep_version(document, Version(version, wanted.name, wanted.at_ms), wanted.text)


@library_api.delete(
    "/{document}/versions/{version}", status_code=204, dependencies=[DRIVER, leaves("librarySaved")]
)
def remove_version(document: IdInPath, version: IdInPath, library: OfLibrary) -> None:
    """Deletes that version for good; the document and its other versions stay."""
    library.remove_version(document, version)


def check_document(text: str) -> None:
    if not is_object(text):
        raise MalformedError("The document must be a JSON object.")


class RobotChoice(Message):
    """`insteadOf`: the robot that the caller expects there."""

    id: Id
    instead_of: Id | None = None


robots_api = routes("/api", "robots")


@robots_api.put("/robot", status_code=204, dependencies=[leaves("robotChosen")])
async def put_on_board(choice: RobotChoice, control: Controlled, caller: Annotated[Caller, DRIVER]) -> None:
    """Puts that robot of the library on this board, for all clients. 412 where a third robot is there."""
    if not control.driving.may_rule(caller):
        raise NotDrivingError("Another client drives: only the driver or an owner may change the robot.")
    await control.robot.put(choice.id, choice.instead_of)
