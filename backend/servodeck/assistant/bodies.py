"""The robot on the board as an assistant is told of it: servos by name, in degrees from home, with their
limits and the board's times.

Pure; made of the robot's document in the library, or of the board's family where there is none.
"""

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from servodeck.client.values import DEGREES_PER_UNIT, Json
from servodeck.protocol.families import FAMILIES, Family
from servodeck.schema import Message
from servodeck.value import value

Degrees = Annotated[dict[str, float], Field(min_length=1, max_length=32)]
"""By the servo's name or number; 0 is its home."""


@value
class Joint:
    """A servo in the units of its document: a place on the board is `trim` further."""

    number: int
    name: str
    min: int
    max: int
    home: int
    trim: int
    degrees_per_unit: float
    """Below 0 where a growing position turns it the other way."""

    def degrees_at(self, position: float) -> float:
        return round((position - self.home) * self.degrees_per_unit, 1)

    def position_at(self, degrees: float) -> int:
        return round(self.home + degrees / self.degrees_per_unit)

    @property
    def range_degrees(self) -> tuple[float, float]:
        ends = sorted((self.degrees_at(self.min), self.degrees_at(self.max)))
        return ends[0], ends[1]


class JointAbout(Message):
    servo: int
    name: str
    least_degrees: float
    most_degrees: float


class RobotAbout(Message):
    """`shortestFrameMs`, `longestFrameMs` and `mostFrames`: of an action group of its board."""

    name: str
    board: str
    joints: list[JointAbout]
    poses: list[str]
    shortest_frame_ms: int
    longest_frame_ms: int
    most_frames: int


@value
class Body:
    name: str
    board: str
    is_arm: bool
    joints: Mapping[int, Joint]

    @property
    def family(self) -> Family:
        return FAMILIES.get(self.board, FAMILIES["doc"])

    def joint_of(self, servo: str) -> Joint | None:
        """By name, in any case of letters, or by number; None where no servo or several are called so."""
        named = [one for one in self.joints.values() if one.name.casefold() == servo.strip().casefold()]
        if len(named) == 1:
            return named[0]
        return self.joints.get(int(servo)) if not named and servo.isascii() and servo.isdigit() else None

    def about(self, poses: list[str]) -> RobotAbout:
        ranges = {number: joint.range_degrees for number, joint in self.joints.items()}
        joints = [
            JointAbout(
                servo=one.number,
                name=one.name,
                least_degrees=ranges[one.number][0],
                most_degrees=ranges[one.number][1],
            )
            for one in self.joints.values()
        ]
        family = self.family
        return RobotAbout(
            name=self.name,
            board=self.board,
            joints=joints,
            poses=poses,
            shortest_frame_ms=max(family.duration_ms.min, family.shortest_move_ms),
            longest_frame_ms=family.duration_ms.max,
            most_frames=family.frames_per_group,
        )


def body_in(robot: Json) -> Body:
    """Of a robot's document, as `robot_in` reads it."""
    joints = {one["servo"]: joint_in(one) for one in robot["servos"]}
    return Body(robot["name"], robot["board"], robot["body"] == "arm", joints)


def joint_in(one: Json) -> Joint:
    sign = -1 if one["isReversed"] else 1
    return Joint(
        one["servo"],
        one["name"],
        one["min"],
        one["max"],
        one["home"],
        one["trim"],
        one["degreesPerUnit"] * sign,
    )


def usual_body(board: str) -> Body:
    """Of a board without a description of its robot: numbers for names, and the board's whole range."""
    family = FAMILIES.get(board, FAMILIES["doc"])
    joints = {}
    for number in range(1, family.usual_servo_count + 1):
        places = family.position_of(number)
        name = f"Servo {number}"
        joints[number] = Joint(
            number, name, places.min, places.max, family.centre, 0, DEGREES_PER_UNIT[family.unit]
        )
    return Body("", board, family.usual_servo_count == 6, joints)
