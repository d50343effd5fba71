"""STOP of somebody who does not drive, at any instant: none is missed, nothing moves behind it (F21)."""

import asyncio
import random

import pytest

from servodeck.callers import THIS_COMPUTER, Caller
from servodeck.clients import take
from servodeck.errors import LatchedError
from servodeck.jobs import Group
from servodeck.messages import StopMessage
from servodeck.values import Frame, ServoTarget
from tests.amount import named, seeds
from tests.client import Client, gateway_on
from tests.samples import DOWNLOAD, MOVE, MOVE_ELSEWHERE, RUN, STOP, wire_ms
from tests.test_download import AnsweringPort
from tests.virtual_time import in_virtual_time, now

GUEST = Caller("guest", "Bert", "viewer")
STATES = {
    "idle": [],
    "one move": [MOVE],
    "drag": [MOVE, MOVE_ELSEWHERE] * 4,
    "group": [RUN],
    "group behind moves": [MOVE, MOVE_ELSEWHERE, RUN],
}
MOTION = {3, 6, 8, 25}
DOWNLOADING = "download"
LONG = Group(10, "Wave", [Frame(1000, (ServoTarget(1, 1500),))] * 200)
LONGEST_PACKET_S = wire_ms(DOWNLOAD) / 1000
GAP_S = 0.010


@pytest.mark.parametrize("state", [*STATES, DOWNLOADING])
@in_virtual_time
async def test_a_viewer_stops_it(state: str) -> None:
    for seed in seeds(50):
        with named("test_stop_by_anyone.py", seed, state):
            await stop_at_random(STATES.get(state, []), random.Random(seed), state == DOWNLOADING)


async def stop_at_random(packets: list[bytes], chance: random.Random, is_download: bool) -> None:
    port = AnsweringPort([[chance.uniform(1, 300)] for _ in LONG.frames])
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control, GUEST)
        waiting = [anna.send(packet) for packet in packets]
        if is_download:
            control.download(LONG, "Anna", lambda: None)
        await asyncio.sleep(chance.uniform(0, 0.25))
        pressed_s, before = now(), len(port.written)
        take(StopMessage(type="stop", hold=None), bert, control)
        with pytest.raises(LatchedError):
            anna.send(MOVE)
        await asyncio.sleep(0.6)
        behind = port.written[before:]
        assert [packet for _, packet in behind].count(STOP) == 3
        assert behind[0][1] == STOP
        assert behind[0][0] - pressed_s <= LONGEST_PACKET_S + GAP_S + 0.001
        # Only the pose that the stop itself holds.
        assert [packet for _, packet in behind if packet[3] in MOTION - {3}] == []
        assert all(left.done() for left in waiting)
        assert [job.status for job in [control.board.jobs.latest] if job] == ["failed"] * is_download
        control.resume(THIS_COMPUTER)
        await anna.send(MOVE)
        assert port.packets()[-1] == MOVE
        for left in waiting:
            left.exception()
