"""What the gateway and its clients say to each other over the WebSocket.

The only description of these messages: `python -m servodeck.messages` prints the JSON schema from which the
page's types are generated. Knows no socket and no rule about who may say what.
"""

import json
import sys
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, TypeAdapter

from servodeck.errors import ErrorCode
from servodeck.intents import PlayIntent
from servodeck.schema import Message, schema_of
from servodeck.told import (
    BatteryTold,
    IdentityTold,
    JobState,
    LatchedBy,
    LeaseState,
    LinkState,
    MotionTold,
    Outcome,
    PlayState,
    PortState,
    RobotTold,
    ServoNumber,
    StopFor,
    StoredGroup,
    UnattendedRun,
    UnheldServos,
)

PROTOCOL = 5
"""Counted up with each change that a page of before would not understand: it is told to load itself again."""

# A packet is 255 bytes at most; one more is let in so that the gate can say what is wrong with it.
Hex = Annotated[
    str, Field(max_length=512, description="Bytes of one packet, two hex digits each, no spaces.")
]
MessageId = Annotated[
    int, Field(ge=0, le=2**53 - 1, description="Chosen by the client; comes back in the answer.")
]


Slot = Annotated[int, Field(ge=0, le=255)]
LeaseAction = Literal["request", "release", "take", "refuse"]
Nonce = Annotated[str, Field(max_length=40, description="Of the latest `tick`: shows how old this is.")]


class Target(Message):
    """Where a servo shall go, in its board's unit."""

    servo: ServoNumber
    position: Annotated[int, Field(ge=0, le=0xFFFF)]


class MoveMessage(Message):
    """Move servos. Of each the newest value counts; what waits for the wire leaves together, servos whose
    place nobody knows slowly and one after another. `durationMs` 0: as fast as the servos and the link allow.
    `nonce` shows that the driver says it, and now. Answered only where it is refused: `left` tells what has
    left.
    """

    type: Literal["move"]
    id: MessageId
    targets: Annotated[list[Target], Field(min_length=1, max_length=253)]
    duration_ms: Annotated[int, Field(ge=0, le=30_000)]
    nonce: Nonce | None


class RunMessage(Message):
    """Run the group in `slot`; `times` 0: until it is stopped. What moves ends first."""

    type: Literal["run"]
    id: MessageId
    slot: Slot
    times: Annotated[int, Field(ge=0, le=0xFFFF)]
    nonce: Nonce | None


class StopGroupMessage(Message):
    """End the running group behind its frame in progress. Everything else is free to move."""

    type: Literal["stopGroup"]
    id: MessageId


class EraseMessage(Message):
    """Erase every slot of the board."""

    type: Literal["erase"]
    id: MessageId
    nonce: Nonce | None


class SetSpeedMessage(Message):
    """How fast the board plays the group in `slot`, `null` every group, until it is switched off."""

    type: Literal["setSpeed"]
    id: MessageId
    slot: Slot | None
    percent: Annotated[int, Field(ge=0, le=0xFFFF)]
    nonce: Nonce | None


class ReleaseMessage(Message):
    """Take the torque off these servos: what they carry drops."""

    type: Literal["release"]
    id: MessageId
    servos: Annotated[list[ServoNumber], Field(min_length=1, max_length=253)]
    nonce: Nonce | None


class PacketMessage(Message):
    """Put one packet on the wire as it is. A question needs no `nonce`."""

    type: Literal["packet"]
    id: MessageId
    bytes: Hex
    nonce: Nonce | None


class StopMessage(Message):
    """STOP: drop all that waits, send stop three times, hold the robot where it is, and latch. Whatever else
    it says, it is a stop.
    """

    model_config = ConfigDict(extra="ignore")

    type: Literal["stop"]
    why: StopFor = "person"


class ResumeMessage(Message):
    """Allow motion again. Moves nothing."""

    type: Literal["resume"]


class BoardMessage(Message):
    """Which family the board is of, as a person has said; `unknown`: ask it again."""

    type: Literal["board"]
    id: MessageId
    board: Annotated[str, Field(max_length=64)]


class ReadMessage(Message):
    """Ask the board now; what it says is told to everybody, and `done` once it has. Needs no lease."""

    type: Literal["read"]
    id: MessageId
    what: Literal["battery"]


class CalibrateMessage(Message):
    """This client looks for the limits of `servo` and may pass the present ones with it, until `null` or the
    end of its connection.
    """

    type: Literal["calibrate"]
    servo: ServoNumber | None


class LeaseMessage(Message):
    """`request` a lease that is free, or ask its driver for it; `release` it, also to whoever asks, or take
    the question back; `refuse` whoever asks; `take` it without asking.
    """

    type: Literal["lease"]
    action: LeaseAction


PersonId = Annotated[str, Field(min_length=1, max_length=64)]


class GiveMessage(Message):
    """The driver's or an owner's: whoever of that id is here and may drive shall drive now, unasked."""

    type: Literal["give"]
    to: PersonId


ContinueMs = Annotated[
    int, Field(ge=1000, le=3_600_000, description="After that it is stopped, at the latest.")
]


class ContinueMessage(Message):
    """The driver's: the run under way may go on without me, for so long at most. `null`: it may not."""

    type: Literal["continue"]
    for_ms: ContinueMs | None


class BeatMessage(Message):
    """The answer to each `tick`: somebody is there who drives."""

    type: Literal["beat"]
    nonce: Nonce


