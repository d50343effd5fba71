"""What the gateway does with what clients and the board do: latch, board, battery, the last one out."""

import asyncio

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.errors import (
    CancelledError,
    ClosedError,
    LatchedError,
    NoAnswerError,
    NotSupportedError,
    OutOfRangeError,
    PortLostError,
    PortMissingError,
)
from servodeck.port.reader import SILENCE_S
from servodeck.robot.control import Control
from servodeck.robot.hub import OUTBOX_MESSAGES
from tests.client import Client, driven, gateway_on
from tests.fake_port import FakePort, FakePorts
from tests.samples import (
    BATTERY,
    BATTERY_HEARD,
    BATTERY_REPORT,
    DOWNLOAD,
    ERASE,
    MOVE,
    MOVE_ELSEWHERE,
    MOVE_S,
    RUN,
    STOP,
    STOPS,
    hold_at,
    wire_ms,
)
from tests.virtual_time import at, in_virtual_time, now


@in_virtual_time
async def test_opening_a_port_sends_one_stop_and_nothing_that_moves() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        assert port.packets() == [STOP]
        assert control.latch is False


@in_virtual_time
async def test_stop_latches_for_everyone_until_resume() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S + 0.1)
        await anna.heard(), await bert.heard()
        await control.stop()
        hold = hold_at(2000)
        assert port.packets() == [STOP, MOVE, STOP, hold, STOP, STOP, hold]
        for session in (anna, bert):
            messages = await session.heard()
            assert [message["type"] for message in messages] == ["state", "halted"]
            assert messages[0]["latch"] is True
        for packet in (MOVE, RUN, DOWNLOAD, ERASE):
            with pytest.raises(LatchedError):
                anna.send(packet)
        await anna.send(BATTERY)
        control.resume(THIS_COMPUTER)
        # More is known of the stops once those behind them have left.
        assert [message["type"] for message in await bert.heard()] == ["halted", "state", "resumed"]
        again = hold_at(2000, 100)
        assert port.packets()[7:] == [again, again, BATTERY]
        await anna.send(MOVE)


@in_virtual_time
async def test_an_unknown_board_gets_questions_and_stops_and_nothing_else() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        await anna.heard(), await bert.heard()
        control.choose_family("unknown")
        assert [message["board"] for message in await bert.heard()] == ["unknown"]
        for packet in (MOVE, RUN, DOWNLOAD, ERASE):
            with pytest.raises(NotSupportedError):
                anna.send(packet)
        await anna.send(BATTERY)
        await anna.send(STOP)
        control.choose_family("openarm-new")
        with pytest.raises(NotSupportedError):
            anna.send(BATTERY)
        await anna.send(MOVE)
        assert port.packets() == [STOP, BATTERY, STOP, MOVE]


@in_virtual_time
async def test_what_waits_for_one_board_does_not_go_to_another() -> None:
    async with driven() as (control, port, anna):
        leaving, waiting = anna.send(BATTERY), anna.send(ERASE)
        await asyncio.sleep(0)
        control.choose_family("lsc-6")
        await leaving
        with pytest.raises(CancelledError):
            await waiting
        with pytest.raises(OutOfRangeError):
            control.choose_family("toaster")
        assert port.packets() == [STOP, BATTERY]


@in_virtual_time
async def test_stop_and_stop_again_are_published_once() -> None:
    async with gateway_on() as control:
        anna = Client(control)
        await anna.heard()
        control.stop()
        await control.stop()
        assert [message["type"] for message in await anna.heard()] == ["state", "halted"]


@in_virtual_time
async def test_without_a_port_stop_latches_and_says_so() -> None:
    control = Control(FakePorts(PortMissingError("Unused.")), now, "doc")
    with pytest.raises(ClosedError):
        control.stop()
    assert control.latch is True


@in_virtual_time
async def test_a_lost_port_latches_fails_what_waits_and_refuses_resume_until_it_is_back() -> None:
    first, second = FakePort(), FakePort()
    async with gateway_on(first, second) as control:
        anna = Client(control)
        await anna.heard()
        left = anna.send(MOVE)
        at(now() + 0.005, first.unplug)
        with pytest.raises(PortLostError):
            await left
        [state] = await anna.heard()
        assert (state["latchedBy"], state["port"]["status"], state["port"]["code"]) == (
            "loss",
            "lost",
            "lost",
        )
        with pytest.raises(PortLostError):
            control.resume(THIS_COMPUTER)
        with pytest.raises(PortLostError):
            anna.send(MOVE)
        await asyncio.sleep(1)
        filler, *others = second.packets()
        assert (filler[:2], others) == (b"\x00\xfd", STOPS)  # test_resync.py
        with pytest.raises(LatchedError):
            anna.send(MOVE)
        control.resume(THIS_COMPUTER)
        await anna.send(MOVE)


