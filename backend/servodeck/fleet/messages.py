"""The payloads of all topics as models: reports of gateways, requests, and their answers. Made of the same
snapshots and intents as the messages of the other doors.

Requests are strict. Reports may have more fields than a console knows, because versions differ.
"""

from typing import Annotated, ClassVar, Literal

from pydantic import ConfigDict, Field

from servodeck.errors import ErrorCode
from servodeck.fleet.topics import Kind, Verb
from servodeck.intents import Anyway, ContinueMs, GroupBody, Nonce, Slot, Target
from servodeck.schema import Message
from servodeck.snapshots import (
    BatteryState,
    JobState,
    LatchedBy,
    LinkState,
    MotionState,
    Name,
    Outcome,
    PlayState,
    Running,
    ServoLimits,
    StoredGroup,
    UnattendedRun,
    UnheldServos,
    Whole,
)

VERSION: Literal[1] = 1
RefusalCode = ErrorCode | Literal["retained", "superseded", "cloned"]
"""Only on a broker: a retained request; one behind which a newer one came; two gateways with one name."""


class Report(Message):
    model_config = ConfigDict(extra="ignore")

    v: Literal[1] = VERSION


class About(Report):
    """Retained. `robot`: its name, empty where none is described. `slots`: the groups that the gateway
    stored. `page`: the address of its page, empty where it is not reachable from elsewhere. `stopToken`: with
    it POST PAGE/api/stop takes a STOP, and nothing else; whoever may read this may stop over the broker, too.
    `lowBatteryMv`: at or below, its battery is low; null where its description does not say.
    """

    name: Name
    version: str
    board: str
    robot: str
    servos: list[ServoLimits]
    slots: dict[str, StoredGroup]
    broken_slots: list[int]
    page: str
    stop_token: str = ""
    low_battery_mv: Whole | None = None


class Online(Report):
    """Retained; `isOnline` false is the last will. `instance` is another one at each start of a gateway. Is
    believed only beside a fresh state of the same instance.
    """

    instance: str
    is_online: bool


class Started(Report):
    """The latest promise to start that was kept, by its name: the first bit of the run left the gateway
    `lateMs` after its time, by its own clock.
    """

    name: str
    late_ms: float


class State(Report):
    """Retained, each second and whenever it changes. `nonce` goes into requests and shows how old they are.
    `isCloned`: another gateway has the same name, so neither takes requests but stop. `unheld`: motion that
    the latest STOP could not hold.
    """

    instance: str
    count: Whole
    epoch: Whole
    nonce: Nonce
    is_cloned: bool
    board: str
    link: LinkState
    latch: bool
    latched_by: LatchedBy | None
    stopped_by: str | None
    unheld: UnheldServos | None
    driver: str | None
    requested_by: str | None
    running: Running | None
    play: PlayState | None
    job: JobState | None
    unattended: UnattendedRun | None
    battery: Annotated[BatteryState, Field(discriminator="kind")]
    started: Started | None = None


class Live(Report):
    """Not retained, 20 a second while somebody drives over the broker."""

    instance: str
    epoch: Whole
    nonce: Nonce
    latch: bool
    driver: str | None
    motion: MotionState


class Request(Message):
    """`n` rises with each request of a session. The same number again gets the same answer."""

    v: Literal[1] = VERSION
    n: Whole


class ReportRequest(Request):
    """Answered with the state; also of those that publish it seldom."""


class TimelyRequest(Request):
    """`nonce`: the newest of that gateway; the request is refused when it is older than `WITHIN_S`."""

    WITHIN_S: ClassVar[float] = 0.5

    nonce: Nonce


class AskRequest(TimelyRequest):
    """For the lease, as on a page. `take`, an owner's: without a request to the driver."""

    WITHIN_S: ClassVar[float] = 10.0

    action: Literal["request", "take", "release"]


class BeatRequest(Request):
    """The driver is present. `nonces`: the newest of each gateway that it drives, by name."""

    nonces: Annotated[dict[Annotated[str, Field(max_length=64)], Nonce], Field(max_length=400)]


class MoveRequest(TimelyRequest):
    """As the `move` of a page: of each servo the newest value counts."""

    targets: Annotated[list[Target], Field(min_length=1, max_length=253)]
    duration_ms: Annotated[int, Field(ge=0, le=30_000)]


