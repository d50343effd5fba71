"""What leaves the port, in which order and when, to the tenth of a millisecond."""

import asyncio
from collections.abc import AsyncIterator, Awaitable
from contextlib import asynccontextmanager
from functools import partial
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.errors import (
    BusyError,
    ClosedError,
    GatewayError,
    LatchedError,
    OutOfRangeError,
    PortLostError,
)
from servodeck.port.wire import QUEUE_PER_OWNER, Hold, Wire, no_hold
from servodeck.protocol.packets import CommandPacket, parse_command
from tests.amount import TIMES
from tests.fake_port import FakeHidPort, FakePort
from tests.samples import BATTERY, GAP_MS, MOVE, MOVE_ELSEWHERE, RUN, STOP, wire_ms
from tests.virtual_time import at, in_virtual_time, now

ANNA, BERT = "anna", "bert"
STOPPED = LatchedError("STOP was pressed before this was sent.")
STOP_MS = wire_ms(STOP)
SLOW_MS = 80


@asynccontextmanager
async def open_wire(port: FakePort, gap_ms: float = GAP_MS) -> AsyncIterator[Wire]:
    wire = Wire(port, gap_s=gap_ms / 1000, now=now, received=lambda _data: None)
    life = asyncio.create_task(wire.run())
    await asyncio.sleep(0)  # until it lives
    try:
        yield wire
    finally:
        life.cancel()
        await asyncio.gather(life, return_exceptions=True)
        port.close()


def sample(data: bytes) -> CommandPacket:
    return CommandPacket(parse_command(data), data)


def once(hold: bytes) -> Hold:
    """All is held by that packet."""
    return lambda held: None if held else sample(hold)


def approx_ms(*times_ms: float) -> object:
    return pytest.approx(list(times_ms), abs=0.1)


@in_virtual_time
async def test_each_packet_leaves_when_the_one_before_has_left_and_the_board_had_its_pause() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        await asyncio.gather(*(wire.send(sample(packet), ANNA) for packet in (MOVE, BATTERY, RUN)))
    second_ms = GAP_MS + wire_ms(MOVE) + GAP_MS
    assert port.packets() == [MOVE, BATTERY, RUN]
    assert port.times_ms() == approx_ms(GAP_MS, second_ms, second_ms + wire_ms(BATTERY) + GAP_MS)


@in_virtual_time
async def test_an_answered_packet_needs_no_pause_behind_it() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        answered_ms = GAP_MS + wire_ms(BATTERY) + 4
        await wire.send(sample(BATTERY), ANNA)
        wire.answered(BATTERY[3] + 1)
        at(answered_ms / 1000, lambda: wire.answered(BATTERY[3]))
        await wire.send(sample(MOVE), ANNA)
    assert port.times_ms() == approx_ms(GAP_MS, answered_ms)


@in_virtual_time
async def test_a_packet_counts_as_sent_when_its_last_bit_has_left() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        await wire.send(sample(MOVE), ANNA)
        assert now() * 1000 == pytest.approx(GAP_MS + wire_ms(MOVE), abs=0.1)


@in_virtual_time
async def test_a_stop_waits_for_the_packet_on_the_wire_and_for_nothing_else() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        waiting = [wire.send(sample(packet), ANNA) for packet in (MOVE, RUN, MOVE_ELSEWHERE)]
        # The first move is on the wire since 10 ms.
        at(0.015, lambda: wire.halt(once(MOVE_ELSEWHERE), STOPPED))
        await waiting[0]
        for left in waiting[1:]:
            with pytest.raises(LatchedError):
                await left
        await asyncio.sleep(1)
    first_ms = GAP_MS + wire_ms(MOVE) + GAP_MS
    hold_after_ms = STOP_MS + GAP_MS
    assert port.packets() == [MOVE, STOP, MOVE_ELSEWHERE, STOP, STOP, MOVE_ELSEWHERE]
    assert port.times_ms() == approx_ms(
        GAP_MS,
        first_ms,
        first_ms + hold_after_ms,
        first_ms + 70,
        first_ms + 140,
        first_ms + 140 + hold_after_ms,
    )


@in_virtual_time
async def test_a_stop_on_an_idle_wire_leaves_at_once() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        await asyncio.sleep(1)
        await wire.halt(no_hold, STOPPED)
        assert port.times_ms() == approx_ms(1000, 1070, 1140)
        assert now() * 1000 == pytest.approx(1140 + STOP_MS, abs=0.1)


