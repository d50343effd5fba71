"""How the gateway itself is: `/api/health` for people and supervisors, `/metrics` for Prometheus.

Looks at what is known anyway; nothing here sends the board a byte or waits for a lock.
"""

from typing import Annotated, Literal

from fastapi import Depends, Response
from starlette.requests import HTTPConnection

from servodeck import __version__
from servodeck.access.roles import ANYBODY, VIEWER
from servodeck.api.process import Pulse
from servodeck.api.routes import Controlled, routes
from servodeck.files import Disk
from servodeck.schema import Message
from servodeck.snapshots import PortState

# Far above what a busy small computer shows, far below what a person at a slider would not notice.
LATE_S = 0.25


class Trouble(Message):
    part: Literal["port", "loop", "disk"]
    detail: str


class Health(Message):
    """`degraded`: it answers and stops the robot, and one part of it does not do its work."""

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


@health_api.get("/api/health", dependencies=[ANYBODY])
async def health(control: Controlled, pulse: Beating, disk: Stored) -> Health:
    """Always 200 while the gateway runs: `status` tells whether it is well, `troubles` what ails it."""
    troubles = [
        *port_troubles(control.board.port),
        *loop_troubles(pulse.worst_s),
        *(Trouble(part="disk", detail=detail) for detail in [await disk.problem()] if detail),
    ]
    return Health(status="degraded" if troubles else "ready", version=__version__, troubles=troubles)


def port_troubles(port: PortState) -> list[Trouble]:
    """No port is none: nobody asked for one."""
    if port.status != "lost":
        return []
    return [Trouble(part="port", detail=f"The serial port is lost ({port.code}) and tried again.")]


def loop_troubles(worst_s: float) -> list[Trouble]:
    if worst_s <= LATE_S:
        return []
    return [Trouble(part="loop", detail=f"Something kept the gateway waiting for {worst_s * 1000:.0f} ms.")]


@health_api.get("/metrics", include_in_schema=False, dependencies=[VIEWER])
async def numbers(control: Controlled, pulse: Beating) -> Response:
    """In Prometheus's text format."""
    from servodeck.api.prometheus import MEDIA_TYPE, numbers_text

    return Response(numbers_text(control, pulse.worst_s), media_type=MEDIA_TYPE)
