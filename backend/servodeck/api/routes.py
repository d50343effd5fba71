"""How routes of the HTTP interface are made: each names the role that it takes, or that none is needed; one
that names nothing is not served. Role and rate are judged on the head, before a body is read.

Knows the entrance and how a framework's routes are built; no route of ours.
"""

import json
from collections.abc import Callable, Collection, Coroutine, Iterator, Sequence
from functools import cached_property
from typing import Annotated, Any

from fastapi import APIRouter, Depends
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute
from pydantic.alias_generators import to_camel
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection, Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Mount

from servodeck.access.audit import Act, Audit
from servodeck.access.connections import connection_of
from servodeck.access.entrance import Entrance
from servodeck.access.guard import judge_script
from servodeck.callers import Caller, Role, as_script
from servodeck.errors import MalformedError, StorageError
from servodeck.robot.control import Control
from servodeck.schema import has_more_values
from servodeck.threads import in_thread

MAX_SHOWN = 64
# Reading as much takes a millisecond or, of a hostile text, ten.
LARGE_BYTES = 64 * 1024
# More than the largest download has. Objects of so many take ten milliseconds, in which a stop waits.
MOST_VALUES = 64_000


class Needs:
    """A dependency: the caller, who must have `role`; None: every caller may."""

    def __init__(self, role: Role | None) -> None:
        self.role = role

    async def __call__(self, connection: HTTPConnection) -> Caller | None:
        if connection.scope["type"] == "websocket":
            return self.judge(connection)
        caller: Caller | None = connection.state.caller  # JudgingRoute has judged the head
        return caller

    def judge(self, connection: HTTPConnection) -> Caller | None:
        entrance = entrance_in(connection)
        headers = connection.scope["headers"]
        caller = entrance.find(headers) if self.role is None else entrance.judge(headers, self.role)
        if caller and (known := connection_of(connection.scope)):
            known.know()
        if caller and self.role not in (None, "stopper") and connection.scope["type"] == "http":
            entrance.count(caller)  # a stop is never one too many, and messages have their own rates
        return caller


class Note:
    """What the list of acts will say of a request once it has succeeded. A route may add to it; `act` None:
    nothing, because it changed nothing, or `robot/acts.py` notes it.
    """

    def __init__(self, act: Act | None, who: str | None) -> None:
        self.act = act
        self.who = who
        self.whom = ""
        self.about = ""
        self.has_taken_effect = False
        """It stands also where it cannot be stored."""


def leave(note: Note, request: Request) -> None:
    if note.act:
        audit_in(request).note(note.act, note.who, note.about, note.whom)


class Leaves:
    """A dependency: the act that a request leaves in the list."""

    def __init__(self, act: Act | None) -> None:
        self.act = act

    async def __call__(self, connection: HTTPConnection) -> Note:
        note = connection.state.note
        assert isinstance(note, Note)
        return note


class BodyRequest(Request):
    """Reads a large body in a thread, because a stop would have to wait for it."""

    async def json(self) -> Any:
        body = await self.body()
        return await in_thread(lambda: parse_large(body)) if len(body) > LARGE_BYTES else parse(body)


def parse(text: bytes | str) -> Any:
    """Raises JSONDecodeError, or HTTPException for a name that is given twice: which of both was meant is
    unknown.
    """
    return json.loads(text, object_pairs_hook=object_of)


