"""Routes that a start does not wait for: each part is loaded with the first request for an address of its
own, all of them soon after the gateway serves. Knows which addresses are whose; no route.
"""

import asyncio
from collections.abc import Callable
from typing import Any, NamedTuple

from fastapi import APIRouter, FastAPI
from starlette.routing import Mount
from starlette.types import Receive, Scope, Send

from servodeck.access.roles import require_roles

# Between two parts a STOP gets its turn; loading one takes some 10 ms.
PAUSE_S = 0.05


def robot() -> tuple[APIRouter, ...]:
    from servodeck.api.robot import api, socket
    from servodeck.intents import client_message

    client_message.rebuild()  # reads what pages say, a STOP too
    return api, socket


def events() -> tuple[APIRouter, ...]:
    from servodeck.api.events import events_api

    return (events_api,)


def groups() -> tuple[APIRouter, ...]:
    from servodeck.api.groups import jobs_api, play_api

    return jobs_api, play_api


def library() -> tuple[APIRouter, ...]:
    from servodeck.api.library import library_api, robots_api

    return library_api, robots_api


def motion() -> tuple[APIRouter, ...]:
    from servodeck.api.motion import motion_api, poses_api

    return motion_api, poses_api


def people() -> tuple[APIRouter, ...]:
    from servodeck.api.people import people_api

    return (people_api,)


class Part(NamedTuple):
    """`names`: the first word of each of its addresses, behind `/api/`."""

    load: Callable[[], tuple[APIRouter, ...]]
    names: frozenset[str]


PARTS = (
    Part(robot, frozenset({"status", "ports", "port", "board", "stop", "resume", "battery", "ws"})),
    Part(people, frozenset({"me", "pair", "people", "invites", "tokens", "stop-links"})),
    Part(library, frozenset({"library", "robot"})),
    Part(motion, frozenset({"move", "slots", "erase", "lease", "driver", "poses"})),
    Part(groups, frozenset({"download", "jobs", "play"})),
    Part(events, frozenset({"events"})),
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
    """Before those that are mounted. As they are: where a router is included the framework makes all anew."""
    count = len(app.router.routes)
    at = next((index for index in range(count) if isinstance(app.router.routes[index], Mount)), count)
    app.router.routes[at:at] = [route for router in routers for route in router.routes]
