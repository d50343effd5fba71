"""Frames that the gateway plays for a script, or for a page whose group does not fit into a message."""

import asyncio
from typing import Any

from servodeck.callers import THIS_COMPUTER
from servodeck.protocol.packets import parse_command
from servodeck.protocol.values import Move
from servodeck.robot.lease import SILENT_S
from tests.client import Client
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to
from tests.samples import MOVE, STOP, STOPS
from tests.scripted import Scripted, move, refusal, script
from tests.virtual_time import in_virtual_time, now

FRAMES = [
    {"durationMs": 200, "positions": {"1": 1000}},
    {"durationMs": 400, "positions": {"1": 2000}},
]
LEAD, SECOND, AGAIN = move(1500, s1=1000), move(400, s1=2000), move(200, s1=1000)


async def latest(here: Scripted) -> Any:
    return (await here.client.get("/api/status")).json()["play"]


@in_virtual_time
async def test_a_script_has_frames_played_looks_how_far_it_is_and_how_it_ended() -> None:
    async with script() as here:
        begun = await here.post("play", frames=FRAMES, times=2)
        assert (begun.status_code, begun.json()["status"], begun.json()["by"]) == (202, "playing", "Dance")
        await asyncio.sleep(1.6)
        assert (await latest(here))["frameIndex"] == 1
        assert (await here.client.get("/api/status")).json()["driver"] == "Dance"
        await here.post("lease", action="heartbeat")
        await asyncio.sleep(1.5)
        assert here.sent() == [LEAD, SECOND, AGAIN, SECOND]
        ended = await latest(here)
        assert (ended["id"], ended["status"]) == (begun.json()["id"], "done")


@in_virtual_time
async def test_without_a_heartbeat_it_is_stopped_after_two_seconds_and_latched() -> None:
    async with script() as here:
        begun_s = now()
        await here.post("play", frames=FRAMES, times=0)
        await asyncio.sleep(SILENT_S - 0.05)
        assert here.control.latch is False
        await asyncio.sleep(0.5)
        stopped_s = next(at_s for at_s, packet in here.port.written if packet == STOP and at_s > begun_s)
        assert stopped_s - begun_s <= SILENT_S + 0.02
        assert (here.control.latch, (await latest(here))["code"]) == (True, "latched")
        await asyncio.sleep(1)  # the hold again, behind as many stops as a board can miss
        count = len(here.port.written)
        await asyncio.sleep(5)
        assert len(here.port.written) == count


@in_virtual_time
async def test_it_may_continue_without_a_heartbeat_for_as_long_as_was_allowed_and_everybody_sees_it() -> None:
    async with script() as here:
        await here.post("play", frames=FRAMES, times=0, continueForMs=10_000)
        await asyncio.sleep(8)
        status = (await here.client.get("/api/status")).json()
        assert (status["driver"], status["play"]["status"]) == (None, "playing")
        assert status["unattended"] == {
            "slot": None,
            "times": 0,
            "by": "Dance",
            "endsInMs": 2000,
            "isMove": False,
        }
        await asyncio.sleep(3)
        assert (await latest(here))["status"] == "ended"
        assert here.control.latch is False
        assert [packet for packet in here.sent() if packet == STOP] == STOPS
        assert (await here.client.get("/api/status")).json()["unattended"] is None


@in_virtual_time
async def test_the_next_driver_ends_an_unattended_play() -> None:
    async with script() as here:
        await here.post("play", frames=FRAMES, times=0, continueForMs=60_000)
        await asyncio.sleep(5)
        page = Client(here.control)
        await page.send(MOVE)
        assert (await latest(here))["status"] == "ended"
        assert here.sent()[-1] == MOVE


@in_virtual_time
async def test_letting_go_ends_it_without_the_latch_and_so_does_delete() -> None:
    async with script() as here:
        await here.post("play", frames=FRAMES, times=0)
        await here.post("lease", action="release")
        assert ((await latest(here))["code"], here.control.latch) == ("notDriving", False)
        await asyncio.sleep(1)
        await here.post("play", frames=FRAMES, times=0)
        await asyncio.sleep(0.1)
        ended = (await here.client.delete("/api/play")).json()
        assert (ended["status"], ended["code"], here.control.latch) == ("ended", "cancelled", False)
        count = len(here.port.written)
        await asyncio.sleep(1.5)
        assert len(here.port.written) == count


