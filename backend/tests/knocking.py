"""One request or upgrade to the application itself, header by header, and every route that it has."""

import asyncio
import time
from collections.abc import Iterator
from typing import Any

from fastapi.routing import APIRoute
from starlette.types import ASGIApp, Message, Scope

from servodeck.access.entrance import Entrance
from servodeck.access.guard import Guard
from servodeck.api.app import LaterApp, create_app
from servodeck.api.routes import named_roles
from servodeck.callers import Role
from servodeck.errors import PortMissingError
from servodeck.robot.control import Control
from tests.fake_port import FakePorts
from tests.running import NO_LIBRARY, PORT, entrance_to

NOWHERE = FakePorts(PortMissingError("There is no such port."))


def app_at(entrance: Entrance | None = None) -> Guard:
    return create_app(Control(NOWHERE, time.monotonic, "doc"), NO_LIBRARY, entrance or entrance_to())


def roles_of_routes() -> Iterator[tuple[str, str, list[Role | None]]]:
    """Method (WS for an upgrade), path and named roles of each route, read from the application itself."""
    app = app_at().app
    assert isinstance(app, LaterApp)
    app.load_all()
    for route, roles in named_roles(app.routes):
        methods = sorted(route.methods or ()) if isinstance(route, APIRoute) else ["WS"]
        yield from ((method, str(getattr(route, "path", "?")), roles) for method in methods)


def all_routes() -> Iterator[tuple[str, str, str]]:
    """Type, method and path of every route, and of unknown addresses."""
    for method, path, _ in roles_of_routes():
        yield ("websocket", "GET", path) if method == "WS" else ("http", method, path)
    yield from (("http", "GET", path) for path in ("/", "/unknown", "/api/unknown"))


async def knock(app: ASGIApp, scope: Scope, *, may_read: bool = True) -> int:
    """The status of one request or upgrade; 101 where it was accepted. Not `may_read`: of its head alone."""
    first = "http.request" if scope["type"] == "http" else "websocket.connect"
    messages: list[Message] = [{"type": first}]
    statuses: list[int] = []
    answered = asyncio.Event()

    async def receive() -> Message:
        """Who has heard the status hangs up: a stream would continue for ever."""
        assert may_read
        if not messages:
            await answered.wait()
        return messages.pop() if messages else {"type": f"{scope['type']}.disconnect", "code": 1000}

    async def send(message: Message) -> None:
        if message["type"] == "websocket.accept":
            statuses.append(101)
        if message["type"].endswith("response.start"):
            statuses.append(message["status"])
        if statuses:
            answered.set()

    await app(scope, receive, send)
    [status] = statuses  # twice answered is a traceback in the log of a real server
    return status


def scope_of(
    kind: str, method: str, path: str, headers: list[tuple[bytes, bytes]], own_address: str = "127.0.0.1"
) -> dict[str, Any]:
    return {
        "type": kind,
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http" if kind == "http" else "ws",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": headers,
        "client": (own_address, 50000),
        "server": (own_address, PORT),
        "extensions": {"websocket.http.response": {}},
        "subprotocols": [],
        "state": {},
    }