@in_virtual_time
async def test_a_port_that_never_opened_does_not_latch() -> None:
    control = Control(FakePorts(PortMissingError("There is no such port.")), now, "doc")
    with pytest.raises(PortMissingError):
        await control.use_port("/dev/board")
    assert control.latch is False
    await control.board.link.close()


@in_virtual_time
async def test_a_plain_stop_overtakes_what_waits_and_takes_waiting_runs_with_it() -> None:
    async with driven() as (control, port, anna):
        on_wire = anna.send(BATTERY)
        await asyncio.sleep(0.002)
        run, move = anna.send(RUN), anna.send(MOVE_ELSEWHERE)
        await anna.send(STOP)
        with pytest.raises(CancelledError):
            await run
        await asyncio.gather(on_wire, move)
        assert port.packets()[1:] == [BATTERY, STOP, MOVE_ELSEWHERE]
        assert control.latch is False


@in_virtual_time
async def test_every_client_hears_every_packet_and_the_noise_between() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        await anna.heard(), await bert.heard()
        port.say(b"\x00\x01" + BATTERY_REPORT + b"\x55\x55\x04\x0f")
        await asyncio.sleep(1)
        for session in (anna, bert):
            messages = await session.heard()
            assert [message for message in messages if message["type"] != "battery"] == [
                {"type": "noise", "reason": "garbage", "bytes": "0001"},
                BATTERY_HEARD,
                {"type": "noise", "reason": "truncated", "bytes": "5555040f"},
            ]


@in_virtual_time
async def test_the_battery_is_asked_once_for_all_who_want_to_know() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        at(now() + 0.1, lambda: port.say(BATTERY_REPORT))
        first, second = await asyncio.gather(control.board.battery.read(), control.board.battery.read())
        assert first == second == 7500
        assert port.packets()[1:] == [BATTERY]
        assert control.board.battery.newest
        assert control.board.battery.newest.battery_mv == 7500


@in_virtual_time
async def test_a_board_that_does_not_tell_its_battery_gets_half_a_second() -> None:
    async with gateway_on() as control:
        begun_s = now()
        with pytest.raises(NoAnswerError):
            await control.board.battery.read()
        assert (now() - begun_s) * 1000 == pytest.approx(wire_ms(BATTERY) + 500, abs=1)
        with pytest.raises(NoAnswerError):
            await control.board.battery.read()


@in_virtual_time
async def test_changing_the_port_first_ends_a_group_that_could_not_be_stopped_afterwards() -> None:
    first, second = FakePort(), FakePort()
    async with gateway_on(first, second) as control:
        anna = Client(control)
        await anna.send(RUN)
        await control.use_port("/dev/other")
        assert first.packets() == [STOP, RUN, STOP, STOP, STOP]


@in_virtual_time
async def test_shutting_down_stops_the_robot_within_a_second() -> None:
    async with driven() as (control, port, anna):
        for _ in range(8):
            anna.send(MOVE)
        await asyncio.sleep(0.001)
        begun_s = now()
        ending = asyncio.create_task(control.shut_down())
        await asyncio.sleep(0.05)
        with pytest.raises(LatchedError):
            anna.send(MOVE)
        await ending
        assert now() - begun_s <= 0.9
        assert port.packets()[1:] == [MOVE, STOP, STOP, STOP]
        assert control.board.link.state.status == "closed"
        await control.shut_down()


@in_virtual_time
async def test_a_client_that_does_not_read_is_given_up_and_the_others_lose_nothing() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        deaf, alert = Client(control), Client(control)
        await alert.heard()
        for _ in range(2 * OUTBOX_MESSAGES):
            port.say(BATTERY_REPORT)
            await asyncio.sleep(2 * SILENCE_S)
            assert [message["type"] for message in await alert.heard()] == ["received", "battery"]
        assert deaf.ended.is_set()
        assert not alert.ended.is_set()
