"""The state of the gateway and of its board, as clients see it: port, link, lease, motion, slots, jobs,
robot.

Knows no message that carries it.
"""

from typing import Annotated, Literal

from pydantic import Field

from servodeck.errors import ErrorCode
from servodeck.packet_models import BatteryReport, PositionsReport, VersionReport
from servodeck.protocol.families import Question, Withheld
from servodeck.schema import Message

PortStatus = Literal["closed", "opening", "open", "lost"]
LinkStatus = Literal["closed", "opening", "identifying", "ready", "stale", "refused", "lost"]


class Candidate(Message):
    """A connected client that may drive."""

    id: str
    name: str


class LeaseState(Message):
    """The lease, by name: who drives, and who has requested it. `drives` and `hasRequested`: this client
    does or has. `grantedInMs`: until then the driver may refuse the request. `grantedBy`: the driver or owner
    who granted it to this client, which drives. `candidates`: the clients to which this one may grant it.
    `you`: this client's own name; several windows of one browser share it.
    """

    you: str
    driver: str | None
    drives: bool
    requested_by: str | None
    has_requested: bool
    granted_in_ms: int | None
    may_drive: bool
    may_take: bool
    granted_by: str | None
    candidates: list[Candidate]


class PortState(Message):
    """The state of the serial port. `code` and `detail` say why it is lost, `heldBy` which programs have it
    open where the system lists them, `retryInMs` when the next attempt follows. `simulated`: it leads to a
    simulated board. `withheld`: commands that this cable does not carry, although the board may know them.
    """

    device: str | None
    status: PortStatus
    simulated: bool = False
    withheld: list[Withheld] = Field(default_factory=list)
    code: ErrorCode | None = None
    detail: str | None = None
    held_by: list[str] = Field(default_factory=list)
    retry_in_ms: int | None = None


# `sent`: the stops have left the wire. `confirmed`: the board said that it stopped, or that it hears them.
# `unanswered`: such a board answers, and this one did not.
StopOutcome = Literal["sent", "confirmed", "unanswered"]


class LinkState(Message):
    """The link to the board: `identifying` while it is queried, `stale` while it does not answer a
    question that such a board always answers, `refused` until a person says which board it is. `code` and
    `detail` say why it is not ready.
    """

    status: LinkStatus
    code: ErrorCode | None = None
    detail: str | None = None


class AnsweredEvidence(Message):
    """The board answered that question of its identification."""

    kind: Literal["answered"] = "answered"
    question: Question
    report: Annotated[BatteryReport | VersionReport | PositionsReport, Field(discriminator="kind")]


class SilentEvidence(Message):
    """It did not answer that question."""

    kind: Literal["silent"] = "silent"
    question: Question


class EchoedEvidence(Message):
    """The request itself came back."""

    kind: Literal["echoed"] = "echoed"


class NoiseEvidence(Message):
    """Bytes came that are no packets."""

    kind: Literal["noise"] = "noise"
    byte_count: int


EvidenceState = AnsweredEvidence | SilentEvidence | EchoedEvidence | NoiseEvidence


class IdentityState(Message):
    """The answers of the board to its identification, and the families that answer like that."""

    evidence: list[Annotated[EvidenceState, Field(discriminator="kind")]]
    candidates: list[str]


class BatteryUnread(Message):
    kind: Literal["unread"] = "unread"


class BatteryRead(Message):
    kind: Literal["read"] = "read"
    battery_mv: int
    age_ms: int


class BatterySilent(Message):
    """Several questions in a row stayed unanswered; `lastMv` is its last report."""

    kind: Literal["silent"] = "silent"
    last_mv: int | None


BatteryState = BatteryUnread | BatteryRead | BatterySilent


class UnattendedRun(Message):
    """A run that may continue without its driver `by`, for `endsInMs` at most. `slot` is null where the
    gateway plays. `isMove`: it is a move of the program `by`, which ends by itself.
    """

    slot: int | None
    times: int
    by: str
    ends_in_ms: int
    is_move: bool = False


class Running(Message):
    """The group that may run: it was begun, and neither stopped nor reported as ended. `endsInMs`: at the
    latest; null where only the board knows, which not every family reports.

    """

    slot: int
    times: int
    ends_in_ms: int | None


class ShownRun(Running):
    """`begunMsAgo`: since it left, or since the board reported it. `acknowledged`: the board has received
    it.
    """

    begun_ms_ago: int
    acknowledged: bool


class ActivityState(Message):
    """What the robot does, whoever began it: the group that may run, and `mayMove`: anything moves, or may as
    far as the gateway knows, also behind the end of a group.
    """

    running: ShownRun | None
    may_move: bool


class StoredGroup(Message):
    """The group that was last stored in a slot: its version, name, document in the library, author and time
    in milliseconds since 1970; null where unknown.
    """

    version: str
    name: str = ""
    document: str | None = None
    by: str = ""
    at_ms: int | None = None


class ServoWay(Message):
    """A move of a servo, in progress or ended: the time since its start (below 0: not started yet), and its
    duration. `start` is null where its position at the start is unknown. `goal`: where it goes on to in later
    parts of its move, in `goal_within_ms`.
    """

    servo: int
    start: float | None
    target: int
    begun_ms_ago: float
    duration_ms: float
    goal: int | None = None
    goal_within_ms: float = 0


