"""Who may move the robot, from the client's message to the bytes on the wire."""

import asyncio

import pytest

from servodeck.callers import Caller
from servodeck.clients import take
from servodeck.errors import (
    BusyError,
    CancelledError,
    ExpiredError,
    ForbiddenError,
    NotDrivingError,
)
from servodeck.hub import Seat
from servodeck.messages import GiveMessage, ResumeMessage, StopMessage
from servodeck.wire import Left
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, MOVE, MOVE_ELSEWHERE, RUN, STOP
from tests.virtual_time import hold_up, in_virtual_time, now

STOPS = [STOP, STOP, STOP]
# MOVE takes servo 1 to 2000 and MOVE_ELSEWHERE to 1500, in a second each.
MOVE_S = 1.0
GUEST = Caller("guest", "Bert", "viewer")
PUPIL = Caller("pupil", "Anna", "driver")
CARL = Caller("carl", "Carl", "driver")


def hold_at(position: int, duration_ms: int = 20) -> bytes:
    return (
        bytes.fromhex("5555080301")
        + duration_ms.to_bytes(2, "little")
        + b"\x01"
        + position.to_bytes(2, "little")
    )


@in_virtual_time
async def test_the_first_who_wants_to_move_drives_and_everybody_hears_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control, PUPIL), Client(control)
        [welcome, *_] = await bert.heard()
        assert welcome["lease"]["driver"] is None
        await anna.send(MOVE)
        assert anna.lease == {
            "driver": "Anna",
            "drives": True,
            "asker": None,
            "asks": False,
            "answerInMs": None,
            "mayDrive": True,
            "mayTake": False,
            "givenBy": None,
            "candidates": [{"id": "local", "name": "This computer"}],
        }
        assert (bert.lease["driver"], bert.lease["drives"], bert.lease["mayTake"]) == ("Anna", False, True)
        with pytest.raises(NotDrivingError):
            bert.send(MOVE)
        await bert.send(BATTERY)
        await bert.send(STOP)
        assert port.packets() == [STOP, MOVE, BATTERY, STOP]


@in_virtual_time
async def test_the_driver_hands_it_to_somebody_present_who_reads_from_whom_and_what_moves_stops() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, carl, bert = Client(control, PUPIL), Client(control, CARL), Client(control, GUEST)
        await anna.send(MOVE)
        assert anna.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        assert carl.lease["candidates"] == bert.lease["candidates"] == []
        for nobody in ("bert", "guest", "elsewhere"):
            take(GiveMessage(type="give", to=nobody), anna, control)
            assert anna.lease["drives"] is True
        take(GiveMessage(type="give", to="carl"), anna, control)
        assert (carl.lease["drives"], carl.lease["givenBy"]) == (True, "Anna")
        assert (anna.lease["driver"], anna.lease["givenBy"]) == ("Carl", None)
        assert anna.lease["candidates"] == []
        await asyncio.sleep(0.5)
        assert port.packets()[:5] == [STOP, MOVE, *STOPS]
        assert control.latch is False
        await carl.send(MOVE_ELSEWHERE)
        with pytest.raises(NotDrivingError):
            anna.send(MOVE)
        control.driving.act(carl, "release")
        control.driving.act(carl, "request")
        assert carl.lease["givenBy"] is None


@in_virtual_time
async def test_an_owner_hands_it_over_too_and_nobody_else() -> None:
    async with gateway_on() as control:
        anna, carl, owner = Client(control, PUPIL), Client(control, CARL), Client(control)
        control.driving.act(anna, "request")
        assert owner.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        take(GiveMessage(type="give", to="carl"), carl, control)
        assert carl.lease["drives"] is False
        bert = Client(control, GUEST)
        take(GiveMessage(type="give", to="carl"), bert, control)
        assert [message["code"] for message in await bert.heard() if message["type"] == "refused"] == [
            "forbidden"
        ]
        control.driving.act(owner, "take")
        control.driving.act(owner, "release")
        take(GiveMessage(type="give", to="carl"), owner, control)
        assert (carl.lease["drives"], carl.lease["givenBy"]) == (True, "This computer")


@in_virtual_time
async def test_whoever_may_hand_it_on_hears_who_comes_and_goes_and_listeners_do_not_count() -> None:
    async with gateway_on() as control:
        anna = Client(control, PUPIL)
        control.driving.act(anna, "request")
        assert anna.lease["candidates"] == []
        control.join(Seat(CARL, answers=False))
        assert anna.lease["candidates"] == []
        carl, elsewhere = Client(control, CARL), Client(control, CARL)
        assert anna.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        control.driving.act(carl, "request")
        control.driving.give(anna, "carl")
        assert carl.lease["drives"] is True  # the window that asks, though another came later
        control.driving.give(carl, "pupil")
        control.driving.give(anna, "carl")
        assert elsewhere.lease["drives"] is True
        control.leave(carl)
        control.driving.give(elsewhere, "pupil")
        assert anna.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        control.leave(elsewhere)
        assert anna.lease["candidates"] == []


