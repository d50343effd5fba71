"""The health of the gateway itself: the delay of its event loop, its descriptors, its messages to systemd;
`/api/health` for people and supervisors, `/metrics` for Prometheus.

Everything waits for the event loop, STOP too, so its delay is the gateway's own health. systemd's datagrams
are written by hand, because one is a line of text on a socket. Nothing here sends the board a byte or waits
for a lock.
"""

import asyncio
import contextlib
import os
import socket
from collections import deque
from collections.abc import Callable
from typing import Annotated, Literal

from fastapi import Depends, Request, Response
from starlette.requests import HTTPConnection

from servodeck import __version__
from servodeck.api.routes import PUBLIC, VIEWER, Controlled, routes
from servodeck.files import Disk
from servodeck.schema import Message
from servodeck.snapshots import FleetStatus, PortState

SAMPLE_EVERY_S = 0.25
REMEMBERED_S = 15.0


class LoopDelay:
    def __init__(self, after_each: Callable[[], None]) -> None:
        """`after_each` is called after each sample."""
        self._after_each = after_each
        self._delays_s: deque[float] = deque(maxlen=int(REMEMBERED_S / SAMPLE_EVERY_S))

    @property
    def worst_s(self) -> float:
        """The longest delay of the loop in the last quarter of a minute."""
        return max(self._delays_s, default=0.0)

    async def run(self) -> None:
        loop = asyncio.get_running_loop()
        while True:
            due = loop.time() + SAMPLE_EVERY_S
            await asyncio.sleep(SAMPLE_EVERY_S)
            self._delays_s.append(max(0.0, loop.time() - due))
            self._after_each()


def notify_systemd(state: str) -> None:
    """`READY=1`, `WATCHDOG=1`, `STOPPING=1`."""
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address or not hasattr(socket, "AF_UNIX"):
        return
    if address.startswith("@"):
        address = f"\0{address[1:]}"  # Linux's names without a file
    with contextlib.suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as telling:
        telling.setblocking(False)
        telling.connect(address)
        telling.send(state.encode())


def sign_of_life() -> Callable[[], None]:
    """To be called while the event loop runs: without it systemd restarts the gateway."""
    is_awaited = os.environ.get("WATCHDOG_PID", str(os.getpid())) == str(os.getpid())
    if "WATCHDOG_USEC" in os.environ and is_awaited:
        return lambda: notify_systemd("WATCHDOG=1")
    return lambda: None


# pyserial waits with select(), which takes no descriptor of a higher number.
WANTED = 1024


def allow_descriptors() -> None:
    """As many as are wanted, or as the system lets us have."""
    if os.name != "posix":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = WANTED if hard == resource.RLIM_INFINITY else min(WANTED, hard)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))


# Far above what a busy small computer shows, far below what a person at a slider would not notice.
LATE_S = 0.25


class Trouble(Message):
    part: Literal["port", "loop", "disk"]
    detail: str


class Health(Message):
    """`degraded`: it answers and can stop the robot, but one part of it does not work."""

    status: Literal["ready", "degraded"]
    version: str
    troubles: list[Trouble]


async def loop_delay_of(connection: HTTPConnection) -> LoopDelay:
    delay = connection.app.state.loop_delay
    assert isinstance(delay, LoopDelay)
    return delay


async def disk_of(connection: HTTPConnection) -> Disk:
    disk = connection.app.state.disk
    assert isinstance(disk, Disk)
    return disk


def fleet_status(connection: HTTPConnection) -> FleetStatus | None:
    found: FleetStatus | None = connection.app.state.on_broker()
    return found


Measured = Annotated[LoopDelay, Depends(loop_delay_of)]
Stored = Annotated[Disk, Depends(disk_of)]
health_api = routes("", "health")


@health_api.get("/api/health", dependencies=[PUBLIC])
async def health(control: Controlled, delay: Measured, disk: Stored) -> Health:
    """Always 200 while the gateway runs; `troubles` lists the parts that do not work."""
    troubles = [
        *port_troubles(control.board.port),
        *loop_troubles(delay.worst_s),
        *(Trouble(part="disk", detail=detail) for detail in [await disk.problem()] if detail),
    ]
    return Health(status="degraded" if troubles else "ready", version=__version__, troubles=troubles)


def port_troubles(port: PortState) -> list[Trouble]:
    """No port is no trouble: none was requested."""
    if port.status != "lost":
        return []
    return [Trouble(part="port", detail=f"The serial port is lost ({port.code}) and tried again.")]


def loop_troubles(worst_s: float) -> list[Trouble]:
    if worst_s <= LATE_S:
        return []
    return [Trouble(part="loop", detail=f"Something blocked the gateway for {worst_s * 1000:.0f} ms.")]


@health_api.get("/metrics", include_in_schema=False, dependencies=[VIEWER])
async def numbers(request: Request, control: Controlled, delay: Measured) -> Response:
    """In Prometheus's text format."""
    from servodeck.api.prometheus import MEDIA_TYPE, numbers_text

    return Response(numbers_text(control, delay.worst_s, fleet_status(request)), media_type=MEDIA_TYPE)
