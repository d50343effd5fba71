"""Limits of connections, against clients that hold them open by sending little, or fill memory by sending
much: a request must come soon and whole, with a head of limited size; its body is read only when the route
needs it; its answer must be read. Only few unauthenticated connections stay open, because STOP needs the
descriptors.

Knows time, bytes and addresses, no request's meaning.
"""

import asyncio
import socket
from collections.abc import Callable
from typing import Protocol

from starlette.types import Scope
from uvicorn._types import ASGI3Application
from uvicorn.protocols.http.httptools_impl import STATUS_LINE, HttpToolsProtocol, RequestResponseCycle
from uvicorn.server import ServerState

# Beside 216 sessions, files and the port, far below the 1,024 descriptors that the process has.
MOST = 256
# A class behind one router loads the page at once: 6 connections of each of 20 browsers.
MOST_OF_ONE = 128


class Closable(Protocol):
    def abort(self) -> None: ...


class Unauthenticated:
    def __init__(self) -> None:
        # The one that was used longest ago comes first.
        self._sources: dict[Closable, str] = {}

    def add(self, connection: Closable, source: str) -> None:
        """One that was just opened from the address `source`."""
        self._sources[connection] = source
        of_source = [each for each, address in self._sources.items() if address == source]
        if len(of_source) > MOST_OF_ONE:
            self._end(of_source[0])
        elif len(self._sources) > MOST:
            self._end(next(iter(self._sources)))

    def use(self, connection: Closable) -> None:
        """A request or an answer passed on it."""
        if connection in self._sources:
            self._sources[connection] = self._sources.pop(connection)

    def remove(self, connection: Closable) -> None:
        """Its caller was authenticated, or it was closed."""
        self._sources.pop(connection, None)

    def _end(self, connection: Closable) -> None:
        self.remove(connection)
        connection.abort()


# Before its first request and between two. Browsers open a connection or two ahead of need, and again later.
IDLE_S = 2
# Of who is known, between two requests: longer than clients keep a connection for their next request, so that
# none of them sends a request on one that is just being closed.
KNOWN_IDLE_S = 20
HEAD_S = 1.0
# A library of 3 MiB over a poor wireless link; for who is unknown, the answer, too.
BODY_S = 30.0
# A client that has its answer and talks on may read it first.
ANSWERED_S = 0.5
HEAD_BYTES = 32 * 1024
HEADERS = 100
# The system's buffer for a connection that is not read; one read brings at most twice as much. A library of
# 3 MiB takes 100 windows of a known client.
RECEIVED_BYTES = 8 * 1024
KNOWN_RECEIVED_BYTES = 32 * 1024
# A pipeline of more requests than any client of ours sends.
PIPELINED = 8
# All answers together that nobody reads, and how long one waits for its reader.
UNREAD_BYTES = 8 * 1024 * 1024
UNREAD_S = 30.0
# Beyond it no connection waits for a next request.
MOST_WAITING = 600
# A browser answers by itself, also for a page that sleeps. Who does not read never gets to the ping.
PING_S = 10.0
PONG_S = 10.0


class Unread:
    """Answers whose readers are slow. Beyond a sum the one that has waited longest ends."""

    def __init__(self) -> None:
        # The one that has waited longest comes first.
        self._bytes: dict[Closable, int] = {}

    def add(self, connection: Closable, size: int) -> None:
        self._bytes[connection] = size
        while sum(self._bytes.values()) > UNREAD_BYTES:
            longest = next(iter(self._bytes))
            self.remove(longest)
            longest.abort()

    def remove(self, connection: Closable) -> None:
        """It has read, or was closed."""
        self._bytes.pop(connection, None)


EXTENSION = "servodeck.connection"
HEAD_REFUSED = b"""{"code":"tooLarge","detail":"The head of a request is at most 32 KiB and 100 headers."}"""


class Connection(Protocol):
    """The connection of a request."""

    def know(self) -> None:
        """Its caller was authenticated."""

    def when_lost(self, lost: Callable[[], None]) -> None:
        """Calls `lost` once when the client has gone, at once if it has already."""

    def abort(self) -> None:
        """Cuts it, also where the client does not read."""

    def limit_frames(self, count: Callable[[], bool]) -> None:
        """Of a WebSocket: calls `count` for each control frame and fragment, and ends where it is False."""


def connection_of(scope: Scope) -> Connection | None:
    """None where there is no server, as in a test."""
    connection: Connection | None = scope.get("extensions", {}).get(EXTENSION, {}).get("connection")
    return connection


MayUpgrade = Callable[[list[tuple[bytes, bytes]], str | None], bool]


class State(ServerState):
    """The state that all connections share."""

    def __init__(self, may_upgrade: MayUpgrade) -> None:
        """`may_upgrade` judges the headers of an upgrade that came in at that address of ours."""
        super().__init__()
        self.unauthenticated = Unauthenticated()
        self.unread = Unread()
        self.may_upgrade = may_upgrade


class Losable:
    """Notifies a listener when the connection is lost."""

    _is_lost = False
    _lost: Callable[[], None] | None = None

    def when_lost(self, lost: Callable[[], None]) -> None:
        if self._is_lost:
            lost()
        else:
            self._lost = lost

    def _notify_lost(self) -> None:
        self._is_lost = True
        if self._lost:
            self._lost()
        self._lost = None


class HeadTooLargeError(Exception):
    """Ends the parsing of a request."""


class TooManyRequestsError(Exception):
    """Ends the parsing of a pipeline."""


