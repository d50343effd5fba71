"""Board families: what a board of each kind takes, answers and means; and the check whether it can take a
command, before that is encoded. A refusal names the field, its value and what is allowed, in the words of
shared/src/codec/encode.ts.

The table is shared/protocol/families.json, with the source of each figure; the page reads the same
(shared/src/codec/families.ts, which says what each field means). What differs between boards is a field
there, never an `if` on a family elsewhere. Knows values and no bytes.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Final, Literal

from servodeck.errors import NotSupportedError, OutOfRangeError
from servodeck.protocol import load_shared, snake
from servodeck.protocol.values import (
    Command,
    CommandKind,
    Download,
    Frame,
    Move,
    ReadPositions,
    Release,
    Run,
    ServoTarget,
    SetSpeed,
)
from servodeck.value import value

# Commands that a cable may not carry although the board knows them: no hardware has confirmed how.
Withheld = Literal["download", "erase"]
# Questions for every board: they move nothing, store nothing and release no servo.
Question = Literal["readBattery", "readVersion", "readPositions"]


HEADER_BYTES: Final = 2  # which LEN does not count
MOVE_BYTES: Final = 7  # of a move of no servo
BYTES_PER_SERVO: Final = 3


@value
class Range:
    min: int
    max: int


@value
class MotionTraits:
    """How a board turns its servos and plays its groups, as far as the motion estimate needs it."""

    tick_ms: int
    # The longest that its loop is busy without being deaf to us: with what it says (S21), a pad's poll (S52),
    # entries handed on to bus servos (S31). Its servos wait that long, and what came meanwhile is late (S29).
    talk_ms: float
    # `shared`: any new target re-times every servo (S26). `perServo`: one that starts leaves the others
    # alone. `unknown`: no source says which, so a packet carries every servo under way and both readings give
    # the same motion.
    timing: Literal["shared", "perServo", "unknown"]
    # A longer move leaves in parts of that time at most; None where it leaves as one packet.
    part_ms: int | None
    # `deadlines`: a frame takes its time, to the millisecond (S42). `polled`: the next begins some time
    # behind it (L7).
    groups: Literal["deadlines", "polled"]
    # A stop halts these where they are; the others continue to the end of their frame (S50, L9).
    halted_by_stop: tuple[int, ...]
    # When the group in this slot ends by itself, the next one is played once (S49).
    chained_slot: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    id: str
    name: str
    unit: Literal["us", "steps"]
    position: Range
    # Servos that may turn less far than `position` says.
    servo_position: Mapping[int, Range]
    # Centre of the position range, where a servo is at rest.
    centre: int
    servo: Range
    usual_servo_count: int
    servos_per_move: int
    servos_per_frame: int
    duration_ms: Range
    shortest_move_ms: int
    frames_per_group: int
    slot: Range
    run_times: Range
    # Where the group speed cannot be set, it is what it is.
    speed_percent: Range
    # What the board makes of `times` 0; where that is not endless, `run_times` leaves it out.
    zero_times: Literal["endless", "once"]
    # Largest LEN that is safe to send.
    max_length: int
    commands: tuple[CommandKind, ...]
    # LEN of the erase command: with a reserved byte or without.
    erase_length: Literal[2, 3]
    answers: tuple[CommandKind, ...]
    # Harmless questions that every such board answers, the cheapest first.
    certain_answers: tuple[Question, ...]
    # 6 and 8 with LEN 5 name slot and times, for every source of the run; otherwise they are empty.
    run_reports_name_slot: bool
    # What an empty packet 7 says: opposite things per family.
    empty_seven: Literal["runFinished", "runStopped", "unknown"]
    # Any question ends a running group without a report (L8): ask only while nothing runs.
    query_kills_run: bool
    # So many bytes of what comes next are taken at most for the rest of a packet that was cut (S3, L3).
    left_over_bytes: int
    # The question whose answer proves that the board hears its stops; None where it may stay silent.
    stop_confirmed_by: Question | None
    # What ends a packet that was cut, on a board that bears it; None: nothing may be sent for that.
    resync_filler: int | None
    # Command numbers that must not go out, not even by hand.
    never_send: tuple[int, ...]
    # Numbers it does not know do nothing at all there (S5); elsewhere it is unknown what they do.
    ignores_unknown: bool
    # Pause after the last byte has left the wire.
    service_gap_ms: int
    motion: MotionTraits
    # What the board reports above this is not measured.
    battery_ceiling_mv: int | None
    # What plays a slot besides a run: buttons of the pad for slots 0, 1 and so on, SELECT with one, the key.
    pad_buttons: tuple[str | None, ...]
    select_slots: tuple[int, ...]
    key_slot: int | None

    def position_of(self, servo: int) -> Range:
        return self.servo_position.get(servo, self.position)


Row = dict[str, Any]


def _expanded(row: Row, bases: dict[str, Row]) -> Row:
    """A row with all that it has from its bases."""
    under = _expanded(bases[row["base"]], bases) if "base" in row else {"motion": {}}
    own = {name: value for name, value in row.items() if name not in ("base", "why")}
    return {**under, **own, "motion": {**under["motion"], **own.get("motion", {})}}


def _value(value: object) -> Any:
    if isinstance(value, dict):
        return Range(**value)
    return tuple(value) if isinstance(value, list) else value


def _family(family_id: str, row: Row) -> Family:
    """A field that is missing or unknown is an error at once."""
    ranges = {int(servo): Range(**allowed) for servo, allowed in row.pop("servoPosition").items()}
    motion = MotionTraits(**{snake(name): _value(value) for name, value in row.pop("motion").items()})
    rest = {snake(name): _value(value) for name, value in row.items()}
    return Family(id=family_id, servo_position=ranges, motion=motion, **rest)


def _table() -> dict[str, Family]:
    data = load_shared("families")
    rows = {**data["families"], "unknown": data["unknown"]}
    return {name: _family(name, _expanded(row, data["bases"])) for name, row in rows.items()}


@cache
def carried(family_id: str, longest_packet: int) -> Family:
    """As much of what such a board takes as a port carries whose packets have so many bytes at most."""
    family = FAMILIES[family_id]
    servos_per_move = min(family.servos_per_move, (longest_packet - MOVE_BYTES) // BYTES_PER_SERVO)
    if servos_per_move == family.servos_per_move:
        return family
    return replace(family, servos_per_move=servos_per_move, max_length=longest_packet - HEADER_BYTES)


FAMILIES: Final = _table()
# A board that is not identified yet: harmless questions and the stop, nothing that moves or stores.
UNKNOWN: Final = FAMILIES["unknown"]

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
