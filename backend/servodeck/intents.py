"""What is asked of the robot, in the same words at every door: WebSocket, HTTP and command line.

Knows shapes; who may ask, and what this robot can do, others judge.
"""

from typing import Annotated

from pydantic import Field

from servodeck.protocol.values import Frame, ServoTarget
from servodeck.schema import Message

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


class PlayIntent(Message):
    """`frames` one after the other, gently to the first one, each at its time by the gateway's clock. `times`
    0: until stopped. Each pass but the first begins with frame `loopFrom`.
    """

    frames: Annotated[list[FrameBody], Field(min_length=1, max_length=PLAYED_FRAMES)]
    times: Annotated[int, Field(ge=0, le=0xFFFF)] = 1
    loop_from: Annotated[int, Field(ge=0, lt=PLAYED_FRAMES)] = 0