class PlayMessage(PlayIntent):
    """Have the gateway play a group; `played` follows when it has ended, or `refused`. One that does not fit
    into a message: `POST /api/play`.
    """

    type: Literal["play"]
    id: MessageId
    nonce: Nonce


class StopPlayingMessage(Message):
    """The driver's: what the gateway plays ends with its frame in progress."""

    type: Literal["stopPlaying"]


AnyClientMessage = (
    MoveMessage
    | PlayMessage
    | StopPlayingMessage
    | RunMessage
    | StopGroupMessage
    | EraseMessage
    | SetSpeedMessage
    | ReleaseMessage
    | PacketMessage
    | StopMessage
    | ResumeMessage
    | BoardMessage
    | ReadMessage
    | CalibrateMessage
    | LeaseMessage
    | GiveMessage
    | ContinueMessage
    | BeatMessage
)
ClientMessage = Annotated[AnyClientMessage, Field(discriminator="type")]


class Standing(Message):
    """How the gateway stands, for everybody alike. `board` is the family that it is driven as.
    `brokenSlots` hold half a group: nobody may run them.
    `slotVersions` tell what was stored in each slot last, as far as the gateway knows. `stoppedBy` is what
    people call whoever pressed STOP, or whose page did it for the battery, where that is known.
    `waitingToStart`: servos that were asked to move, but nobody knows where they stand, so they start one
    after another, in this order.
    """

    board: str
    port: PortState
    link: LinkState
    identity: IdentityTold
    latch: bool
    latched_by: LatchedBy | None
    stopped_by: str | None
    clients: int
    unattended: UnattendedRun | None
    broken_slots: list[int]
    slot_versions: dict[str, StoredGroup]
    waiting_to_start: list[int]


class WelcomeMessage(Standing):
    """The first message on each connection."""

    type: Literal["welcome"] = "welcome"
    version: str
    robot: RobotTold | None
    lease: LeaseState
    job: JobState | None
    play: PlayState | None
    motion: MotionTold
    battery: Annotated[BatteryTold, Field(discriminator="kind")]


class BatteryMessage(Message):
    """The board has told its battery, which the gateway asks for now and then, or stays silent about it."""

    type: Literal["battery"] = "battery"
    battery: Annotated[BatteryTold, Field(discriminator="kind")]


class DoneMessage(Message):
    """What was asked with that `id` is done. `outcome`: of a command for the board."""

    type: Literal["done"] = "done"
    id: MessageId
    outcome: Outcome | None = None


class RefusedMessage(Message):
    """`id` is null where the message itself could not be read, and for a stop."""

    type: Literal["refused"] = "refused"
    id: MessageId | None
    code: ErrorCode
    detail: str


class ReceivedMessage(Message):
    """One packet of the board."""

    type: Literal["received"] = "received"
    packet: str


class NoiseMessage(Message):
    """Bytes of the board that belong to no packet."""

    type: Literal["noise"] = "noise"
    bytes: str


class HaltedMessage(Message):
    """The stop sequence has left the wire. `unheld`: what may go on in spite of it, if anything."""

    type: Literal["halted"] = "halted"
    unheld: UnheldServos | None


class ResumedMessage(Message):
    """Motion is allowed again, by somebody else's word."""

    type: Literal["resumed"] = "resumed"
    by: str


class StateMessage(Standing):
    """Something of this changed."""

    type: Literal["state"] = "state"


class JobMessage(Message):
    """A download began, came further or ended; the latest one, whoever began it."""

    type: Literal["job"] = "job"
    job: JobState


class PlayToldMessage(Message):
    """What the gateway plays began, came further or ended; the latest play, whoever began it."""

    type: Literal["play"] = "play"
    play: PlayState


class PlayedMessage(Message):
    """To whoever asked for it: that play has ended, and how."""

    type: Literal["played"] = "played"
    id: MessageId
    play: PlayState


class RobotMessage(Message):
    """Another robot stands on the board now, or any robot of the library has changed: look there."""

    type: Literal["robot"] = "robot"
    robot: RobotTold | None


class LeaseToldMessage(Message):
    """Something of the lease changed."""

    type: Literal["lease"] = "lease"
    lease: LeaseState


class LeftMessage(Message):
    """What has left the wire since the last of these, whoever asked for it."""

    type: Literal["left"] = "left"
    packets: list[str]


class TickMessage(Message):
    """To the driver, four times a second: answer it with a `beat`, and put its nonce into each `send`."""

    type: Literal["tick"] = "tick"
    nonce: str


GatewayMessage = Annotated[
    WelcomeMessage
    | BatteryMessage
    | DoneMessage
    | RefusedMessage
    | ReceivedMessage
    | NoiseMessage
    | HaltedMessage
    | ResumedMessage
    | StateMessage
    | RobotMessage
    | LeaseToldMessage
    | TickMessage
    | LeftMessage
    | JobMessage
    | PlayToldMessage
    | PlayedMessage,
    Field(discriminator="type"),
]

client_message: TypeAdapter[AnyClientMessage] = TypeAdapter(ClientMessage)
gateway_message: TypeAdapter[Any] = TypeAdapter(GatewayMessage)


def encode(message: Message) -> str:
    return message.model_dump_json()


def json_schema() -> dict[str, Any]:
    schema = schema_of("Message", {"ClientMessage": ClientMessage}, {"GatewayMessage": GatewayMessage})
    return {**schema, "version": PROTOCOL}


if __name__ == "__main__":
    json.dump(json_schema(), sys.stdout, indent=2)
    sys.stdout.write("\n")
