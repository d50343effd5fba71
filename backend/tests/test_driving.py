"""Who may move the robot, from the client's message to the bytes on the wire."""

import asyncio

import pytest

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import BusyError, ExpiredError, ForbiddenError, NotDrivingError
from servodeck.intents import GrantMessage, ResumeMessage, StopMessage
from servodeck.port.wire import Left
from servodeck.robot.hub import Session
from tests.client import Client, driven, gateway_on
from tests.fake_port import FakePort
from tests.samples import (
    BATTERY,
    GAP_MS,
    MOVE,
    MOVE_ELSEWHERE,
    MOVE_S,
    RUN,
    STOP,
    STOPS,
    hold_at,
    is_held_ahead,
    wire_ms,
)
from tests.virtual_time import in_virtual_time

GUEST = Caller("guest", "Bert", "viewer")
PUPIL = Caller("pupil", "Anna", "driver")
CARL = Caller("carl", "Carl", "driver")


@in_virtual_time
async def test_the_first_who_wants_to_move_drives_and_everybody_hears_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control, PUPIL), Client(control)
        [welcome, *_] = await bert.heard()
        assert welcome["lease"]["driver"] is None
        await anna.send(MOVE)
        assert anna.lease == {
            "you": "Anna",
            "driver": "Anna",
            "drives": True,
            "requestedBy": None,
            "hasRequested": False,
            "grantedInMs": None,
            "mayDrive": True,
            "mayTake": False,
            "grantedBy": None,
            "candidates": [{"id": "local", "name": "This computer"}],
        }
        assert (bert.lease["driver"], bert.lease["drives"], bert.lease["mayTake"]) == ("Anna", False, True)
        with pytest.raises(NotDrivingError):
            bert.send(MOVE)
        await bert.send(BATTERY)
        await bert.send(STOP)
        assert port.packets() == [STOP, MOVE, BATTERY, STOP]


@in_virtual_time
async def test_the_driver_hands_it_to_a_connected_client_which_gets_the_givers_name_and_motion_stops() -> (
    None
):
    port = FakePort()
    async with gateway_on(port) as control:
        anna, carl, bert = Client(control, PUPIL), Client(control, CARL), Client(control, GUEST)
        await anna.send(MOVE)
        assert anna.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        assert carl.lease["candidates"] == bert.lease["candidates"] == []
        for unfit in ("bert", "guest", "elsewhere"):
            take(GrantMessage(type="grant", to=unfit), anna, control)
            assert anna.lease["drives"] is True
        take(GrantMessage(type="grant", to="carl"), anna, control)
        assert (carl.lease["drives"], carl.lease["grantedBy"]) == (True, "Anna")
        assert (anna.lease["driver"], anna.lease["grantedBy"]) == ("Carl", None)
        assert anna.lease["candidates"] == []
        await asyncio.sleep(0.5)
        assert port.packets()[:5] == [STOP, MOVE, *STOPS]
        assert control.latch is False
        await carl.send(MOVE_ELSEWHERE)
        with pytest.raises(NotDrivingError):
            anna.send(MOVE)
        control.driving.act(carl, "release")
        control.driving.act(carl, "request")
        assert carl.lease["grantedBy"] is None


@in_virtual_time
async def test_an_owner_hands_it_over_too_and_no_other() -> None:
    async with gateway_on() as control:
        anna, carl, owner = Client(control, PUPIL), Client(control, CARL), Client(control)
        control.driving.act(anna, "request")
        assert owner.lease["candidates"] == [{"id": "carl", "name": "Carl"}]
        take(GrantMessage(type="grant", to="carl"), carl, control)
        assert carl.lease["drives"] is False
        bert = Client(control, GUEST)
        take(GrantMessage(type="grant", to="carl"), bert, control)
        assert [message["code"] for message in await bert.heard() if message["type"] == "refused"] == [
            "forbidden"
        ]
        control.driving.act(owner, "take")
        control.driving.act(owner, "release")
        take(GrantMessage(type="grant", to="carl"), owner, control)
        assert (carl.lease["drives"], carl.lease["grantedBy"]) == (True, "This computer")


@in_virtual_time
async def test_clients_that_may_hand_it_over_get_the_candidates_without_listeners() -> None:
    async with gateway_on() as control:
        anna = Client(control, PUPIL)
        control.driving.act(anna, "request")
        assert anna.lease["candidates"] == []
        control.join(Session(CARL, answers=False))
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
        control.stop()
        await bert.heard()
        take(ResumeMessage(type="resume"), bert, control)
        assert [message["code"] for message in await bert.heard()] == ["forbidden"]
        assert control.latch is True


