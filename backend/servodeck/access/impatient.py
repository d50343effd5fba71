"""Connections that cannot be held open by saying little: a request comes soon and whole, with a head of sane
size; a WebSocket answers a ping; else the connection ends.

Knows time and bytes, no request's meaning. uvicorn itself waits for ever.
"""

import asyncio
from collections.abc import Callable

from starlette.types import Scope
from uvicorn._types import ASGISendEvent
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol
from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

# Browsers open a connection or two ahead of need.
FIRST_BYTE_S = 10.0
HEAD_S = 1.0
# A library of 3 MiB over a poor wireless link.
BODY_S = 30.0
# Whoever has its answer and talks on may read it first.
ANSWERED_S = 0.5
HEAD_BYTES = 32 * 1024
# A browser answers by itself, also for a page that sleeps. Who does not read never gets to the ping.
PING_S = 10.0
PONG_S = 10.0
# For the words of the end to arrive.
FAREWELL_S = 2.0

ABORT = "servodeck.abort"


def abort_of(scope: Scope) -> Callable[[], None]:
    """Cuts that request's connection, also where its other end does not read."""
    abort: Callable[[], None] = scope["extensions"][ABORT]["abort"]
    return abort


class ImpatientProtocol(HttpToolsProtocol):
    _timer: asyncio.TimerHandle | None = None
    _head_bytes = 0
    _in_head = False
    _in_body = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._end_in(FIRST_BYTE_S)

    def connection_lost(self, exc: Exception | None) -> None:
        self._end_in(None)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if self._in_head:
            self._count(len(data))

    def handle_websocket_upgrade(self) -> None:
        self._end_in(None)
        super().handle_websocket_upgrade()

    def on_message_begin(self) -> None:
        super().on_message_begin()
        self._in_head, self._head_bytes = True, 0
        self._end_in(HEAD_S)

    def on_headers_complete(self) -> None:
        self._in_head, self._in_body = False, True
        self._end_in(BODY_S)
        super().on_headers_complete()
        self.scope["extensions"] = {ABORT: {"abort": self.transport.abort}}

    def on_message_complete(self) -> None:
        self._in_body = False
        self._end_in(None)
        super().on_message_complete()

    def on_response_complete(self) -> None:
        if self._in_body:  # for good: uvicorn would keep it open without an end
            self.loop.call_later(ANSWERED_S, self.transport.abort)
        super().on_response_complete()

    def _count(self, size: int) -> None:
        self._head_bytes += size
        if self._head_bytes > HEAD_BYTES:
            self.transport.abort()

    def _end_in(self, seconds: float | None) -> None:
        """The connection, unless this is called again before; None lets it be."""
        if self._timer:
            self._timer.cancel()
        self._timer = None if seconds is None else self.loop.call_later(seconds, self.transport.abort)


class ImpatientSocket(WebSocketsSansIOProtocol):
    """To close is not enough: what was written and is not read would keep the connection for good."""

    def keepalive_timeout(self) -> None:
        super().keepalive_timeout()
        self.transport.abort()

    async def send(self, message: ASGISendEvent) -> None:
        if self.close_sent:  # nobody's mistake: it was on its way when the end came
            raise ClientDisconnected
        await super().send(message)

    async def run_asgi(self) -> None:
        await super().run_asgi()
        self.loop.call_later(FAREWELL_S, self.transport.abort)
