"""A port of this computer without a gateway's server: the robot core and its rules run in a thread of this
program, and requests reach them without a socket.

Loads what the gateway loads, FastAPI too. Knows no request of ours; what may move is judged as everywhere.
"""

import asyncio
import atexit
import concurrent.futures
import contextlib
import math
import queue
import tempfile
import threading
import time
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import unquote

from starlette.types import ASGIApp, Message, Scope

from servodeck.access import addresses
from servodeck.access.devices import Devices, NoDeviceStore
from servodeck.access.entrance import Entrance
from servodeck.api.app import create_app
from servodeck.api.library import robots_in
from servodeck.client.ending import before_signals, no_signals
from servodeck.client.errors import UnreachableError
from servodeck.client.transport import GATEWAY_PORT, Answer, Headers
from servodeck.client.values import robot_in, servos_of
from servodeck.errors import OutOfRangeError
from servodeck.library.library import Library, wall_clock_ms
from servodeck.port.link import BackgroundPorts
from servodeck.protocol.families import FAMILIES
from servodeck.robot.control import Control
from servodeck.snapshots import NamedPose, PoseTarget, RobotFacts, ServoLimits

T = TypeVar("T")
HOST = f"127.0.0.1:{GATEWAY_PORT}"
OPEN_S, CLOSE_S = 30.0, 5.0
DOCUMENT = "robot"


class DirectTransport:
    def __init__(self, device: str, board: str, robot: str | Path | None) -> None:
        """Opens the port. `robot`: a file of the page's export. Raises a GatewayError."""
        if board not in FAMILIES:
            raise OutOfRangeError(f"board is {board}, allowed: {', '.join(FAMILIES)}")
        text = None if robot is None else Path(robot).read_text("utf-8")
        facts = None if text is None else facts_of(text, board)
        self._folder = tempfile.TemporaryDirectory(prefix="servodeck-")
        self._library = Library(Path(self._folder.name))
        if text and facts:
            self._library.write(DOCUMENT, text, facts.model_dump_json(), 0, kind="robot")
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="robot", daemon=True)
        self._thread.start()
        self._control: Control | None = None
        self._ending: concurrent.futures.Future[None] | None = None
        self._is_closed = False
        atexit.register(self.close)  # a program that ends stops its robot
        self.mind_signals()
        try:
            self._app = self._result_of(self._opened(device, board, has_robot=facts is not None), OPEN_S)
        except BaseException:
            self.close()
            raise

    async def _opened(self, device: str, board: str, *, has_robot: bool) -> ASGIApp:
        self._control = control = Control(
            BackgroundPorts(),
            time.monotonic,
            board,
            device,
            identifies_board=True,
            read_robot=robots_in(self._library),
        )
        await control.use_port(device)
        if has_robot:
            await control.robot.put(DOCUMENT, None)
        devices = Devices(NoDeviceStore(), wall_clock_ms)
        return create_app(
            control, self._library, Entrance(addresses.local(GATEWAY_PORT), devices, control.now)
        )

    def request(
        self,
        method: str,
        path: str,
        headers: Headers,
        body: bytes | None,
        timeout_s: float,
        look_s: float = math.inf,  # noqa: ARG002 (it cannot vanish)
        look: Callable[[], object] = lambda: None,  # noqa: ARG002
    ) -> Answer:
        return self._result_of(self._request(method, path, headers, body or b""), timeout_s)

    def stream(self, path: str, headers: Headers, timeout_s: float) -> "DirectStream":
        stream = DirectStream(self._loop)
        asyncio.run_coroutine_threadsafe(
            stream.run(self._app, scope_of("GET", path, headers, b"")), self._loop
        )
        stream.begin(timeout_s)
        return stream

    def mind_signals(self) -> None:
        before_signals(self.close)

    def close(self) -> None:
        """Stops the robot and closes the port. A second call, as by a signal in the middle of the first,
        waits until the robot is stopped. Ctrl-C meanwhile is raised behind the stops, not in place of them.
        """
        if self._ending is None:
            self._ending = asyncio.run_coroutine_threadsafe(self._ended(), self._loop)
        interrupt = interrupt_during(self._ending)
        if not self._is_closed:
            self._release()
        if interrupt:
            raise interrupt

    def _release(self) -> None:
        self._is_closed = True
        atexit.unregister(self.close)
        no_signals(self.close)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(CLOSE_S)
        if not self._thread.is_alive():
            self._loop.close()
        self._library.close()
        self._folder.cleanup()

    async def _ended(self) -> None:
        if self._control:
            await self._control.shut_down()
        others = asyncio.all_tasks() - {asyncio.current_task()}
        for task in others:
            task.cancel()
        await asyncio.gather(*others, return_exceptions=True)

    async def _request(self, method: str, path: str, headers: Headers, body: bytes) -> Answer:
        heard: list[Message] = [{"type": "http.request", "body": body}]
        said: list[Message] = []
        is_answered = asyncio.Event()

        async def receive() -> Message:
            if not heard:
                await is_answered.wait()
            return heard.pop() if heard else {"type": "http.disconnect"}

        async def send(message: Message) -> None:
            said.append(message)

        try:
            await self._app(scope_of(method, path, headers, body), receive, send)
        finally:
            is_answered.set()
        start, *parts = said
        named = {name.decode(): text.decode() for name, text in start["headers"]}
        return Answer(start["status"], named, b"".join(part.get("body", b"") for part in parts))

    def _result_of(self, work: Coroutine[Any, Any, T], timeout_s: float) -> T:
        future = asyncio.run_coroutine_threadsafe(work, self._loop)
        try:
            return future.result(timeout_s)
        except concurrent.futures.TimeoutError as error:
            future.cancel()
            raise UnreachableError("The port did not answer in time.") from error
        except KeyboardInterrupt:
            future.cancel()
            raise


