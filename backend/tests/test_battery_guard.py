"""New runs and plays while the battery is at its alarm, for every door of the gateway, in virtual time."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

import pytest

from servodeck.api.websocket import take
from servodeck.intents import PlayMessage, RunMessage, StopPlayingMessage
from servodeck.robot.board.battery_rule import RunLimit, verdict
from servodeck.robot.document import robot_facts
from servodeck.snapshots import RobotFacts
from tests.client import ANNA, Client
from tests.fake_port import FakePort
from tests.robots import care, robot_text
from tests.samples import BATTERY, RUN
from tests.scripted import Scripted, refusal, script
from tests.vectors import load_vectors
from tests.virtual_time import in_virtual_time

FRAMES: list[dict[str, Any]] = [{"durationMs": 1500, "positions": {"1": 1600}}]
TEN_MINUTES_S = 600


@pytest.mark.parametrize("each", load_vectors("batteryRule"), ids=lambda each: each["what"])
def test_the_rule(each: dict[str, Any]) -> None:
    found = each["limit"]
    limit = RunLimit(found["alarmMv"], found["ceilingMv"]) if found else None
    assert verdict(limit, each["batteryMv"], each["ageMs"]) == each["verdict"]


class Powered(FakePort):
    """Tells its battery, when asked; None: it does not answer."""

    battery_mv: int | None = 6500

    def write(self, data: bytes) -> Awaitable[None] | None:
        written = super().write(data)
        if data == BATTERY:
            asyncio.get_running_loop().call_later(0.02, self.tell)
        return written

    def tell(self) -> None:
        if self.battery_mv is not None:
            self.say(b"\x55\x55\x04\x0f" + self.battery_mv.to_bytes(2, "little"))

    def asked(self) -> int:
        return self.packets().count(BATTERY)


@asynccontextmanager
async def robot(
    policy: str = "refuse", battery_mv: int | None = 6500
) -> AsyncIterator[tuple[Scripted, Powered]]:
    """Its alarm is at 6.6 V."""
    port = Powered()
    port.battery_mv = battery_mv
    facts = robot_facts(robot_text(batteryCare=care(policy, 7000, 6600)), 0)

    def read(_document: str) -> tuple[RobotFacts, int]:
        return facts, 1

    async with script(behind=port, read_robot=read) as here:
        await here.control.robot.put("arm", None)
        yield here, port


def page_of(here: Scripted) -> Client:
    """The one that drives."""
    driver = here.control.driving.driver
    if isinstance(driver, Client):
        return driver
    page = Client(here.control, ANNA)
    here.control.driving.act(page, "request")
    return page


async def said_to(page: Client) -> dict[str, Any]:
    """The answer to a request."""
    await asyncio.sleep(2)
    [answer] = [one for one in await page.heard() if one["type"] in ("done", "refused", "play")][:1]
    return answer


async def by_http_run(here: Scripted, *, anyway: bool) -> str:
    answer = await here.post("slots/8/run", anyway=anyway)
    return "begun" if answer.status_code == 200 else str(answer.json()["code"])


async def by_http_play(here: Scripted, *, anyway: bool) -> str:
    answer = await here.post("play", frames=FRAMES, anyway=anyway)
    return "begun" if answer.status_code == 202 else str(answer.json()["code"])


async def by_page_run(here: Scripted, *, anyway: bool) -> str:
    page = page_of(here)
    message = RunMessage(type="run", id=1, slot=8, times=1, nonce=page.nonce, anyway=anyway)
    take(message, page, here.control)
    answer = await said_to(page)
    return "begun" if answer["type"] == "done" else str(answer["code"])


async def by_page_play(here: Scripted, *, anyway: bool) -> str:
    page = page_of(here)
    fields = {"type": "play", "id": 1, "nonce": page.nonce, "frames": FRAMES, "anyway": anyway}
    take(PlayMessage.model_validate(fields), page, here.control)
    answer = await said_to(page)
    return "begun" if answer["type"] == "play" else str(answer["code"])


async def by_packet(here: Scripted, *, anyway: bool) -> str:
    """Its one button is for those who know what they do; there is no other word beside it."""
    if anyway:
        return "begun"
    page = page_of(here)
    page.run(RUN)
    answer = await said_to(page)
    return "begun" if answer["type"] == "done" else str(answer["code"])


Door = Callable[..., Awaitable[str]]
DOORS = [by_http_run, by_http_play, by_page_run, by_page_play, by_packet]
every_door = pytest.mark.parametrize("door", DOORS, ids=lambda door: door.__name__)


def moved(here: Scripted) -> list[bytes]:
    """Runs and moves that left."""
    return [packet for packet in here.sent() if packet[3] in (3, 6)]


@every_door
@pytest.mark.parametrize("policy", ["refuse", "rest"])
def test_an_alarm_refuses_new_runs_until_a_person_says_anyway(door: Door, policy: str) -> None:
    @in_virtual_time
    async def each() -> None:
        async with robot(policy) as (here, _):
            assert await door(here, anyway=False) == "batteryLow"
            assert moved(here) == []
            assert await door(here, anyway=True) == "begun"

    each()


@every_door
@pytest.mark.parametrize(("policy", "battery_mv"), [("tell", 6500), ("refuse", 6650), ("refuse", None)])
def test_nothing_else_keeps_a_run_from_leaving(door: Door, policy: str, battery_mv: int | None) -> None:
    @in_virtual_time
    async def each() -> None:
        async with robot(policy, battery_mv) as (here, _):
            assert await door(here, anyway=False) == "begun"
            assert moved(here) != []

    each()


@in_virtual_time
async def test_the_last_reading_at_rest_counts_for_ten_minutes() -> None:
    async with robot(battery_mv=7600) as (here, port):
        port.tell()
        await asyncio.sleep(TEN_MINUTES_S - 1)
        port.battery_mv = 6500
        assert (await here.post("slots/8/run")).status_code == 200
        assert port.asked() == 0
        await here.post("lease", action="release")
        await asyncio.sleep(40)  # behind the longest frame that a stop lets end
        assert refusal(await here.post("slots/8/run")) == (409, "batteryLow")
        assert port.asked() == 1
        port.battery_mv = 7600
        await asyncio.sleep(60)
        assert refusal(await here.post("slots/8/run")) == (409, "batteryLow")
        await asyncio.sleep(TEN_MINUTES_S)
        assert (await here.post("slots/8/run")).status_code == 200


@in_virtual_time
async def test_a_reading_under_load_does_not_count() -> None:
    async with robot(battery_mv=7600) as (here, port):
        port.tell()
        await asyncio.sleep(1)
        await here.move(1500, s1=1600)
        port.battery_mv = 6500
        port.tell()
        await asyncio.sleep(3)
        assert here.control.board.battery.snapshot().model_dump()["batteryMv"] == 6500
        assert (await here.post("slots/8/run")).status_code == 200


@in_virtual_time
async def test_a_run_whose_battery_is_not_known_says_so() -> None:
    async with robot(battery_mv=None) as (here, port):
        answer = await here.post("slots/8/run")
        assert answer.json() == {"outcome": "silent", "batteryUnknown": True}
        assert port.asked() == 1
        await here.post("lease", action="release")
        await asyncio.sleep(40)
        played = await here.post("play", frames=FRAMES)
        assert played.json()["batteryUnknown"] is True


@in_virtual_time
async def test_a_stop_ends_a_play_that_waits_for_the_battery() -> None:
    async with robot(battery_mv=None) as (here, _):
        page = page_of(here)
        fields = {"type": "play", "id": 1, "nonce": page.nonce, "frames": FRAMES}
        take(PlayMessage.model_validate(fields), page, here.control)
        await asyncio.sleep(0.1)
        take(StopPlayingMessage(type="stopPlaying"), page, here.control)
        assert (await said_to(page))["code"] == "cancelled"
        assert moved(here) == []