@in_virtual_time
async def test_a_stop_keeps_its_distance_even_from_a_board_that_needs_less() -> None:
    port = FakePort()
    async with open_wire(port, gap_ms=2) as wire:
        await wire.send(sample(MOVE), ANNA)
        await wire.halt(no_hold, STOPPED)
    assert port.times_ms()[1] == pytest.approx(port.times_ms()[0] + wire_ms(MOVE) + GAP_MS, abs=0.1)


@in_virtual_time
async def test_nothing_slips_in_between_the_stops_and_the_pose() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        halted = wire.halt(once(MOVE_ELSEWHERE), STOPPED)
        wire.send(sample(BATTERY), ANNA)
        wire.send(sample(STOP), ANNA, urgent=True)
        await halted
        await asyncio.sleep(1)
    assert port.packets() == [STOP, MOVE_ELSEWHERE, STOP, STOP, MOVE_ELSEWHERE, STOP, BATTERY]


@in_virtual_time
async def test_pressing_stop_again_joins_the_sequence_and_brings_the_newer_pose() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        first = wire.halt(once(MOVE), STOPPED)
        at(0.03, lambda: wire.halt(once(MOVE_ELSEWHERE), STOPPED))
        await first
    assert port.packets() == [STOP, MOVE, STOP, STOP, MOVE_ELSEWHERE]


@in_virtual_time
async def test_hammering_stop_never_puts_off_the_pose_and_each_press_is_followed_by_a_stop() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        for press in range(100):
            at(press * 0.05, lambda: wire.halt(once(MOVE), STOPPED))
        await asyncio.sleep(6)
    poses = [at_s for at_s, packet in port.written if packet == MOVE]
    stops = [at_s for at_s, packet in port.written if packet == STOP]
    assert poses[0] < 0.25
    assert all(any(press * 0.05 <= at_s <= press * 0.05 + 0.1 for at_s in stops) for press in range(100))


@in_virtual_time
async def test_after_the_sequence_the_wire_serves_again() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        await wire.halt(no_hold, STOPPED)
        await wire.send(sample(MOVE), ANNA)
        await wire.halt(no_hold, STOPPED)
    assert port.packets() == [STOP, STOP, STOP, MOVE, STOP, STOP, STOP]


@in_virtual_time
async def test_one_client_cannot_fill_the_queue_for_the_others() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        for _ in range(QUEUE_PER_OWNER):
            wire.send(sample(MOVE), ANNA)
        with pytest.raises(BusyError):
            wire.send(sample(MOVE), ANNA)
        await wire.send(sample(BATTERY), BERT)


@in_virtual_time
async def test_a_full_queue_does_not_keep_stops_out_yet_they_are_bounded_too() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        for _ in range(QUEUE_PER_OWNER):
            wire.send(sample(MOVE), ANNA)
        for _ in range(QUEUE_PER_OWNER):
            wire.send(sample(STOP), ANNA, urgent=True)
        with pytest.raises(BusyError):
            wire.send(sample(STOP), ANNA, urgent=True)
        await wire.halt(no_hold, STOPPED)


@in_virtual_time
async def test_what_a_client_left_behind_is_dropped_unless_it_is_on_the_wire() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        on_wire, dropped = wire.send(sample(MOVE), ANNA), wire.send(sample(MOVE), ANNA)
        harmless = wire.send(sample(BATTERY), BERT)
        at(0.012, lambda: wire.purge(lambda job: job.owner is ANNA, ClosedError("gone")))
        await on_wire
        with pytest.raises(ClosedError):
            await dropped
        await harmless
    assert port.packets() == [MOVE, BATTERY]


@in_virtual_time
async def test_a_lost_port_fails_waiting_and_later_packets() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        pending = [wire.send(sample(MOVE), ANNA), wire.send(sample(MOVE), ANNA)]
        at(0.012, port.unplug)
        for left in pending:
            with pytest.raises(PortLostError):
                await left
        with pytest.raises(PortLostError):
            wire.send(sample(MOVE), ANNA)
        with pytest.raises(PortLostError):
            wire.halt(no_hold, STOPPED)


@in_virtual_time
async def test_a_port_that_takes_nothing_is_lost_too() -> None:
    port = FakePort()
    port.refuses_writes = True
    async with open_wire(port) as wire:
        with pytest.raises(PortLostError):
            await wire.halt(no_hold, STOPPED)


class SlowPort(FakePort):
    """A radio: the system takes a packet later than it is given one."""

    def write(self, data: bytes) -> Awaitable[None]:
        super().write(data)
        return asyncio.sleep(SLOW_MS / 1000)


