"""Requests over HTTP that wait for the end of what they begin, and what ends the waiting."""

import asyncio
from collections.abc import Awaitable, Callable

from tests.samples import RUN, STOPS
from tests.scripted import RUN_ENDED, RUN_TAKEN, refusal, script
from tests.virtual_time import at, in_virtual_time, now

FRAMES = [{"durationMs": 500, "positions": {"1": position}} for position in (1200, 1800)]


@in_virtual_time
async def test_a_move_is_answered_when_the_servos_have_arrived() -> None:
    async with script() as here:
        begun_s = now()
        answer = await here.post("move", timeMs=1500, positions={"1": 1500}, waitMs=5000)
        assert answer.json() == {"packets": 1, "overInMs": 1500, "firstMoves": [1], "ended": True}
        assert 1.5 <= now() - begun_s < 1.7
        later = await here.post("move", timeMs=1500, positions={"1": 1200}, waitMs=200)
        assert later.json()["ended"] is False
        assert here.control.latch is False


@in_virtual_time
async def test_a_run_that_is_waited_for_needs_no_heartbeat_until_the_time_is_over() -> None:
    async with script() as here:
        at(now() + 0.05, lambda: here.port.say(RUN_TAKEN))
        at(now() + 9, lambda: here.port.say(RUN_ENDED))
        begun_s = now()
        answer = await here.post("slots/8/run", waitMs=60_000)
        assert answer.json() == {"outcome": "acknowledged", "ended": True}
        assert 9 <= now() - begun_s < 9.2
        assert here.sent() == [RUN]
        assert (await here.post("slots/8/run", waitMs=5000)).json()["ended"] is False
        assert here.sent() == [RUN, RUN]
        await asyncio.sleep(2.5)
        assert here.sent() == [RUN, RUN, *STOPS]


@in_virtual_time
async def test_a_stop_and_another_driver_end_the_waiting_with_their_codes() -> None:
    async with script() as here:
        stop = asyncio.create_task(later(1.0, lambda: here.post("stop")))
        assert refusal(await here.post("slots/8/run", waitMs=60_000)) == (409, "latched")
        await stop
        await here.post("resume")
        await asyncio.sleep(1)
        taken = asyncio.create_task(later(1.0, lambda: here.post("lease", owner=True, action="take")))
        assert refusal(await here.post("slots/8/run", waitMs=60_000)) == (409, "notDriving")
        await taken


@in_virtual_time
async def test_plays_and_downloads_answer_with_their_last_state() -> None:
    async with script() as here:
        played = await here.post("play", frames=FRAMES, waitMs=60_000)
        assert (played.status_code, played.json()["status"]) == (202, "done")
        endless = await here.post("play", frames=FRAMES, times=0, waitMs=5000)
        assert endless.json()["status"] == "playing"
        await here.post("lease", action="release")
        await asyncio.sleep(2)
        stored = await here.post("download", groups=[{"slot": 5, "frames": FRAMES}], waitMs=60_000)
        assert (stored.json()["status"], stored.json()["code"]) == ("failed", "noAnswer")


@in_virtual_time
async def test_a_repeat_with_the_same_key_waits_for_the_same_end() -> None:
    async with script() as here:
        at(now() + 3, lambda: here.port.say(RUN_ENDED))
        key = {"idempotency-key": "wave"}
        first, again = [
            asyncio.create_task(here.client.post("/api/slots/8/run", json={"waitMs": 60_000}, headers=key))
            for _ in range(2)
        ]
        assert (await first).json() == (await again).json() == {"outcome": "silent", "ended": True}
        assert here.sent() == [RUN]


async def later(after_s: float, work: Callable[[], Awaitable[object]]) -> None:
    await asyncio.sleep(after_s)
    await work()