@in_virtual_time
async def test_a_viewer_may_stop_and_ask_questions_and_nothing_more() -> None:
    async with gateway_on() as control:
        bert = Client(control, GUEST)
        for action in ("request", "take"):
            with pytest.raises(ForbiddenError):
                control.driving.act(bert, action)
        control.stop(None)
        await bert.heard()
        take(ResumeMessage(type="resume"), bert, control)
        assert [message["code"] for message in await bert.heard()] == ["forbidden"]
        assert control.latch is True


@in_virtual_time
async def test_while_somebody_drives_only_they_or_an_owner_resume_and_everybody_hears_it() -> None:
    async with gateway_on() as control:
        anna, carl, bert = Client(control, PUPIL), Client(control, CARL), Client(control, GUEST)
        teacher = Client(control)
        everybody = (anna, bert, carl, teacher)
        for by, others in ((anna, (bert, carl, teacher)), (teacher, (anna, bert, carl))):
            await anna.send(MOVE)
            take(StopMessage(type="stop", hold=None), bert, control)
            for one in everybody:
                stopped = [message for message in await one.heard() if message["type"] == "state"]
                assert [state["stoppedBy"] for state in stopped][-1:] == ["Bert"]
            take(ResumeMessage(type="resume"), carl, control)
            [refused] = await carl.heard()
            assert (refused["code"], refused["detail"]) == (
                "notDriving",
                "Anna drives: only Anna or an owner may resume.",
            )
            assert control.latch is True
            await asyncio.sleep(0.3)
            for one in everybody:
                await one.heard()
            take(ResumeMessage(type="resume"), by, control)
            assert control.latch is False
            for one in others:
                assert [message["by"] for message in await one.heard() if message["type"] == "resumed"] == [
                    by.caller.name
                ]
            assert "resumed" not in [message["type"] for message in await by.heard()]


@in_virtual_time
async def test_while_nobody_drives_whoever_may_drive_resumes() -> None:
    async with gateway_on() as control:
        Client(control, PUPIL)
        carl = Client(control, CARL)
        control.stop(None)
        take(ResumeMessage(type="resume"), carl, control)
        assert control.latch is False


@in_virtual_time
async def test_a_tab_that_froze_and_wakes_moves_nothing() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(BATTERY)
        anna.beats = False
        await asyncio.sleep(0.8)
        with pytest.raises(ExpiredError):
            anna.send(MOVE)
        await asyncio.sleep(60)
        anna.beats = True
        assert control.driving.driver is None
        with pytest.raises(NotDrivingError):
            control.send(anna, MOVE.hex(), anna.nonce)
        control.driving.act(anna, "request")
        await anna.send(MOVE)
        assert port.packets() == [STOP, BATTERY, MOVE]


@in_virtual_time
async def test_what_waits_too_long_for_the_wire_is_not_sent() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(MOVE)
        anna.beats = False
        long_move = bytes.fromhex("5555650320e803" + "".join(f"{servo:02x}dc05" for servo in range(1, 33)))
        waiting = [anna.send(long_move) for _ in range(6)]
        outcomes = await asyncio.gather(*waiting, return_exceptions=True)
        assert [type(outcome) for outcome in outcomes[:4]] == [type(None)] * 4
        assert isinstance(outcomes[-1], (ExpiredError, CancelledError))
        last_s = max(at_s for at_s, packet in port.written if packet == long_move)
        assert last_s <= 0.1 + 0.5 + 0.05


@in_virtual_time
async def test_a_driver_who_falls_silent_in_a_move_is_stopped_and_held_in_time() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        await anna.send(MOVE_ELSEWHERE)
        left_s = now()
        anna.beats = False
        await bert.heard()
        await asyncio.sleep(0.85)
        sent = port.written[3:]
        assert sent[0][0] - left_s <= 0.75 + 0.001
        went = (sent[0][0] - left_s) / MOVE_S
        assert [packet for _, packet in sent][:2] == [STOP, hold_at(round(2000 - 500 * went))]
        [state] = await bert.heard()
        assert (state["latch"], state["latchedBy"]) == (True, "silence")
        await asyncio.sleep(0.3)
        assert [packet for _, packet in port.written[3:]].count(STOP) == 3


@in_virtual_time
async def test_a_gateway_that_was_held_up_itself_asks_whether_its_driver_is_there() -> None:
    for is_there in (True, False):
        port = FakePort()
        async with gateway_on(port) as control:
            anna = Client(control)
            await anna.send(RUN)
            anna.beats = is_there
            hold_up(2.5)
            await asyncio.sleep(0.4)
            assert control.latch is not is_there
            assert port.packets() == [STOP, RUN, *([] if is_there else STOPS)]


@in_virtual_time
async def test_a_gateway_that_is_held_up_again_and_again_stops_for_a_lost_driver_all_the_same() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(RUN)
        anna.beats = False
        hold_up(2.5)
        for _ in range(3):
            await asyncio.sleep(0.01)
            hold_up(0.3)
        await asyncio.sleep(0.01)
        assert control.latch is True


