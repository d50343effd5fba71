"""A run that may continue without its driver: bounded, visible to all clients, and any of them may end it."""

import asyncio

import pytest

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import CancelledError, MovingError, NotDrivingError
from servodeck.intents import ContinueMessage, StopMessage
from servodeck.robot.control import Control
from tests.client import ANNA, Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import MOVE, MOVE_S, RUN, STOP, STOPS
from tests.scripted import RUN_ENDED, script
from tests.virtual_time import in_virtual_time, now

BERT = Caller("bert", "Bert", "viewer")
ENDLESS = bytes.fromhex("55550506080000")


async def begin(control: Control, for_ms: int = 60_000) -> Client:
    """Anna starts a group and lets it continue."""
    anna = Client(control, ANNA)
    await anna.send(RUN)
    take(ContinueMessage(type="continue", for_ms=for_ms), anna, control)
    return anna


async def unattended_of(session: Client) -> object:
    """The newest word about it."""
    return next(
        message["unattended"] for message in reversed(await session.heard()) if "unattended" in message
    )


@in_virtual_time
async def test_it_outlives_the_silence_and_the_leaving_of_its_driver_and_everybody_sees_it() -> None:
    for leaves in (False, True):
        port = FakePort()
        async with gateway_on(port) as control:
            bert = Client(control, BERT)
            anna = await begin(control)
            assert await unattended_of(bert) == {
                "slot": 8,
                "times": 1,
                "by": "Anna",
                "endsInMs": 60_000,
                "isMove": False,
            }
            anna.beats = False
            if leaves:
                control.leave(anna)
            await asyncio.sleep(30)
            assert control.driving.driver is None
            assert (port.packets(), control.latch) == ([STOP, RUN], False)
            late = Client(control, BERT)
            assert await unattended_of(late) == {
                "slot": 8,
                "times": 1,
                "by": "Anna",
                "endsInMs": 30_000,
                "isMove": False,
            }


@in_virtual_time
async def test_it_ends_when_its_time_is_over_without_a_need_to_resume() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        bert = Client(control, BERT)
        begun_s = now()
        control.leave(await begin(control))
        await asyncio.sleep(61)
        assert port.packets() == [STOP, RUN, *STOPS]
        assert port.written[2][0] - begun_s == pytest.approx(60, abs=0.1)
        assert (await unattended_of(bert), control.latch) == (None, False)


@in_virtual_time
async def test_any_client_stops_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        bert = Client(control, BERT)
        control.leave(await begin(control))
        take(StopMessage(type="stop"), bert, control)
        await asyncio.sleep(0.5)
        assert port.packets() == [STOP, RUN, *STOPS]
        assert (await unattended_of(bert), control.latch) == (None, True)
        await asyncio.sleep(120)
        assert port.packets() == [STOP, RUN, *STOPS]


@in_virtual_time
async def test_the_next_driver_ends_it_first() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.leave(await begin(control))
        carl = Client(control)
        with pytest.raises(MovingError):
            await carl.send(MOVE)
        await asyncio.sleep(0.5)
        await carl.send(MOVE)
        assert port.packets() == [STOP, RUN, *STOPS, MOVE]
        assert await unattended_of(carl) is None


@in_virtual_time
async def test_the_one_who_began_it_may_come_back_to_it_and_take_that_back() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await begin(control)
        control.driving.act(anna, "release")
        control.driving.act(anna, "request")
        await asyncio.sleep(1)
        assert port.packets() == [STOP, RUN]
        take(ContinueMessage(type="continue", for_ms=None), anna, control)
        assert await unattended_of(anna) is None
        control.leave(anna)
        await asyncio.sleep(1)
        assert port.packets() == [STOP, RUN, *STOPS]


@in_virtual_time
async def test_the_boards_word_that_it_ended_and_another_run_end_the_leave_too() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await begin(control)
        await asyncio.sleep(1)
        port.say(RUN_ENDED)
        await asyncio.sleep(0.1)
        assert await unattended_of(anna) is None
        again = await begin(control) if control.driving.driver is None else anna
        await again.send(RUN)
        take(ContinueMessage(type="continue", for_ms=60_000), again, control)
        again.run(RUN)
        await asyncio.sleep(0.5)
        assert port.packets()[-5:] == [RUN, *STOPS, RUN]
        assert await unattended_of(again) is None
        control.leave(again)
        await asyncio.sleep(1)
        assert port.packets()[-3:] == STOPS


@in_virtual_time
async def test_an_endless_run_ends_when_its_time_is_over() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control, ANNA)
        await anna.send(ENDLESS)
        take(ContinueMessage(type="continue", for_ms=60_000), anna, control)
        assert await unattended_of(anna) == {
            "slot": 8,
            "times": 0,
            "by": "Anna",
            "endsInMs": 60_000,
            "isMove": False,
        }
        control.leave(anna)
        await asyncio.sleep(59)
        assert port.packets() == [STOP, ENDLESS]
        await asyncio.sleep(2)
        assert (port.packets(), control.latch) == ([STOP, ENDLESS, *STOPS], False)


@in_virtual_time
async def test_only_what_runs_may_continue_and_only_its_driver_allows_it() -> None:
    async with gateway_on() as control:
        anna, carl = Client(control, ANNA), Client(control)
        with pytest.raises(NotDrivingError):
            control.allow_unattended(anna, 60_000)
        await anna.send(MOVE)
        with pytest.raises(CancelledError):
            control.allow_unattended(anna, 60_000)
        await asyncio.sleep(MOVE_S)
        await anna.send(RUN)
        with pytest.raises(NotDrivingError):
            control.allow_unattended(carl, 60_000)


@in_virtual_time
async def test_a_script_says_so_with_the_run_itself() -> None:
    async with script() as here:
        assert (await here.post("slots/8/run", times=2, continueForMs=10_000)).status_code == 200
        status = (await here.client.get("/api/status")).json()
        assert (status["unattended"]["by"], status["driver"]) == ("Dance", "Dance")
        await asyncio.sleep(8)
        assert (await here.client.get("/api/status")).json()["driver"] is None
        assert len(here.sent()) == 1
        await asyncio.sleep(3)
        assert here.sent()[1:] == STOPS
        assert (await here.client.get("/api/status")).json()["unattended"] is None