class ImpatientProtocol(Losable, HttpToolsProtocol):
    _timer: asyncio.TimerHandle | None = None
    _unread_timer: asyncio.TimerHandle | None = None
    _head_bytes = 0
    _received_bytes = 0
    _in_head = False
    _in_body = False
    _is_known = False
    _upgrades = False
    _answered: RequestResponseCycle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._end_in(IDLE_S)
        self._shared.unauthenticated.add(transport, self.client[0] if self.client else "")

    def connection_lost(self, exc: Exception | None) -> None:
        self._end_in(None)
        self._has_read()
        self._shared.unauthenticated.remove(self.transport)
        self._notify_lost()
        if self._answered:  # uvicorn looks at the request that came last, which may wait for its turn
            self._answered.disconnected = True
            self._answered.message_event.set()
        super().connection_lost(exc)
        self._forget()

    def _forget(self) -> None:
        """Breaks the circles of references: what was received would stay in memory until the garbage of all
        connections is collected.
        """
        self._unset_keepalive_if_required()
        self._answered = None
        self.pipeline.clear()
        self.parser = self.cycle = self.scope = self.headers = None  # type: ignore[assignment]

    def pause_writing(self) -> None:
        super().pause_writing()
        if self._unread_timer is None:
            self._unread_timer = self.loop.call_later(UNREAD_S, self.transport.abort)
        self._shared.unread.add(self.transport, self.transport.get_write_buffer_size())

    def resume_writing(self) -> None:
        super().resume_writing()
        self._has_read()

    def _has_read(self) -> None:
        self._shared.unread.remove(self.transport)
        if self._unread_timer:
            self._unread_timer.cancel()
        self._unread_timer = None

    def _start_asgi_task(self, cycle: RequestResponseCycle, app: ASGI3Application) -> None:
        self._answered = cycle
        super()._start_asgi_task(cycle, app)

    @property
    def _shared(self) -> State:
        return shared(self.server_state)

    def know(self) -> None:
        if not self._is_known and (opened := self.transport.get_extra_info("socket")):
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, KNOWN_RECEIVED_BYTES)
        self._is_known = True
        self.timeout_keep_alive = KNOWN_IDLE_S
        self._shared.unauthenticated.remove(self.transport)
        if not self._in_body:
            self._end_in(None)

    def abort(self) -> None:
        self.transport.abort()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if self._in_head:
            self._received_bytes += len(data)
            if self._received_bytes > HEAD_BYTES:  # a header that does not end
                self._refuse_head()

    def _should_upgrade(self) -> bool:
        """Else it is answered as any other request: a socket that is refused stays in memory, in circles of
        references, until the garbage of all of them is collected.
        """
        return self._upgrades

    def _unsupported_upgrade_warning(self) -> None:
        """Nothing to warn of: the module that refuses it says why."""

    def handle_websocket_upgrade(self) -> None:
        self._end_in(None)
        super().handle_websocket_upgrade()
        self._forget()

    def on_message_begin(self) -> None:
        if len(self.pipeline) >= PIPELINED:
            self.transport.abort()
            raise TooManyRequestsError
        super().on_message_begin()
        self._in_head, self._head_bytes, self._received_bytes = True, 0, 0
        self._end_in(HEAD_S)

    def on_header(self, name: bytes, value: bytes) -> None:
        super().on_header(name, value)
        self._head_bytes += len(name) + len(value)
        if self._is_head_too_large():
            raise HeadTooLargeError

    def on_headers_complete(self) -> None:
        self._in_head, self._in_body = False, True
        self._end_in(BODY_S)
        self._shared.unauthenticated.use(self.transport)
        self._upgrades = super()._should_upgrade() and self._shared.may_upgrade(
            self.headers, self.server[0] if self.server else None
        )
        super().on_headers_complete()
        if not (self.parser.should_upgrade() and self._upgrades):
            self.scope["extensions"] = {EXTENSION: {"connection": self}}
            self.flow.pause_reading()  # until the route needs the body

    def on_message_complete(self) -> None:
        self._in_body = False
        if self._is_known:
            self._end_in(None)
        if not self.pipeline:
            self.flow.resume_reading()
        super().on_message_complete()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        self._shared.unauthenticated.use(self.transport)
        if not self.cycle.response_complete or self._in_head:  # the next request is here already
            return
        if self._in_body:
            self.cycle.body = bytearray()
            self._hang_up()
        else:
            self._end_in(None)
            if len(self.connections) > MOST_WAITING:
                self.transport.close()

    def send_400_response(self, msg: str) -> None:
        if self._in_head and self._is_head_too_large():
            self._refuse_head()
        else:
            super().send_400_response(msg)

    def _is_head_too_large(self) -> bool:
        return self._head_bytes + len(self.url) > HEAD_BYTES or len(self.headers) > HEADERS

    def _refuse_head(self) -> None:
        self._in_head = False
        due = self._answered
        if due and not due.response_complete:  # an answer to an earlier request
            self.transport.abort()
            return
        head = b"content-type: application/json\r\nconnection: close\r\ncontent-length: %d\r\n\r\n"
        self.transport.write(STATUS_LINE[431] + head % len(HEAD_REFUSED) + HEAD_REFUSED)
        self._hang_up()

    def _hang_up(self) -> None:
        """Reads nothing more. A close with unread bytes would overtake the answer: that comes later."""
        self.flow.pause_reading()
        if self.transport.can_write_eof():
            self.transport.write_eof()
        self._end_in(ANSWERED_S)

    def _end_in(self, seconds: float | None) -> None:
        """The connection, unless this is called again before; None lets it be."""
        if self._timer:
            self._timer.cancel()
        self._timer = None if seconds is None else self.loop.call_later(seconds, self.transport.abort)


def shared(state: ServerState) -> State:
    assert isinstance(state, State)
    return state
