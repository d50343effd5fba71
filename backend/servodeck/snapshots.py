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
    """Somebody who is here and may drive."""

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
    """How the serial port stands. `code` and `detail` say why it is lost, `retryInMs` when the next attempt
    follows. `simulated` where the device was declared to be no real board. `withheld`: what this way to the
    board is not to carry, although the board may know it.
    """

    device: str | None
    status: PortStatus
    simulated: bool = False
    withheld: list[Withheld] = Field(default_factory=list)
    code: ErrorCode | None = None
    detail: str | None = None
    retry_in_ms: int | None = None


class LinkState(Message):
    """The way to the board, and the board: `identifying` while it is asked who it is, `stale` while it does
    not answer what such a board always answers, `refused` until a person says which board it is. `code` and
    `detail` say why it is not ready.
    """

    status: LinkStatus
    code: ErrorCode | None = None
    detail: str | None = None


class AnsweredEvidence(Message):
    """The board answered that question when it was asked who it is."""

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
    """What the board answered when it was asked who it is, and the families that answer like that."""

    evidence: list[Annotated[EvidenceState, Field(discriminator="kind")]]
    candidates: list[str]


class BatteryUnread(Message):
    kind: Literal["unread"] = "unread"


class BatteryRead(Message):
    kind: Literal["read"] = "read"
    battery_mv: int
    age_ms: int


class BatterySilent(Message):
    """Several questions in a row stayed unanswered; `lastMv` is what it said before."""

    kind: Literal["silent"] = "silent"
    last_mv: int | None


BatteryState = BatteryUnread | BatteryRead | BatterySilent


class UnattendedRun(Message):
    """A run that may go on without its driver `by`, for so long at most. `slot` is null where the gateway
    plays.
    """

    slot: int | None
    times: int
    by: str
    ends_in_ms: int


class StoredGroup(Message):
    """What a slot was given last: which version, called what, of which document of the library where one is
    named, by whom, and when, in milliseconds since 1970; null where that was not noted.
    """

    version: str
    name: str = ""
    document: str | None = None
    by: str = ""
    at_ms: int | None = None


class ServoWay(Message):
    """A servo on its way, or there already: begun so long ago (below 0: not yet), and taking so long. `start`
    is null where it is unknown where it began.
    """

    servo: int
    start: float | None
    target: int
    begun_ms_ago: float
    duration_ms: float


class ReportedPosition(Message):
    """Where the board said that a servo stood, so long ago. `isCurrent`: as far as the gateway can tell it
    stands there still.
    """

    servo: int
    position: int
    age_ms: int
    is_current: bool


class MotionState(Message):
    """Where packets have taken the servos since the port opened, and what the board has reported of them; of
    one that is not named the place is unknown. `runSlot`: the group that may run. `released`: they have no
    torque, so hands may have turned them.
    """

    servos: list[ServoWay]
    run_slot: int | None
    released: list[int]
    reported: list[ReportedPosition]


JobStatus = Literal["running", "done", "failed", "cancelled"]


class JobState(Message):
    """A download and how far it is. `slots`: where its groups go, in this order; `slot` and `name`: of the
    one that is being stored, or was last; frames and bytes are of all of them. `by`: who began it. `code` and
    `detail` say why it failed or was cancelled.
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
    """Frames that the gateway plays by its own clock, and how far it is. `times` 0: until stopped. `by`: who
    began it. `lateFrames` began so late that those behind them were put off, by `latestMs` at most;
    `skippedFrames` did not leave. `ended`: before its last frame had ended; `code` and `detail` say why.
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
    code: ErrorCode | None = None
    detail: str | None = None


ServoNumber = Annotated[int, Field(ge=1, le=253)]


class ServoLimits(Message):
    """How far a servo may be turned, in its board's unit, and what people call it."""

    servo: ServoNumber
    name: Annotated[str, Field(min_length=1, max_length=64)]
    min: Annotated[int, Field(ge=0, le=65535)]
    max: Annotated[int, Field(ge=0, le=65535)]


class RobotState(Message):
    """The robot on the board: which document of the library, at which revision; 0 while it is read."""

    id: str
    revision: int


class UnheldServos(Message):
    """What may go on in spite of a STOP: these servos, `null` where it is unknown which, for so long at most
    from its press; `null` where a group may run that heard no stop.
    """

    servos: list[int] | None
    for_ms: int | None


Outcome = Literal["acknowledged", "silent", "sent"]
"""The board has taken it, which says nothing of what it makes of it; it should have said so and has not; such
a board never says.
"""

StopFor = Literal["person", "battery"]
"""Somebody pressed STOP; the policy for a low battery, on the driver's page."""

LatchedBy = Literal[StopFor, "silence", "loss"]
"""Besides these: a driver was not heard while the robot moved; the port went away."""

MAX_SAFE = 2**53 - 1
Name = Annotated[str, Field(max_length=64)]
Whole = Annotated[int, Field(ge=0, le=MAX_SAFE)]


class PoseTarget(Message):
    servo: Annotated[int, Field(ge=0, le=0xFF)]
    position: Annotated[int, Field(ge=0, le=0xFFFF)]


class NamedPose(Message):
    """`id` stays when it is named anew. `targets` are some of the robot's servos, as its board counts."""

    id: Whole
    name: Annotated[str, Field(min_length=1, max_length=64)]
    unit: Literal["us", "steps"]
    targets: Annotated[list[PoseTarget], Field(min_length=1, max_length=253)]


class RobotFacts(Message):
    """What the gateway itself needs to know of a robot: how far its servos may be turned and the poses that
    programs go to, as the board counts.
    """

    kind: Literal["robot"]
    name: Name
    board: Name
    updated_at_ms: Whole
    limits: Annotated[list[ServoLimits], Field(max_length=253)]
    poses: Annotated[list[NamedPose], Field(max_length=1001)]
