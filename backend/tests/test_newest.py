"""Moves that a newer one takes the place of while they wait: one of a driver at most, in order."""

import asyncio
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.driving.lease import COMMAND_S
from servodeck.errors import ExpiredError, GatewayError, LatchedError, MalformedError
from servodeck.messages import SendMessage
from servodeck.port.wire import QUEUE_PER_OWNER, Left, no_hold
from servodeck.web.clients import take
from tests.amount import TIMES
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, GAP_MS, MOVE, MOVE_ELSEWHERE, RUN, STOP, wire_ms
from tests.test_wire import ANNA, BERT, STOPPED, open_wire
from tests.virtual_time import at, in_virtual_time, now


def move_to(position: int) -> bytes:
    return MOVE[:8] + position.to_bytes(2, "little")


@in_virtual_time
async def test_the_newest_leaves_at_the_wires_own_pace_however_many_are_said() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        for number in range(100):
            wire.send(move_to(number), ANNA, newest=True)
            await asyncio.sleep(0.005)
        await asyncio.sleep(0.1)
    cycle_ms = wire_ms(MOVE) + GAP_MS
    times_ms = port.times_ms()
    assert times_ms == pytest.approx([GAP_MS + cycle_ms * n for n in range(len(times_ms))], abs=0.1)
    ages_ms = [at_ms - 5 * packet[8] for at_ms, packet in zip(times_ms, port.packets(), strict=True)]
    assert max(ages_ms[:-1]) <= 5.1
    assert port.packets()[-1] == move_to(99)


@in_virtual_time
async def test_it_keeps_the_place_in_front_of_others_and_stays_behind_what_its_own_sender_said() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        wire.send(move_to(1), ANNA, newest=True)
        wire.send(BATTERY, BERT)
        wire.send(move_to(2), ANNA, newest=True)
        await asyncio.sleep(0.2)
        wire.send(move_to(3), ANNA, newest=True)
        wire.send(RUN, ANNA)
        wire.send(move_to(4), ANNA, newest=True)
        await asyncio.sleep(0.2)
    assert port.packets() == [move_to(2), BATTERY, RUN, move_to(4)]


@in_virtual_time
async def test_each_is_answered_once_and_nobody_elses_gives_way() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        await anna.heard()
        for number, position in enumerate((1000, 1001, 1002)):
            packet = move_to(position).hex()
            message = SendMessage(type="send", id=number, packet=packet, nonce=anna.nonce, newest=True)
            take(message, anna, control)
        await asyncio.sleep(0.1)
        answers = [(told["type"], told["id"]) for told in await anna.heard()]
        assert answers == [("replaced", 0), ("replaced", 1), ("sent", 2)]
        assert port.packets() == [STOP, move_to(1002)]
        with pytest.raises(MalformedError):
            control.send(anna, RUN.hex(), anna.nonce, newest=True)


@in_virtual_time
async def test_a_stop_of_anybody_drops_it_and_what_comes_behind_waits_for_resume() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(MOVE)
        under_way = anna.send(MOVE_ELSEWHERE)
        waiting = control.send(anna, MOVE.hex(), anna.nonce, newest=True)
        before = len(port.written)
        control.stop(None)
        with pytest.raises(LatchedError):
            await waiting
        with pytest.raises(LatchedError):
            control.send(anna, MOVE.hex(), anna.nonce, newest=True)
        await asyncio.sleep(0.5)
        assert port.packets()[before:].count(MOVE) == 0
        assert isinstance(under_way.exception(), LatchedError)


@in_virtual_time
async def test_one_that_waited_too_long_does_not_leave() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        begun_s = now()
        await anna.send(MOVE)
        nonce, anna.beats = anna.nonce, False
        await asyncio.sleep(begun_s + COMMAND_S - 0.05 - now())
        questions = [control.send(anna, BATTERY.hex()) for _ in range(QUEUE_PER_OWNER - 1)]
        waiting = control.send(anna, MOVE_ELSEWHERE.hex(), nonce, newest=True)
        with pytest.raises(ExpiredError):
            await waiting
        assert all(left.done() for left in questions)
        assert MOVE_ELSEWHERE not in port.packets()


KINDS = ["newest", "newest", "newest", "move", "battery", "stop"]
asks = st.lists(st.tuples(st.integers(0, 300), st.sampled_from(KINDS)), min_size=1, max_size=40)


@settings(max_examples=60 * TIMES)
@given(asks)
def test_whatever_is_asked_order_stays_and_nothing_passes_a_stop(asked: list[tuple[int, str]]) -> None:
    check(sorted(asked))


@in_virtual_time
async def check(asked: list[tuple[int, str]]) -> None:
    port = FakePort()
    said: list[tuple[int, bytes, Left]] = []

    def ask(number: int, kind: str) -> None:
        if kind == "stop":
            wire.halt(no_hold, STOPPED)
            return
        packet = BATTERY if kind == "battery" else move_to(number)
        owner = BERT if kind == "battery" else ANNA
        try:
            said.append((number, packet, wire.send(packet, owner, newest=kind == "newest")))
        except GatewayError:
            assert kind != "newest" or len(said) > 8

    async with open_wire(port) as wire:
        for number, (at_ms, kind) in enumerate(asked):
            at(at_ms / 1000 + number / 1e6, partial(ask, number, kind))  # in this order at one instant, too
        await asyncio.sleep(5)
    assert all(left.done() for _, _, left in said)
    left_now = [packet for _, packet, left in said if not left.cancelled() and left.exception() is None]
    assert sorted(left_now) == sorted(packet for packet in port.packets() if packet != STOP)
    moves = [packet for packet in port.packets() if packet not in (STOP, BATTERY)]
    assert moves == [packet for packet in left_now if packet != BATTERY]
    stops = [number for number, (_, kind) in enumerate(asked) if kind == "stop"]
    first_stop = next((place for place, packet in enumerate(port.packets()) if packet == STOP), None)
    if stops and first_stop is not None:
        earlier = {move_to(number) for number in range(stops[0])}
        assert not earlier & set(port.packets()[first_stop:])
    newest = [number for number, _, _ in said if asked[number][1] == "newest"]
    if newest and newest[-1] > (stops[-1] if stops else -1):
        assert move_to(newest[-1]) in moves  # the last word of a gesture is always heard
