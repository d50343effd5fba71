"""STOP while a group runs that the gateway stored itself: held where its frames have the servo, at every
door.
"""

import asyncio
from collections.abc import Awaitable, Callable

import pytest

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.intents import StopMessage
from tests.boards import new_board, old_board
from tests.client import Client
from tests.samples import STOP, hold_at, is_held_ahead
from tests.scripted import Scripted, script
from tests.virtual_time import in_virtual_time, now

SLOT = 5
FRAME_MS = 4000
GUEST = Caller("guest", "Bert", "viewer")
PASSER_BY = Caller("link", "Stop link", "stopper")
Door = Callable[[Scripted], Awaitable[object]]


async def over_http(here: Scripted) -> None:
    assert (await here.post("stop")).status_code == 200


def on_a_page(caller: Caller) -> Door:
    async def stop(here: Scripted) -> None:
        session = Client(here.control, caller)
        take(StopMessage(type="stop"), session, here.control)
        await asyncio.sleep(0.2)

    return stop


async def let_go(here: Scripted) -> None:
    await here.post("lease", action="release")
    await asyncio.sleep(0.2)


DOORS: dict[str, Door] = {
    "HTTP": over_http,
    "viewer": on_a_page(GUEST),
    "stop-only link": on_a_page(PASSER_BY),
    "letting go of the lease": let_go,
}


async def begun_long_ago(here: Scripted, frames: int) -> float:
    """Runs it, and tells when its first frame began."""
    await here.move(1500, s1=1000)
    await asyncio.sleep(2)
    assert (await here.download(SLOT, duration_ms=FRAME_MS, frames=frames)).status == "done"
    await here.post(f"slots/{SLOT}/run")
    begun_s = here.port.written[-1][0] + 7 * 10 / 9600
    await asyncio.sleep(1)
    return begun_s


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize(("board", "announces_s"), [("openarm-old", 0.0), ("openarm-new", 4 * 10 / 9600)])
@in_virtual_time
async def test_it_is_held_where_its_frame_has_the_servo(board: str, announces_s: float, door: str) -> None:
    async with script(board=board, behind=old_board() if board == "openarm-old" else new_board()) as here:
        begun_s = await begun_long_ago(here, frames=1) + announces_s
        before = len(here.sent())
        await DOORS[door](here)
        [first, hold, *repeats, again] = here.port.written[1 + before :]
        assert [first[1], *(packet for _, packet in repeats)] == [STOP] * 3
        assert is_held_ahead(hold[1], 1000 + 500 * (hold[0] - begun_s) * 1000 / FRAME_MS, 1500)
        assert again[1] == hold_at(int.from_bytes(hold[1][8:10], "little"))
        assert hold[0] - first[0] < 0.02


@in_virtual_time
async def test_a_later_frame_is_held_on_its_way_too() -> None:
    async with script(board="openarm-old", behind=old_board()) as here:
        begun_s = await begun_long_ago(here, frames=3)
        for _ in range(9):
            await here.post("lease", action="heartbeat")
            await asyncio.sleep(1)
        pressed_s = now()
        await over_http(here)
        went = (pressed_s - begun_s) * 1000 / FRAME_MS - 2
        assert is_held_ahead(here.sent()[-1], 1600 + 100 * went, 1700)


async def unheld_in(here: Scripted) -> tuple[object, object]:
    """The servos that a stop cannot hold, as its client and a viewer get them."""
    bert = Client(here.control, GUEST)
    answer = (await here.post("stop")).json()["unheld"]
    [halted] = [message for message in await bert.heard() if message["type"] == "halted"]
    return answer, halted["unheld"]


@in_virtual_time
async def test_every_client_gets_the_unheld_servos_and_their_time() -> None:
    async with script(board="openarm-old", behind=old_board()) as here:
        await asyncio.sleep(30)
        assert await unheld_in(here) == (None, None)
        await here.post("resume")
        await here.move(3000, s3=2000)
        pressed_in_first_move = {"servos": [3], "forMs": pytest.approx(3099, abs=2)}
        await asyncio.sleep(0.01)
        assert await unheld_in(here) == (pressed_in_first_move, pressed_in_first_move)
        await here.post("resume")
        await asyncio.sleep(3)
        await here.post("slots/77/run")
        of_a_group_nobody_knows = {"servos": None, "forMs": pytest.approx(30_085, abs=10)}
        assert await unheld_in(here) == (of_a_group_nobody_knows, of_a_group_nobody_knows)
        await here.post("resume")
        await asyncio.sleep(1)
        again = {"servos": None, "forMs": pytest.approx(28_900, abs=100)}
        assert await unheld_in(here) == (again, again)


@in_virtual_time
async def test_of_a_group_that_it_knows_all_is_held() -> None:
    async with script(board="openarm-old", behind=old_board()) as here:
        await asyncio.sleep(30)
        await begun_long_ago(here, frames=2)
        assert await unheld_in(here) == (None, None)
