"""The cameras of the gateway: their list, and the stream of each, relayed to clients that may view.
Motion JPEG; anything else is refused.

Knows the addresses of cameras and HTTP as a client; no robot, and nothing of a picture. Reads in a thread for
each viewer, no faster than the viewer does: on the event loop a STOP would wait for it.
"""

import asyncio
import base64
import contextlib
import threading
import time
from collections.abc import AsyncGenerator, Callable
from dataclasses import dataclass
from http.client import HTTPException
from typing import Annotated, Any
from urllib.parse import unquote, urlsplit, urlunsplit

from fastapi import Request as Requested
from starlette.responses import StreamingResponse
from starlette.types import Receive, Scope, Send

from servodeck.api.routes import VIEWER, entrance_in, routes
from servodeck.callers import Caller
from servodeck.errors import BusyError, CameraError, NotFoundError
from servodeck.schema import Message
from servodeck.threads import in_thread

KIND = "multipart/x-mixed-replace"
# A camera that sends nothing for so long, or no whole head, is gone.
SILENT_S = 10.0
CHUNK_BYTES = 32 * 1024
# Read ahead of a slow viewer.
WAITING_CHUNKS = 4
MOST_STREAMS = 12
# A viewer whose access is revoked loses the picture within that time.
CHECK_EACH_S = 1.0


@dataclass(frozen=True)
class Camera:
    name: str
    url: str


class CameraName(Message):
    """`id`: its place in the list that the gateway was started with."""

    id: int
    name: str


def parse_camera(text: str) -> Camera:
    """`NAME=URL`, or a URL alone. Raises ValueError with the reason."""
    name, separator, url = text.partition("=")
    if not separator or "://" in name:
        name, url = "", text
    parts = urlsplit(url)
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ValueError("it takes an address that begins with http:// or https://")
    return Camera(name.strip() or parts.hostname, url)


cameras_api = routes("/api/cameras", "cameras")


@cameras_api.get("", dependencies=[VIEWER])
async def list_cameras(request: Requested) -> list[CameraName]:
    """The cameras at the gateway."""
    return [CameraName(id=index, name=one.name) for index, one in enumerate(cameras_in(request))]


@cameras_api.get(
    "/{camera_id}/stream",
    response_class=StreamingResponse,
    responses={200: {"content": {"multipart/x-mixed-replace": {}}}},
)
async def stream(request: Requested, camera_id: int, caller: Annotated[Caller, VIEWER]) -> StreamingResponse:
    """The stream of a camera as motion JPEG, for as long as the client reads it. 502 if the camera does not
    answer or sends something else, 429 while too many streams are open.
    """
    cameras, state = cameras_in(request), request.app.state
    if not 0 <= camera_id < len(cameras):
        raise NotFoundError("There is no such camera.")
    if state.open_streams >= MOST_STREAMS:
        raise BusyError(f"{MOST_STREAMS} camera streams are open already. Close one of them, then try again.")
    state.open_streams += 1
    try:
        source = await source_for(request, cameras[camera_id])
    except BaseException:
        state.open_streams -= 1
        raise
    return Relay(source, state, lambda: entrance_in(request).still_lets_in(caller))


async def source_for(request: Requested, camera: Camera) -> "Source":
    """Raises CameraError, also where the viewer leaves before the camera answers."""
    source = Source()
    opening = asyncio.create_task(in_thread(lambda: source.open(camera), lambda _: close(source)))
    leaving = asyncio.create_task(until_gone(request.receive))
    try:
        await asyncio.wait({opening, leaving}, return_when=asyncio.FIRST_COMPLETED)
        if not opening.done():
            source.abort()
        await opening
    except BaseException:
        source.abort()
        raise
    finally:
        leaving.cancel()
        opening.cancel()
    return source


async def until_gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


class Relay(StreamingResponse):
    """Its place is free again when it ends, also if its viewer leaves before the first byte."""

    def __init__(self, source: Any, state: Any, may_view: Callable[[], bool]) -> None:
        super().__init__(self._chunks(may_view), media_type=source.media_type)
        self._source, self._state = source, state
        self._is_read = False

    async def _chunks(self, may_view: Callable[[], bool]) -> AsyncGenerator[bytes]:
        self._is_read = True
        async with contextlib.aclosing(relayed(self._source, may_view)) as chunks:
            async for chunk in chunks:
                yield chunk

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            self._state.open_streams -= 1
            if not self._is_read:  # else its thread closes it
                close(self._source)