class ReportedPosition(Message):
    """The position that the board reported for a servo, with its age. `isCurrent`: as far as the gateway
    knows, the servo has not moved since.
    """

    servo: int
    position: int
    age_ms: int
    is_current: bool


class MotionState(Message):
    """The moves of the servos since the port opened, and their reported positions; the position of a servo
    without either is unknown. `runSlot`: the group that may run. `released`: they have no torque, so a person
    may have turned them.
    """

    servos: list[ServoWay]
    run_slot: int | None
    released: list[int]
    reported: list[ReportedPosition]


JobStatus = Literal["running", "done", "failed", "cancelled"]


class JobState(Message):
    """A download and its progress. `slots`: of its groups, in this order; `slot` and `name`: of the one that
    is being stored, or was last; frames and bytes are of all of them. `by`: the client that began it. `code`
    and `detail` say why it failed or was cancelled.
    """

    id: str
    by: str
    status: JobStatus
    slots: list[int]
    groups_stored: int
    slot: int
    name: str
    frames_stored: int
    frame_count: int
    bytes_sent: int
    bytes_total: int
    remaining_ms: int
    code: ErrorCode | None = None
    detail: str | None = None


PlayStatus = Literal["playing", "done", "ended"]


class PlayState(Message):
    """A play of the gateway by its own clock, and its progress. `times` 0: until stopped. `by`: the client
    that began it. `lateFrames` began so late that later frames were delayed, by `latestMs` at most;
    `skippedFrames` did not leave. `batteryUnknown`: new runs are refused at an alarm, and its battery could
    not be judged. `ended`: before its last frame had ended; `code` and `detail` say why.
    """

    id: str
    by: str
    status: PlayStatus
    frame_index: int
    frame_count: int
    times: int
    late_frames: int = 0
    latest_ms: int = 0
    skipped_frames: int = 0
    battery_unknown: bool = False
    code: ErrorCode | None = None
    detail: str | None = None


ServoNumber = Annotated[int, Field(ge=1, le=253)]


class ServoLimits(Message):
    """The limits of a servo, its trim, which is in them already, all in its board's unit, and its name. A
    page of before stored no trim.
    """

    servo: ServoNumber
    name: Annotated[str, Field(min_length=1, max_length=64)]
    min: Annotated[int, Field(ge=0, le=65535)]
    max: Annotated[int, Field(ge=0, le=65535)]
    trim: Annotated[int, Field(ge=-65535, le=65535)] = 0


class RobotState(Message):
    """The robot on the board: which document of the library, at which revision; 0 while it is read."""

    id: str
    revision: int


class UnheldServos(Message):
    """Motion that a STOP could not hold: `servos`, `null` where unknown, that may move for `forMs` after the
    press at most; `null` where the board may not have received the stop.
    """

    servos: list[int] | None
    for_ms: int | None


Outcome = Literal["acknowledged", "silent", "sent"]
"""The board has taken it, which says nothing of what it makes of it; it should have said so and has not; such
a board never says.
"""

StopFor = Literal["person", "battery"]
"""A person pressed STOP; the driver's page did so for a low battery."""

LatchedBy = Literal[StopFor, "silence", "loss"]
"""Besides these: a driver was not heard while the robot moved; the port went away."""

MAX_SAFE = 2**53 - 1
Name = Annotated[str, Field(max_length=64)]
Whole = Annotated[int, Field(ge=0, le=MAX_SAFE)]


class PoseTarget(Message):
    servo: Annotated[int, Field(ge=0, le=0xFF)]
    position: Annotated[int, Field(ge=0, le=0xFFFF)]


class NamedPose(Message):
    """`id` stays when it is named anew. `targets` are some of the robot's servos, in its board's unit."""

    id: Whole
    name: Annotated[str, Field(min_length=1, max_length=64)]
    unit: Literal["us", "steps"]
    targets: Annotated[list[PoseTarget], Field(min_length=1, max_length=253)]


BatteryPolicy = Literal["tell", "refuse", "rest"]
"""What a battery at its alarm brings about, each with what is before it: the person is warned; nothing new is
run or played; the robot goes to rest and is stopped by the page that drives.
"""


class RobotFacts(Message):
    """The facts of a robot that the gateway needs: the limits of its servos and the poses for programs, in
    the board's unit. `lowBatteryMv`: at or below, its battery is low; at or below `alarmMv` its
    `batteryPolicy` holds. These are null where a version of before stored it.
    """

    kind: Literal["robot"]
    name: Name
    board: Name
    updated_at_ms: Whole
    limits: Annotated[list[ServoLimits], Field(max_length=253)]
    poses: Annotated[list[NamedPose], Field(max_length=1001)]
    low_battery_mv: Whole | None = None
    battery_policy: BatteryPolicy | None = None
    alarm_mv: Whole | None = None


class FleetStatus(Message):
    """The gateway on a broker. `problem` says why it is not connected, or not heard there; `refused`:
    messages that were refused before they reached the robot, by code.
    """

    broker: str
    site: str
    name: str
    is_connected: bool
    is_cloned: bool
    problem: str | None
    refused: dict[str, int]
