"""How routes of the HTTP interface are made, and what they are given. Knows no route."""

from typing import Annotated

from fastapi import APIRouter, Depends, Request
from fastapi.routing import APIRoute
from pydantic.alias_generators import to_camel
from starlette.requests import HTTPConnection

from servodeck.access.guard import judge_script
from servodeck.access.roles import JudgingRoute
from servodeck.robot.control import Control


class ApiRoute(JudgingRoute):
    """Only our own page and programs get this far."""

    def judge(self, request: Request) -> None:
        judge_script(request.scope["headers"])
        super().judge(request)


# Dependencies are coroutines even where they wait for nothing: a plain function would go through a thread,
# and STOP with it.
async def control_of(connection: HTTPConnection) -> Control:
    control = connection.app.state.control
    assert isinstance(control, Control)
    return control


def operation_id(route: APIRoute) -> str:
    """What generators of clients call it: what it is about, then what it does."""
    return to_camel(f"{route.tags[0]}_{route.name}")


def routes(prefix: str, about: str) -> APIRouter:
    """For our own page and for scripts; whatever they refuse for is a Problem, as openapi.py says of each."""
    return APIRouter(
        prefix=prefix,
        tags=[about],
        generate_unique_id_function=operation_id,
        route_class=ApiRoute,
    )


Controlled = Annotated[Control, Depends(control_of)]
