"""A move that its program asks to end with its heartbeats, and one that the request itself permits: when the
gateway stops them, and what it tells the clients. Packets at the port, in virtual time.
"""

import asyncio
import random
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

import pytest
from httpx2 import Response

from servodeck.protocol.values import Move
from tests.amount import named, seeds
from tests.client import Client
from tests.samples import STOP, command_in
from tests.scripted import Scripted, script
from tests.virtual_time import in_virtual_time, now

SILENT_S = 2.0
# Timers, the answer of a request, and the stop's way onto the wire.
LATE_S = 0.05
LONG_MS = 10_000


@asynccontextmanager
async def known() -> AsyncIterator[Scripted]:
    """Servos 1 and 2 are at 1500: what moves them can be held."""
    async with script() as here:
        await here.move(1500, s1=1500, s2=1500)
        await asyncio.sleep(5)
        here.port.written.clear()
        yield here


async def begin(here: Scripted, time_ms: int = LONG_MS, *, servo: int = 1, beats: bool = True) -> Response:
    answer = await here.post("move", timeMs=time_ms, positions={str(servo): 2000}, beats=beats)
    assert answer.status_code == 200, answer.text
    return answer


async def beat(here: Scripted) -> None:
    await here.post("lease", action="heartbeat")


def stops_s(here: Scripted) -> list[float]:
    return [at_s for at_s, packet in here.port.written if packet == STOP]


def held_in(packet: bytes) -> dict[int, int]:
    command = command_in(packet)
    assert isinstance(command, Move)
    return {target.servo: target.position for target in command.targets}


def went_to_its_end(here: Scripted) -> bool:
    """In parts, each farther, and nothing else left."""
    places = [held_in(packet)[1] for packet in here.port.packets()]
    return places == sorted(places) and places[-1] == 2000


async def unattended(here: Scripted) -> object:
    return (await here.client.get("/api/status")).json()["unattended"]


@in_virtual_time
async def test_a_move_with_beats_is_stopped_and_held_two_seconds_after_the_last_one() -> None:
    async with known() as here:
        await begin(here)
        for _ in range(3):
            await asyncio.sleep(1)
            await beat(here)
        last_s = now()
        await asyncio.sleep(5)
        assert stops_s(here)[0] == pytest.approx(last_s + SILENT_S, abs=LATE_S)
        packets = here.port.packets()
        hold = packets[packets.index(STOP) + 1]
        # On the way from 1500 to 2000 in ten seconds, five of which have passed.
        assert held_in(hold)[1] == pytest.approx(1750, abs=20)
        # The program may have died with the robot in motion: a person has to look.
        assert (here.control.latch, here.control.latched_by) == (True, "silence")
        assert here.control.driving.driver is None


@in_virtual_time
async def test_a_pose_with_beats_ends_with_them_too() -> None:
    async with known() as here:
        begun = await here.post("poses/home/apply", timeMs=8000, beats=True)
        assert begun.status_code == 404  # no robot is described; the field is known
        begun = await here.post("poses/home/apply", timeMs=8000, beets=True)
        assert begun.status_code == 422


@in_virtual_time
async def test_a_move_with_beats_goes_to_its_end_while_they_come() -> None:
    async with known() as here:
        await begin(here)
        for _ in range(10):
            await asyncio.sleep(1)
            await beat(here)
        await asyncio.sleep(5)
        assert went_to_its_end(here)
        assert (here.control.latch, here.control.driving.driver) == (False, None)


@in_virtual_time
async def test_a_move_without_beats_is_permitted_by_its_request_and_shown_to_everybody() -> None:
    for time_ms in (3000, 30_000):
        async with known() as here:
            page = Client(here.control)
            await begin(here, time_ms, beats=False)
            assert await unattended(here) == {
                "slot": None,
                "times": 1,
                "by": "Dance",
                "isMove": True,
                "endsInMs": pytest.approx(time_ms, abs=100),
            }
            await asyncio.sleep(time_ms / 1000)
            assert await unattended(here) is None
            shown = [message["unattended"] for message in await page.heard() if "unattended" in message]
            assert shown[-1] is None
            await asyncio.sleep(5)
            assert went_to_its_end(here)
            assert (here.control.latch, here.control.driving.driver) == (False, None)


@in_virtual_time
async def test_what_does_not_outlive_a_silence_is_not_shown() -> None:
    async with known() as here:
        await begin(here, 2000, beats=False)
        assert await unattended(here) is None


@in_virtual_time
async def test_a_stop_and_another_driver_end_what_is_shown() -> None:
    for ends in ("stop", "take"):
        async with known() as here:
            page = Client(here.control)
            await begin(here, beats=False)
            if ends == "stop":
                here.control.stop()
            else:
                here.control.driving.act(page, "take")
            await asyncio.sleep(0.5)
            assert await unattended(here) is None
            assert stops_s(here)


@in_virtual_time
async def test_the_permission_of_an_earlier_move_does_not_cover_one_with_beats() -> None:
    async with known() as here:
        await begin(here, 30_000, beats=False)
        await asyncio.sleep(1)
        await begin(here, servo=2)
        begun_s = now()
        await asyncio.sleep(5)
        assert stops_s(here)[0] == pytest.approx(begun_s + SILENT_S, abs=LATE_S)


@in_virtual_time
async def test_a_request_that_waits_is_the_heartbeat_of_its_program() -> None:
    async with known() as here:
        begun = await here.post("move", timeMs=LONG_MS, positions={"1": 2000}, beats=True, waitMs=60_000)
        assert begun.json()["ended"] is True
        await asyncio.sleep(5)
        assert went_to_its_end(here)
        assert not here.control.latch


@in_virtual_time
async def test_a_heartbeat_that_comes_before_the_silence_of_a_page_would_be_one_is_not_needed() -> None:
    """A page is stopped after 750 ms; a program beats once a second."""
    async with known() as here:
        await begin(here)
        await asyncio.sleep(1.9)
        assert stops_s(here) == []


async def with_gaps(here: Scripted, gaps_s: Sequence[float]) -> float | None:
    """The time at which it has to be stopped; None where it may go to its end."""
    await begin(here)
    ends_s = now() + LONG_MS / 1000
    for gap_s in gaps_s:
        last_s = now()
        await asyncio.sleep(gap_s)
        if gap_s > SILENT_S and last_s + SILENT_S < ends_s:
            return last_s + SILENT_S
        await beat(here)
    return None if now() + SILENT_S > ends_s else now() + SILENT_S


@in_virtual_time
async def test_for_any_beats_it_is_stopped_two_seconds_after_the_last_one_or_not_at_all() -> None:
    for seed in seeds(60):
        with named("test_beats.py", seed, "gaps"):
            chance = random.Random(seed)
            gaps_s = [chance.choice([0.1, 0.7, 1.0, 1.9, 2.2, 4.0]) for _ in range(chance.randint(0, 12))]
            async with known() as here:
                due_s = await with_gaps(here, gaps_s)
                await asyncio.sleep(LONG_MS / 1000 + 5)
                assert here.control.latch is (due_s is not None)
                assert here.control.driving.driver is None
                if due_s is None:
                    assert stops_s(here) == []
                else:
                    assert stops_s(here)[0] == pytest.approx(due_s, abs=LATE_S)
