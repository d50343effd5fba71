"""What a host can ask and what a board can say, as values. Knows no bytes and no limits.

The same values as shared/src/codec/commands.ts and reports.ts.
"""

from dataclasses import dataclass
from typing import ClassVar, Literal

from servodeck.protocol.families import CommandKind


@dataclass(frozen=True, slots=True)
class ServoTarget:
    """`position` is in the board's unit: pulse width in µs, or steps of a bus servo."""

    servo: int
    position: int


@dataclass(frozen=True, slots=True)
class ServoOffset:
    """A servo's trim, in the board's unit."""

    servo: int
    offset: int


@dataclass(frozen=True, slots=True)
class Frame:
    """Targets reached together after `duration_ms`. A frame without targets is a pause."""

    duration_ms: int
    targets: tuple[ServoTarget, ...]


@dataclass(frozen=True, slots=True)
class Move:
    duration_ms: int
    targets: tuple[ServoTarget, ...]
    kind: ClassVar[CommandKind] = "move"


@dataclass(frozen=True, slots=True)
class Run:
    """`times` 0 repeats until stopped."""

    slot: int
    times: int
    kind: ClassVar[CommandKind] = "run"


@dataclass(frozen=True, slots=True)
class Stop:
    """Ends a running group after its frame in progress (S50): not an emergency stop."""

    kind: ClassVar[CommandKind] = "stop"


@dataclass(frozen=True, slots=True)
class Erase:
    """Erases every slot, whatever its parameter byte says (S19)."""

    kind: ClassVar[CommandKind] = "erase"


@dataclass(frozen=True, slots=True)
class ReadBattery:
    kind: ClassVar[CommandKind] = "readBattery"


@dataclass(frozen=True, slots=True)
class Download:
    """Stores frame `frame_index` (0-based, S33) of `frame_count` in `slot`."""

    slot: int
    frame_count: int
    frame_index: int
    frame: Frame
    kind: ClassVar[CommandKind] = "download"


@dataclass(frozen=True, slots=True)
class SetSpeed:
    """Group speed in percent of how it was stored, until power-off (X3); `slot` None for every group."""

    slot: int | None
    percent: int
    kind: ClassVar[CommandKind] = "setSpeed"


@dataclass(frozen=True, slots=True)
class Release:
    """Takes the torque off: what these servos carry drops (X7)."""

    servos: tuple[int, ...]
    kind: ClassVar[CommandKind] = "release"


@dataclass(frozen=True, slots=True)
class ReadPositions:
    servos: tuple[int, ...]
    kind: ClassVar[CommandKind] = "readPositions"


@dataclass(frozen=True, slots=True)
class ReadVersion:
    kind: ClassVar[CommandKind] = "readVersion"


@dataclass(frozen=True, slots=True)
class ReadAllPositions:
    kind: ClassVar[CommandKind] = "readAllPositions"


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, slots=True)
class RunAccepted:
    """Proves reception only: it comes before the slot is looked up (S18)."""

    kind: ClassVar[ReportKind] = "runAccepted"


@dataclass(frozen=True, slots=True)
class RunStarted:
    slot: int
    times: int
    kind: ClassVar[ReportKind] = "runStarted"


@dataclass(frozen=True, slots=True)
class RunFinished:
    """`slot` where the board names it."""

    slot: int | None
    kind: ClassVar[ReportKind] = "runFinished"


@dataclass(frozen=True, slots=True)
class RunStopped:
    kind: ClassVar[ReportKind] = "runStopped"


@dataclass(frozen=True, slots=True)
class Erased:
    kind: ClassVar[ReportKind] = "erased"


@dataclass(frozen=True, slots=True)
class Battery:
    battery_mv: int
    kind: ClassVar[ReportKind] = "battery"


@dataclass(frozen=True, slots=True)
class FrameStored:
    """The download frame was handled, successfully or not (S20)."""

    kind: ClassVar[ReportKind] = "frameStored"


@dataclass(frozen=True, slots=True)
class Positions:
    """Where bus servos stand."""

    positions: tuple[ServoTarget, ...]
    kind: ClassVar[ReportKind] = "positions"


@dataclass(frozen=True, slots=True)
class AllPositions:
    """Where the board has its servos, all of them (LeArm)."""

    positions: tuple[ServoTarget, ...]
    kind: ClassVar[ReportKind] = "allPositions"


@dataclass(frozen=True, slots=True)
class Offsets:
    """What the board adds to the positions of its servos (LeArm)."""

    offsets: tuple[ServoOffset, ...]
    kind: ClassVar[ReportKind] = "offsets"


@dataclass(frozen=True, slots=True)
class Version:
    """Which servos the board drives, by the unit they count in, and its firmware."""

    unit: Literal["us", "steps"]
    version: int
    kind: ClassVar[ReportKind] = "version"


@dataclass(frozen=True, slots=True)
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