@in_virtual_time
async def test_a_group_outlives_its_drivers_silence_by_two_seconds_at_most() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(RUN)
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
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
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
        port = FakePort()
        async with gateway_on(port) as control:
            anna, bert = Client(control), Client(control)
            await anna.send(begun)
            control.leave(anna)
            await asyncio.sleep(0.5)
            assert port.packets() == [STOP, begun, *STOPS]
            assert control.latch is True
            assert bert.lease["driver"] is None


@in_virtual_time
async def test_a_driver_who_leaves_a_robot_at_rest_stops_nothing() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(RUN)
        await anna.send(STOP)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        control.leave(anna)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, RUN, STOP, MOVE]
        assert control.latch is False


@in_virtual_time
async def test_a_driver_who_leaves_after_the_group_has_ended_stops_nothing() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(RUN)
        await asyncio.sleep(1)
        port.say(STOP)  # from this board: finished by itself
        await asyncio.sleep(0.01)
        control.leave(anna)
        await asyncio.sleep(1)
        assert (port.packets(), control.latch) == ([STOP, RUN], False)


@in_virtual_time
async def test_what_a_leaving_client_had_waiting_is_never_sent() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        for _ in range(5):
            anna.send(MOVE)
        await asyncio.sleep(0.005)
        control.leave(anna)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, MOVE, *STOPS]


@in_virtual_time
async def test_a_request_passes_after_five_seconds_and_motion_ends_first_without_a_latch() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert, carl = Client(control), Client(control, PUPIL), Client(control)
        await anna.send(RUN)
        control.driving.act(bert, "request")
        assert (anna.lease["asker"], anna.lease["answerInMs"], bert.lease["asks"]) == ("Anna", 5000, True)
        with pytest.raises(BusyError):
            control.driving.act(carl, "request")
        await asyncio.sleep(4.9)
        assert port.packets() == [STOP, RUN]
        await asyncio.sleep(0.2)
        assert bert.lease["drives"] is True
        await bert.send(MOVE)
        assert port.packets() == [STOP, RUN, *STOPS, MOVE]
        assert control.latch is False
        with pytest.raises(NotDrivingError):
            anna.send(MOVE)


@in_virtual_time
async def test_a_refused_request_changes_nothing_and_an_allowed_one_passes_at_once() -> None:
    async with gateway_on() as control:
        anna, bert = Client(control), Client(control)
        await anna.send(MOVE)
        control.driving.act(bert, "request")
        control.driving.act(anna, "refuse")
        await asyncio.sleep(6)
        assert (bert.lease["drives"], bert.lease["asks"]) == (False, False)
        control.driving.act(bert, "request")
        control.driving.act(anna, "release")
        assert bert.lease["drives"] is True


@in_virtual_time
async def test_the_owner_takes_it_and_what_was_under_way_is_held() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, owner = Client(control, PUPIL), Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        await anna.send(MOVE_ELSEWHERE)
        waiting = anna.send(MOVE)
        control.driving.act(owner, "take")
        with pytest.raises(NotDrivingError):
            await waiting
        await asyncio.sleep(0.5)
        assert [packet[3] for packet in port.packets()[3:]] == [7, 3, 7, 7, 3]
        assert control.latch is False
        with pytest.raises(ForbiddenError):
            control.driving.act(anna, "take")


@in_virtual_time
async def test_a_stop_without_a_pose_holds_where_the_gateway_knows_the_robot_to_be() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        await anna.send(MOVE_ELSEWHERE)
        await asyncio.sleep(0.5)
        await control.stop(None)
        assert port.packets()[3:] == [STOP, hold_at(1750), STOP, STOP, hold_at(1750)]


@in_virtual_time
async def test_a_servo_in_its_first_move_ends_it_slowly() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        other_servo = MOVE[:7] + b"\x02" + MOVE[8:]
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        await anna.send(other_servo)
        await asyncio.sleep(0.25)
        await control.stop(None)
        assert port.packets()[4] == hold_at(2000, 750)


@in_virtual_time
async def test_everybody_who_moves_needs_fresh_words_of_the_lease_of_now() -> None:
    async with gateway_on() as control:
        anna = Client(control)
        await anna.send(MOVE)
        old = anna.nonce
        await asyncio.sleep(0.6)
        for nonce in (None, "1-1", old):
            with pytest.raises(ExpiredError):
                control.send(anna, MOVE.hex(), nonce)


@in_virtual_time
async def test_who_leaves_behind_a_closed_port_latches_nothing() -> None:
    async with gateway_on() as control:
        anna = Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(0.1)
        closing = asyncio.create_task(control.close_port())
        anna.send(MOVE_ELSEWHERE).add_done_callback(taken)  # leaves with the last breath of the port
        await closing
        control.leave(anna)
        assert control.latch is False


def taken(left: Left) -> None:
    """Whatever became of it."""
    left.exception()
