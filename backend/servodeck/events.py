"""The messages of the gateway to its clients on the WebSocket and in the event stream.

`python -m servodeck.events` prints the JSON schema of these messages and of the clients' (intents.py), from
which the page's types are generated. Knows no socket and no role.
"""

import json
import sys
from typing import Annotated, Any, Literal

from pydantic import Field

from servodeck.errors import ErrorCode
from servodeck.intents import ClientMessage, MessageId
from servodeck.packet_models import CommandModel, ReportModel
from servodeck.schema import Message, schema_of
from servodeck.snapshots import (
    ActivityState,
    BatteryState,
    IdentityState,
    JobState,
    LatchedBy,
    LeaseState,
    LinkState,
    MotionState,
    Outcome,
    PlayState,
    PortState,
    RobotState,
    StopOutcome,
    StoredGroup,
    UnattendedRun,
    UnheldServos,
)

PROTOCOL = 9
"""Counted up with each change that an older page would not understand: that page is to reload."""


class GatewayState(Message):
    """The state of the gateway, the same for every client. `board` is the family by which the board is
    driven. `brokenSlots` hold half a group: they cannot be run. `slotVersions` are the groups that the
    gateway last stored in each slot. `stoppedBy` is the name of the person who pressed STOP, or whose page
    did so for the battery, if known. `waitingToStart`: servos that are to move from an unknown place, so they
    start one after another, in this order. `mayBeRunning`: what others began before the port was opened may
    continue, because the board has not answered yet.
    """

    board: str
    port: PortState
    link: LinkState
    identity: IdentityState
    latch: bool
    latched_by: LatchedBy | None
    stopped_by: str | None
    clients: int
    unattended: UnattendedRun | None
    broken_slots: list[int]
    slot_versions: dict[str, StoredGroup]
    waiting_to_start: list[int]
    may_be_running: bool


class WelcomeMessage(GatewayState):
    """The first message on each connection."""

    type: Literal["welcome"] = "welcome"
    version: str
    robot: RobotState | None
    lease: LeaseState
    job: JobState | None
    play: PlayState | None
    motion: MotionState
    activity: ActivityState
    battery: Annotated[BatteryState, Field(discriminator="kind")]


class ActivityMessage(Message):
    """What the robot does has changed."""

    type: Literal["activity"] = "activity"
    activity: ActivityState


class BatteryMessage(Message):
    """The board has reported its battery, or has stopped answering about it."""

    type: Literal["battery"] = "battery"
    battery: Annotated[BatteryState, Field(discriminator="kind")]


class DoneMessage(Message):
    """The request with that `id` is done. `outcome`: of a command for the board. `batteryUnknown`: of a run,
    which is refused at an alarm of its battery, that could not be judged.
    """

    type: Literal["done"] = "done"
    id: MessageId
    outcome: Outcome | None = None
    battery_unknown: bool = False


class RefusedMessage(Message):
    """`id` is null where the message itself could not be read, and for a stop."""

    type: Literal["refused"] = "refused"
    id: MessageId | None
    code: ErrorCode
    detail: str


class ReceivedMessage(Message):
    """A report of the board; `bytes` are its packet, for logs."""

    type: Literal["received"] = "received"
    report: ReportModel
    bytes: str


class NoiseMessage(Message):
    """Bytes of the board that belong to no packet, or to one that the silence cut short."""

    type: Literal["noise"] = "noise"
    reason: Literal["garbage", "truncated"]
    bytes: str


class HaltedMessage(Message):
    """The stop sequence has left the wire. `unheld`: servos that may continue to move, if any. It comes again
    where more is known later.
    """

    type: Literal["halted"] = "halted"
    outcome: StopOutcome
    unheld: UnheldServos | None


class ResumedMessage(Message):
    """Another client has resumed: motion is allowed again."""

    type: Literal["resumed"] = "resumed"
    by: str


class StateMessage(GatewayState):
    """Some part of the state has changed."""

    type: Literal["state"] = "state"


class JobMessage(Message):
    """A download began, progressed or ended; the latest one of all clients."""

    type: Literal["job"] = "job"
    job: JobState


class PlayStateMessage(Message):
    """A play of the gateway began, progressed or ended; the latest one of all clients."""

    type: Literal["play"] = "play"
    play: PlayState


class PlayedMessage(Message):
    """To the client that requested it: that play has ended, and how."""

    type: Literal["played"] = "played"
    id: MessageId
    play: PlayState


class RobotMessage(Message):
    """Another robot is on the board now, or a robot of the library has changed."""

    type: Literal["robot"] = "robot"
    robot: RobotState | None


class LeaseStateMessage(Message):
    """The lease has changed."""

    type: Literal["lease"] = "lease"
    lease: LeaseState


class LeftMessage(Message):
    """The commands that have left the wire since the last such message, for all clients."""

    type: Literal["left"] = "left"
    commands: list[CommandModel]


class TickMessage(Message):
    """To the driver, four times a second. It is answered with `heartbeat`; its nonce goes into each message
    that moves.
    """

    type: Literal["tick"] = "tick"
    nonce: str


GatewayMessage = Annotated[
    WelcomeMessage
    | ActivityMessage
    | BatteryMessage
    | DoneMessage
    | RefusedMessage
    | ReceivedMessage
    | NoiseMessage
    | HaltedMessage
    | ResumedMessage
    | StateMessage
    | RobotMessage
    | LeaseStateMessage
    | TickMessage
    | LeftMessage
    | JobMessage
    | PlayStateMessage
    | PlayedMessage,
    Field(discriminator="type"),
]


def encode(message: Message) -> str:
    return message.model_dump_json()


def json_schema() -> dict[str, Any]:
    schema = schema_of("Message", {"ClientMessage": ClientMessage}, {"GatewayMessage": GatewayMessage})
    return {**schema, "version": PROTOCOL}


if __name__ == "__main__":
    json.dump(json_schema(), sys.stdout, indent=2)
    sys.stdout.write("\n")
