"""Requests to the robot, the same for WebSocket, HTTP and command line.

Knows shapes. Roles and the robot's limits are judged elsewhere.

"""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field, TypeAdapter

from servodeck.protocol.values import Frame, ServoTarget
from servodeck.schema import Message
from servodeck.snapshots import ServoNumber, StopFor

Servo = Annotated[str, Field(pattern=r"^[1-9][0-9]{0,2}$")]
# Far more than a board stores: a slow group is sent in parts.
PLAYED_FRAMES = 8192


class FrameBody(Message):
    """Positions by servo number, in the board's unit, reached after `durationMs`."""

    duration_ms: int
    positions: Annotated[dict[Servo, int], Field(max_length=32)]

    def frame(self) -> Frame:
        targets = (ServoTarget(int(servo), position) for servo, position in self.positions.items())
        return Frame(self.duration_ms, tuple(targets))


Version = Annotated[str, Field(max_length=64)]


class GroupBody(Message):
    """`version` is any text that distinguishes it from other groups; by default the gateway makes one.
    `replaces`: the version that the caller expects in the slot, an empty text for none; another one there is
    a conflict. `document`: its document in the library.

    """

    slot: Annotated[int, Field(ge=0, le=255)]
    name: Annotated[str, Field(max_length=64)] = ""
    version: Version = ""
    replaces: Version | None = None
    document: Version | None = None
    frames: Annotated[list[FrameBody], Field(min_length=1, max_length=255)]


Anyway = Annotated[
    bool,
    Field(description="A person wants it although the battery is at its alarm and new runs are refused."),
]


class PlayIntent(Message):
    """`frames` one after the other, gently to the first one, each at its time by the gateway's clock. `times`
    0: until stopped. Each pass but the first begins with frame `loopFrom`.
    """

    frames: Annotated[list[FrameBody], Field(min_length=1, max_length=PLAYED_FRAMES)]
    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    loop_from: Annotated[int, Field(ge=0, lt=PLAYED_FRAMES)] = 0
    anyway: Anyway = False


# A packet is 255 bytes at most; one more is let in so that the gate can say what is wrong with it.
Hex = Annotated[
    str, Field(max_length=512, description="Bytes of one packet, two hex digits each, no spaces.")
]
MessageId = Annotated[
    int, Field(ge=0, le=2**53 - 1, description="Chosen by the client; comes back in the answer.")
]


Slot = Annotated[int, Field(ge=0, le=255)]
LeaseAction = Literal["request", "release", "take", "refuse"]
Nonce = Annotated[
    str, Field(max_length=40, description="Of the latest `tick`: shows how old the message is.")
]


class Target(Message):
    """The target of a servo, in its board's unit."""

    servo: ServoNumber
    position: Annotated[int, Field(ge=0, le=0xFFFF)]


class MoveMessage(Message):
    """Move servos. Of each the newest value counts; waiting values leave together, servos of unknown position
    slowly and one after another. `durationMs` 0: as fast as the servos and the link allow. `nonce` proves
    that the driver sent it just now. Answered only where it is refused: `left` has the commands that left.
    """

    type: Literal["move"]
    id: MessageId
    targets: Annotated[list[Target], Field(min_length=1, max_length=253)]
    duration_ms: Annotated[int, Field(ge=0, le=30_000)]
    nonce: Nonce | None


class RunMessage(Message):
    """Run the group in `slot`; `times` 0: until it is stopped. A motion in progress ends first."""

    type: Literal["run"]
    id: MessageId
    slot: Slot
    times: Annotated[int, Field(ge=0, le=0xFFFF)]
    nonce: Nonce | None
    anyway: Anyway = False


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
    """Set the speed of the group in `slot`, `null` for every group, until the board is switched off."""

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
    """STOP: drop all that waits, send stop three times, hold the robot where it is, and latch. Unknown fields
    are ignored.
    """

    model_config = ConfigDict(extra="ignore")

    type: Literal["stop"]
    reason: StopFor = "person"


class ResumeMessage(Message):
    """Allow motion again. Moves nothing."""

    type: Literal["resume"]


class BoardMessage(Message):
    """The family of the board, as a person has chosen it; `unknown`: identify it again."""

    type: Literal["board"]
    id: MessageId
    board: Annotated[str, Field(max_length=64)]


class ReadMessage(Message):
    """Ask the board now; every client gets its report, and this one `done`. Needs no lease. `servos`:
    whose positions; some boards report all of them, whichever are named.
    """

    type: Literal["read"]
    id: MessageId
    what: Literal["battery", "positions", "version", "offsets"]
    servos: Annotated[list[ServoNumber], Field(max_length=253)]


class CalibrateMessage(Message):
    """This client calibrates `servo` and may move it beyond its present limits, until `null` or the
    end of its connection.
    """

    type: Literal["calibrate"]
    servo: ServoNumber | None


class LeaseMessage(Message):
    """`request` the lease: granted at once where it is free, otherwise unless its driver refuses. `release`
    it, to the client that has requested it if there is one; also withdraws a request. `refuse` a request.
    `take` it, without a request.
    """

    type: Literal["lease"]
    action: LeaseAction


PersonId = Annotated[str, Field(min_length=1, max_length=64)]


class GrantMessage(Message):
    """The driver or an owner grants the lease to the connected client of that id, without a request."""

    type: Literal["grant"]
    to: PersonId


ContinueMs = Annotated[
    int, Field(ge=1000, le=3_600_000, description="After that it is stopped, at the latest.")
]


class ContinueMessage(Message):
    """The driver lets the run in progress continue without one, for so long at most. `null`: not at all."""

    type: Literal["continue"]
    for_ms: ContinueMs | None


class HeartbeatMessage(Message):
    """The driver's answer to each `tick`."""

    type: Literal["heartbeat"]
    nonce: Nonce


class PlayMessage(PlayIntent):
    """Have the gateway play a group; `played` follows when it has ended, or `refused`. One that does not fit
    into a message: `POST /api/play`.
    """

    type: Literal["play"]
    id: MessageId
    nonce: Nonce


class StopPlayingMessage(Message):
    """The driver ends the play of the gateway with its frame in progress."""

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
    | GrantMessage
    | ContinueMessage
    | HeartbeatMessage
)
ClientMessage = Annotated[AnyClientMessage, Field(discriminator="type")]

client_message: TypeAdapter[AnyClientMessage] = TypeAdapter(
    ClientMessage, config=ConfigDict(defer_build=True)
)
"""Built behind a start, see later.py."""
