"""The whole gateway for a test: behind HTTP without a socket, or as a real server on a free port."""

import asyncio
import os
import socket
import time
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

from httpx2 import ASGITransport, AsyncClient
from starlette.types import ASGIApp

from servodeck.access import addresses
from servodeck.access.addresses import Access
from servodeck.access.devices import Devices, NoDeviceStore
from servodeck.access.entrance import Entrance
from servodeck.api.app import create_app
from servodeck.api.cameras import Camera
from servodeck.api.library import robots_in
from servodeck.api.page import STATIC
from servodeck.api.server import Server
from servodeck.files import Remembered
from servodeck.library.library import Library, wall_clock_ms
from servodeck.notify.notifications import Notifications
from servodeck.port.link import Ports
from servodeck.robot.control import Control

PORT = 8300
DEVICE = "/dev/board"
# Below a device, where no folder can be: code that stores without a library fails.
NO_LIBRARY = Library(Path(os.devnull) / "none")


def entrance_to(where: Access | None = None, now: Callable[[], float] = time.monotonic) -> Entrance:
    """One that stores no device; local by default."""
    return Entrance(where or addresses.local(PORT), Devices(NoDeviceStore(), wall_clock_ms), now)


def remembered_in(library: Library) -> Remembered:
    return Remembered(None if library is NO_LIBRARY else library.folder)


@asynccontextmanager
async def http_to(
    ports: Ports,
    now: Callable[[], float],
    device: str | None = DEVICE,
    static: Path = STATIC,
    library: Library | None = None,
    entrance: Entrance | None = None,
) -> AsyncIterator[tuple[AsyncClient, Control]]:
    """A client of the application itself, and what stands behind it; its port is open when it starts."""
    library = library or NO_LIBRARY
    control = Control(
        ports,
        now,
        "doc",
        device,
        remembered=remembered_in(library),
        read_robot=robots_in(library),
    )
    if device:
        await control.use_port(device)
        await control.until_identified()
    app = create_app(control, library, entrance or entrance_to(), static)
    async with client_of(app) as client:
        yield client, control
    await control.board.link.close()


def client_of(app: ASGIApp) -> AsyncClient:
    transport = ASGITransport(app, raise_app_exceptions=False)
    return AsyncClient(transport=transport, base_url=f"http://127.0.0.1:{PORT}")


@dataclass
class Running:
    host: str
    control: Control
    server: Server
    entrance: Entrance

    @property
    def address(self) -> tuple[str, int]:
        name, _, port = self.host.rpartition(":")
        return name, int(port)

    @property
    def ws(self) -> str:
        return f"ws://{self.host}/ws"


@asynccontextmanager
async def server_on(
    ports: Ports,
    device: str | None = DEVICE,
    make_access: Callable[[int], Access] = addresses.local,
    library: Library = NO_LIBRARY,
    cameras: Sequence[Camera] = (),
    notifications: Notifications | None = None,
) -> AsyncIterator[Running]:
    """A real server on a free port."""
    listener = socket.create_server(("127.0.0.1", 0))
    port = listener.getsockname()[1]
    control = Control(ports, time.monotonic, "doc", device, read_robot=robots_in(library))
    ready = asyncio.Event()
    entrance = entrance_to(make_access(port))
    app = create_app(control, library, entrance, cameras=cameras, notifications=notifications)
    server = Server(app, control, device, ready.set)
    life = asyncio.create_task(server.serve([listener]))
    await ready.wait()
    if device:
        await control.until_identified()
    try:
        yield Running(f"127.0.0.1:{port}", control, server, entrance)
    finally:
        server.leave()
        await life
