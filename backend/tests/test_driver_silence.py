"""A driver who falls silent, freezes or leaves: what is dropped, what is stopped, when the lease is free."""

import asyncio

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.errors import CancelledError, ExpiredError, MovingError, NotDrivingError
from servodeck.protocol.values import Frame, ServoTarget
from servodeck.robot.board.download import Group
from tests.client import Client, driven, gateway_on
from tests.downloading import AnsweringPort, begin, ended
from tests.samples import BATTERY, MOVE, MOVE_ELSEWHERE, MOVE_S, RUN, STOP, STOPS, is_held_ahead
from tests.virtual_time import hold_up, in_virtual_time, now

TWO_FRAMES = Group(4, "Wave", [Frame(500, (ServoTarget(1, position),)) for position in (1500, 1600)])


@in_virtual_time
async def test_a_tab_that_froze_and_wakes_moves_nothing() -> None:
    async with driven(BATTERY) as (control, port, anna):
        anna.beats = False
        await asyncio.sleep(0.8)
        with pytest.raises(ExpiredError):
            anna.send(MOVE)
        await asyncio.sleep(60)
        anna.beats = True
        assert control.driving.driver is None
        with pytest.raises(NotDrivingError):
            control.requests.send(anna, MOVE.hex(), anna.nonce)
        control.driving.act(anna, "request")
        await anna.send(MOVE)
        assert port.packets() == [STOP, BATTERY, MOVE]


@in_virtual_time
async def test_what_waits_too_long_for_the_wire_is_not_sent() -> None:
    async with driven(MOVE) as (_, port, anna):
        anna.beats, begun_s = False, now()
        long_move = bytes.fromhex("5555650320e803" + "".join(f"{servo:02x}dc05" for servo in range(1, 33)))
        waiting = [anna.send(long_move) for _ in range(6)]
        outcomes = await asyncio.gather(*waiting, return_exceptions=True)
        assert [type(outcome) for outcome in outcomes[:4]] == [type(None)] * 4
        assert isinstance(outcomes[-1], (ExpiredError, CancelledError))
        last_s = max(at_s for at_s, packet in port.written if packet == long_move)
        assert last_s - begun_s <= 0.5 + 0.05


@in_virtual_time
async def test_a_driver_who_falls_silent_in_a_move_is_stopped_and_held_in_time() -> None:
    async with driven(MOVE) as (control, port, anna):
        bert = Client(control)
        await asyncio.sleep(MOVE_S + 0.1)
        await anna.send(MOVE_ELSEWHERE)
        left_s = now()
        anna.beats = False
        await bert.heard()
        await asyncio.sleep(0.85)
        sent = port.written[3:]
        assert sent[0][0] - left_s <= 0.75 + 0.001
        went = (sent[1][0] - left_s) / MOVE_S
        assert sent[0][1] == STOP
        assert is_held_ahead(sent[1][1], 2000 - 500 * went, 1500)
        [state, *_] = await bert.heard()
        assert (state["latch"], state["latchedBy"]) == (True, "silence")
        await asyncio.sleep(0.3)
        assert [packet for _, packet in port.written[3:]].count(STOP) == 3


@in_virtual_time
async def test_a_gateway_that_was_held_up_itself_first_sends_its_driver_a_tick() -> None:
    for is_there in (True, False):
        async with driven(RUN) as (control, port, anna):
            anna.beats = is_there
            hold_up(2.5)
            await asyncio.sleep(0.4)
            assert control.latch is not is_there
            assert port.packets() == [STOP, RUN, *([] if is_there else STOPS)]


@in_virtual_time
async def test_a_gateway_that_is_held_up_again_and_again_stops_for_a_lost_driver_all_the_same() -> None:
    async with driven(RUN) as (control, _, anna):
        anna.beats = False
        hold_up(2.5)
        for _ in range(3):
            await asyncio.sleep(0.01)
            hold_up(0.3)
        await asyncio.sleep(0.01)
        assert control.latch is True


@in_virtual_time
async def test_a_group_outlives_its_drivers_silence_by_two_seconds_at_most() -> None:
    async with driven(RUN) as (control, port, anna):
        anna.beats = False
        begun_s = now()
        await asyncio.sleep(1.7)
        assert port.packets() == [STOP, RUN]
        await asyncio.sleep(0.8)
        assert port.packets() == [STOP, RUN, *STOPS]
        assert port.written[2][0] - begun_s <= 2.0 + 0.001
        assert control.latch is True