class RunRequest(TimelyRequest):
    """`times` 0: until stopped. `continueForMs`: it may continue so long without its driver."""

    slot: Slot
    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    anyway: Anyway = False
    continue_for_ms: ContinueMs | None = None


class PressRequest(TimelyRequest):
    """A button of home automation was pressed: run that group once. `n` is the `count` of the state that
    `nonce` was in, so that a button needs no memory, and two of one state are one (docs/adr/0050).
    """

    WITHIN_S: ClassVar[float] = 3.0

    slot: Slot


class ResumeRequest(TimelyRequest):
    """Allow motion again."""


class DownloadRequest(TimelyRequest):
    """As `POST /api/download`."""

    WITHIN_S: ClassVar[float] = 10.0

    groups: Annotated[list[GroupBody], Field(min_length=1, max_length=256)]
    behind: Annotated[str, Field(max_length=64)] | None = None


class EraseRequest(TimelyRequest):
    """Erase every slot of the board. An owner's."""


class SyncRequest(Request):
    """Answered at once with the gateway's clock."""


StartName = Annotated[str, Field(min_length=1, max_length=64)]


class PrepareRequest(TimelyRequest):
    """Promise to run the group in `slot` at `startMs` of the gateway's clock, known to `uncertaintyMs`, if
    `commit` comes. `version`: what the slot has to hold; null: whatever it holds.
    """

    WITHIN_S: ClassVar[float] = 10.0

    name: StartName
    slot: Slot
    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    anyway: Anyway = False
    version: str | None = None
    start_ms: Annotated[float, Field(strict=False)]
    uncertainty_ms: Annotated[float, Field(ge=0, strict=False)]


class CommitRequest(Request):
    """Keep the promise of that name. Gateways without one do not answer."""

    name: StartName


class CancelRequest(CommitRequest):
    """Give it up."""


AnyRequest = (
    ReportRequest
    | AskRequest
    | BeatRequest
    | MoveRequest
    | RunRequest
    | PressRequest
    | ResumeRequest
    | DownloadRequest
    | EraseRequest
    | SyncRequest
    | PrepareRequest
    | CommitRequest
    | CancelRequest
)


class Done(Report):
    """`nonce` and `epoch` are for the next request; `drives`: the asking session has the lease. `outcome`: of
    a command for the board. `batteryUnknown`: of a run, as over HTTP. `state`: the answer to `report`.
    """

    kind: Literal["done"] = "done"
    gateway: str
    n: Whole | None
    nonce: Nonce
    epoch: Whole
    drives: bool
    outcome: Outcome | None = None
    battery_unknown: bool | None = None
    job: JobState | None = None
    state: State | None = None


class Refused(Report):
    """`n` is null where it could not be read."""

    kind: Literal["refused"] = "refused"
    gateway: str
    n: Whole | None
    code: RefusalCode
    detail: str


class Clock(Report):
    """The answer to `sync`: the gateway's clock when the request came."""

    kind: Literal["clock"] = "clock"
    gateway: str
    n: Whole
    clock_ms: float


AnyAnswer = Done | Refused | Clock
Answer = Annotated[AnyAnswer, Field(discriminator="kind")]

REPORTS: dict[Kind, type[Report]] = {"about": About, "state": State, "online": Online, "live": Live}
REQUESTS: dict[Verb, type[AnyRequest]] = {
    "report": ReportRequest,
    "ask": AskRequest,
    "beat": BeatRequest,
    "move": MoveRequest,
    "run": RunRequest,
    "press": PressRequest,
    "resume": ResumeRequest,
    "download": DownloadRequest,
    "erase": EraseRequest,
    "sync": SyncRequest,
    "prepare": PrepareRequest,
    "commit": CommitRequest,
    "cancel": CancelRequest,
}
"""A stop has no model: it is done whatever it carries."""


def encode(message: Message) -> bytes:
    # A gateway of a version before refuses a field that it does not know.
    unsaid = {"anyway"} if getattr(message, "anyway", None) is False else None
    return message.model_dump_json(exclude=unsaid, exclude_none=False).encode()
