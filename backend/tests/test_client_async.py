"""`servodeck.AsyncRobot`: the same methods for asyncio."""

import asyncio
import inspect

import pytest

from servodeck import AsyncRobot, Robot
from servodeck.errors import ClosedError, LatchedError
from tests.samples import STOP
from tests.scripted import move
from tests.served_robot import Served
from tests.test_client import BoardPort, has, here, port, sent

pytestmark = pytest.mark.slow
fixtures = (here, port)


def test_both_have_the_same_methods_with_the_same_arguments() -> None:
    def methods(kind: type) -> dict[str, list[str]]:
        found = inspect.getmembers(kind, inspect.isfunction)
        return {name: list(inspect.signature(each).parameters) for name, each in found if name[0] != "_"}

    assert methods(AsyncRobot) == methods(Robot)
    assert list(inspect.signature(AsyncRobot).parameters) == list(inspect.signature(Robot).parameters)


async def test_it_moves_plays_runs_and_looks(here: Served, port: BoardPort) -> None:
    port.ends_in_s = 0.6  # a report that comes sooner may be of the run before
    async with AsyncRobot(here.url) as robot:
        await robot.move({"Base": 20}, units="deg")
        await robot.play([(0.1, {"Base": 10}), (0.1, {"Base": 0})], units="deg")
        assert await robot.run(8) == "acknowledged"
        assert await robot.poses() == {0: "home", 1: "Greeting"}
        assert (await robot.snapshot()).board == "doc"
        async for event in robot.events(seconds=5):
            assert event.type == "welcome"
            break
        assert await robot.stop() is None
        with pytest.raises(LatchedError):
            await robot.pose("home")
        await robot.resume()
    assert sent(port)[0] == move(1500, s1=1700)


async def test_a_method_that_is_cancelled_stops_its_motion(here: Served, port: BoardPort) -> None:
    robot = AsyncRobot(here.url)
    moving = asyncio.create_task(robot.move({1: 2000}, units="board", seconds=20))
    await asyncio.to_thread(has, lambda: len(sent(port)) > 0)
    moving.cancel()
    with pytest.raises(asyncio.CancelledError):
        await moving
    await asyncio.to_thread(has, lambda: STOP in sent(port))
    await robot.close()


async def test_a_closed_robot_refuses_every_method(here: Served, port: BoardPort) -> None:
    robot = AsyncRobot(here.url)
    await robot.close()
    await robot.close()
    for ask in (
        lambda: robot.move({1: 1500}, units="board"),
        lambda: robot.run(8),
        robot.stop,
        robot.status,
        robot.snapshot,
        lambda: anext(robot.events()),
    ):
        with pytest.raises(ClosedError, match="was closed"):
            await ask()
    assert sent(port) == []


async def test_a_move_that_is_not_waited_for_goes_to_its_end(here: Served, port: BoardPort) -> None:
    async with AsyncRobot(here.url) as robot:
        await robot.move({1: 1800}, units="board", seconds=3, wait=False)
        await asyncio.sleep(3.2)  # longer than without a heartbeat
        assert sent(port) == [move(3000, s1=1800)]


async def test_what_it_began_is_stopped_at_the_end(here: Served, port: BoardPort) -> None:
    async with AsyncRobot(here.url) as robot:
        await robot.run(8, times=0, wait=False)
    await asyncio.to_thread(has, lambda: STOP in sent(port))
    assert here.running.control.driving.driver is None