def cameras_in(request: Requested) -> tuple[Camera, ...]:
    cameras: tuple[Camera, ...] = request.app.state.cameras
    return cameras


class Source:
    """The stream of a camera. Its methods block, but for `abort`, which ends the others from any thread."""

    media_type = KIND

    def __init__(self) -> None:
        from servodeck.fetching import Fetch

        self._fetch = Fetch(SILENT_S)
        self._answer: Any = None

    def open(self, camera: Camera) -> None:
        """Raises CameraError."""
        from urllib.error import HTTPError

        request, same_host = request_of(camera)
        try:
            self._answer = self._fetch.open(request, same_host)
        except (OSError, ValueError, HTTPException) as error:
            if isinstance(error, HTTPError):
                error.close()
            advice = "Check that it is on, and its address."
            raise CameraError(
                f"The camera {camera.name} does not answer: {reason_in(error)}. {advice}"
            ) from error
        kind = self._answer.headers.get_content_type()
        # On one line, as it may have come folded.
        self.media_type = " ".join(str(self._answer.headers["Content-Type"]).split())
        if kind != KIND or not self.media_type.isprintable():
            self._answer.close()
            advice = "Use an address of it that sends motion JPEG."
            raise CameraError(f"The camera {camera.name} sends {kind}. {advice}")

    def read1(self, size: int) -> bytes:
        found: bytes = self._answer.read1(size)
        return found

    def close(self) -> None:
        self._answer.close()

    def abort(self) -> None:
        self._fetch.abort()


def request_of(camera: Camera) -> tuple[Any, Any]:
    """With the handler of its redirections."""
    # They take as long to load as all routes.
    from urllib.request import HTTPRedirectHandler, Request

    class SameHost(HTTPRedirectHandler):
        """A password goes to its camera alone."""

        def redirect_request(self, req: Request, *answer: Any) -> Request | None:
            *_, address = answer
            is_same = urlsplit(address)[:2] == urlsplit(req.full_url)[:2]
            return super().redirect_request(req, *answer) if is_same else None

    parts = urlsplit(camera.url)
    headers = {}
    if parts.username is not None:
        pair = f"{unquote(parts.username)}:{unquote(parts.password or '')}"
        headers["Authorization"] = "Basic " + base64.b64encode(pair.encode()).decode()
    host = parts.netloc.rpartition("@")[2]
    return Request(urlunsplit(parts._replace(netloc=host)), headers=headers), SameHost


def reason_in(error: Exception) -> str:
    """In the words of the system, or of the camera's server."""
    cause = getattr(error, "reason", error)
    return str(getattr(cause, "strerror", None) or cause).strip()


def close(source: Any) -> None:
    with contextlib.suppress(OSError):
        source.close()


async def relayed(source: Any, may_view: Callable[[], bool]) -> AsyncGenerator[bytes]:
    """Ends with the camera, with the viewer, or with the access of the viewer."""
    loop = asyncio.get_running_loop()
    chunks: asyncio.Queue[bytes] = asyncio.Queue()
    room = threading.Semaphore(WAITING_CHUNKS)
    has_ended = threading.Event()

    def read() -> None:
        # Silent, cut, closed, or the loop has ended.
        with contextlib.suppress(OSError, HTTPException, ValueError, RuntimeError):
            while not has_ended.is_set() and (chunk := source.read1(CHUNK_BYTES)):
                loop.call_soon_threadsafe(chunks.put_nowait, chunk)
                room.acquire()
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(chunks.put_nowait, b"")
        close(source)

    threading.Thread(target=read, name="camera", daemon=True).start()
    checked_s = time.monotonic()
    try:
        while chunk := await chunks.get():
            if time.monotonic() - checked_s > CHECK_EACH_S:
                checked_s = time.monotonic()
                if not may_view():
                    return
            yield chunk
            room.release()
    finally:
        has_ended.set()
        room.release()
        source.abort()  # the thread may wait for a byte
