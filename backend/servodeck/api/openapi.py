"""The description of the HTTP interface, for people and programs: what the framework reads from the routes,
with who may use each, examples, and the one shape of every error; and the same as a page without a script, so
that it works offline and under the strict content policy.

Knows OpenAPI and the routes' roles; not what a route does.
"""

import json
from collections.abc import Iterator
from html import escape
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute
from pydantic import ConfigDict

from servodeck.api.examples import EXAMPLES, PROBLEMS, Example
from servodeck.api.routes import named_roles
from servodeck.callers import Role
from servodeck.errors import ErrorCode, GatewayError
from servodeck.schema import Message
from servodeck.value import value

LINE_LENGTH = 100
REFERENCE = "#/components/schemas/{model}"


class Problem(Message):
    """Why a request failed. `code` is for programs, `detail` for people. `heldBy`: with `portBusy` the
    programs that have the port, where the system tells.
    """

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    code: ErrorCode
    detail: str
    held_by: list[str] | None = None


@value
class Tag:
    """A group of operations. `title` is for people."""

    name: str
    title: str
    description: str

    def described(self) -> dict[str, str]:
        return {"name": self.name, "description": self.description, "x-displayName": self.title}


PROBLEM = {"$ref": REFERENCE.format(model=Problem.__name__)}
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
# In the order in which they are shown. The name is the first word of each operation's identifier.
TAGS = (
    Tag("gateway", "Status, port and Stop", "The state of the robot, its port and board, Stop and Resume."),
    Tag("motion", "Motion", "Moves, runs of the board's groups, and the lease that lets one client drive."),
    Tag("poses", "Poses", "The poses of the robot on the board, by name or number."),
    Tag("jobs", "Slots and downloads", "Groups are stored in the board's slots as jobs that can be watched."),
    Tag("play", "Play", "The gateway plays frames by its own clock; nothing is stored on the board."),
    Tag("events", "Events", "Every change as a server-sent event with an id."),
    Tag(
        "fleet",
        "Fleet",
        "Every robot of a site, where the gateway is on a broker: state, Stop, groups for several.",
    ),
    Tag("library", "Library", "Action groups and robots as documents with versions."),
    Tag("robots", "Robot on the board", "Which robot of the library is on the board."),
    Tag("cameras", "Cameras", "The pictures of the cameras at the gateway."),
    Tag("people", "People", "Paired devices, roles, invitations and the tokens of programs."),
    Tag("audit", "Acts", "Who did what at this gateway, and when, for owners."),
    Tag("health", "Health", "The gateway's own state, for supervisors."),
)
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
            title=app.title,
            version=app.version,
            description=app.description,
            routes=app.routes,
            tags=[tag.described() for tag in TAGS],
        )
        for name in ("HTTPValidationError", "ValidationError"):
            # Of 422, the framework's own shape, which is never sent.
            schema["components"]["schemas"].pop(name)
        schema["components"]["schemas"][Problem.__name__] = Problem.model_json_schema(
            ref_template=REFERENCE, mode="serialization"
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
        operation["requestBody"]["content"][JSON]["example"] = example.request
    responses = operation["responses"]
    responses.pop("422", None)
    for answer in responses.values():
        for content in answer.get("content", {}).values():
            content["example"] = example.response
    responses |= problems(operation, example, role)


def who(role: Role | None) -> str:
    return "For every caller." if role is None else f"Takes the role {role}."


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

# Longer ones are hard to read within a line.
MANY = 8
METHODS = ("get", "put", "post", "patch", "delete")

STYLE = """
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }
body { max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
section { border-top: 1px solid color-mix(in srgb, currentColor 20%, transparent); padding: 0.5rem 0 1rem; }
nav ul { padding: 0; list-style: none; }
h2 { margin: 2.5rem 0 0; }
h2 + p { margin-top: 0; }
h3 { font-size: 1rem; font-family: ui-monospace, monospace; overflow-wrap: anywhere; }
h3 span { display: inline-block; min-width: 5rem; font-weight: 700; text-transform: uppercase; }
table { border-collapse: collapse; }
th, td { text-align: left; vertical-align: top; padding: 0.2rem 1.5rem 0.2rem 0; font-weight: normal; }
details { color: color-mix(in srgb, currentColor 75%, transparent); font-size: 0.875rem; }
code { font-family: ui-monospace, monospace; overflow-wrap: anywhere; }
pre { margin: 0; white-space: pre-wrap; }
"""


def docs_page(schema: dict[str, Any]) -> str:
    tags = schema["tags"]
    contents = "".join(
        f'<li><a href="#{tag["name"]}">{escape(tag["x-displayName"])}</a> {escape(tag["description"])}</li>'
        for tag in tags
    )
    info = schema["info"]
    title = escape(f"{info['title']} {info['version']}")
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width">'
        f'<title>{title}</title><link rel="stylesheet" href="docs.css"></head><body>'
        f"<h1>{title}</h1><p>{escape(info['description'])}</p>"
        '<p>For programs: <a href="openapi.json">openapi.json</a></p>'
        f"<nav><ul>{contents}</ul></nav>"
        f"{''.join(group(tag, schema) for tag in tags)}</body></html>"
    )


