"""What happens, as a stream of server-sent events: the messages that pages get, for scripts. Whoever does not
read is sent away like a page that does not.

Knows a seat and a response; no port, no packet and no message's meaning.
"""

import asyncio
import contextlib
import itertools
import json
import secrets
from typing import Annotated

from fastapi import Header
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from servodeck.access.connections import connection_of
from servodeck.access.roles import VIEWER
from servodeck.api.routes import Controlled, routes
from servodeck.callers import Caller
from servodeck.errors import BusyError
from servodeck.robot.control import Control
from servodeck.robot.hub import Session

# A line that says nothing: whoever is gone is found out, and nothing between closes a stream for its silence.
SILENCE_S = 15.0
CLOSE_WAIT_S = 0.1
MAX_ID = 64
HEADERS = [(b"content-type", b"text/event-stream; charset=utf-8"), (b"x-accel-buffering", b"no")]
EXAMPLE = 'id: 5f0c1a2b-7\ndata: {"type": "state", "board": "doc", "latch": true, "clients": 2}\n\n'

events_api = routes("/api", "events")


class EventStream(Response):
    media_type = "text/event-stream"

    def __init__(self, caller: Caller, control: Control, last_id: str | None) -> None:
        """`last_id` is what was heard last on a stream before this one."""
        super().__init__()
        self._name = secrets.token_hex(4)
        self._last_id = last_id
        self._session = Session(caller, answers=False)
        self._control = control

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        self._control.join(self._session)
        tasks = [
            asyncio.create_task(self._write_all(send)),
            asyncio.create_task(until_gone(receive)),
            asyncio.create_task(self._session.ended.wait()),
        ]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            self._control.leave(self._session)
            for task in tasks:
                task.cancel()
        if self._session.close_reason:
            await end(scope, send)

    async def _write_all(self, send: Send) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": HEADERS})
        if self._last_id is not None:
            gap = json.dumps({"type": "gap", "after": self._last_id})
            await send({"type": "http.response.body", "body": f"data: {gap}\n\n".encode(), "more_body": True})
        for number in itertools.count(1):
            while (text := await self._next()) is None:
                await send({"type": "http.response.body", "body": b":\n\n", "more_body": True})
            line = f"id: {self._name}-{number}\ndata: {text}\n\n"
            await send({"type": "http.response.body", "body": line.encode(), "more_body": True})

    async def _next(self) -> str | None:
        """None where nothing happens for a while."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(SILENCE_S):
                return await self._session.next()
        return None


async def until_gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


async def end(scope: Scope, send: Send) -> None:
    """Politely where it reads."""
    try:
        async with asyncio.timeout(CLOSE_WAIT_S):
            await send({"type": "http.response.body", "body": b"", "more_body": False})
    except TimeoutError:
        if connection := connection_of(scope):
            connection.abort()
        await asyncio.sleep(0)  # the server hears of it before this ends


@events_api.get(
    "/events",
    status_code=200,
    response_class=EventStream,
    responses={200: {"content": {"text/event-stream": {"example": EXAMPLE}}}},
)
async def events(
    caller: Annotated[Caller, VIEWER],
    control: Controlled,
    last_event_id: Annotated[str | None, Header(max_length=MAX_ID)] = None,
) -> EventStream:
    """What happens, from now on, as server-sent events with an id: each is one message as `/ws` tells it to
    pages. The first is a `welcome` with everything as it stands. Nothing is repeated: with Last-Event-ID a
    `gap` comes before it, because what happened since that event is not told.
    """
    if not control.hub.has_room_for(caller):
        raise BusyError("Too many clients are connected: close another window or event stream.")
    return EventStream(caller, control, last_event_id)
