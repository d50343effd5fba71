"""Commands of a host and reports of a board, as JSON: the values of protocol/values.py with the
same names as shared/src/codec/commands.ts and reports.ts.

Knows no bytes but those of unknown packets, and no rule.
"""

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from servodeck.protocol.values import Command, Report, UnknownReport
from servodeck.schema import Message


class ServoPosition(Message):
    """In the board's unit."""

    servo: int
    position: int


class ServoTrim(Message):
    """The trim that a board adds to the positions of a servo, in its unit."""

    servo: int
    offset: int


class StoredFrame(Message):
    """Targets reached together after `durationMs`."""

    duration_ms: int
    targets: tuple[ServoPosition, ...]


class ServoGoal(Message):
    """Where a servo goes on to in later parts of its move, and in how many milliseconds it is there."""

    servo: int
    position: int
    within_ms: int


class MoveCommand(Message):
    """`goals`: of the servos for which it is a part of a longer move."""

    kind: Literal["move"]
    duration_ms: int
    targets: tuple[ServoPosition, ...]
    goals: tuple[ServoGoal, ...] = ()


class RunCommand(Message):
    """`times` 0 repeats until stopped."""

    kind: Literal["run"]
    slot: int
    times: int


class DownloadCommand(Message):
    """Frame `frameIndex`, from 0, of `frameCount` for `slot`."""

    kind: Literal["download"]
    slot: int
    frame_count: int
    frame_index: int
    frame: StoredFrame


class SetSpeedCommand(Message):
    """`slot` is null for every group."""

    kind: Literal["setSpeed"]
    slot: int | None
    percent: int


class ServosCommand(Message):
    """Releases these servos, or reads their positions."""

    kind: Literal["release", "readPositions"]
    servos: tuple[int, ...]


class PlainCommand(Message):
    kind: Literal["stop", "erase", "readBattery", "readVersion", "readAllPositions", "readOffsets"]


AnyCommand = MoveCommand | RunCommand | DownloadCommand | SetSpeedCommand | ServosCommand | PlainCommand


class RunStartedReport(Message):
    kind: Literal["runStarted"]
    slot: int
    times: int


class RunFinishedReport(Message):
    """`slot` where the board names it."""

    kind: Literal["runFinished"]
    slot: int | None


class BatteryReport(Message):
    kind: Literal["battery"] = "battery"
    battery_mv: int


class PositionsReport(Message):
    kind: Literal["positions"] = "positions"
    positions: tuple[ServoPosition, ...]


class AllPositionsReport(Message):
    kind: Literal["allPositions"]
    positions: tuple[ServoPosition, ...]


class OffsetsReport(Message):
    kind: Literal["offsets"]
    offsets: tuple[ServoTrim, ...]


class VersionReport(Message):
    """The kind of the board's servos, by the unit of their positions, and its firmware."""

    kind: Literal["version"] = "version"
    unit: Literal["us", "steps"]
    version: int


class PlainReport(Message):
    kind: Literal["runAccepted", "runStopped", "erased", "frameStored"]


class UnreadableReport(Message):
    """A packet that no such board is known to send."""

    kind: Literal["unknown"] = "unknown"
    command: int


AnyReport = (
    RunStartedReport
    | RunFinishedReport
    | BatteryReport
    | PositionsReport
    | AllPositionsReport
    | OffsetsReport
    | VersionReport
    | PlainReport
    | UnreadableReport
)

CommandModel = Annotated[AnyCommand, Field(discriminator="kind")]
ReportModel = Annotated[AnyReport, Field(discriminator="kind")]

_command: TypeAdapter[AnyCommand] = TypeAdapter(CommandModel)
_report: TypeAdapter[AnyReport] = TypeAdapter(ReportModel)


def command_model(command: Command) -> AnyCommand:
    return _command.validate_python(command, from_attributes=True)


def report_model(report: Report) -> AnyReport:
    if isinstance(report, UnknownReport):
        return UnreadableReport(command=report.command)
    return _report.validate_python(report, from_attributes=True)
