"""What happens, as a stream of server-sent events: the messages that pages get, for scripts. Whoever does not
read is sent away like a page that does not.

Knows a seat and a response; no port, no packet and no message's meaning.
"""

import asyncio
import contextlib
from typing import Annotated

from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from servodeck.access.hub import Seat
from servodeck.access.impatient import abort_of
from servodeck.access.roles import VIEWER
from servodeck.callers import Caller
from servodeck.driving.control import Control
from servodeck.errors import BusyError
from servodeck.web.api import Controlled, routes

# A line that says nothing: whoever is gone is found out, and nothing between closes a stream for its silence.
SILENCE_S = 15.0
CLOSE_WAIT_S = 0.1
HEADERS = [(b"content-type", b"text/event-stream; charset=utf-8"), (b"x-accel-buffering", b"no")]
EXAMPLE = 'data: {"type": "state", "board": "doc", "latch": true, "clients": 2}\n\n'

events_api = routes("/api")


class EventStream(Response):
    media_type = "text/event-stream"

    def __init__(self, caller: Caller, control: Control) -> None:
        super().__init__()
        self._seat = Seat(caller, answers=False)
        self._control = control

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        self._control.join(self._seat)
        tasks = [
            asyncio.create_task(self._write_all(send)),
            asyncio.create_task(until_gone(receive)),
            asyncio.create_task(self._seat.ended.wait()),
        ]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            self._control.leave(self._seat)
            for task in tasks:
                task.cancel()
        if self._seat.ended.is_set():
            await end(scope, send)

    async def _write_all(self, send: Send) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": HEADERS})
        while True:
            line = ":\n\n"
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(SILENCE_S):
                    line = f"data: {await self._seat.next()}\n\n"
            await send({"type": "http.response.body", "body": line.encode(), "more_body": True})


async def until_gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


async def end(scope: Scope, send: Send) -> None:
    """Politely where it reads."""
    try:
        async with asyncio.timeout(CLOSE_WAIT_S):
            await send({"type": "http.response.body", "body": b"", "more_body": False})
    except TimeoutError:
        abort_of(scope)()
        await asyncio.sleep(0)  # the server hears of it before this ends


@events_api.get(
    "/events",
    status_code=200,
    response_class=EventStream,
    responses={200: {"content": {"text/event-stream": {"example": EXAMPLE}}}},
)
async def events(caller: Annotated[Caller, VIEWER], control: Controlled) -> EventStream:
    """What happens, from now on, as server-sent events: each is one message as `/ws` tells it to pages. The
    first is a `welcome` with everything as it stands.
    """
    if not control.hub.has_room_for(caller):
        raise BusyError("All seats are taken: close another window or stream.")
    return EventStream(caller, control)
