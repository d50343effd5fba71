"""Python programs drive a robot with it: `Robot` waits for each answer, `AsyncRobot` has the same methods for
asyncio. Errors are those of servodeck.errors.

Uses the standard library alone, unless a program opens a port itself (direct.py).
"""

from servodeck.client.asynchronous import AsyncRobot
from servodeck.client.errors import TimedOutError, UnreachableError
from servodeck.client.robot import Robot
from servodeck.client.values import Event, Servo, Snapshot

__all__ = ["AsyncRobot", "Event", "Robot", "Servo", "Snapshot", "TimedOutError", "UnreachableError"]