@in_virtual_time
async def test_a_silent_driver_of_a_robot_at_rest_stops_nothing_and_loses_the_lease_after_ten_seconds() -> (
    None
):
    async with driven() as (control, port, anna):
        bert = Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S + 0.1)
        anna.beats = False
        await asyncio.sleep(9)
        assert bert.lease["driver"] == "This computer"
        await asyncio.sleep(1.1)
        assert bert.lease["driver"] is None
        assert (port.packets(), control.latch) == ([STOP, MOVE], False)


@in_virtual_time
async def test_a_driver_who_leaves_is_lost_at_once_and_what_moves_stops() -> None:
    for begun in (MOVE, RUN):
        async with driven(begun) as (control, port, anna):
            bert = Client(control)
            control.leave(anna)
            await asyncio.sleep(0.5)
            assert port.packets() == [STOP, begun, *STOPS]
            assert control.latch is True
            assert bert.lease["driver"] is None


@in_virtual_time
async def test_a_driver_who_leaves_while_the_last_frame_of_an_unknown_group_may_continue_stops_it() -> None:
    for goes_after_s, is_stopped in ((5, True), (29, True), (31, False)):
        async with driven(RUN, STOP) as (control, port, anna):
            await asyncio.sleep(goes_after_s)
            control.leave(anna)
            await asyncio.sleep(1)
            assert port.packets() == [STOP, RUN, STOP, *(STOPS if is_stopped else [])]
            assert control.latch is is_stopped


@in_virtual_time
@pytest.mark.parametrize("how", ["falls silent", "leaves"])
async def test_a_download_right_behind_an_unknown_group_is_refused_and_puts_off_no_stop(how: str) -> None:
    async with driven(RUN, STOP) as (control, port, anna):
        with pytest.raises(MovingError, match=r"moves for up to 30\.0 s more"):
            begin(control, TWO_FRAMES)
        if how == "leaves":
            control.leave(anna)
        anna.beats = False
        await asyncio.sleep(2.2)
        assert (control.latch, port.packets()) == (True, [STOP, RUN, STOP, *STOPS])


@in_virtual_time
async def test_a_download_behind_the_last_frame_of_an_unknown_group_is_stored_without_its_driver() -> None:
    port = AnsweringPort([[180], [46]])
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(RUN)
        await anna.send(STOP)
        await asyncio.sleep(30.1)
        job = begin(control, TWO_FRAMES)
        control.leave(anna)
        assert (await ended(control, job)).status == "done"
        await asyncio.sleep(2.1)
        assert (control.latch, len(port.packets())) == (False, 5)


@in_virtual_time
async def test_who_has_resumed_answers_for_the_last_frame_of_a_group_that_was_stopped_before() -> None:
    async with driven(RUN) as (control, port, anna):
        await control.stop()
        await asyncio.sleep(1)
        control.resume(THIS_COMPUTER, anna)
        await asyncio.sleep(1)
        control.leave(anna)
        await asyncio.sleep(1)
        assert (port.packets(), control.latch) == ([STOP, RUN, *STOPS], False)
        control.stop()
        await asyncio.sleep(1)
        assert control.unheld is not None
        assert control.unheld.servos is None
        assert control.unheld.for_ms is not None
        assert 26_000 < control.unheld.for_ms < 28_000


@in_virtual_time
async def test_a_group_that_is_run_behind_a_resume_is_stopped_for_a_driver_who_leaves() -> None:
    async with driven(RUN) as (control, port, anna):
        await control.stop()
        control.resume(THIS_COMPUTER, anna)
        anna.send(RUN)
        await asyncio.sleep(1)
        anna.send(STOP)
        await asyncio.sleep(1)
        control.leave(anna)
        await asyncio.sleep(1)
        assert (port.packets(), control.latch) == ([STOP, RUN, *STOPS, RUN, STOP, *STOPS], True)


@in_virtual_time
async def test_a_driver_who_leaves_a_robot_at_rest_stops_nothing() -> None:
    async with driven(RUN, STOP, MOVE) as (control, port, anna):
        await asyncio.sleep(MOVE_S + 0.1)
        control.leave(anna)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, RUN, STOP, MOVE]
        assert control.latch is False


@in_virtual_time
async def test_a_driver_who_leaves_after_the_group_has_ended_stops_nothing() -> None:
    async with driven(RUN) as (control, port, anna):
        await asyncio.sleep(1)
        port.say(STOP)  # from this board: finished by itself
        await asyncio.sleep(0.01)
        control.leave(anna)
        await asyncio.sleep(1)
        assert (port.packets(), control.latch) == ([STOP, RUN], False)


@in_virtual_time
async def test_what_a_leaving_client_had_waiting_is_never_sent() -> None:
    async with driven() as (control, port, anna):
        for _ in range(5):
            anna.send(MOVE)
        await asyncio.sleep(0.005)
        control.leave(anna)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, MOVE, *STOPS]
