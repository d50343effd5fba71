"""Puts the gateway together: guard, routes, page, and one shape for every error. Has no rule of its own.

A start does not wait for most routes: each part is loaded with the first request for an address of its own,
all of them soon after the gateway serves. `python -m servodeck.api.app` prints the description of all routes,
from which the page's types are made.
"""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from fastapi import APIRouter, FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import Mount
from starlette.types import Receive, Scope, Send

from servodeck import __version__, metrics
from servodeck.access.audit import Audit, NoAuditStore
from servodeck.access.entrance import Entrance
from servodeck.access.expiry import Expiry
from servodeck.access.guard import Guard, log_refusal
from servodeck.api.health import LoopDelay, health_api, sign_of_life
from servodeck.api.page import STATIC, page
from servodeck.api.routes import PUBLIC, JudgingRoute, named_roles, require_roles
from servodeck.errors import ErrorCode, GatewayError, MalformedError, PortBusyError
from servodeck.files import Disk
from servodeck.library.library import Library
from servodeck.robot.control import Control
from servodeck.robot.scripts import Scripts
from servodeck.snapshots import FleetStatus
from servodeck.threads import in_thread

if TYPE_CHECKING:
    from servodeck.api.cameras import Camera
    from servodeck.fleet.service import FleetService
    from servodeck.notify.notifications import Notifications

CODE_OF_STATUS: dict[int, ErrorCode] = {
    403: "forbidden",
    404: "notFound",
    405: "methodNotAllowed",
    413: "tooLarge",
    500: "internal",
}


METHODS_OF_PAGE = ("GET", "HEAD")
DETAILS = {
    404: "There is nothing at this address; /docs lists what there is.",
    405: "This address takes another method; /docs lists what there is.",
}


# Between two parts a STOP can be served; loading one takes some 10 ms.
PAUSE_S = 0.05


def robot() -> tuple[APIRouter, ...]:
    from servodeck.api.robot import api, events_api, socket
    from servodeck.intents import client_message

    client_message.rebuild()  # reads what pages say, a STOP too
    return api, socket, events_api


def library() -> tuple[APIRouter, ...]:
    from servodeck.api.library import library_api, robots_api

    return library_api, robots_api


def motion() -> tuple[APIRouter, ...]:
    from servodeck.api.motion import jobs_api, motion_api, play_api, poses_api

    return motion_api, poses_api, jobs_api, play_api


def cameras() -> tuple[APIRouter, ...]:
    from servodeck.api.cameras import cameras_api

    return (cameras_api,)


def audit_routes() -> tuple[APIRouter, ...]:
    from servodeck.api.audit import audit_api

    return (audit_api,)


def fleet() -> tuple[APIRouter, ...]:
    from servodeck.api.fleet import fleet_api
    from servodeck.api.fleet_drive import drive_socket

    return fleet_api, drive_socket


def people() -> tuple[APIRouter, ...]:
    from servodeck.api.people import people_api

    return (people_api,)


class Part(NamedTuple):
    """`names`: the first word of each of its addresses, behind `/api/`."""

    load: Callable[[], tuple[APIRouter, ...]]
    names: frozenset[str]


PARTS = (
    Part(robot, frozenset({"status", "ports", "port", "board", "stop", "resume", "battery", "events", "ws"})),
    Part(people, frozenset({"me", "pair", "people", "invites", "tokens", "stop-links"})),
    Part(audit_routes, frozenset({"audit"})),
    Part(library, frozenset({"library", "robot"})),
    Part(cameras, frozenset({"cameras"})),
    Part(fleet, frozenset({"fleet"})),
    Part(
        motion, frozenset({"move", "slots", "erase", "lease", "driver", "poses", "download", "jobs", "play"})
    ),
)


class LaterApp(FastAPI):
    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._waiting = list(PARTS)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if self._waiting and scope["type"] != "lifespan":
            name = scope["path"].removeprefix("/api").removeprefix("/").partition("/")[0]
            for part in [each for each in self._waiting if name in each.names]:
                self._load(part)
        await super().__call__(scope, receive, send)

    def load_all(self) -> None:
        while self._waiting:
            self._load(self._waiting[0])

    async def load_soon(self) -> None:
        while self._waiting:
            await asyncio.sleep(PAUSE_S)
            if self._waiting:
                self._load(self._waiting[0])

    def _load(self, part: Part) -> None:
        routers = part.load()
        for router in routers:
            require_roles(router.routes)
        add_routes(self, *routers)
        self._waiting.remove(part)


def add_routes(app: FastAPI, *routers: APIRouter) -> None:
    """Before mounted routes. Not by including the router, for which the framework creates each route
    again.
    """
    count = len(app.router.routes)
    at = next((index for index in range(count) if isinstance(app.router.routes[index], Mount)), count)
    app.router.routes[at:at] = [route for router in routers for route in router.routes]


def create_app(
    control: Control,
    library: Library,
    entrance: Entrance,
    static: Path = STATIC,
    cameras: Sequence["Camera"] = (),
    notifications: "Notifications | None" = None,
    audit: Audit | None = None,
    on_broker: Callable[[], FleetStatus | None] = lambda: None,
    fleet: "FleetService | None" = None,
) -> Guard:
    """The gateway with that entrance and the page built into `static`. Without `audit` the list of acts is
    not stored. `on_broker`: how it is there.
    """
    app = app_without_state()
    audit = audit or Audit(NoAuditStore(), entrance.devices.now_ms)
    app.state.audit = audit
    app.state.control = control
    control.acts.note = audit.note
    app.state.scripts = Scripts(control, entrance.still_lets_in)
    app.state.expiry = Expiry(entrance.devices, app.state.scripts.disconnect, audit)
    app.state.library = library
    app.state.cameras = tuple(cameras)
    app.state.fleet = fleet
    app.state.open_streams = 0
    app.state.notifications = notifications
    app.state.loop_delay = LoopDelay(sign_of_life())
    app.state.disk = Disk(library.folder, control.now)
    app.state.entrance = entrance
    app.state.on_broker = on_broker
    app.mount("/", page(static))
    return Guard(app, entrance)


