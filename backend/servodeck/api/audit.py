"""The list of acts over HTTP, for owners: by pages, and as a file.

Decides nothing: `access/audit.py` keeps the list.
"""

from itertools import islice
from typing import Annotated, Literal

from fastapi import Query
from starlette.responses import Response

from servodeck.access.audit import Act, Entry
from servodeck.access.audit_file import as_csv, as_json_lines
from servodeck.api.routes import OWNER, Audited, routes
from servodeck.schema import Message
from servodeck.threads import in_thread

MAX_PAGE = 200
audit_api = routes("/api", "audit")


class AuditEntry(Message):
    """`count` such acts from `atMs` until `untilMs`. `who` did it, null where no person did, to `whom`; both
    are names at that time. `about`: a slot, a servo, a role, a cause, a port or a document.
    """

    id: int
    act: Act
    who: str | None
    whom: str
    about: str
    at_ms: int
    until_ms: int
    count: int


class AuditPage(Message):
    """The newest first. `more`: there are older ones. `names`: of all who did something. `problem`: why the
    list is not stored at present; it is held in memory then.
    """

    entries: list[AuditEntry]
    more: bool
    names: list[str]
    problem: str | None


Kind = Annotated[Act | None, Query(alias="act", description="Only of this kind.")]
Person = Annotated[str | None, Query(max_length=64, description="Only of this person, by name.")]


@audit_api.get("/audit", dependencies=[OWNER])
async def read(
    audit: Audited,
    before: Annotated[int | None, Query(ge=0, description="Only older ones than that entry.")] = None,
    limit: Annotated[int, Query(ge=1, le=MAX_PAGE)] = 50,
    act: Kind = None,
    who: Person = None,
) -> AuditPage:
    """Who did what, and when: the newest 10,000 entries."""
    found = list(islice(audit.find(before, act, who), limit + 1))
    return AuditPage(
        entries=[entry_of(one) for one in found[:limit]],
        more=len(found) > limit,
        names=audit.names,
        problem=audit.problem,
    )


def entry_of(entry: Entry) -> AuditEntry:
    return AuditEntry(
        id=entry.id,
        act=entry.act,
        who=entry.who,
        whom=entry.whom,
        about=entry.about,
        at_ms=entry.at_ms,
        until_ms=entry.until_ms,
        count=entry.count,
    )


FORMATS = {"csv": (as_csv, "text/csv"), "jsonl": (as_json_lines, "application/jsonl")}


@audit_api.get(
    "/audit/file",
    dependencies=[OWNER],
    status_code=200,
    response_class=Response,
    responses={200: {"content": {"text/csv": {}, "application/jsonl": {}}}},
)
async def export(
    audit: Audited,
    format_: Annotated[Literal["csv", "jsonl"], Query(alias="format")] = "csv",
    act: Kind = None,
    who: Person = None,
) -> Response:
    """The whole list as CSV or as JSON lines, the newest first. Times are UTC."""
    write, media_type = FORMATS[format_]
    found = list(audit.find(None, act, who))
    text = await in_thread(lambda: write(found))
    name = f'attachment; filename="servodeck-audit.{format_}"'
    return Response(text, media_type=media_type, headers={"Content-Disposition": name})
