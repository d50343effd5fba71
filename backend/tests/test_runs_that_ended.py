"""A run that has ended, or never began, is not waited for: nothing is stopped or refused because of it."""

import asyncio
from collections.abc import Callable

import pytest

from tests.boards import WorkingBoard, new_board, old_board
from tests.samples import STOPS
from tests.scripted import Scripted, script
from tests.virtual_time import in_virtual_time

GROUP_MS = 2000


async def watched(here: Scripted, seconds: float) -> None:
    """The script sends heartbeats for its run."""
    for _ in range(round(seconds)):
        await here.post("lease", action="heartbeat")
        await asyncio.sleep(1)


async def running(here: Scripted) -> object:
    return (await here.client.get("/api/status")).json()["running"]


@in_virtual_time
async def test_a_download_behind_a_run_that_has_ended_is_not_stopped() -> None:
    async with script(board="openarm-old", behind=old_board()) as here:
        assert (await here.download(5, duration_ms=GROUP_MS)).status == "done"
        await here.post("slots/5/run")
        await watched(here, 5)
        before = len(here.sent())
        job = await here.download(5, 6, frames=20)
        assert (job.status, here.control.latch) == ("done", False)
        assert all(packet not in STOPS for packet in here.sent()[before:])
        assert here.control.board.broken_slots == []


@pytest.mark.parametrize(("board", "make"), [("openarm-old", old_board), ("openarm-new", new_board)])
@in_virtual_time
async def test_a_download_behind_a_run_of_an_erased_slot_is_not_stopped(
    board: str, make: Callable[[], WorkingBoard]
) -> None:
    async with script(role="owner", board=board, behind=make()) as here:
        assert (await here.download(5, duration_ms=GROUP_MS)).status == "done"
        assert (await here.post("erase")).json() == {"erased": True}
        assert (await here.post("slots/5/run")).status_code == 200
        assert await running(here) is None
        job = await here.download(5, 6, frames=20)
        assert (job.status, here.control.latch) == ("done", False)


@in_virtual_time
async def test_once_every_slot_is_empty_a_run_prevents_no_move() -> None:
    async with script(role="owner", board="openarm-new", behind=new_board()) as here:
        await here.download(5, duration_ms=14_000)
        await here.post("erase")
        for slot in (5, 77):
            await here.post(f"slots/{slot}/run", times=3)
            assert await running(here) is None
            assert (await here.move(1500, s1=2000)).status_code == 200
            await asyncio.sleep(2)
        await here.download(77, duration_ms=14_000)
        await here.post("slots/77/run")
        assert await running(here) is not None


@in_virtual_time
async def test_a_run_of_an_unknown_slot_ends_with_a_stop_and_at_the_latest_by_itself() -> None:
    async with script(board="openarm-old", behind=old_board()) as here:
        await here.post("slots/77/run")
        refused = await here.move(1500, s1=2000)
        assert (refused.status_code, "stop" in refused.json()["detail"]) == (409, True)
        await here.post("stop")
        await here.post("resume")
        assert (await here.move(1500, s1=2000)).status_code == 200
        await asyncio.sleep(2)
        await here.post("slots/77/run", continueForMs=3_600_000)
        await asyncio.sleep(255 * 30 + 10)
        assert await running(here) is None
        assert (await here.move(1500, s1=2000)).status_code == 200
