"""The description of the HTTP interface, for people and programs: what the framework reads from the routes,
with who may use each, examples, and the one shape of every error.

Knows OpenAPI and the routes' roles; not what a route does.
"""

from collections.abc import Iterator
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute

from servodeck.access.roles import named_roles
from servodeck.callers import Role
from servodeck.errors import ErrorCode, GatewayError
from servodeck.web.api_examples import EXAMPLES, PROBLEMS, Example

PROBLEM = {"$ref": "#/components/schemas/Problem"}
SCHEMES = {
    "token": {
        "type": "http",
        "scheme": "bearer",
        "description": "A script's token, made by an owner. Without an Origin header, as programs have none.",
    },
    "page": {
        "type": "apiKey",
        "in": "cookie",
        "name": "servodeck_8300",
        "description": "A paired browser's, named after the port. Counts only for the gateway's own page.",
    },
}
ALL_SCHEMES: list[dict[str, list[str]]] = [{name: []} for name in SCHEMES]
JSON = "application/json"
RETRY_AFTER = {
    "Retry-After": {
        "description": "With 429 `tooMany`: after so many seconds one more request is taken.",
        "schema": {"type": "integer", "minimum": 1},
    }
}


def described(app: FastAPI) -> dict[str, Any]:
    """As OpenAPI; the same object each time."""
    if app.openapi_schema is None:
        schema = get_openapi(
            title=app.title, version=app.version, description=app.description, routes=app.routes
        )
        schema["components"]["securitySchemes"] = SCHEMES
        for route, method, role in operations(app):
            complete(schema["paths"][route.path_format][method.lower()], EXAMPLES[method, route.path], role)
        app.openapi_schema = schema
    return app.openapi_schema


def operations(app: FastAPI) -> Iterator[tuple[APIRoute, str, Role | None]]:
    for route, roles in named_roles(app.routes):
        if isinstance(route, APIRoute) and route.include_in_schema:
            yield from ((route, method, roles[0]) for method in route.methods or ())


def complete(operation: dict[str, Any], example: Example, role: Role | None) -> None:
    text = " ".join(operation["description"].split())
    operation["summary"] = text.partition(". ")[0].partition("; ")[0].rstrip(".")
    operation["description"] = f"{text} {who(role)}"
    operation["security"] = [] if role is None else ALL_SCHEMES
    if "requestBody" in operation:
        operation["requestBody"]["content"][JSON]["example"] = example.asks
    responses = operation["responses"]
    responses.pop("422", None)  # the framework's own shape, which nobody is sent
    for answer in responses.values():
        for content in answer.get("content", {}).values():
            content["example"] = example.answers
    responses |= problems(operation, example, role)


def who(role: Role | None) -> str:
    return "For anybody." if role is None else f"Takes the role {role}."


def problems(operation: dict[str, Any], example: Example, role: Role | None) -> dict[str, Any]:
    """Those of this route as examples, by the class of their status."""
    codes: list[ErrorCode] = [*example.errors]
    if "requestBody" in operation or operation.get("parameters"):
        codes.append("malformed")
    codes.append("forbidden")
    if role is not None:
        codes.append("notPaired")
    if role not in (None, "stopper"):
        codes.append("tooMany")
    found: dict[str, dict[str, Any]] = {"4XX": {}, "5XX": {}}
    for code in codes:
        value = {"code": code, "detail": PROBLEMS[code]}
        found[f"{STATUS_OF[code] // 100}XX"][code] = {"summary": str(STATUS_OF[code]), "value": value}
    found["5XX"]["internal"] = {
        "summary": "500",
        "value": {"code": "internal", "detail": "The gateway made a mistake; its log says more."},
    }
    return {
        status: {
            "description": "It was not done, and why.",
            **({"headers": RETRY_AFTER} if "tooMany" in examples else {}),
            "content": {JSON: {"schema": PROBLEM, "examples": examples}},
        }
        for status, examples in found.items()
    }


def classes_below(root: type[GatewayError]) -> Iterator[type[GatewayError]]:
    for each in root.__subclasses__():
        yield each
        yield from classes_below(each)


STATUS_OF: dict[ErrorCode, int] = {each.code: each.status for each in classes_below(GatewayError)}