@in_virtual_time
async def test_a_stop_for_the_battery_names_its_reason_and_the_page() -> None:
    async with gateway_on() as control:
        anna, bert = Client(control, PUPIL), Client(control, GUEST)
        await anna.send(MOVE)
        await bert.heard()
        take(StopMessage(type="stop", reason="battery"), anna, control)
        stopped = [message for message in await bert.heard() if message["type"] == "state"]
        assert [(state["latchedBy"], state["stoppedBy"]) for state in stopped][-1:] == [("battery", "Anna")]


@in_virtual_time
async def test_while_a_client_drives_only_it_or_an_owner_resumes_and_all_clients_hear_it() -> None:
    async with gateway_on() as control:
        anna, carl, bert = Client(control, PUPIL), Client(control, CARL), Client(control, GUEST)
        teacher = Client(control)
        clients = (anna, bert, carl, teacher)
        for by, others in ((anna, (bert, carl, teacher)), (teacher, (anna, bert, carl))):
            await anna.send(MOVE)
            take(StopMessage(type="stop"), bert, control)
            for one in clients:
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
            for one in clients:
                await one.heard()
            take(ResumeMessage(type="resume"), by, control)
            assert control.latch is False
            for one in others:
                assert [message["by"] for message in await one.heard() if message["type"] == "resumed"] == [
                    by.caller.name
                ]
            assert "resumed" not in [message["type"] for message in await by.heard()]


@in_virtual_time
async def test_without_a_driver_any_client_that_may_drive_resumes() -> None:
    async with gateway_on() as control:
        Client(control, PUPIL)
        carl = Client(control, CARL)
        control.stop()
        take(ResumeMessage(type="resume"), carl, control)
        assert control.latch is False


@in_virtual_time
async def test_a_request_passes_after_five_seconds_and_motion_ends_first_without_a_latch() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert, carl = Client(control), Client(control, PUPIL), Client(control)
        await anna.send(RUN)
        control.driving.act(bert, "request")
        assert (anna.lease["requestedBy"], anna.lease["grantedInMs"], bert.lease["hasRequested"]) == (
            "Anna",
            5000,
            True,
        )
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
        assert (bert.lease["drives"], bert.lease["hasRequested"]) == (False, False)
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
        # The last is the hold behind the first row of stops that go on.
        assert [packet[3] for packet in port.packets()[3:]] == [7, 3, 7, 7, 3, 3]
        assert control.latch is False
        with pytest.raises(ForbiddenError):
            control.driving.act(anna, "take")


@in_virtual_time
async def test_a_stop_without_a_pose_holds_where_the_gateway_knows_the_robot_to_be() -> None:
    async with driven(MOVE) as (control, port, anna):
        await asyncio.sleep(MOVE_S + 0.1)
        await anna.send(MOVE_ELSEWHERE)
        await asyncio.sleep(0.5)
        await control.stop()
        # As it stands when the pose leaves, behind the first stop.
        [*stops, again] = port.packets()[3:]
        held = stops.pop(1)
        assert stops == STOPS
        assert is_held_ahead(held, 1750 - (wire_ms(STOP) + GAP_MS) / 2, 1500)
        assert again == hold_at(int.from_bytes(held[8:10], "little"))


@in_virtual_time
async def test_a_servo_in_its_first_move_ends_it_slowly() -> None:
    async with driven() as (control, port, anna):
        other_servo = MOVE[:7] + b"\x02" + MOVE[8:]
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S)
        await anna.send(other_servo)
        await asyncio.sleep(0.25)
        await control.stop()
        # In whole ticks, and not before that move has ended, with what the board may say meanwhile.
        assert port.packets()[4] == hold_at(2000, 760)


@in_virtual_time
async def test_everybody_who_moves_needs_fresh_words_of_the_lease_of_now() -> None:
    async with gateway_on() as control:
        anna = Client(control)
        await anna.send(MOVE)
        old = anna.nonce
        await asyncio.sleep(0.6)
        for nonce in (None, "1-1", old):
            with pytest.raises(ExpiredError):
                control.requests.send(anna, MOVE.hex(), nonce)


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
    """With any outcome."""
    left.exception()
