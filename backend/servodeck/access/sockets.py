"""The WebSocket of one client, on the sans-I/O core of `websockets` (docs/adr/0061): messages in, texts out,
both bounded. What has come is parsed in small pieces, one in a turn of the event loop; control frames and
fragments count as messages do; a client that does not read is cut off.

Knows frames, bytes and time, no message's meaning.
"""

import asyncio
import logging
import secrets
from collections import deque
from collections.abc import Callable
from http import HTTPStatus
from typing import Any, cast
from urllib.parse import unquote

from starlette.types import Message
from uvicorn.config import Config
from uvicorn.server import ServerState
from websockets.datastructures import Headers
from websockets.exceptions import InvalidState
from websockets.frames import CloseCode, Frame, Opcode
from websockets.http11 import Request, Response
from websockets.protocol import State as Phase
from websockets.server import ServerProtocol

from servodeck.access.connections import EXTENSION, Losable, shared
from servodeck.callers import Rate

# A frame takes 6 bytes at least and 10 µs to parse: a STOP waits 4 ms for one piece.
PIECE_BYTES = 2 * 1024
# Pongs, pings and messages that wait for the client, in addition to what the system holds. Above 64 KiB a
# message waits.
UNREAD_BYTES = 128 * 1024
# Control frames and fragments a second, and at once, where the application names no limit of its own.
FRAMES = (10.0, 100)
# Time in which the reason of a close reaches the client.
CLOSE_S = 2.0
PING_BYTES = 4
log = logging.getLogger("uvicorn.error")


