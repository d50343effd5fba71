"""The library over HTTP. Translates between messages and `library`; decides only what text is a document.

Plain functions, because the library waits for a disk: they run in threads, where STOP does not wait for them.
"""

import json
from typing import Annotated

from fastapi import APIRouter, Depends, Path
from starlette.requests import HTTPConnection

from servodeck.api import Problem, called_by_own_page
from servodeck.callers import Caller
from servodeck.errors import MalformedError
from servodeck.library import Library, Version
from servodeck.library_messages import (
    DocumentIds,
    DocumentWrite,
    DocumentWritten,
    Facts,
    LibraryListing,
    ListedDocument,
    ListedVersion,
    StoredDocument,
    VersionText,
    VersionWrite,
)
from servodeck.roles import DRIVER, OWNER, VIEWER


async def library_of(connection: HTTPConnection) -> Library:
    library = connection.app.state.library
    assert isinstance(library, Library)
    return library


Kept = Annotated[Library, Depends(library_of)]
Id = Annotated[str, Path(pattern=r"^[A-Za-z0-9-]{1,64}$")]
library_api = APIRouter(
    prefix="/api/library",
    dependencies=[Depends(called_by_own_page)],
    responses={"4XX": {"model": Problem}, "5XX": {"model": Problem}},
)


@library_api.get("", dependencies=[VIEWER])
def list_documents(library: Kept) -> LibraryListing:
    """Every document, those in the trash too."""
    documents = [
        ListedDocument(
            id=one.id,
            revision=one.revision,
            is_removed=one.is_removed,
            facts=Facts.model_validate_json(one.facts),
        )
        for one in library.list()
    ]
    return LibraryListing(documents=documents, set_aside=library.set_aside)


@library_api.post("/remove", status_code=204, dependencies=[OWNER])
def remove(documents: DocumentIds, library: Kept) -> None:
    """Puts them into the trash for 30 days: all or none."""
    library.remove(documents.ids)


@library_api.post("/restore", status_code=204, dependencies=[DRIVER])
def restore(documents: DocumentIds, library: Kept) -> None:
    """Takes them out of the trash: all or none."""
    library.restore(documents.ids)


@library_api.get("/{document}", dependencies=[VIEWER])
def read(document: Id, library: Kept) -> StoredDocument:
    """The text of a document, also of one in the trash."""
    text, revision = library.read(document)
    return StoredDocument(text=text, revision=revision)


@library_api.put("/{document}")
def write(
    document: Id, wanted: DocumentWrite, library: Kept, caller: Annotated[Caller, DRIVER]
) -> DocumentWritten:
    """Keeps a text; 412, and nothing changed, where the document is at another revision with another text."""
    check_document(wanted.text)
    facts = wanted.facts.model_dump_json()
    if wanted.is_removed and not caller.may("owner"):
        library.require_removed(document)
    revision = library.write(document, wanted.text, facts, wanted.expected, is_removed=wanted.is_removed)
    return DocumentWritten(revision=revision)


@library_api.get("/{document}/versions", dependencies=[VIEWER])
def list_versions(document: Id, library: Kept) -> list[ListedVersion]:
    """Its named versions, oldest first."""
    return [ListedVersion(id=one.id, name=one.name, at_ms=one.at_ms) for one in library.versions(document)]


@library_api.get("/{document}/versions/{version}", dependencies=[VIEWER])
def read_version(document: Id, version: Id, library: Kept) -> VersionText:
    """The text that was kept under that version's name."""
    return VersionText(text=library.read_version(document, version))


@library_api.put("/{document}/versions/{version}", status_code=204, dependencies=[DRIVER])
def keep_version(document: Id, version: Id, wanted: VersionWrite, library: Kept) -> None:
    """Keeps a text beside the document under a name."""
    check_document(wanted.text)
    library.keep_version(document, Version(version, wanted.name, wanted.at_ms), wanted.text)


@library_api.delete("/{document}/versions/{version}", status_code=204, dependencies=[DRIVER])
def remove_version(document: Id, version: Id, library: Kept) -> None:
    """That version goes for good; the document and its other versions stay."""
    library.remove_version(document, version)


def check_document(text: str) -> None:
    try:
        is_object = isinstance(json.loads(text), dict)
    except (ValueError, RecursionError):
        is_object = False
    if not is_object:
        raise MalformedError("A document is a JSON object.")
