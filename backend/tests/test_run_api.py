"""What a script may run and erase over HTTP, and when it ends."""

import asyncio
from typing import Any

from tests.samples import ERASE, RUN, STOPS, stored
from tests.scripted import (
    ERASED,
    RUN_ENDED,
    RUN_TAKEN,
    Scripted,
    move,
    refusal,
    script,
)
from tests.virtual_time import at, in_virtual_time, now


@in_virtual_time
async def test_a_run_without_a_heartbeat_is_stopped_after_two_seconds() -> None:
    async with script() as here:
        at(now() + 0.05, lambda: here.port.say(RUN_TAKEN))
        assert (await here.post("slots/8/run", times=1)).json() == {"outcome": "acknowledged"}
        assert here.sent() == [RUN]
        begun_s = now()
        await asyncio.sleep(2.5)
        assert here.sent() == [RUN, *STOPS]
        assert here.port.written[2][0] - begun_s <= 2.0
        assert here.control.latch is True


@in_virtual_time
async def test_beats_keep_a_run_going_and_letting_go_ends_it_without_the_latch() -> None:
    async with script() as here:
        assert (await here.post("slots/8/run")).json() == {"outcome": "silent"}
        for _ in range(10):
            await asyncio.sleep(1)
            assert (await here.post("lease", action="heartbeat")).json()["drives"] is True
        assert here.sent() == [RUN]
        assert (await here.post("lease", action="release")).json()["driver"] is None
        await asyncio.sleep(1)
        assert here.sent() == [RUN, *STOPS]
        assert here.control.latch is False


@in_virtual_time
async def test_another_run_ends_the_one_before_and_a_move_waits_for_its_end() -> None:
    async with script() as here:
        await here.post("slots/8/run")
        assert refusal(await here.move(1500, s1=2000)) == (409, "busy")
        await here.post("slots/8/run")
        assert here.sent() == [RUN, *STOPS, RUN]
        await asyncio.sleep(0.6)
        here.port.say(RUN_ENDED)
        await asyncio.sleep(0.1)
        assert (await here.move(1500, s1=2000)).status_code == 200


@in_virtual_time
async def test_where_only_the_board_knows_the_end_a_release_is_enough_without_a_resume() -> None:
    async with script() as here:
        await here.post("slots/8/run")
        assert (await running(here)) == {"slot": 8, "times": 1, "endsInMs": None}
        assert "release the lease" in (await here.move(1500, s1=2000)).json()["detail"]
        await here.post("lease", action="release")
        await asyncio.sleep(0.3)
        assert (await here.move(1500, s1=2000)).status_code == 200
        assert here.sent() == [RUN, *STOPS, move(1500, s1=2000)]


@in_virtual_time
async def test_of_a_group_that_the_gateway_stored_itself_it_says_how_long_it_may_take() -> None:
    async with script() as here:
        here.control.board.motion.stored(8, stored(8, 2000), now())
        await here.post("slots/8/run")
        ends_in_ms = (await running(here))["endsInMs"]
        assert 2000 < ends_in_ms < 3600
        assert f"up to {ends_in_ms / 1000:.1f} s" in (await here.move(1500, s1=2000)).json()["detail"]
        for _ in range(4):
            await here.post("lease", action="heartbeat")
            await asyncio.sleep(ends_in_ms / 4000)
        assert await running(here) is None
        assert (await here.move(1500, s1=2000)).status_code == 200


async def running(here: Scripted) -> Any:
    return (await here.client.get("/api/status")).json()["running"]


@in_virtual_time
async def test_erasing_is_an_owners_needs_rest_and_waits_for_the_boards_word() -> None:
    async with script() as here:
        assert refusal(await here.post("erase")) == (403, "forbidden")
        await here.move(1500, s1=2000)
        assert refusal(await here.post("erase", owner=True)) == (409, "busy")
        await asyncio.sleep(4)
        at(now() + 0.4, lambda: here.port.say(ERASED))
        assert (await here.post("erase", owner=True)).json() == {"erased": True}
        assert refusal(await here.post("erase", owner=True)) == (504, "noAnswer")
        assert here.sent()[1:] == [ERASE, ERASE]


@in_virtual_time
async def test_who_is_not_let_in_any_more_is_stopped() -> None:
    async with script() as here:
        await here.post("slots/8/run")
        revoked = await here.client.delete(f"/api/people/{here.token_id}", headers=here.owner)
        assert revoked.status_code == 204
        await asyncio.sleep(0.5)
        assert here.sent() == [RUN, *STOPS]
        assert (await here.move(1500, s1=2000)).status_code == 401


@in_virtual_time
async def test_an_unnamed_board_gets_nothing_and_the_refusal_says_how_to_name_it() -> None:
    async with script(board="unknown") as here:
        frame = {"durationMs": 500, "positions": {"1": 1500}}
        refused = (
            await here.move(500, s1=2000),
            await here.post("slots/8/run"),
            await here.post("erase", owner=True),
            await here.post("download", groups=[{"slot": 1, "frames": [frame]}]),
            await here.post("poses/Greeting/apply"),
        )
        for answer in refused:
            assert refusal(answer) == (409, "boardUnknown")
            assert "servodeck board FAMILY" in answer.json()["detail"]
        assert here.sent() == []
