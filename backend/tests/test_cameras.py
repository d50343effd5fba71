"""Cameras of the gateway: a real one on a socket, its pictures through a real server."""

import asyncio
import contextlib
import shutil
import socket
import subprocess
import threading
from collections.abc import AsyncIterator, Iterator
from http.client import IncompleteRead
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import SimpleNamespace
from typing import Any

import pytest
from httpx2 import AsyncClient

from servodeck.api.cameras import (
    CHUNK_BYTES,
    MOST_STREAMS,
    WAITING_CHUNKS,
    Camera,
    Relay,
    parse_camera,
    relayed,
)
from servodeck.errors import PortMissingError
from tests.fake_port import FakePorts
from tests.running import server_on
from tests.stubborn import WAYS, stubborn

pytestmark = pytest.mark.slow

BOUNDARY = "frame"
FRAME = b"\xff\xd8" + bytes(2000) + b"\xff\xd9"
PART = (
    b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: "
    + str(len(FRAME)).encode()
    + b"\r\n\r\n"
    + FRAME
)
ODD_KINDS = {
    "/folded": f"multipart/x-mixed-replace;\r\n boundary={BOUNDARY}",
    "/tabbed": f"multipart/x-mixed-replace;\x0bboundary={BOUNDARY}",
    "/control": f"multipart/x-mixed-replace; boundary=\x01{BOUNDARY}",
}
MOVED = {"/moved": "/three", "/away": "http://localhost:{port}/three"}
SECRET = "Basic dXNlcjpwQHNz"  # user:p@ss


class Picture(BaseHTTPRequestHandler):
    """`/endless`: frames until the viewer leaves; `/three`: three of them; `/page`, `/still`: no motion JPEG;
    `/rtsp`: no HTTP; `/moved`, `/away`: three are at another address, on this host or another.
    """

    def do_GET(self) -> None:
        if self.path == "/secret" and self.headers["Authorization"] != SECRET:
            self.send_error(401)
            return
        if self.path == "/rtsp":
            self.wfile.write(b"RTSP/1.0 400 Bad Request\r\n\r\n")
            return
        if self.path in MOVED:
            self.send_response(302)
            self.send_header(
                "Location", MOVED[self.path].format(port=self.headers["Host"].rpartition(":")[2])
            )
            self.end_headers()
            return
        self.send_response(200)
        motion = f"multipart/x-mixed-replace; boundary={BOUNDARY}"
        kinds = {**ODD_KINDS, "/page": "text/html", "/still": "image/jpeg"}
        self.send_header("Content-Type", kinds.get(self.path, motion))
        self.end_headers()
        count = 0
        with contextlib.suppress(OSError):
            while self.path == "/endless" or count < 3:
                self.wfile.write(PART)
                count += 1

    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def source() -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), Picture)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}"
    server.shutdown()
    server.server_close()


@contextlib.asynccontextmanager
async def gateway(*cameras: Camera) -> AsyncIterator[AsyncClient]:
    nowhere = FakePorts(PortMissingError("There is none."))
    async with (
        server_on(nowhere, None, cameras=cameras) as running,
        AsyncClient(base_url=f"http://{running.host}") as client,
    ):
        yield client


async def test_a_picture_goes_through_as_it_comes(source: str) -> None:
    async with gateway(Camera("Bench", f"{source}/three"), Camera("Hall", f"{source}/endless")) as client:
        listed = await client.get("/api/cameras")
        assert listed.json() == [{"id": 0, "name": "Bench"}, {"id": 1, "name": "Hall"}]
        answer = await client.get("/api/cameras/0/stream")
        assert answer.headers["content-type"] == f"multipart/x-mixed-replace; boundary={BOUNDARY}"
        assert answer.content == PART * 3


async def test_a_viewer_that_leaves_makes_room_for_the_next(source: str) -> None:
    async with gateway(Camera("Hall", f"{source}/endless")) as client, asyncio.timeout(20):
        for _ in range(2):
            async with contextlib.AsyncExitStack() as viewers:
                # Held, because a reader that is thrown away ends its answer.
                readers = [await first_chunk_of(viewers, client) for _ in range(MOST_STREAMS)]
                one_more = await client.get("/api/cameras/0/stream")
                assert (one_more.status_code, one_more.json()["code"]) == (429, "busy")
                assert len(readers) == MOST_STREAMS
            while await status_of_stream(client) != 200:  # noqa: ASYNC110 (nothing says that the gateway has noticed)
                await asyncio.sleep(0.02)


