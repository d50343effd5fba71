"""STOP of a client that does not drive, at any instant: none is missed, nothing moves behind it (F21)."""

import asyncio
import random

import pytest

from servodeck.api.intake import Intake
from servodeck.api.websocket import intake_of, take, take_text
from servodeck.callers import THIS_COMPUTER, Caller
from servodeck.errors import GatewayError, LatchedError, MovingError, PortLostError
from servodeck.intents import StopMessage
from servodeck.protocol.timings import wire_s
from servodeck.protocol.values import Frame, ServoTarget
from servodeck.robot.board.download import Group
from tests.amount import named, seeds
from tests.client import Client, gateway_on
from tests.downloading import AnsweringPort, begin
from tests.fake_port import FakePort
from tests.samples import BATTERY, DOWNLOAD, MOVE, MOVE_ELSEWHERE, RUN, STOP, wire_ms
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
FLOODERS = 10
SAID_EACH = 300
TRY_S = 0.6
# Of a port that is back: as many stops as a board can miss, then three.
OPENING_S = 0.8
"""From before a port that was lost is opened again until well behind it."""
LONGEST_PACKET_S = wire_ms(DOWNLOAD) / 1000
GAP_S = 0.010


@pytest.mark.parametrize("state", [*STATES, DOWNLOADING])
@in_virtual_time
async def test_a_viewer_stops_it(state: str) -> None:
    for seed in seeds(50):
        with named("test_stop_by_anyone.py", seed, state):
            await stop_at_random(STATES.get(state, []), random.Random(seed), state == DOWNLOADING)


@pytest.mark.exhaustive
@in_virtual_time
async def test_a_viewer_who_floods_with_others_stops_it() -> None:
    for seed in seeds(50):
        with named("test_stop_by_anyone.py", seed, "flood"):
            await stop_in_flood(random.Random(seed))


@in_virtual_time
async def test_a_viewer_stops_it_while_the_port_comes_back() -> None:
    for seed in seeds(50):
        with named("test_stop_by_anyone.py", seed, "reconnect"):
            await stop_at_reconnect(random.Random(seed))


async def stop_in_flood(chance: random.Random) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control, GUEST)
        moving = [anna.send(packet) for packet in STATES["drag"]]
        flooders = [bert, *(Client(control, GUEST) for _ in range(FLOODERS - 1))]
        intakes = [intake_of(client, control) for client in flooders]
        shouting = [
            asyncio.create_task(shout(client, intake, chance.uniform(0, 0.2)))
            for client, intake in zip(flooders, intakes, strict=True)
        ]
        await asyncio.sleep(chance.uniform(0, 0.25))
        pressed_s, before = now(), len(port.written)
        take_text('{"type":"stop"}', bert, intakes[0])
        await asyncio.sleep(0.6)
        first_s, first = port.written[before]
        assert first == STOP
        assert first_s - pressed_s <= LONGEST_PACKET_S + GAP_S + 0.001
        assert [packet for _, packet in port.written[before:] if packet[3] in MOTION] == []
        await asyncio.gather(*shouting)
        for intake in intakes:
            intake.close()
        for left in moving:
            left.exception()


async def shout(client: Client, intake: Intake, from_s: float) -> None:
    """Questions, which every client may send, far more than the rate and the wire take."""
    await asyncio.sleep(from_s)
    for number in range(SAID_EACH):
        take_text(f'{{"type":"packet","id":{number},"bytes":"{BATTERY.hex()}","nonce":null}}', client, intake)


FILLER_HEAD = b"\x00\xfd"


def stops_of(port: FakePort) -> list[float]:
    """When each began to leave, also of those in a row."""
    return [
        at_s + index * wire_s(len(STOP))
        for at_s, data in port.everything()
        if data.startswith(STOP)
        for index in range(len(data) // len(STOP))
    ]


async def stop_at_reconnect(chance: random.Random) -> None:
    first, second = FakePort(), FakePort()
    async with gateway_on(first, second) as control:
        anna, bert = Client(control), Client(control, GUEST)
        moving = [anna.send(packet) for packet in STATES["drag"]]
        await asyncio.sleep(chance.uniform(0, 0.1))
        first.unplug()
        await asyncio.sleep(chance.uniform(0, TRY_S))
        pressed_s, before = now(), len(first.written)
        take(StopMessage(type="stop"), bert, control)
        with pytest.raises((LatchedError, MovingError, PortLostError)):
            anna.send(MOVE)
        await asyncio.sleep(TRY_S + OPENING_S)
        stops_s = [at_s for at_s in stops_of(second) if at_s >= pressed_s]
        first_packet, *others = second.packets()
        assert first_packet == STOP or first_packet[:2] == FILLER_HEAD  # test_resync.py
        assert set(others) <= {STOP}
        assert not any(packet[3] in MOTION for _, packet in first.written[before:])
        # Pressed once it was back: three of its own.
        is_back = second.everything()[0][0] < pressed_s
        assert len(stops_s) >= (3 if is_back else 1)
        assert not is_back or stops_s[0] - pressed_s <= LONGEST_PACKET_S + GAP_S + 0.001
        control.resume(THIS_COMPUTER)
        await anna.send(MOVE)
        assert second.packets()[-1] == MOVE
        for left in moving:
            assert isinstance(left.exception(), GatewayError | None)


async def stop_at_random(packets: list[bytes], chance: random.Random, is_download: bool) -> None:
    port = AnsweringPort([[chance.uniform(1, 300)] for _ in LONG.frames])
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control, GUEST)
        waiting = [anna.send(packet) for packet in packets]
        if is_download:
            begin(control, LONG)
        await asyncio.sleep(chance.uniform(0, 0.25))
        pressed_s, before = now(), len(port.written)
        take(StopMessage(type="stop"), bert, control)
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
