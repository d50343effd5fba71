"""Roles at the routes: each names who may use it, or that anybody may; one that names nothing keeps the
gateway from starting.

Knows the entrance and how a framework's routes are built; no route of ours.
"""

from collections.abc import Iterator, Sequence

from fastapi import Depends, FastAPI
from fastapi.dependencies.models import Dependant
from starlette.requests import HTTPConnection
from starlette.routing import BaseRoute, Mount

from servodeck.access.entrance import Entrance
from servodeck.callers import Caller, Role


class Needs:
    """A dependency: who asks, where they may. Anybody may where `role` is None."""

    def __init__(self, role: Role | None) -> None:
        self.role = role

    async def __call__(self, connection: HTTPConnection) -> Caller | None:
        entrance = await entrance_of(connection)
        headers = connection.scope["headers"]
        if self.role is None:
            return entrance.find(headers)
        caller = entrance.judge(headers, self.role)
        if self.role != "stopper" and connection.scope["type"] == "http":
            entrance.count(caller)  # a stop is never one too many, and messages have their own rates
        return caller


async def entrance_of(connection: HTTPConnection) -> Entrance:
    entrance = connection.app.state.entrance
    assert isinstance(entrance, Entrance)
    return entrance


ANYBODY = Depends(Needs(None))
STOPPER = Depends(Needs("stopper"))
VIEWER = Depends(Needs("viewer"))
DRIVER = Depends(Needs("driver"))
OWNER = Depends(Needs("owner"))


def named_roles(routes: Sequence[BaseRoute]) -> Iterator[tuple[BaseRoute, list[Role | None]]]:
    """Every route with the roles it names. What is mounted serves the page, which is no secret."""
    for route in routes:
        included = getattr(route, "original_router", None)
        if included:
            yield from named_roles(included.routes)
        elif not isinstance(route, Mount):
            yield route, list(needs_of(getattr(route, "dependant", None)))


def needs_of(dependant: Dependant | None) -> Iterator[Role | None]:
    for each in dependant.dependencies if dependant else ():
        if isinstance(each.call, Needs):
            yield each.call.role


def require_roles(app: FastAPI) -> None:
    """Denies by default: whoever adds a route without a role finds out before anybody can use it."""
    for route, roles in named_roles(app.routes):
        if len(roles) != 1:
            raise TypeError(f"{route} has to name one role")