class Socket(Losable, asyncio.Protocol):
    """A server of uvicorn makes one for each upgrade, as its `ws`, and has it run the application."""

    def __init__(self, config: Config, server_state: ServerState, app_state: dict[str, Any]) -> None:
        self._config = config
        self._shared = shared(server_state)
        self._app_state = app_state
        self._loop = asyncio.get_running_loop()
        self._core = ServerProtocol(max_size=config.ws_max_size, logger=log)
        self.transport: asyncio.Transport
        self._count: Callable[[], bool] = Rate(*FRAMES, self._loop.time).take
        # Bytes that are not parsed yet: one read of the transport, which is paused meanwhile.
        self._unparsed = memoryview(b"")
        self._received: deque[Message] = deque()
        self._has_received = asyncio.Event()
        self._message = bytearray()
        self._is_text = True
        self._may_write = asyncio.Event()
        self._may_write.set()
        self._response: Response | None = None
        self._denial = b""
        self._has_answered = False
        self._is_parsing = False
        self._is_broken = False
        self._has_left = False
        self._ping = b""
        self._timer: asyncio.TimerHandle | None = None

    # Called by the server

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast("asyncio.Transport", transport)
        self._shared.connections.add(self)  # type: ignore[arg-type]  # the server asks for `shutdown` alone

    def shutdown(self) -> None:
        if self._core.state is Phase.OPEN:
            self._core.send_close(CloseCode.SERVICE_RESTART)
            self._write()
        self._leave(CloseCode.SERVICE_RESTART)
        self.transport.close()

    # Called by the application

    def know(self) -> None:
        """Only who is known may upgrade."""
        self._shared.unauthenticated.remove(self.transport)

    def abort(self) -> None:
        self.transport.abort()

    def limit_frames(self, count: Callable[[], bool]) -> None:
        """Calls `count` for each control frame and fragment; the connection ends where it returns False."""
        self._count = count

    async def receive(self) -> Message:
        if not self._received:
            self._parse_soon()
        while not self._received:
            self._has_received.clear()
            await self._has_received.wait()
        return self._received.popleft()

    async def send(self, message: Message) -> None:
        await self._may_write.wait()
        if self._has_left or self.transport.is_closing():
            raise ConnectionResetError
        try:
            SENDS[message["type"]](self, message)
        except InvalidState:  # the end was on its way when this came
            raise ConnectionResetError from None
        self._write()

    def _accept(self, message: Message) -> None:
        assert self._response
        for name, value in message.get("headers", []):
            self._response.headers[name.decode("latin-1")] = value.decode("latin-1")
        self._core.send_response(self._response)
        self._has_answered = True
        self._ping_later()

    def _begin_denial(self, message: Message) -> None:
        headers = Headers(
            (name.decode("latin-1"), value.decode("latin-1")) for name, value in message["headers"]
        )
        status = HTTPStatus(message["status"])
        self._response = Response(status, status.phrase, headers)

    def _deny(self, message: Message) -> None:
        self._denial += message.get("body", b"")
        if message.get("more_body", False):
            return
        assert self._response
        self._response.body = self._denial
        self._response.headers.setdefault("Content-Length", str(len(self._denial)))
        self._response.headers.setdefault("Connection", "close")
        self._core.send_response(self._response)
        self._has_answered = True

    def _send_text(self, message: Message) -> None:
        self._core.send_text(message["text"].encode())

    def _close(self, message: Message) -> None:
        if self._has_answered:
            self._core.send_close(message.get("code", CloseCode.NORMAL_CLOSURE), message.get("reason") or "")
        else:
            self._core.send_response(self._core.reject(HTTPStatus.FORBIDDEN, ""))
            self._has_answered = True
        self._end_in(CLOSE_S)

    async def _run(self, request: Request) -> None:
        path, _, query = request.path.partition("?")
        scope = {
            "type": "websocket",
            "asgi": {"version": self._config.asgi_version, "spec_version": "2.4"},
            "http_version": "1.1",
            "scheme": "ws",
            "server": self.transport.get_extra_info("sockname")[:2],
            "client": self.transport.get_extra_info("peername")[:2],
            "root_path": "",
            "path": unquote(path),
            "raw_path": path.encode("ascii"),
            "query_string": query.encode("ascii"),
            "headers": [
                (name.lower().encode("ascii"), value.encode("latin-1"))
                for name, value in request.headers.raw_items()
            ],
            "subprotocols": [],
            "state": self._app_state.copy(),
            "extensions": {"websocket.http.response": {}, EXTENSION: {"connection": self}},
        }
        try:
            await self._config.loaded_app(scope, self.receive, self.send)
        except OSError:
            pass  # the client has left
        except Exception:
            log.exception("Exception in ASGI application")
        if self._core.state is Phase.CONNECTING and not self._has_answered:
            self._core.send_response(self._core.reject(HTTPStatus.INTERNAL_SERVER_ERROR, ""))
        elif self._core.state is Phase.OPEN:
            self._core.send_close(CloseCode.NORMAL_CLOSURE)
        self._write()
        self._end_in(CLOSE_S)

    # What comes from the client

    def data_received(self, data: bytes) -> None:
        self.transport.pause_reading()
        self._unparsed = memoryview(data)
        if not self._has_answered and self._response is None:
            self._parse()  # the request: it has been checked
        elif not self._received:
            self._parse_soon()

    def eof_received(self) -> None:
        """The transport closes itself; what has come before is still parsed."""

    def connection_lost(self, _error: Exception | None) -> None:
        self._shared.unauthenticated.remove(self.transport)
        self._shared.connections.discard(self)
        self._has_left = True
        self._end_in(None)
        self._may_write.set()
        self._notify_lost()
        if not self._received:
            self._parse_soon()

    def pause_writing(self) -> None:
        self._may_write.clear()

    def resume_writing(self) -> None:
        self._may_write.set()

    def _parse_soon(self) -> None:
        if not self._is_parsing:
            self._is_parsing = True
            self._loop.call_soon(self._parse)

    def _parse(self) -> None:
        """One piece, and the next one in the next turn, until the application has a message to take."""
        self._is_parsing = False
        if self._unparsed:
            piece, self._unparsed = self._unparsed[:PIECE_BYTES], self._unparsed[PIECE_BYTES:]
            self._core.receive_data(bytes(piece))
            for event in self._core.events_received():
                if not self._is_broken:
                    self._take(event)
            if self._core.parser_exc and not self._is_broken:
                self._is_broken = True
                self._leave(
                    self._core.close_sent.code if self._core.close_sent else CloseCode.ABNORMAL_CLOSURE
                )
            self._write()
        if self._is_broken:
            self._unparsed = memoryview(b"")
        if self._received:
            return
        if self._unparsed:
            self._parse_soon()
        elif self._has_left:
            self._leave(CloseCode.ABNORMAL_CLOSURE)
        elif not self.transport.is_closing() and not self._is_broken:
            self.transport.resume_reading()

    def _take(self, event: Any) -> None:
        if isinstance(event, Request):
            self._take_request(event)
        elif isinstance(event, Frame):
            if event.opcode is Opcode.CLOSE:
                closed = self._core.close_rcvd
                self._leave(closed.code if closed else CloseCode.NO_STATUS_RCVD)
                self._end_in(CLOSE_S)
            elif event.opcode in (Opcode.PING, Opcode.PONG):
                self._take_control(event)
            else:
                self._take_part(event)

    def _take_request(self, request: Request) -> None:
        self._response = self._core.accept(request)
        if self._response.status_code != HTTPStatus.SWITCHING_PROTOCOLS:
            self._core.send_response(self._response)
            self._has_answered = True
            self._end_in(CLOSE_S)
            return
        self._received.append({"type": "websocket.connect"})
        task = self._loop.create_task(self._run(request))
        self._shared.tasks.add(task)
        task.add_done_callback(self._shared.tasks.discard)

    def _take_control(self, frame: Frame) -> None:
        if frame.opcode is Opcode.PONG and self._ping and bytes(frame.data) == self._ping:
            self._ping_later()
        self._count_frame()

    def _take_part(self, frame: Frame) -> None:
        if frame.opcode is not Opcode.CONT:
            self._is_text = frame.opcode is Opcode.TEXT
        self._message += frame.data
        if not frame.fin:
            self._count_frame()
            return
        data, self._message = bytes(self._message), bytearray()
        if self._core.state is not Phase.OPEN:
            return
        try:
            kind: Message = {"text": data.decode()} if self._is_text else {"bytes": data}
        except UnicodeDecodeError:
            self._break(CloseCode.INVALID_DATA, "This is not UTF-8.")
        else:
            self._receive({"type": "websocket.receive", **kind})

    def _count_frame(self) -> None:
        if not self._count():
            self._break(CloseCode.POLICY_VIOLATION, "Too many messages.")

    def _break(self, code: CloseCode, reason: str) -> None:
        """Ends the connection with that code. What comes then is not even read."""
        self._is_broken = True
        self._core.fail(code, reason)
        self._leave(code)

    def _leave(self, code: int) -> None:
        self._receive({"type": "websocket.disconnect", "code": code})

    def _receive(self, message: Message) -> None:
        self._received.append(message)
        self._has_received.set()

    # Shared by both ways

    def _write(self) -> None:
        if self.transport.is_closing():
            return
        data = self._core.data_to_send()
        if written := b"".join(data):
            self.transport.write(written)
        if b"" in data:  # the end
            if self.transport.can_write_eof():
                self.transport.write_eof()
            self._end_in(CLOSE_S)
        if self.transport.get_write_buffer_size() > UNREAD_BYTES:
            self.transport.abort()

    def _ping_later(self) -> None:
        self._ping = b""
        if self._config.ws_ping_interval and self._core.state is Phase.OPEN:
            self._end_in(None)
            self._timer = self._loop.call_later(self._config.ws_ping_interval, self._ping_now)

    def _ping_now(self) -> None:
        if self._core.state is Phase.OPEN:
            self._ping = secrets.token_bytes(PING_BYTES)
            self._core.send_ping(self._ping)
            self._write()
            self._end_in(self._config.ws_ping_timeout)

    def _end_in(self, seconds: float | None) -> None:
        """Closing is not enough: what the client does not read would hold the connection for good."""
        if self._timer:
            self._timer.cancel()
        self._timer = None
        if seconds is not None and not self._has_left:
            self._timer = self._loop.call_later(seconds, self.transport.abort)


SENDS: dict[str, Callable[[Socket, Message], None]] = {
    "websocket.accept": Socket._accept,
    "websocket.http.response.start": Socket._begin_denial,
    "websocket.http.response.body": Socket._deny,
    "websocket.send": Socket._send_text,
    "websocket.close": Socket._close,
}
