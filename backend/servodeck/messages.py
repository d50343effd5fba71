"""What the gateway and its clients say to each other, as strict models: unknown fields are refused.

The only description of these messages: `python -m servodeck.messages` prints the JSON schema from which the
page's types are generated. Knows no socket and no rule about who may say what.
"""

import json
import sys
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter
from pydantic.alias_generators import to_camel
from pydantic.json_schema import GenerateJsonSchema

from servodeck.errors import ErrorCode

# A packet is 255 bytes at most; one more is let in so that the gate can say what is wrong with it.
Hex = Annotated[
    str, Field(max_length=512, description="Bytes of one packet, two hex digits each, no spaces.")
]
MessageId = Annotated[
    int, Field(ge=0, le=2**53 - 1, description="Chosen by the client; comes back in the answer.")
]


class Message(BaseModel):
    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        frozen=True,
        alias_generator=to_camel,
        populate_by_name=True,
        serialize_by_alias=True,
        json_schema_serialization_defaults_required=True,
    )


PortStatus = Literal["closed", "opening", "open", "lost"]


LeaseAction = Literal["request", "release", "take", "refuse"]
Nonce = Annotated[str, Field(max_length=40, description="Of the latest `tick`: shows how old this is.")]


class Candidate(Message):
    """Somebody who is here and may drive."""

    id: str
    name: str


class LeaseState(Message):
    """Who drives and who asks to, by name; `drives` and `asks`: that is this client. `answerInMs`: how long
    the driver may still refuse. `givenBy`: who handed it to this client, which drives. `candidates`: whom
    this client may hand it to.
    """

    driver: str | None
    drives: bool
    asker: str | None
    asks: bool
    answer_in_ms: int | None
    may_drive: bool
    may_take: bool
    given_by: str | None
    candidates: list[Candidate]


class PortState(Message):
    """How the serial port stands. `code` and `detail` say why it is lost, `retryInMs` when the next attempt
    follows. `simulated` where the device was declared to be no real board.
    """

    device: str | None
    status: PortStatus
    simulated: bool = False
    code: ErrorCode | None = None
    detail: str | None = None
    retry_in_ms: int | None = None


class UnattendedRun(Message):
    """A run that may go on without its driver `by`, for so long at most."""

    slot: int
    times: int
    by: str
    ends_in_ms: int


class ServoWay(Message):
    """A servo on its way, or there already: begun so long ago (below 0: not yet), and taking so long. `start`
    is null where nobody knows where it began.
    """

    servo: int
    start: float | None
    target: int
    begun_ms_ago: float
    duration_ms: float


class MotionTold(Message):
    """Where packets have taken the servos since the port opened; of one that is not named nobody knows the
    place. `runSlot`: the group that may run.
    """

    servos: list[ServoWay]
    run_slot: int | None


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


class SendMessage(Message):
    """Put one packet on the wire. `nonce` shows that the driver says it, and now; a question needs none.
    `newest`: a move that a later one like it takes the place of while it waits; each says anew where all
    servos shall go that may still wait.
    """

    type: Literal["send"]
    id: MessageId
    packet: Hex
    nonce: Nonce | None
    newest: bool = False


class StopMessage(Message):
    """STOP: drop all that waits, send stop three times, then `hold` (one move to the present pose), and
    latch.
    """

    type: Literal["stop"]
    hold: Hex | None


class ResumeMessage(Message):
    """Allow motion again. Moves nothing."""

    type: Literal["resume"]


class BoardMessage(Message):
    """Which family the board is of, as a person has said; `unknown`: ask it again."""

    type: Literal["board"]
    board: Annotated[str, Field(max_length=64)]


ServoNumber = Annotated[int, Field(ge=1, le=253)]


class ServoLimits(Message):
    """How far a servo may be turned, in its board's unit, and what people call it."""

    servo: ServoNumber
    name: Annotated[str, Field(min_length=1, max_length=64)]
    min: Annotated[int, Field(ge=0, le=65535)]
    max: Annotated[int, Field(ge=0, le=65535)]


class RobotTold(Message):
    """The robot on the board: which document of the library, at which revision; 0 while it is read."""

    id: str
    revision: int


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


