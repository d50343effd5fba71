"""Checks whether a board of a family can take a command, before it is encoded.

Knows values and family rows, no bytes. A refusal names the field, its value and what is allowed, in
the words of shared/src/codec/encode.ts.
"""

from servodeck.errors import NotSupportedError, OutOfRangeError
from servodeck.protocol.families import Family, Range
from servodeck.protocol.values import (
    Command,
    Download,
    Frame,
    Move,
    ReadPositions,
    Release,
    Run,
    ServoTarget,
    SetSpeed,
)

UNITS = {"us": "µs", "steps": "steps"}


def check(command: Command, family: Family) -> None:
    """Raises NotSupportedError where such a board has no such command, else OutOfRangeError."""
    if command.kind not in family.commands:
        refuse("command", command.kind, ", ".join(family.commands))
    match command:
        case Move(duration_ms, targets):
            check_frame(Frame(duration_ms, targets), Range(1, family.servos_per_move), family)
        case Run(slot, times):
            check_range("slot", slot, family.slot)
            check_range("times", times, family.run_times)
        case Download(slot, frame_count, frame_index, frame):
            check_range("slot", slot, family.slot)
            check_range("frameCount", frame_count, Range(1, family.frames_per_group))
            check_range("frameIndex", frame_index, Range(0, frame_count - 1))
            check_frame(frame, Range(0, family.servos_per_frame), family)
        case SetSpeed(slot, percent):
            if slot is not None:
                check_range("slot", slot, family.slot)
            check_range("percent", percent, family.speed_percent, "%")
        case Release(servos) | ReadPositions(servos):
            check_servos(servos, family)


def check_frame(frame: Frame, servo_count: Range, family: Family) -> None:
    check_range("durationMs", frame.duration_ms, family.duration_ms, "ms")
    check_range("servoCount", len(frame.targets), servo_count)
    seen: set[int] = set()
    for target in frame.targets:
        check_range("servo", target.servo, family.servo)
        check_position(target, family)
        if target.servo in seen:
            refuse("servo", target.servo, "once in a packet")
        seen.add(target.servo)


def check_servos(servos: tuple[int, ...], family: Family) -> None:
    """Never all servos at once by an empty list or by 254, only those that are named."""
    check_range("servoCount", len(servos), Range(1, family.servos_per_move))
    for at, servo in enumerate(servos):
        check_range("servo", servo, family.servo)
        if servo in servos[:at]:
            refuse("servo", servo, "once in a packet")


def check_position(target: ServoTarget, family: Family) -> None:
    allowed = family.position_of(target.servo)
    check_range("position", target.position, allowed, UNITS[family.unit], target.servo)


def check_range(
    field: str, value: float, allowed: Range, unit: str | None = None, servo: int | None = None
) -> None:
    whole = isinstance(value, int)
    if whole and allowed.min <= value <= allowed.max:
        return
    span = f"{allowed.min}..{allowed.max}{f' {unit}' if unit else ''}"
    refuse(field, value, span if whole else f"whole numbers {span}", servo)


def refuse(field: str, value: float | str, allowed: str, servo: int | None = None) -> None:
    """For example `position of servo 3 is 2600, allowed 500..2500 µs`: the same sentences as in the page."""
    subject = field if servo is None else f"{field} of servo {servo}"
    error = NotSupportedError if field == "command" else OutOfRangeError
    raise error(f"{subject} is {value}, allowed {allowed}")
