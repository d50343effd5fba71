"""What a page has the board do besides moves: its outcome, what ends first, what keeps it from leaving."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.intents import (
    AnyClientMessage,
    EraseMessage,
    ReadMessage,
    ReleaseMessage,
    RunMessage,
    SetSpeedMessage,
    StopGroupMessage,
    StopMessage,
)
from servodeck.robot.control import Control
from tests.client import ANNA, Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, BATTERY_REPORT, ERASE, MOVE, MOVE_S, RUN, STOP, STOPS
from tests.virtual_time import in_virtual_time, now

RUN_ACCEPTED = bytes.fromhex("55550206")
ERASED = bytes.fromhex("55550208")
READ_POSITIONS = bytes.fromhex("55550515020102")
POSITIONS = bytes.fromhex("55550915020190010290" + "01")
# Servo 1 to 500 in a second.
MOVE_TO_STEP = bytes.fromhex("5555080301e80301f401")
VIEWER = Caller("guest", "Bert", "viewer")


def run(page: Client, number: int = 1) -> RunMessage:
    """As RUN."""
    return RunMessage(type="run", id=number, slot=8, times=1, nonce=page.nonce)


def erase(page: Client) -> EraseMessage:
    return EraseMessage(type="erase", id=1, nonce=page.nonce)


def set_speed(page: Client) -> SetSpeedMessage:
    return SetSpeedMessage(type="setSpeed", id=1, slot=None, percent=50, nonce=page.nonce)


def release(page: Client) -> ReleaseMessage:
    return ReleaseMessage(type="release", id=1, servos=[1, 2], nonce=page.nonce)


def end_group(_page: Client) -> StopGroupMessage:
    return StopGroupMessage(type="stopGroup", id=1)


def driver_on(control: Control, caller: Caller | None = None) -> Client:
    page = Client(control, caller) if caller else Client(control)
    control.driving.act(page, "request")
    return page


async def answers(page: Client) -> list[dict[str, Any]]:
    return [message for message in await page.heard() if message["type"] in ("done", "refused")]


async def outcome(page: Client, message: AnyClientMessage) -> str:
    """Of that message, or the code of its refusal."""
    take(message, page, page.control)
    for _ in range(400):
        if found := await answers(page):
            [answer] = found
            return str(answer.get("outcome") or answer["code"])
        await asyncio.sleep(0.01)
    raise AssertionError("It was never answered.")


@in_virtual_time
async def test_a_run_says_whether_the_board_has_taken_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        page = driver_on(control)
        assert await outcome(page, run(page)) == "silent"
        asyncio.get_running_loop().call_later(0.3, port.say, RUN_ACCEPTED)
        assert await outcome(page, run(page)) == "acknowledged"
        # The one before was ended first.
        assert port.packets() == [STOP, RUN, *STOPS, RUN]
        await control.stop()
        control.choose_family("openarm-old")
        control.resume(page.caller)
        assert await outcome(page, run(page)) == "sent"


@in_virtual_time
async def test_what_moves_ends_before_a_run_and_is_held() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        page = driver_on(control)
        await page.send(MOVE)
        await asyncio.sleep(MOVE_S + 0.1)
        await page.send(MOVE[:8] + (1000).to_bytes(2, "little"))
        await asyncio.sleep(0.5)
        before = len(port.written)
        assert await outcome(page, run(page)) == "silent"
        commands = [packet[3] for packet in port.packets()[before:]]
        assert commands == [7, 3, 7, 7, 3, 6]
        assert control.latch is False


@in_virtual_time
async def test_any_client_ends_a_group_by_three_stops_and_a_run_waits_for_the_last() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        page, viewer = driver_on(control), Client(control, VIEWER)
        await viewer.heard()
        take(run(page), page, control)
        await asyncio.sleep(0.6)
        await page.heard()
        begun_s = now()
        take(end_group(viewer), viewer, control)
        await asyncio.sleep(0.02)
        take(run(page, 2), page, control)
        await asyncio.sleep(1)
        assert port.packets()[:5] == [STOP, RUN, *STOPS]
        assert port.packets()[-1] == RUN
        assert port.packets().count(RUN) == 2
        assert port.written[4][0] - begun_s < 0.16
        assert control.latch is False
        assert [message["outcome"] for message in await answers(viewer)] == ["sent"]


@in_virtual_time
async def test_ending_a_group_continues_when_its_page_has_gone() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        viewer = Client(control, VIEWER)
        take(end_group(viewer), viewer, control)
        await asyncio.sleep(0.05)
        control.leave(viewer)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, *STOPS]


@in_virtual_time
async def test_erasing_speed_and_release_are_sent_once_and_answered() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        page = driver_on(control)
        asyncio.get_running_loop().call_later(0.2, port.say, ERASED)
        assert await outcome(page, erase(page)) == "acknowledged"
        assert await outcome(page, erase(page)) == "noAnswer"
        assert await outcome(page, set_speed(page)) == "notSupported"  # of such a board
        control.choose_family("bus-ctrl")
        assert await outcome(page, set_speed(page)) == "sent"
        assert await outcome(page, release(page)) == "sent"
        assert [packet[3] for packet in port.packets()] == [7, 8, 8, 11, 20]
        assert port.packets()[1] == ERASE


@pytest.mark.parametrize(("make", "family"), [(erase, "doc"), (release, "bus-ctrl")])
@in_virtual_time
async def test_what_needs_rest_is_refused_while_something_moves_or_waits(
    make: Callable[[Client], AnyClientMessage], family: str
) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.choose_family(family)
        page = driver_on(control)
        await page.send(MOVE if family == "doc" else MOVE_TO_STEP)
        assert await outcome(page, make(page)) == "busy"
        await asyncio.sleep(1.1)
        assert len(port.packets()) == 2


@pytest.mark.parametrize(
    ("make", "family", "done"), [(erase, "doc", "acknowledged"), (release, "bus-ctrl", "sent")]
)
@in_virtual_time
async def test_what_needs_rest_is_refused_while_the_last_frame_of_an_unknown_group_may_move(
    make: Callable[[Client], AnyClientMessage], family: str, done: str
) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.choose_family(family)
        page = driver_on(control)
        await page.send(RUN)
        await page.send(STOP)
        assert await outcome(page, make(page)) == "busy"
        await asyncio.sleep(30.1)
        await page.heard()
        asyncio.get_running_loop().call_later(0.2, port.say, ERASED)
        assert await outcome(page, make(page)) == done


@pytest.mark.parametrize(
    ("make", "family"),
    [(run, "doc"), (erase, "doc"), (set_speed, "bus-ctrl"), (release, "bus-ctrl")],
)
@in_virtual_time
async def test_nothing_of_it_leaves_without_the_lease_the_role_or_while_stopped(
    make: Callable[[Client], AnyClientMessage], family: str
) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.choose_family(family)
        viewer, other = Client(control, VIEWER), Client(control)
        page = driver_on(control)
        for client, code in ((viewer, "forbidden"), (other, "notDriving")):
            await client.heard()
            assert await outcome(client, make(client)) == code
        nonce = page.nonce
        page.beats = False
        await asyncio.sleep(0.55)
        assert page.nonce == nonce
        assert await outcome(page, make(page)) == "expired"
        page.beats = True
        await asyncio.sleep(0.3)
        take(StopMessage(type="stop"), page, control)
        await asyncio.sleep(0.3)
        await page.heard()
        assert await outcome(page, make(page)) == "latched"
        # A board that answers it is asked whether it has heard the stops.
        assert set(port.packets()) <= {STOP, BATTERY}


@in_virtual_time
async def test_only_an_owner_erases() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        pupil = driver_on(control, ANNA)
        assert await outcome(pupil, erase(pupil)) == "forbidden"
        assert port.packets() == [STOP]


@in_virtual_time
async def test_what_was_asked_ends_with_its_seat() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        page = driver_on(control)
        await page.send(MOVE)
        take(run(page), page, control)
        await asyncio.sleep(0.1)
        control.leave(page)
        await asyncio.sleep(2)
        assert RUN not in port.packets()


@in_virtual_time
async def test_questions_reach_the_board_one_at_a_time() -> None:
    """A bus board that asks its servos keeps one packet and drops the others (S52)."""
    port = FakePort()
    async with gateway_on(port, board="xarm") as control:
        page, other = Client(control), Client(control)
        take(ReadMessage(type="read", id=1, what="positions", servos=[1, 2]), page, control)
        take(ReadMessage(type="read", id=2, what="positions", servos=[1, 2]), other, control)
        take(ReadMessage(type="read", id=3, what="battery", servos=[]), other, control)
        await asyncio.sleep(0.1)
        assert port.packets()[1:] == [READ_POSITIONS]
        port.say(POSITIONS)
        await asyncio.sleep(0.1)
        assert port.packets()[1:] == [READ_POSITIONS, BATTERY]
        assert [answer["id"] for answer in await answers(page)] == [1]
        assert [answer["id"] for answer in await answers(other)] == [2]
        port.say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
        assert [answer["id"] for answer in await answers(other)] == [3]


@in_virtual_time
async def test_a_question_that_is_not_answered_is_refused_and_the_next_one_is_asked() -> None:
    port = FakePort()
    async with gateway_on(port, board="xarm") as control:
        page = Client(control)
        take(ReadMessage(type="read", id=1, what="positions", servos=[1, 2]), page, control)
        take(ReadMessage(type="read", id=2, what="version", servos=[]), page, control)
        take(ReadMessage(type="read", id=3, what="battery", servos=[]), page, control)
        await asyncio.sleep(0.5)
        assert port.packets()[1:] == [READ_POSITIONS, BATTERY]
        codes = {answer["id"]: answer["code"] for answer in await answers(page)}
        assert codes == {1: "noAnswer", 2: "notSupported"}
