"""Commands of a host and reports of a board, as values. Knows no bytes and no limits.

The same values as shared/src/codec/commands.ts and reports.ts.
"""

from collections.abc import Sequence
from typing import ClassVar, Literal

from servodeck.value import value

CommandKind = Literal[
    "move",
    "run",
    "stop",
    "erase",
    "readBattery",
    "download",
    "setSpeed",
    "release",
    "readPositions",
    "readVersion",
    "readAllPositions",
    "readOffsets",
]


@value
class ServoTarget:
    """`position` is in the board's unit: pulse width in µs, or steps of a bus servo."""

    servo: int
    position: int


@value
class ServoOffset:
    """A servo's trim, in the board's unit."""

    servo: int
    offset: int


@value
class Frame:
    """Targets reached together after `duration_ms`. A frame without targets is a pause."""

    duration_ms: int
    targets: tuple[ServoTarget, ...]


@value
class Goal:
    """Where a servo goes on to in later parts of its move, and in how many milliseconds it is there."""

    servo: int
    position: int
    within_ms: int


@value
class Move:
    duration_ms: int
    targets: tuple[ServoTarget, ...]
    goals: tuple[Goal, ...] = ()
    """Not in the packet: where it is a part of a longer move."""
    kind: ClassVar[CommandKind] = "move"


@value
class Run:
    """`times` 0 repeats until stopped."""

    slot: int
    times: int
    kind: ClassVar[CommandKind] = "run"


@value
class Stop:
    """Ends a running group after its frame in progress (S50): not an emergency stop."""

    kind: ClassVar[CommandKind] = "stop"


@value
class Erase:
    """Erases every slot; its parameter byte has no effect (S19)."""

    kind: ClassVar[CommandKind] = "erase"


@value
class ReadBattery:
    kind: ClassVar[CommandKind] = "readBattery"


@value
class Download:
    """Stores frame `frame_index` (0-based, S33) of `frame_count` in `slot`."""

    slot: int
    frame_count: int
    frame_index: int
    frame: Frame
    kind: ClassVar[CommandKind] = "download"


@value
class SetSpeed:
    """Group speed in percent of how it was stored, until power-off (X3); `slot` None for every group."""

    slot: int | None
    percent: int
    kind: ClassVar[CommandKind] = "setSpeed"


@value
class Release:
    """Takes the torque off: what these servos carry drops (X7)."""

    servos: tuple[int, ...]
    kind: ClassVar[CommandKind] = "release"


@value
class ReadPositions:
    servos: tuple[int, ...]
    kind: ClassVar[CommandKind] = "readPositions"


@value
class ReadVersion:
    kind: ClassVar[CommandKind] = "readVersion"


@value
class ReadAllPositions:
    kind: ClassVar[CommandKind] = "readAllPositions"


@value
class ReadOffsets:
    """The trims it keeps in flash."""

    kind: ClassVar[CommandKind] = "readOffsets"


Command = (
    Move
    | Run
    | Stop
    | Erase
    | ReadBattery
    | Download
    | SetSpeed
    | Release
    | ReadPositions
    | ReadVersion
    | ReadAllPositions
    | ReadOffsets
)


ReportKind = Literal[
    "runAccepted",
    "runStarted",
    "runFinished",
    "runStopped",
    "erased",
    "battery",
    "frameStored",
    "positions",
    "allPositions",
    "offsets",
    "version",
    "unknown",
]


@value
class RunAccepted:
    """Proves reception only: it comes before the slot is looked up (S18)."""

    kind: ClassVar[ReportKind] = "runAccepted"


@value
class RunStarted:
    slot: int
    times: int
    kind: ClassVar[ReportKind] = "runStarted"


@value
class RunFinished:
    """`slot` where the board names it."""

    slot: int | None
    kind: ClassVar[ReportKind] = "runFinished"


@value
class RunStopped:
    kind: ClassVar[ReportKind] = "runStopped"


@value
class Erased:
    kind: ClassVar[ReportKind] = "erased"


@value
class Battery:
    battery_mv: int
    kind: ClassVar[ReportKind] = "battery"


@value
class FrameStored:
    """The download frame was handled, successfully or not (S20)."""

    kind: ClassVar[ReportKind] = "frameStored"


@value
class Positions:
    """Positions of bus servos."""

    positions: tuple[ServoTarget, ...]
    kind: ClassVar[ReportKind] = "positions"


@value
class AllPositions:
    """Positions of all servos of the board (LeArm)."""

    positions: tuple[ServoTarget, ...]
    kind: ClassVar[ReportKind] = "allPositions"


@value
class Offsets:
    """Trims that the board adds to the positions of its servos (LeArm)."""

    offsets: tuple[ServoOffset, ...]
    kind: ClassVar[ReportKind] = "offsets"


@value
class Version:
    """The kind of the board's servos, by the unit of their positions, and its firmware."""

    unit: Literal["us", "steps"]
    version: int
    kind: ClassVar[ReportKind] = "version"


@value
class UnknownReport:
    """Well-formed, but not a report this family is known to send."""

    command: int
    params: bytes
    kind: ClassVar[ReportKind] = "unknown"


Report = (
    RunAccepted
    | RunStarted
    | RunFinished
    | RunStopped
    | Erased
    | Battery
    | FrameStored
    | Positions
    | AllPositions
    | Offsets
    | Version
    | UnknownReport
)


def extremes_of(frames: Sequence[Frame]) -> list[ServoTarget]:
    """The least and the greatest position of each servo."""
    least: dict[int, ServoTarget] = {}
    greatest: dict[int, ServoTarget] = {}
    for target in (target for frame in frames for target in frame.targets):
        servo, position = target.servo, target.position
        if servo not in least or position < least[servo].position:
            least[servo] = target
        if servo not in greatest or position > greatest[servo].position:
            greatest[servo] = target
    return [*least.values(), *greatest.values()]
