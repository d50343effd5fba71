"""A download at the gateway, for tests: a board that answers it, its begin and its end."""

from collections.abc import Iterable, Sequence

from servodeck.callers import Caller
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.packets import DOWNLOAD
from servodeck.protocol.timings import wire_s
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.control import Control
from servodeck.snapshots import JobState
from tests.client import ANNA, Client
from tests.fake_port import FakePort
from tests.virtual_time import at, now

STORED = bytes.fromhex("55550219")
GUEST = Caller("guest", "Bert", "viewer")


class AnsweringPort(FakePort):
    """Acknowledges frames at the given times: a list for each packet, after the packet's last bit."""

    def __init__(self, answers_ms: Iterable[Sequence[float]] = ()) -> None:
        super().__init__()
        self._answers_ms = iter(answers_ms)

    def write(self, data: bytes) -> None:
        super().write(data)
        if data[COMMAND_AT] == DOWNLOAD:
            for after_ms in next(self._answers_ms, ()):
                at(now() + wire_s(len(data)) + after_ms / 1000, lambda: self.say(STORED))


async def ended(control: Control, job: JobState) -> JobState:
    """Its state once it has ended; a viewer is connected."""
    bert = Client(control, GUEST)
    while (state := control.board.jobs.find(job.id)).status == "running":
        await bert.next()
    control.leave(bert)
    return state


def begin(control: Control, *groups: Group) -> JobState:
    """By a caller that may."""
    board = control.board.family_id
    parts = [made_of(group, list(packets_of(group, board)), board) for group in groups]
    return control.requests.download(parts, ANNA, lambda: None)