@in_virtual_time
async def test_one_thing_at_a_time_and_each_refusal_says_what_is_in_the_way() -> None:
    async with script(role="owner") as here:
        await here.post("play", frames=FRAMES, times=0)
        for refused in (
            await here.post("play", frames=FRAMES),
            await here.post("slots/8/run"),
            await here.post("download", groups=[{"slot": 5, "frames": FRAMES}]),
        ):
            assert refusal(refused) == (409, "busy")
            assert "Dance plays a group" in refused.json()["detail"]
        assert refusal(await here.post("erase")) == (409, "busy")
        await here.client.delete("/api/play")
        await asyncio.sleep(1)
        await here.post("slots/8/run")
        assert refusal(await here.post("play", frames=FRAMES)) == (409, "busy")


@in_virtual_time
async def test_an_owner_takes_the_lease_for_it_and_what_moved_is_held_first() -> None:
    async with script(role="owner") as here:
        page = Client(here.control)
        await page.send(MOVE)
        assert refusal(await here.post("play", frames=FRAMES)) == (409, "notDriving")
        assert (await here.post("play", frames=FRAMES, take=True)).status_code == 202
        await asyncio.sleep(2.5)
        of_play = here.sent().index(LEAD)
        assert here.sent()[1:of_play].count(STOP) == 3
        assert here.sent()[of_play:] == [LEAD, SECOND]


@in_virtual_time
async def test_who_is_not_let_in_any_more_is_stopped_unless_an_owner_lets_it_continue() -> None:
    for goes_on in (False, True):
        async with script() as here:
            await here.post("play", frames=FRAMES, times=0, continueForMs=60_000)
            await asyncio.sleep(2.5)
            path = f"/api/people/{here.token_id}?continues={'true' if goes_on else 'false'}"
            assert (await here.client.delete(path, headers=here.owner)).status_code == 204
            count = len(here.port.written)
            await asyncio.sleep(2)
            behind = [parse_command(packet) for packet in here.port.packets()[count:]]
            assert (here.control.board.plays.present is not None) is goes_on
            assert here.control.latch is not goes_on
            assert goes_on or sum(isinstance(command, Move) for command in behind) <= 4


@in_virtual_time
async def test_what_no_board_takes_is_refused_before_anything_leaves() -> None:
    async with script() as here:
        too_far = [*FRAMES, {"durationMs": 400, "positions": {"1": 9000}}]
        refused = await here.post("play", frames=too_far)
        assert refusal(refused) == (422, "outOfRange")
        assert "position of servo 1 is 9000" in refused.json()["detail"]
        assert refusal(await here.post("play", frames=[])) == (422, "malformed")
        assert refusal(await here.post("play", frames=FRAMES, loopFrom=2)) == (422, "outOfRange")
        await here.post("stop")
        assert refusal(await here.post("play", frames=FRAMES)) == (409, "latched")
        assert here.sent() == STOPS


@in_virtual_time
async def test_a_large_group_of_the_page_that_drives_comes_over_http_and_is_answered_on_its_socket() -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, control):
        await asyncio.sleep(0.1)
        page = Client(control)
        control.driving.act(page, "request")
        many = [{"durationMs": 20, "positions": {str(servo): 1500 for servo in range(1, 33)}}] * 255
        body = {"frames": many, "id": 3, "nonce": page.nonce}
        begun = await client.post("/api/play", json=body)
        assert (begun.status_code, begun.json()["frameCount"]) == (202, 255)
        await client.delete("/api/play")
        [played] = [message for message in await page.heard() if message["type"] == "played"]
        assert (played["id"], played["play"]["id"]) == (3, begun.json()["id"])
        assert refusal(await client.post("/api/play", json=body | {"id": None})) == (422, "malformed")
        await asyncio.sleep(0.6)
        assert refusal(await client.post("/api/play", json=body)) == (409, "expired")
        control.driving.act(page, "release")
        assert refusal(await client.post("/api/play", json=body)) == (409, "notDriving")
        assert page.caller is THIS_COMPUTER