AnyClientMessage = (
    SendMessage
    | StopMessage
    | ResumeMessage
    | BoardMessage
    | CalibrateMessage
    | LeaseMessage
    | GiveMessage
    | ContinueMessage
    | BeatMessage
)
ClientMessage = Annotated[AnyClientMessage, Field(discriminator="type")]


LatchedBy = Literal["person", "silence", "loss"]
"""Somebody pressed STOP; a driver was not heard while the robot moved; the port went away."""


class WelcomeMessage(Message):
    """The first message on each connection."""

    type: Literal["welcome"] = "welcome"
    version: str
    board: str
    port: PortState
    latch: bool
    latched_by: LatchedBy | None
    stopped_by: str | None
    clients: int
    unattended: UnattendedRun | None
    robot: RobotTold | None
    lease: LeaseState
    broken_slots: list[int]
    slot_versions: dict[str, str]
    job: JobState | None
    motion: MotionTold


class SentMessage(Message):
    """The packet's last bit has left the wire."""

    type: Literal["sent"] = "sent"
    id: MessageId


class ReplacedMessage(Message):
    """That `newest` move has not left: a newer one has taken its place."""

    type: Literal["replaced"] = "replaced"
    id: MessageId


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
    """The stop sequence has left the wire."""

    type: Literal["halted"] = "halted"


class ResumedMessage(Message):
    """Motion is allowed again, by somebody else's word."""

    type: Literal["resumed"] = "resumed"
    by: str


class StateMessage(Message):
    """Something of this changed. `brokenSlots` hold half a group: nobody may run them. `slotVersions` tell
    what was stored in each slot last, as far as the gateway knows. `stoppedBy` is what
    people call whoever pressed STOP, where that is known.
    """

    type: Literal["state"] = "state"
    board: str
    port: PortState
    latch: bool
    latched_by: LatchedBy | None
    stopped_by: str | None
    clients: int
    unattended: UnattendedRun | None
    broken_slots: list[int]
    slot_versions: dict[str, str]


class JobMessage(Message):
    """A download began, came further or ended; the latest one, whoever began it."""

    type: Literal["job"] = "job"
    job: JobState


class RobotMessage(Message):
    """Another robot stands on the board now, or any robot of the library has changed: look there."""

    type: Literal["robot"] = "robot"
    robot: RobotTold | None


class LeaseToldMessage(Message):
    """Something of the lease changed."""

    type: Literal["lease"] = "lease"
    lease: LeaseState


class LeftMessage(Message):
    """What others have put on the wire since the last of these, or the gateway itself; no questions."""

    type: Literal["left"] = "left"
    packets: list[str]


class TickMessage(Message):
    """To the driver, four times a second: answer it with a `beat`, and put its nonce into each `send`."""

    type: Literal["tick"] = "tick"
    nonce: str


GatewayMessage = Annotated[
    WelcomeMessage
    | SentMessage
    | ReplacedMessage
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
    | JobMessage,
    Field(discriminator="type"),
]

client_message: TypeAdapter[AnyClientMessage] = TypeAdapter(ClientMessage)
gateway_message: TypeAdapter[Any] = TypeAdapter(GatewayMessage)


def encode(message: Message) -> str:
    return message.model_dump_json()


class PlainSchema(GenerateJsonSchema):
    """Without a title for each field, which would become a type name of its own in TypeScript."""

    def field_title_should_be_set(self, _schema: Any) -> bool:
        return False


def schema_of(title: str, read: dict[str, Any], written: dict[str, Any]) -> dict[str, Any]:
    """One schema whose $defs hold those named types and all they consist of."""
    types = [(name, "validation", TypeAdapter(each)) for name, each in read.items()]
    types += [(name, "serialization", TypeAdapter(each)) for name, each in written.items()]
    names, definitions = TypeAdapter.json_schemas(
        types,  # type: ignore[arg-type]
        ref_template="#/$defs/{model}",
        schema_generator=PlainSchema,
    )
    unions = {name: {**schema, "title": name} for (name, _mode), schema in names.items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "oneOf": [{"$ref": f"#/$defs/{name}"} for name in unions],
        "$defs": {**definitions["$defs"], **unions},
    }


def json_schema() -> dict[str, Any]:
    return schema_of("Message", {"ClientMessage": ClientMessage}, {"GatewayMessage": GatewayMessage})


if __name__ == "__main__":
    json.dump(json_schema(), sys.stdout, indent=2)
    sys.stdout.write("\n")
