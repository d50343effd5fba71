"""What a program gets to see: servos with their names and degrees, snapshots and events.

Knows the documents of robots as the library stores them, and the usual servos of each family; no transport.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from servodeck.errors import DamagedTextError, NotFoundError, OutOfRangeError
from servodeck.protocol.families import FAMILIES

Json = Mapping[str, Any]
# Of the usual servos, where no robot is on the board (shared/src/profile/readyRobots.ts).
DEGREES_PER_UNIT = {"us": 0.09, "steps": 0.24}


@dataclass(frozen=True)
class Servo:
    """`min`, `max` and `home` are in the board's unit, as the board counts; `home` is 0 degrees."""

    number: int
    name: str
    min: int
    max: int
    home: int
    degrees_per_unit: float
    """Below 0 where a growing position turns it the other way."""

    def position_at(self, degrees: float) -> int:
        return round(self.home + degrees / self.degrees_per_unit)

    def degrees_at(self, position: float) -> float:
        return (position - self.home) * self.degrees_per_unit


@dataclass(frozen=True)
class Snapshot:
    """`targets`: where each servo is, or is moving to, so far as that is known. `groups`: the names of the
    groups in the board's slots that the gateway knows. `raw` is the gateway's whole state, as in the
    `welcome` of its events.
    """

    board: str
    link: str
    is_latched: bool
    driver: str | None
    battery_mv: int | None
    targets: Mapping[int, int]
    groups: Mapping[int, str]
    raw: Json


@dataclass(frozen=True)
class Event:
    """`type` and `data` are those of the gateway's messages; `gap`: some were missed during a reconnect."""

    type: str
    data: Json


def snapshot_of(welcome: Json) -> Snapshot:
    motion, battery = welcome["motion"], welcome["battery"]
    reported = {one["servo"]: one["position"] for one in motion["reported"] if one["isCurrent"]}
    return Snapshot(
        board=welcome["board"],
        link=welcome["link"]["status"],
        is_latched=welcome["latch"],
        driver=welcome["lease"]["driver"],
        battery_mv=battery.get("batteryMv"),
        targets={one["servo"]: one["target"] for one in motion["servos"]} | reported,
        groups={int(slot): stored["name"] for slot, stored in welcome["slotVersions"].items()},
        raw=welcome,
    )


def robot_in(text: str) -> Json:
    """Of a robot's document: a file of the page's export, or the text in the library. Raises a
    DamagedTextError.
    """
    try:
        document = json.loads(text)
        if "kit" in document:
            document = json.loads(document["kit"]["robot"])
        robot: Json = document["robot"]
        servos_of(robot)
    except (ValueError, TypeError, KeyError) as error:
        raise DamagedTextError("The description of the robot cannot be read.") from error
    return robot


def servos_of(robot: Json) -> list[Servo]:
    return [servo_of(one) for one in robot["servos"]]


def servo_of(one: Json) -> Servo:
    trim = one["trim"]
    sign = -1 if one["isReversed"] else 1
    per_unit = one["degreesPerUnit"] * sign
    return Servo(
        one["servo"], one["name"], one["min"] + trim, one["max"] + trim, one["home"] + trim, per_unit
    )


class Servos:
    """Of the robot on the board; of a board without a robot, its usual servos, which have numbers only."""

    def __init__(self, known: Iterable[Servo], board: str) -> None:
        self._known = {servo.number: servo for servo in known}
        self._board = board

    def all(self) -> list[Servo]:
        return list(self._known.values())

    def number_of(self, servo: str | int) -> int:
        """Raises NotFoundError for a name that no servo or several servos have."""
        if isinstance(servo, int):
            return servo
        exact = [one.number for one in self._known.values() if one.name == servo]
        found = exact or [
            one.number for one in self._known.values() if one.name.casefold() == servo.casefold()
        ]
        if not found and servo.isascii() and servo.isdigit():
            return int(servo)
        if len(found) != 1:
            names = ", ".join(one.name for one in self._known.values()) or "no names"
            problem = "Several servos are" if found else "No servo is"
            raise NotFoundError(f"{problem} called {servo}. The robot on the board has: {names}.")
        return found[0]

    def position_at(self, number: int, degrees: float) -> int:
        """Raises OutOfRangeError where the board is unknown."""
        if known := self._known.get(number):
            return known.position_at(degrees)
        family = FAMILIES.get(self._board)
        if self._known or family is None or family.id == "unknown":
            raise OutOfRangeError(f"Degrees of servo {number} are unknown: the robot does not describe it.")
        return round(family.centre + degrees / DEGREES_PER_UNIT[family.unit])
