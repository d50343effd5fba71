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

from fastapi import Depends, Response
from starlette.requests import HTTPConnection

from servodeck import __version__
from servodeck.api.routes import PUBLIC, VIEWER, Controlled, routes
from servodeck.files import Disk
from servodeck.schema import Message
from servodeck.snapshots import PortState

BEAT_S = 0.25
REMEMBERED_S = 15.0


class Pulse:
    def __init__(self, each_beat: Callable[[], None]) -> None:
        self._each_beat = each_beat
        self._delays_s: deque[float] = deque(maxlen=int(REMEMBERED_S / BEAT_S))

    @property
    def worst_s(self) -> float:
        """The longest delay of the loop in the last quarter of a minute."""
        return max(self._delays_s, default=0.0)

    async def run(self) -> None:
        loop = asyncio.get_running_loop()
        while True:
            due = loop.time() + BEAT_S
            await asyncio.sleep(BEAT_S)
            self._delays_s.append(max(0.0, loop.time() - due))
            self._each_beat()


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
    """To be called at each beat of the event loop: without it systemd restarts the gateway."""
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


async def pulse_of(connection: HTTPConnection) -> Pulse:
    pulse = connection.app.state.pulse
    assert isinstance(pulse, Pulse)
    return pulse


async def disk_of(connection: HTTPConnection) -> Disk:
    disk = connection.app.state.disk
    assert isinstance(disk, Disk)
    return disk


Beating = Annotated[Pulse, Depends(pulse_of)]
Stored = Annotated[Disk, Depends(disk_of)]
health_api = routes("", "health")


@health_api.get("/api/health", dependencies=[PUBLIC])
async def health(control: Controlled, pulse: Beating, disk: Stored) -> Health:
    """Always 200 while the gateway runs; `troubles` lists the parts that do not work."""
    troubles = [
        *port_troubles(control.board.port),
        *loop_troubles(pulse.worst_s),
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
async def numbers(control: Controlled, pulse: Beating) -> Response:
    """In Prometheus's text format."""
    from servodeck.api.prometheus import MEDIA_TYPE, numbers_text

    return Response(numbers_text(control, pulse.worst_s), media_type=MEDIA_TYPE)