async def first_chunk_of(viewers: contextlib.AsyncExitStack, client: AsyncClient) -> AsyncIterator[bytes]:
    answer = await viewers.enter_async_context(client.stream("GET", "/api/cameras/0/stream"))
    assert answer.status_code == 200
    reader = answer.aiter_bytes()
    assert await anext(reader)
    return reader


async def status_of_stream(client: AsyncClient, camera: int = 0) -> int:
    async with client.stream("GET", f"/api/cameras/{camera}/stream") as answer:
        return answer.status_code


async def test_what_is_no_picture_is_refused_with_the_reason(source: str) -> None:
    addresses = (f"{source}/page", f"{source}/still", f"{source}/rtsp", "http://127.0.0.1:9/")
    reasons = ("sends text/html", "sends image/jpeg", "does not answer: RTSP/1.0 400", "does not answer")
    async with gateway(*(Camera("Bench", address) for address in addresses)) as client:
        for index, reason in enumerate(reasons):
            answer = await client.get(f"/api/cameras/{index}/stream")
            assert (answer.status_code, answer.json()["code"]) == (502, "cameraFailed")
            assert reason in answer.json()["detail"]
        assert (await client.get(f"/api/cameras/{len(addresses)}/stream")).status_code == 404


@pytest.mark.parametrize(("path", "status"), [("/folded", 200), ("/tabbed", 200), ("/control", 502)])
async def test_an_odd_kind_goes_on_as_one_line_or_is_refused(source: str, path: str, status: int) -> None:
    async with gateway(Camera("Bench", source + path)) as client:
        answer = await client.get("/api/cameras/0/stream")
    assert answer.status_code == status
    if status == 200:
        assert answer.headers["content-type"] == f"multipart/x-mixed-replace; boundary={BOUNDARY}"


async def test_a_name_and_password_in_the_address_go_to_the_camera_alone(source: str) -> None:
    address = source.replace("//", "//user:p%40ss@")
    async with gateway(Camera("Door", f"{address}/secret")) as client:
        assert (await client.get("/api/cameras/0/stream")).content == PART * 3
        assert "p@ss" not in (await client.get("/api/cameras")).text