def interrupt_during(ending: "concurrent.futures.Future[None]") -> KeyboardInterrupt | None:
    """Waits until it is over, also where Ctrl-C is pressed meanwhile; returns that."""
    found: KeyboardInterrupt | None = None
    while True:
        try:
            with contextlib.suppress(concurrent.futures.TimeoutError):
                ending.result(CLOSE_S)
        except KeyboardInterrupt as interrupt:
            found = interrupt
        else:
            return found


class DirectStream:
    """Of events, between two threads."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.status = 0
        self._loop = loop
        self._parts: queue.Queue[Message | None] = queue.Queue()
        self._lines: list[bytes] = []
        self._is_gone = asyncio.Event()

    async def run(self, app: ASGIApp, scope: Scope) -> None:
        async def receive() -> Message:
            await self._is_gone.wait()
            return {"type": "http.disconnect"}

        async def send(message: Message) -> None:
            self._parts.put(message)

        try:
            await app(scope, receive, send)
        finally:
            self._parts.put(None)

    def begin(self, timeout_s: float) -> None:
        start = self._next(timeout_s)
        if start is None:
            raise UnreachableError("The event stream has ended.")
        self.status = start["status"]

    def rest(self) -> bytes:
        body = b""
        while part := self._next(CLOSE_S):
            body += part.get("body", b"")
        return body

    def line(self, timeout_s: float) -> bytes:
        while not self._lines:
            part = self._next(timeout_s)
            if part is None:
                return b""
            self._lines = part["body"].splitlines(keepends=True)
        return self._lines.pop(0)

    def close(self) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed
            self._loop.call_soon_threadsafe(self._is_gone.set)

    def _next(self, timeout_s: float) -> Message | None:
        try:
            return self._parts.get(timeout=timeout_s)
        except queue.Empty as error:
            raise UnreachableError("No event came in time.") from error


def scope_of(method: str, path: str, headers: Headers, body: bytes) -> Scope:
    """As a server makes it from a request of this computer."""
    whole = {**headers, "Host": HOST, "Content-Length": str(len(body))}
    return {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http",
        "path": unquote(path),
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": [(name.lower().encode(), text.encode()) for name, text in whole.items()],
        "client": ("127.0.0.1", 0),
        "server": ("127.0.0.1", GATEWAY_PORT),
    }


def facts_of(text: str, board: str) -> RobotFacts:
    """As the page makes them of a robot's file: its limits, and home as its one pose."""
    described = robot_in(text)
    servos = servos_of(described)
    home = [PoseTarget(servo=one.number, position=one.home) for one in servos]
    return RobotFacts(
        kind="robot",
        name=described["name"],
        board=described["board"],
        updated_at_ms=0,
        limits=[ServoLimits(servo=one.number, name=one.name, min=one.min, max=one.max) for one in servos],
        poses=[NamedPose(id=0, name="home", unit=FAMILIES[board].unit, targets=home)],
    )
