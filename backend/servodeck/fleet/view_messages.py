"""What the page of a fleet is sent: robots, tasks, events, cues and groups of robots. Knows no console."""

from typing import Annotated, Literal

from pydantic import Field

from servodeck.fleet.heard import Presence
from servodeck.schema import Message
from servodeck.snapshots import LinkStatus, ServoLimits, Whole


class FleetSlot(Message):
    slot: int
    name: str


class FleetRunning(Message):
    """`name` is empty where the gateway does not know what the slot holds."""

    slot: int
    name: str


class FleetState(Message):
    link: LinkStatus
    latch: bool
    stopped_by: str | None
    driver: str | None
    running: FleetRunning | None
    battery_mv: int | None


class FleetRobot(Message):
    """A gateway of the site and its robot. `limits`: of the servos of its robot, in the board's unit.
    `lowBatteryMv`: at or below, its battery is low; null where the robot does not say. `page`:
    the address of its own page, empty where it has none. `seenMsAgo`: in steps of 10 s, null while it is
    present, and where it never was. `state`: the latest one, null until one was heard.
    """

    id: str
    name: str
    robot: str
    board: str
    version: str
    page: str
    limits: list[ServoLimits]
    low_battery_mv: int | None
    slots: list[FleetSlot]
    groups: list[str]
    presence: Presence
    seen_ms_ago: int | None
    state: FleetState | None


PartStatus = Literal["waiting", "busy", "done", "failed"]


class FleetTaskPart(Message):
    """`share` of its work that is done, 0 to 1, null where unknown. `detail` says why it failed."""

    robot: str
    status: PartStatus
    share: float | None = None
    detail: str | None = None


class FleetTask(Message):
    """What a person asked of several robots. `names`: of the action groups. `spreadMs`: between the first and
    the last first bit of those that started together, by their own clocks; null where unknown.
    """

    id: str
    verb: Literal["run", "download", "resume"]
    names: list[str]
    by: str
    parts: list[FleetTaskPart]
    spread_ms: float | None = None


FleetEventKind = Literal["stopped", "resumed", "lost", "ready", "silent", "cloned", "back"]


class FleetEvent(Message):
    """`robot`: its name then. `atMs`: since 1970, by the clock of the gateway that serves the page."""

    at_ms: Whole
    robot: str
    kind: FleetEventKind
    by: str | None


class FleetBroker(Message):
    """The link to the broker; `detail` says why it is not connected."""

    status: Literal["connected", "connecting"]
    detail: str


class FleetCue(Message):
    """A step of a show: the group of that name on the robots of a group of robots, empty for all."""

    name: Annotated[str, Field(min_length=1, max_length=64)]
    robots: Annotated[str, Field(max_length=64)]
    times: Annotated[int, Field(ge=1, le=0xFFFF)]
    stops_others: Annotated[bool, Field(description="Where one robot fails, all of the cue are stopped.")]


class FleetCues(Message):
    cues: Annotated[list[FleetCue], Field(max_length=200)]


class FleetChanges(Message):
    """All of it where `isWhole`, else what changed since the revision that was asked for; `cues` are always
    all of them.
    """

    revision: Whole
    is_whole: bool
    site: str
    broker: FleetBroker
    robots: list[FleetRobot]
    removed: list[str]
    tasks: list[FleetTask]
    events: list[FleetEvent]
    cues: list[FleetCue]


Members = Annotated[list[Annotated[str, Field(max_length=64)]], Field(max_length=1000)]


class FleetGroups(Message):
    """The robots of each group, by its name: as it is kept in a file."""

    groups: Annotated[
        dict[Annotated[str, Field(min_length=1, max_length=64)], Members], Field(max_length=100)
    ]