@in_virtual_time
async def test_a_packet_that_the_system_takes_late_has_left_late_and_a_stop_waits_for_it() -> None:
    port = SlowPort()
    async with open_wire(port) as wire:
        left = wire.send(sample(MOVE), ANNA)
        at(0.015, lambda: wire.halt(no_hold, STOPPED))
        await left
        assert now() * 1000 == pytest.approx(GAP_MS + SLOW_MS, abs=0.1)
        await asyncio.sleep(1)
    assert port.packets() == [MOVE, STOP, STOP, STOP]
    assert port.times_ms()[1] == pytest.approx(GAP_MS + SLOW_MS + GAP_MS, abs=0.1)


@in_virtual_time
async def test_closing_fails_all_that_waits_as_closed() -> None:
    port = FakePort()
    async with open_wire(port) as wire:
        left = wire.send(sample(MOVE), ANNA)
    with pytest.raises(ClosedError):
        await left


@in_virtual_time
async def test_bytes_of_the_board_come_through() -> None:
    port, received = FakePort(), bytearray()
    wire = Wire(port, gap_s=0, now=now, received=received.extend)
    life = asyncio.create_task(wire.run())
    at(0.1, lambda: port.say(b"\x55\x55"))
    await asyncio.sleep(1)
    life.cancel()
    await asyncio.gather(life, return_exceptions=True)
    port.close()
    assert received == b"\x55\x55"


asks = st.lists(st.tuples(st.integers(0, 400), st.sampled_from(["move", "battery", "stop"])), max_size=30)


@settings(max_examples=60 * TIMES)
@given(asks)
def test_in_any_order_packets_are_spaced_and_stops_purge(
    asked: list[tuple[int, str]],
) -> None:
    written = run_script(asked)
    for (before_s, packet), (next_s, _) in pairwise(written):
        assert (next_s - before_s) * 1000 >= wire_ms(packet) + GAP_MS - 0.01
    for press_ms, kind in asked:
        if kind == "stop":
            first_s = min(at_s for at_s, packet in written if packet == STOP and at_s * 1000 >= press_ms)
            assert first_s * 1000 <= press_ms + wire_ms(MOVE) + 2 * GAP_MS + STOP_MS + 70


@in_virtual_time
async def play(asked: list[tuple[int, str]], port: FakePort) -> None:
    def ask(wire: Wire, kind: str) -> None:
        try:
            if kind == "stop":
                wire.halt(no_hold, STOPPED)
            else:
                wire.send(sample(MOVE if kind == "move" else BATTERY), ANNA)
        except GatewayError:
            pass

    async with open_wire(port) as wire:
        for at_ms, kind in asked:
            at(at_ms / 1000, partial(ask, wire, kind))
        await asyncio.sleep(3)


def run_script(asked: list[tuple[int, str]]) -> list[tuple[float, bytes]]:
    port = FakePort()
    play(asked, port)
    return port.written


@in_virtual_time
async def test_a_hold_of_several_packets_leaves_whole_after_the_first_stop_and_the_last() -> None:
    port = FakePort()
    parts = [MOVE, MOVE_ELSEWHERE]
    async with open_wire(port) as wire:
        await wire.halt(lambda held: sample(parts[len(held)]) if len(held) < len(parts) else None, STOPPED)
    assert port.packets() == [STOP, *parts, STOP, STOP, *parts]


@in_virtual_time
async def test_a_packet_that_the_port_cannot_carry_is_refused_and_never_split() -> None:
    port = FakeHidPort()
    async with open_wire(port) as wire:
        with pytest.raises(OutOfRangeError, match="65 bytes, this port carries 64"):
            wire.send(sample(bytes(65)), ANNA)
        await wire.send(sample(bytes(64)), ANNA)
    assert port.packets() == [bytes(64)]


@in_virtual_time
async def test_short_packets_are_as_far_apart_as_the_port_needs() -> None:
    port = FakeHidPort()
    async with open_wire(port, gap_ms=2) as wire:
        await asyncio.gather(*(wire.send(sample(BATTERY), ANNA) for _ in range(3)))
    assert port.times_ms() == approx_ms(GAP_MS, GAP_MS + 20 + GAP_MS, 2 * (GAP_MS + 20) + GAP_MS)


@in_virtual_time
async def test_a_packet_that_is_taken_late_keeps_the_next_one_back() -> None:
    port = FakeHidPort()
    port.takes_s = 0.255
    async with open_wire(port) as wire:
        await asyncio.gather(*(wire.send(sample(BATTERY), ANNA) for _ in range(2)))
    assert port.times_ms() == approx_ms(GAP_MS, GAP_MS + 255 + GAP_MS)
