"""A proposed action group: checked against the robot on the board, and written as a document of the library
that is marked as a draft. Nothing here plays it, and no tool does.

Pure. The document is that of docs/group.schema.json.
"""

import json
from collections.abc import Sequence
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from servodeck.assistant.bodies import Body, Degrees, Joint
from servodeck.value import value

Easing = Literal["linear", "in", "out", "inOut"]
# A common servo takes 0.16 s for 60 degrees without load: what is faster comes late.
FASTEST_DEGREES_PER_S = 300.0
MAX_NAME, MAX_NOTE = 64, 200


class ProposedFrame(BaseModel):
    """`seconds`: how long the move into this frame takes. Servos that are not named stay where they are."""

    model_config = ConfigDict(extra="forbid")

    seconds: Annotated[float, Field(gt=0, le=65)]
    degrees: Degrees
    easing: Easing = "linear"
    note: Annotated[str, Field(max_length=MAX_NOTE)] = ""


@value
class Checked:
    """`positions` of each frame by servo. With `problems` it is no group; `remarks` may be accepted."""

    positions: Sequence[dict[int, int]]
    problems: Sequence[str]
    remarks: Sequence[str]
    ranges: dict[str, tuple[float, float]]
    """Of each servo that it moves, in degrees."""

    @property
    def poses(self) -> list[dict[int, int]]:
        """The whole pose after each frame, of the servos that have been named until then."""
        whole: dict[int, int] = {}
        return [whole := {**whole, **places} for places in self.positions]


def check(frames: Sequence[ProposedFrame], body: Body) -> Checked:
    problems: list[str] = []
    remarks: list[str] = []
    positions: list[dict[int, int]] = []
    seen: dict[str, list[float]] = {}
    before: dict[int, float] = {}
    family = body.family
    if len(frames) > family.frames_per_group:
        problems.append(f"It has {len(frames)} frames; the board takes {family.frames_per_group}.")
    shortest_ms = max(family.duration_ms.min, family.shortest_move_ms)
    for number, frame in enumerate(frames, 1):
        length_ms = duration_of(frame)
        if not shortest_ms <= length_ms <= family.duration_ms.max:
            problems.append(
                f"Frame {number}: {length_ms} ms; the board takes {shortest_ms} to {family.duration_ms.max}."
            )
        places: dict[int, int] = {}
        for servo, degrees in frame.degrees.items():
            joint = body.joint_of(servo)
            if joint is None:
                names = ", ".join(one.name for one in body.joints.values())
                problems.append(f"Frame {number}: no servo is called {servo}. There are: {names}.")
                continue
            if joint.number in places:
                problems.append(f"Frame {number}: {joint.name} (servo {joint.number}) is named twice.")
                continue
            if problem := beyond(joint, degrees):
                problems.append(f"Frame {number}: {problem}")
                continue
            last = before.get(joint.number)
            speed = abs(degrees - last) / frame.seconds if last is not None else 0.0
            if speed > FASTEST_DEGREES_PER_S:
                remarks.append(
                    f"Frame {number}: {joint.name} would turn at {speed:.0f} degrees a second; "
                    f"common servos reach about {FASTEST_DEGREES_PER_S:.0f}, so it comes late."
                )
            before[joint.number] = degrees
            places[joint.number] = joint.position_at(degrees)
            seen.setdefault(joint.name, []).append(degrees)
        positions.append(places)
    ranges = {name: (min(turned), max(turned)) for name, turned in seen.items()}
    return Checked(positions, problems, remarks, ranges)


def beyond(joint: Joint, degrees: float) -> str | None:
    """What is wrong with that place, if it is beyond its limits."""
    if joint.min <= joint.position_at(degrees) <= joint.max:
        return None
    least, most = joint.range_degrees
    return f"{joint.name} (servo {joint.number}) cannot go to {degrees:g} degrees: {least:g} to {most:g}."


def duration_of(frame: ProposedFrame) -> int:
    return round(frame.seconds * 1000)


def duration_ms(frames: Sequence[ProposedFrame]) -> int:
    return sum(map(duration_of, frames))


def document(name: str, frames: Sequence[ProposedFrame], checked: Checked, body: Body) -> str:
    """Its text; the gateway adds the tags that make it a draft."""
    content: dict[str, Any] = {
        "name": name[:MAX_NAME],
        "unit": body.family.unit,
        "robot": body.name[:MAX_NAME],
        "tags": [],
        "slot": None,
        "times": 1,
        "frames": [
            {
                "id": number,
                "durationMs": duration_of(frame),
                "targets": [{"servo": servo, "position": place} for servo, place in sorted(places.items())],
                "easing": frame.easing,
                "note": frame.note,
                "colour": None,
            }
            for number, (frame, places) in enumerate(zip(frames, checked.positions, strict=True), 1)
        ],
        "markers": [],
        "nextId": len(frames) + 1,
    }
    return json.dumps({"format": "servodeck-group", "version": 1, "content": content}, ensure_ascii=False)