@pytest.mark.parametrize("how", WAYS)
async def test_a_head_without_end_is_waited_for_no_longer_than_silence(
    how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.api.cameras.SILENT_S", 0.2)
    with stubborn(how) as camera:
        async with gateway(Camera("Bench", camera.address)) as client, asyncio.timeout(5):
            answer = await client.get("/api/cameras/0/stream")
            assert (answer.status_code, answer.json()["code"]) == (502, "cameraFailed")
            assert "timed out" in answer.json()["detail"]
            assert await asyncio.to_thread(camera.ended.acquire, timeout=2)


@pytest.mark.parametrize("how", WAYS)
async def test_a_viewer_that_leaves_ends_the_opening_and_makes_room(source: str, how: str) -> None:
    with stubborn(how) as camera:
        cameras = Camera("Bench", camera.address), Camera("Hall", f"{source}/endless")
        async with gateway(*cameras) as client, asyncio.timeout(9):
            viewers = [asyncio.create_task(client.get("/api/cameras/0/stream")) for _ in range(MOST_STREAMS)]
            for _ in viewers:
                assert await asyncio.to_thread(camera.begun.acquire, timeout=4)
            assert await status_of_stream(client, 1) == 429
            for viewer in viewers:
                viewer.cancel()
            for _ in viewers:
                assert await asyncio.to_thread(camera.ended.acquire, timeout=4)
            while await status_of_stream(client, 1) != 200:  # noqa: ASYNC110 (nothing says that all have left)
                await asyncio.sleep(0.02)


class Endless:
    """A source that counts what was read of it."""

    media_type = "multipart/x-mixed-replace; boundary=frame"

    def __init__(self) -> None:
        self.reads = 0
        self.is_closed = threading.Event()

    def read1(self, size: int) -> bytes:
        self.reads += 1
        return bytes(size)

    def close(self) -> None:
        self.is_closed.set()

    def abort(self) -> None:
        """It blocks nobody."""


async def test_nothing_is_read_that_a_slow_viewer_does_not_take() -> None:
    source = Endless()
    chunks = relayed(source, lambda: True)
    assert len(await anext(chunks)) == CHUNK_BYTES
    await asyncio.sleep(0.2)
    assert source.reads <= WAITING_CHUNKS + 1
    await chunks.aclose()
    assert await asyncio.to_thread(source.is_closed.wait, 2)


async def test_a_viewer_that_leaves_before_the_first_byte_holds_no_place() -> None:
    async def left() -> dict[str, str]:
        return {"type": "http.disconnect"}

    async def send(_: object) -> None:
        await asyncio.sleep(0)

    camera, state = Endless(), SimpleNamespace(open_streams=1)
    scope = {"type": "http", "asgi": {"spec_version": "2.3"}}
    async with asyncio.timeout(2):
        await Relay(camera, state, lambda: True)(scope, left, send)
    assert state.open_streams == 0
    assert await asyncio.to_thread(camera.is_closed.wait, 2)


async def test_a_camera_leads_to_another_address_on_its_own_host_only(source: str) -> None:
    async with gateway(Camera("Bench", f"{source}/moved"), Camera("Door", f"{source}/away")) as client:
        assert (await client.get("/api/cameras/0/stream")).content == PART * 3
        away = await client.get("/api/cameras/1/stream")
        assert (away.status_code, away.json()["code"]) == (502, "cameraFailed")


async def test_a_viewer_that_may_view_no_longer_loses_the_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.api.cameras.CHECK_EACH_S", 0.05)
    source, may_view = Endless(), True
    chunks = relayed(source, lambda: may_view)
    await anext(chunks)
    may_view = False
    async with asyncio.timeout(2):
        async for _ in chunks:
            pass
    assert await asyncio.to_thread(source.is_closed.wait, 2)


class Broken(Endless):
    """A source that fails from its `good + 1`-th read on."""

    def __init__(self, good: int, error: Exception) -> None:
        super().__init__()
        self.good, self.error = good, error

    def read1(self, size: int) -> bytes:
        if self.reads == self.good:
            raise self.error
        return super().read1(size)


@pytest.mark.parametrize("good", [0, 1])
@pytest.mark.parametrize("error", [TimeoutError(), IncompleteRead(b"")])  # silent; cut between two chunks
async def test_a_camera_that_fails_ends_the_picture(good: int, error: Exception) -> None:
    source = Broken(good, error)
    async with asyncio.timeout(2):
        chunks = [chunk async for chunk in relayed(source, lambda: True)]
    assert len(chunks) == good
    assert await asyncio.to_thread(source.is_closed.wait, 2)


@pytest.mark.parametrize(
    ("text", "name", "url"),
    [
        ("Bench=http://cam.local:8081/stream", "Bench", "http://cam.local:8081/stream"),
        ("http://cam.local/?action=stream", "cam.local", "http://cam.local/?action=stream"),
        (" Front door =https://u:p@10.0.0.2/x?a=b", "Front door", "https://u:p@10.0.0.2/x?a=b"),
    ],
)
def test_a_camera_is_a_name_and_an_address(text: str, name: str, url: str) -> None:
    assert parse_camera(text) == Camera(name, url)


@pytest.mark.parametrize("text", ["", "Bench", "file:///etc/passwd", "Bench=rtsp://cam/1", "Bench=http://"])
def test_anything_else_is_no_camera(text: str) -> None:
    with pytest.raises(ValueError, match="http://"):
        parse_camera(text)


@pytest.fixture
def filmed() -> Iterator[str]:
    """The address of a picture that ffmpeg makes. It takes one viewer."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        url = f"http://127.0.0.1:{free.getsockname()[1]}/stream"
    pictures = ["-re", "-f", "lavfi", "-i", "testsrc=size=320x240:rate=25", "-c:v", "mjpeg"]
    served = ["-f", "mpjpeg", "-content_type", "multipart/x-mixed-replace;boundary=ffmpeg", "-listen", "1"]
    command = ["ffmpeg", "-loglevel", "error", *pictures, *served, url]
    with subprocess.Popen(command, stdin=subprocess.DEVNULL) as ffmpeg:
        yield url
        ffmpeg.kill()


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed on this computer")
async def test_the_pictures_of_ffmpeg_go_through(filmed: str) -> None:
    async with gateway(Camera("Bench", filmed)) as client, asyncio.timeout(20):
        while (heads := await heads_of(client)) == []:  # noqa: ASYNC110 (nothing says that ffmpeg listens)
            await asyncio.sleep(0.1)
        assert all(head.startswith(b"\xff\xd8\xff") for head in heads)


async def heads_of(client: AsyncClient) -> list[bytes]:
    """The beginnings of five pictures; none where the camera is not there yet."""
    async with client.stream("GET", "/api/cameras/0/stream") as answer:
        if answer.status_code != 200:
            return []
        content = b""
        async for chunk in answer.aiter_bytes():
            content += chunk
            parts = content.split(b"\r\n\r\n")[1:]
            if len(parts) > 5:
                return [part[:3] for part in parts[:5]]
    return []