def object_of(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    whole = dict(pairs)
    if len(whole) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise HTTPException(MalformedError.status, f"{twice} is given twice.")
    return whole


def parse_large(body: bytes) -> Any:
    """As `parse`. Raises HTTPException, too, where so much would be made of it that a stop waits."""
    text = body.decode()
    try:
        is_too_much = has_more_values(text, MOST_VALUES)
    except ValueError as error:
        raise json.JSONDecodeError(str(error), "", 0) from error
    if is_too_much:
        raise HTTPException(413, f"The request holds more than {MOST_VALUES} values.")
    return parse(text)


Handler = Callable[[Request], Coroutine[Any, Any, Response]]


class JudgingRoute(APIRoute):
    """Judges the head first; the framework reads the body before its dependencies."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        handle = self.noting(super().get_route_handler())

        async def judge_and_handle(request: Request) -> Response:
            self.judge(request)
            return await handle(BodyRequest(request.scope, request.receive))

        return judge_and_handle

    def noting(self, handle: Handler) -> Handler:
        """Notes the act of a request once it has succeeded."""
        named_acts = [each.act for each in leaves_of(self.dependant)]
        if not named_acts:
            return handle

        async def handle_and_note(request: Request) -> Response:
            caller = request.state.caller
            who = named(request, caller).name if caller else None
            note = request.state.note = Note(named_acts[0], who)
            try:
                response = await handle(request)
            except StorageError:
                if note.has_taken_effect:
                    leave(note, request)
                raise
            leave(note, request)
            return response

        return handle_and_note

    def judge(self, request: Request) -> None:
        """Raises a GatewayError for a caller who may not request this, or for a parameter that is none."""
        for needs in needs_of(self.dependant):
            request.state.caller = needs.judge(request)
        # A STOP is done whatever it carries.
        if not any(each.role == "stopper" for each in needs_of(self.dependant)):
            judge_query(request, self._query)

    @cached_property
    def _query(self) -> Collection[str]:
        """The parameters that it takes."""
        return set(query_of(self.dependant))


class ApiRoute(JudgingRoute):
    """Only our own page and programs get this far."""

    def judge(self, request: Request) -> None:
        judge_script(request.scope["headers"])
        super().judge(request)


def query_of(dependant: Dependant) -> Iterator[str]:
    """The names of the parameters that a route takes behind its address."""
    yield from (each.alias for each in dependant.query_params)
    for each in dependant.dependencies:
        yield from query_of(each)


def judge_query(request: Request, known: Collection[str]) -> None:
    """Raises MalformedError for a parameter that this route does not have: its default would be taken in
    silence.
    """
    for name in request.query_params:
        if name not in known:
            allowed = ", ".join(sorted(known)) or "none"
            raise MalformedError(f"{name[:MAX_SHOWN]} is no parameter here, allowed: {allowed}")


def entrance_in(connection: HTTPConnection) -> Entrance:
    entrance = connection.app.state.entrance
    assert isinstance(entrance, Entrance)
    return entrance


def audit_in(connection: HTTPConnection) -> Audit:
    audit = connection.app.state.audit
    assert isinstance(audit, Audit)
    return audit


def named(connection: HTTPConnection, caller: Caller) -> Caller:
    """A page says where it comes from, a program does not."""
    return caller if "origin" in connection.headers else as_script(caller)


async def audit_of(connection: HTTPConnection) -> Audit:
    return audit_in(connection)


async def entrance_of(connection: HTTPConnection) -> Entrance:
    return entrance_in(connection)


PUBLIC = Depends(Needs(None))
STOPPER = Depends(Needs("stopper"))
VIEWER = Depends(Needs("viewer"))
DRIVER = Depends(Needs("driver"))
OWNER = Depends(Needs("owner"))


def leaves(act: Act | None) -> Any:
    """The act that a route leaves in the list where it succeeds."""
    return Depends(Leaves(act))


SEEN_AT_ROBOT = leaves(None)
"""Of a route whose effect passes `robot/acts.py`."""


def named_roles(routes: Sequence[BaseRoute]) -> Iterator[tuple[BaseRoute, list[Role | None]]]:
    """Every route with the roles it names. What is mounted serves the page, which is no secret."""
    for route in routes:
        included = getattr(route, "original_router", None)
        if included:
            yield from named_roles(included.routes)
        elif not isinstance(route, Mount):
            yield route, [each.role for each in needs_of(getattr(route, "dependant", None))]


def needs_of(dependant: Dependant | None) -> Iterator[Needs]:
    for each in dependant.dependencies if dependant else ():
        if isinstance(each.call, Needs):
            yield each.call


def leaves_of(dependant: Dependant | None) -> Iterator[Leaves]:
    for each in dependant.dependencies if dependant else ():
        if isinstance(each.call, Leaves):
            yield each.call


READING = frozenset({"GET", "HEAD"})


def require_roles(routes: Sequence[BaseRoute]) -> None:
    """Denies by default: a route that was added without a role, or changes something and does not say which
    act it leaves, fails before it can be used.
    """
    for route, roles in named_roles(routes):
        if len(roles) != 1:
            raise TypeError(f"{route} has to name one role")
        if isinstance(route, APIRoute) and not isinstance(route, JudgingRoute):
            raise TypeError(f"{route} has to be a JudgingRoute")
        is_changing = isinstance(route, APIRoute) and not READING.issuperset(route.methods or ())
        if is_changing and len(list(leaves_of(getattr(route, "dependant", None)))) != 1:
            raise TypeError(f"{route} has to name the act that it leaves")


# Dependencies are coroutines even where they wait for nothing: a plain function would go through a thread,
# and STOP with it.
async def control_of(connection: HTTPConnection) -> Control:
    control = connection.app.state.control
    assert isinstance(control, Control)
    return control


def operation_id(route: APIRoute) -> str:
    """The name for client generators: the subject, then the operation."""
    return to_camel(f"{route.tags[0]}_{route.name}")


def routes(prefix: str, about: str, route_class: type[ApiRoute] = ApiRoute) -> APIRouter:
    """For our own page and for scripts; every refusal is a Problem, as openapi.py describes."""
    return APIRouter(
        prefix=prefix,
        tags=[about],
        generate_unique_id_function=operation_id,
        route_class=route_class,
    )


Controlled = Annotated[Control, Depends(control_of)]
Audited = Annotated[Audit, Depends(audit_of)]
