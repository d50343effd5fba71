"""The gateway's loop of a download against shared/protocol/vectors/downloads.json: when a board says what,
and each packet that follows from it. The page's session (shared/src/session/downloads.test.ts) runs the same
file.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import pytest

from servodeck.board.parts import Group, made_of, packets_of
from servodeck.callers import Caller
from servodeck.driving.control import Control
from servodeck.protocol.timings import wire_s
from servodeck.protocol.values import Frame, ServoTarget
from servodeck.told import JobState
from tests.client import ANNA, Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import STOP
from tests.vectors import load_vectors
from tests.virtual_time import at, in_virtual_time, now

VECTORS = load_vectors("downloads")
STORED = bytes.fromhex("55550219")
GUEST = Caller("guest", "Bert", "viewer")


class AnsweringPort(FakePort):
    """Says "stored" as it is told: a list for each packet, of times after the packet's last bit."""

    def __init__(self, answers_ms: Iterable[Sequence[float]] = ()) -> None:
        super().__init__()
        self._answers_ms = iter(answers_ms)

    def write(self, data: bytes) -> None:
        super().write(data)
        if data != STOP:
            for after_ms in next(self._answers_ms, ()):
                at(now() + wire_s(len(data)) + after_ms / 1000, lambda: self.say(STORED))


async def ended(control: Control, job: JobState) -> JobState:
    """When it has; somebody looks on."""
    bert = Client(control, GUEST)
    while (state := control.board.jobs.find(job.id)).status == "running":
        await bert.next()
    control.leave(bert)
    return state


def begin(control: Control, *groups: Group) -> JobState:
    """By somebody who may."""
    board = control.board.taken_for
    parts = [made_of(group, list(packets_of(group, board)), board) for group in groups]
    return control.download(parts, ANNA, lambda: None)


def groups_of(scenario: dict[str, Any]) -> list[Group]:
    return [Group(one["slot"], "", frames_of(one)) for one in (scenario, *scenario.get("then", ()))]


def frames_of(group: dict[str, Any]) -> list[Frame]:
    return [
        Frame(one["durationMs"], tuple(ServoTarget(*target) for target in one["targets"]))
        for one in group["frames"]
    ]


@pytest.mark.parametrize("scenario", VECTORS["scenarios"], ids=[one["name"] for one in VECTORS["scenarios"]])
@in_virtual_time
async def test_a_download_in_which(scenario: dict[str, Any]) -> None:
    port = AnsweringPort(scenario["answersMs"])
    async with gateway_on(port) as control:
        begun_s = now()
        job = begin(control, *groups_of(scenario))
        if "cancelAtMs" in scenario:
            at(begun_s + scenario["cancelAtMs"] / 1000, lambda: control.board.jobs.cancel(job.id))
        end = await ended(control, job)
        took_ms = (now() - begun_s) * 1000
        times_ms, indexes = zip(*scenario["sent"], strict=True)
        sent = port.written[1:]
        assert [packet.hex() for _, packet in sent] == [scenario["packets"][index] for index in indexes]
        assert [(at_s - begun_s) * 1000 for at_s, _ in sent] == pytest.approx(times_ms, abs=0.01)
        assert took_ms == pytest.approx(scenario["tookMs"], abs=0.01)
        assert (end.code or end.status) == scenario["outcome"]
        broken = [] if end.status == "done" else scenario.get("broken", [scenario["slot"]])
        assert control.board.jobs.broken(control.board.link.place) == broken
