"""The gateway of Servodeck: owns a serial port, judges what may go on the wire, serves the page.

For programs, `Robot` and `AsyncRobot` drive a robot; they are loaded when they are first named, because the
gateway does not need them.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from servodeck.client import AsyncRobot as AsyncRobot
    from servodeck.client import Robot as Robot

__version__ = "0.1.0"
FOR_PROGRAMS = ("AsyncRobot", "Robot")


def __getattr__(name: str) -> Any:
    if name not in FOR_PROGRAMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from servodeck import client

    return getattr(client, name)
