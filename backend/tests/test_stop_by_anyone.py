"""STOP of somebody who does not drive, at any instant: none is missed, nothing moves behind it (F21)."""

import asyncio
import random

import pytest

from servodeck.callers import Caller
from servodeck.clients import take
from servodeck.errors import LatchedError
from servodeck.messages import StopMessage
from tests.amount import named, seeds
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import DOWNLOAD, MOVE, MOVE_ELSEWHERE, RUN, STOP, wire_ms
from tests.virtual_time import in_virtual_time, now

GUEST = Caller("guest", "Bert", "viewer")
STATES = {
    "idle": [],
    "one move": [MOVE],
    "drag": [MOVE, MOVE_ELSEWHERE] * 4,
    "group": [RUN],
    "download": [DOWNLOAD] * 8,
    "group behind moves": [MOVE, MOVE_ELSEWHERE, RUN],
}
MOTION = {3, 6, 8, 25}
LONGEST_PACKET_S = wire_ms(DOWNLOAD) / 1000
GAP_S = 0.010


@pytest.mark.parametrize("state", STATES)
@in_virtual_time
async def test_a_viewer_stops_it(state: str) -> None:
    for seed in seeds(50):
        with named("test_stop_by_anyone.py", seed, state):
            await stop_at_random(STATES[state], random.Random(seed))


async def stop_at_random(packets: list[bytes], chance: random.Random) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control, GUEST)
        waiting = [anna.send(packet) for packet in packets]
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
        control.resume()
        await anna.send(MOVE)
        assert port.packets()[-1] == MOVE
        for left in waiting:
            left.exception()