def group(tag: dict[str, Any], schema: dict[str, Any]) -> str:
    operations_of_tag = "".join(
        operation(method, path, methods[method], schema)
        for path, methods in schema["paths"].items()
        for method in METHODS
        if method in methods and tag["name"] in methods[method]["tags"]
    )
    title, about = escape(tag["x-displayName"]), escape(tag["description"])
    return f'<h2 id="{tag["name"]}">{title}</h2><p>{about}</p>{operations_of_tag}'


def operation(method: str, path: str, description: dict[str, Any], schema: dict[str, Any]) -> str:
    said = {"body": description["requestBody"]} if "requestBody" in description else {}
    rows = "".join(
        f"<tr><th>{escape(label)}</th><td>{content(part, schema)}</td></tr>"
        for label, part in {**said, **description["responses"]}.items()
    )
    return (
        f'<section id="{description["operationId"]}"><h3><span>{method}</span>{escape(path)}</h3>'
        f"<p>{escape(description.get('description', ''))}</p><table>{rows}</table></section>"
    )


def content(part: dict[str, Any], schema: dict[str, Any]) -> str:
    """An example and its shape; of errors, which all have one shape, their codes."""
    for found in part.get("content", {}).values():
        if "examples" in found:
            return ", ".join(f"{each['summary']} {code}" for code, each in found["examples"].items())
        example = escape(pretty(found["example"]))
        fields = shape(found.get("schema", {}), schema)
        return f"<pre><code>{example}</code></pre><details><summary>all fields</summary>{fields}</details>"
    return "nothing"


def shape(part: dict[str, Any], schema: dict[str, Any]) -> str:
    """One line of a type: `{device: string, likely: boolean}`."""
    if "$ref" in part:
        part = schema["components"]["schemas"][part["$ref"].rsplit("/", 1)[1]]
    if "anyOf" in part:
        return " or ".join(shape(each, schema) for each in part["anyOf"])
    if len(part.get("enum", ())) > MANY:
        return "a code"
    if "enum" in part:
        return " or ".join(f"<code>{escape(str(each))}</code>" for each in part["enum"])
    if "const" in part:
        return f"<code>{escape(str(part['const']))}</code>"
    if part.get("type") == "array":
        return f"list of {shape(part['items'], schema)}"
    if "properties" in part:
        fields = [
            f"<code>{escape(name)}</code>: {shape(each, schema)}" for name, each in part["properties"].items()
        ]
        return "{ " + ", ".join(fields) + " }"
    return escape(str(part.get("type", "nothing")))


def pretty(example: Any) -> str:
    """Short ones on a line of their own, long ones with their parts below each other."""
    line = json.dumps(example, ensure_ascii=False)
    return line if len(line) <= LINE_LENGTH else json.dumps(example, ensure_ascii=False, indent=2)