def app_without_state() -> LaterApp:
    """The app with its routes, enough to describe them."""
    app = LaterApp(
        title="Servodeck gateway",
        description="Drives a servo controller on a serial port. An error is a code and a sentence. "
        "Every address below /api/ is there below /api/v1/, too: programs that name the version keep working "
        "where a later one changes.",
        version=__version__,
        docs_url=None,
        redoc_url=None,
        openapi_url=None,
        # Also where the environment requests it: no data of this gateway is sent elsewhere.
        telemetry={"auto_configure": False, "tracing": False, "metrics": False, "logs": False},
        lifespan=lifespan,
    )
    app.router.route_class = JudgingRoute
    add_routes(app, health_api)
    add_docs(app)
    add_errors(app)
    require_roles(app.routes)
    return app


@contextlib.asynccontextmanager
async def lifespan(app: LaterApp) -> AsyncIterator[None]:
    control: Control = app.state.control
    sampling = asyncio.create_task(app.state.loop_delay.run())
    loading = asyncio.create_task(app.load_soon())
    expiry: Expiry = app.state.expiry
    expiry.plan()
    fleet: FleetService | None = app.state.fleet
    if fleet:
        fleet.start()
    audit: Audit = app.state.audit
    audit.note("gatewayStarted", None, __version__)
    notifications: Notifications | None = app.state.notifications
    watching = asyncio.create_task(notifications.watch(control)) if notifications else None
    yield
    if watching:
        watching.cancel()
    audit.note("gatewayEnded", None)
    expiry.end()
    if fleet:
        await fleet.end()
    loading.cancel()
    sampling.cancel()
    await control.shut_down()


def add_docs(app: LaterApp) -> None:
    """By functions that hold no app, because the framework caches the functions of routes for the process."""
    app.state.describing = asyncio.Lock()
    answers: dict[str, Callable[..., Awaitable[Response]]] = {
        "/docs": docs,
        "/openapi.json": schema,
        "/docs.css": style,
    }
    for path, answer in answers.items():
        app.add_api_route(path, answer, include_in_schema=False, dependencies=[PUBLIC])


async def description(app: LaterApp) -> dict[str, Any]:
    """Made in a thread, because it takes long and a stop would wait."""
    from servodeck.api.openapi import described

    app.load_all()
    async with app.state.describing:
        if app.openapi_schema is None:
            return await in_thread(lambda: described(app))
        return app.openapi_schema


async def docs(request: Request) -> HTMLResponse:
    from servodeck.api.openapi import docs_page

    return HTMLResponse(docs_page(await description(request.app)))


async def schema(request: Request) -> JSONResponse:
    return JSONResponse(await description(request.app))


async def style() -> Response:
    from servodeck.api.openapi import STYLE

    return Response(STYLE, media_type="text/css")


def add_errors(app: LaterApp) -> None:
    @app.exception_handler(GatewayError)
    async def gateway_error(connection: HTTPConnection, error: GatewayError) -> JSONResponse:
        if connection.scope["type"] == "websocket":
            log_refusal(connection.scope, error)
        held_by = error.held_by if isinstance(error, PortBusyError) else ()
        answer = problem(error.status, error.code, error.detail, held_by)
        answer.headers.update(error.headers)
        return answer

    @app.exception_handler(RequestValidationError)
    async def validation_error(_request: Request, error: RequestValidationError) -> JSONResponse:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        return problem(MalformedError.status, MalformedError.code, f"{where}: {first['msg']}")

    @app.exception_handler(HTTPException)
    async def http_error(request: Request, error: HTTPException) -> JSONResponse:
        status, methods = error.status_code, methods_at(app, request.scope["path"])
        if status == HTTPStatus.NOT_FOUND and methods and request.method not in methods:
            status = HTTPStatus.METHOD_NOT_ALLOWED  # of the page, which was looked through for it
        answer = problem(status, CODE_OF_STATUS.get(status, "malformed"), DETAILS.get(status, error.detail))
        answer.headers.update(error.headers or {})
        if status == HTTPStatus.METHOD_NOT_ALLOWED:
            answer.headers["Allow"] = ", ".join(methods or METHODS_OF_PAGE)
        return answer

    @app.exception_handler(Exception)
    async def defect(_request: Request, _error: Exception) -> JSONResponse:
        return problem(500, "internal", "The gateway made a mistake; its log says more.")


def methods_at(app: LaterApp, path: str) -> list[str]:
    """Of all routes of that address; the framework names those of one route."""
    app.load_all()
    found: set[str] = set()
    for route, _ in named_roles(app.routes):
        if isinstance(route, APIRoute) and route.path_regex.match(path):
            found |= route.methods or set()
    return sorted(found)


def problem(status: int, code: ErrorCode, detail: str, held_by: Sequence[str] = ()) -> JSONResponse:
    metrics.refused[code] += 1
    held = {"heldBy": held_by} if held_by else {}
    return JSONResponse({"code": code, "detail": detail, **held}, status)


if __name__ == "__main__":
    import json
    import sys

    from servodeck.api.openapi import described

    whole = app_without_state()
    whole.load_all()
    json.dump(described(whole), sys.stdout)
