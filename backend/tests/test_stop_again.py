"""A stop that fell into the board's flash work: said once more when the board hears again."""

import asyncio

from servodeck.callers import THIS_COMPUTER
from tests.client import Client, driven
from tests.samples import ERASE, GAP_MS, MOVE, MOVE_S, RUN, STOP, STOPS
from tests.scripted import ERASED, RUN_TAKEN
from tests.virtual_time import in_virtual_time, now

# Erasing is over by then for sure, and the gateway takes a run, but the board has not said so.
UNTIL_RUN_S = 1.1
LONGEST_DEAF_S = 2.5


async def run_unheard(driver: Client) -> None:
    await asyncio.sleep(UNTIL_RUN_S)
    await driver.send(RUN)


@in_virtual_time
async def test_it_is_said_again_when_the_longest_work_is_over() -> None:
    async with driven(ERASE) as (control, port, anna):
        await run_unheard(anna)
        run_s = now()
        await control.stop()
        await asyncio.sleep(2)
        assert port.packets() == [STOP, ERASE, RUN, *STOPS]
        assert control.board.activity.may_move()
        await asyncio.sleep(1)
        assert port.packets() == [STOP, ERASE, RUN, *STOPS, *STOPS]
        assert port.written[6][0] - run_s <= LONGEST_DEAF_S + 0.001
        await asyncio.sleep(10)
        assert (port.packets()[9:], control.board.activity.may_move(), control.latch) == ([], False, True)


@in_virtual_time
async def test_it_is_said_again_as_soon_as_the_board_has_answered() -> None:
    async with driven(ERASE) as (control, port, anna):
        await run_unheard(anna)
        await control.stop()
        await asyncio.sleep(0.1)
        port.say(ERASED)
        port.say(RUN_TAKEN)
        answered_s = now()
        await asyncio.sleep(0.3)
        assert port.packets() == [STOP, ERASE, RUN, *STOPS, *STOPS]
        assert port.written[6][0] - answered_s <= GAP_MS / 1000 + 0.01
        assert not control.board.activity.may_move()


@in_virtual_time
async def test_a_run_that_the_board_takes_behind_it_is_stopped_however_long_it_was_deaf() -> None:
    async with driven(ERASE) as (control, port, anna):
        await run_unheard(anna)
        await control.stop()
        await asyncio.sleep(10)
        before = len(port.packets())
        port.say(ERASED)
        port.say(RUN_TAKEN)
        await asyncio.sleep(0.3)
        assert port.packets()[before:] == [*STOPS]


@in_virtual_time
async def test_a_motion_begun_since_is_not_stopped_by_it() -> None:
    async with driven(ERASE) as (control, port, anna):
        await run_unheard(anna)
        await control.stop()
        control.resume(THIS_COMPUTER)
        anna.run(RUN)
        await asyncio.sleep(5)
        # The group that may run still is ended before the next one begins.
        assert port.packets() == [STOP, ERASE, RUN, *STOPS, *STOPS, RUN]


@in_virtual_time
async def test_what_was_heard_is_not_said_again() -> None:
    async with driven(MOVE) as (control, port, _):
        await asyncio.sleep(MOVE_S)
        await control.stop()
        await asyncio.sleep(1)  # the hold again, behind as many stops as a board can miss
        before = port.packets()
        await asyncio.sleep(5)
        assert port.packets() == before
