"""A caller who is revoked, or may not drive any more, moves nothing from the gateway's answer on: what they
asked for ends before it.
"""

import asyncio
from typing import Any

import pytest
from fastapi import FastAPI
from httpx2 import Response

from servodeck.access.guard import Guard
from servodeck.api.websocket import take
from servodeck.errors import NotPairedError
from servodeck.intents import LeaseMessage, StopMessage
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Run
from servodeck.robot.scripts import Scripts
from tests.client import ANNA, Client
from tests.downloading import AnsweringPort
from tests.fake_port import FakePort
from tests.samples import DOWNLOAD, RUN, STOPS
from tests.scripted import Scripted, move, refusal, script
from tests.virtual_time import in_virtual_time

REVOKE, DEMOTE = "DELETE", "PATCH"
RUN_TWICE = encode(Run(8, 2), FAMILIES["doc"])


async def disconnect(here: Scripted, how: str, **params: Any) -> None:
    body = {"role": "viewer"} if how == DEMOTE else None
    path = f"/api/people/{here.token_id}"
    answer = await here.client.request(how, path, json=body, params=params, headers=here.owner)
    assert answer.status_code in (200, 204), answer.text


def scripts_of(here: Scripted) -> Scripts:
    app = here.app
    assert isinstance(app, Guard)
    assert isinstance(app.app, FastAPI)
    scripts = app.app.state.scripts
    assert isinstance(scripts, Scripts)
    return scripts


def begin(asked: Any) -> "asyncio.Task[Response]":
    return asyncio.create_task(asked)


@pytest.mark.parametrize("how", [REVOKE, DEMOTE])
@pytest.mark.parametrize("after_ms", [30, 80, 130, 150])
@in_virtual_time
async def test_a_run_that_waits_for_a_moves_end_ends_with_its_client(how: str, after_ms: int) -> None:
    async with script() as here:
        await here.move(3000, s1=2000)
        waiting = begin(here.post("slots/8/run"))
        await asyncio.sleep(after_ms / 1000)
        await disconnect(here, how)
        assert waiting.done()
        assert here.control.driving.driver is None
        await asyncio.sleep(2)
        assert RUN not in here.sent()
        assert here.control.driving.driver is None
        assert refusal(await waiting) == (409, "cancelled")


@pytest.mark.parametrize("how", [REVOKE, DEMOTE])
@in_virtual_time
async def test_first_moves_that_wait_for_the_one_before_end_before_the_answer(how: str) -> None:
    async with script() as here:
        waiting = begin(here.move(1500, s1=2000, s2=2000, s3=2000))
        await asyncio.sleep(0.1)
        await disconnect(here, how)
        assert waiting.done()
        await asyncio.sleep(2)
        assert here.sent()[0] == move(1500, s1=2000)
        assert move(1500, s2=2000) not in here.sent()


@in_virtual_time
async def test_what_was_read_before_and_asked_after_the_revocation_is_refused() -> None:
    async with script() as here:
        caller = here.entrance.devices.get(here.token_id).caller
        await disconnect(here, REVOKE)
        with pytest.raises(NotPairedError):
            scripts_of(here).act(caller, "request")
        assert here.control.driving.driver is None


@pytest.mark.parametrize("how", [REVOKE, DEMOTE])
@in_virtual_time
async def test_a_page_drops_its_packets_and_is_not_heard_before_the_answer(how: str) -> None:
    async with script() as here:
        page = Client(here.control, here.entrance.devices.get(here.token_id).caller)
        await page.send(move(1500, s1=2000))
        waiting = [page.send(move(1500, s1=1000 + each)) for each in range(3)]
        await disconnect(here, how)
        assert here.control.driving.driver is None
        take(LeaseMessage(type="lease", action="request"), page, here.control)
        assert here.control.driving.driver is None
        assert all(one.done() for one in waiting)
        already = len(here.sent())
        await asyncio.sleep(2)
        assert {packet[5:7] for packet in here.sent()[already:]}.isdisjoint({move(1500, s1=1000)[5:7]})


@pytest.mark.parametrize("how", ["release", "silence", REVOKE, DEMOTE])
@in_virtual_time
async def test_every_loss_of_the_lease_raises_the_epoch(how: str) -> None:
    async with script() as here:
        await here.move(1500, s1=2000)
        before = here.control.driving.lease.epoch
        if how == "release":
            await here.post("lease", action="release")
        elif how == "silence":
            await asyncio.sleep(60)
        else:
            await disconnect(here, how)
        assert here.control.driving.driver is None
        assert here.control.driving.lease.epoch == before + 1


@pytest.mark.parametrize("how", [REVOKE, DEMOTE])
@pytest.mark.parametrize("after_s", [0.5, 5])
@in_virtual_time
async def test_a_group_that_they_let_continue_is_stopped_in_the_owners_name(how: str, after_s: float) -> None:
    """Whether they still drive or not."""
    async with script() as here:
        anna = Client(here.control, ANNA)
        await here.post("slots/8/run", times=2, continueForMs=60_000)
        await asyncio.sleep(after_s)
        assert await unattended_slot(here) == 8
        await disconnect(here, how)
        assert here.control.board.unattended.snapshot() is None
        await asyncio.sleep(1)
        assert here.sent() == [RUN_TWICE, *STOPS]
        assert (here.control.latch, (await latest_state(anna))["stoppedBy"]) == (True, "Olga")


@pytest.mark.parametrize("after_s", [0.5, 5])
@in_virtual_time
async def test_the_owner_may_let_that_group_continue(after_s: float) -> None:
    async with script() as here:
        anna = Client(here.control, ANNA)
        await here.post("slots/8/run", times=2, continueForMs=60_000)
        await asyncio.sleep(after_s)
        await disconnect(here, REVOKE, continues=True)
        await asyncio.sleep(40)
        assert here.sent() == [RUN_TWICE]
        assert (await latest_state(anna))["unattended"]["by"] == "Dance"
        await asyncio.sleep(20)
        assert here.sent() == [RUN_TWICE, *STOPS]


@in_virtual_time
async def test_a_group_without_permission_to_continue_is_stopped_in_any_case() -> None:
    async with script() as here:
        await here.post("slots/8/run", times=2)
        await disconnect(here, REVOKE, continues=True)
        await asyncio.sleep(1)
        assert here.sent() == [RUN_TWICE, *STOPS]


@in_virtual_time
async def test_the_group_of_a_client_that_may_still_drive_continues_under_the_new_role() -> None:
    async with script() as here:
        await here.post("slots/8/run", times=2, continueForMs=60_000)
        await asyncio.sleep(5)
        path = f"/api/people/{here.token_id}"
        promoted = await here.client.patch(path, json={"role": "owner"}, headers=here.owner)
        assert promoted.status_code == 200
        await asyncio.sleep(1)
        assert here.sent() == [RUN_TWICE]
        assert (await unattended_slot(here)) == 8
        await disconnect(here, REVOKE)
        await asyncio.sleep(1)
        assert here.sent() == [RUN_TWICE, *STOPS]


@in_virtual_time
async def test_the_revocation_of_another_client_stops_nothing() -> None:
    async with script() as here:
        await here.move(3000, s1=2000)
        other, _ = here.entrance.devices.admit("device", "Bert", "driver")
        assert (await here.client.delete(f"/api/people/{other.id}", headers=here.owner)).status_code == 204
        await asyncio.sleep(0.5)
        assert here.sent() == [move(3000, s1=2000)]


FRAMES = [{"durationMs": 500, "positions": {"1": 1500}}]
STORES = {"slot": 8, "frames": FRAMES * 3}
ANSWERS_MS = [[180], [4], [46]]


def stored_by(port: FakePort) -> list[tuple[int, int]]:
    """Slot and frame of each frame that left."""
    return [(packet[4], packet[6]) for packet in port.packets() if packet[3] == DOWNLOAD[3]]


@pytest.mark.parametrize("how", [REVOKE, DEMOTE])
@pytest.mark.parametrize("by", ["script", "page"])
@in_virtual_time
async def test_their_download_ends_before_the_answer_and_its_slot_is_broken(how: str, by: str) -> None:
    async with script(behind=AnsweringPort([[180], [4], []])) as here:
        anna = Client(here.control, ANNA)
        nonce = None
        if by == "page":
            page = Client(here.control, here.entrance.devices.get(here.token_id).caller)
            here.control.driving.act(page, "request")
            nonce = page.nonce
        begun = await here.post("download", groups=[STORES], nonce=nonce)
        assert begun.status_code == 202
        await asyncio.sleep(0.3)
        assert stored_by(here.port) == [(8, 0), (8, 1), (8, 2)]
        await disconnect(here, how)
        found = here.control.board.jobs.find(begun.json()["id"])
        assert (found.status, found.code) == ("cancelled", "cancelled")
        state = await latest_state(anna)
        assert (state["brokenSlots"], state["latch"]) == ([8], False)
        await asyncio.sleep(10)
        assert stored_by(here.port) == [(8, 0), (8, 1), (8, 2)]


@in_virtual_time
async def test_of_their_groups_the_stored_ones_stay_and_those_behind_are_not_begun() -> None:
    async with script(behind=AnsweringPort(ANSWERS_MS * 3)) as here:
        await here.post("download", groups=[{**STORES, "slot": slot} for slot in (8, 3, 200)])
        await asyncio.sleep(0.4)
        await disconnect(here, REVOKE)
        board = here.control.board
        assert (board.broken_slots, list(board.slot_versions)) == ([3], ["8"])
        await asyncio.sleep(10)
        assert {slot for slot, _ in stored_by(here.port)} == {8, 3}


@in_virtual_time
async def test_a_download_continues_when_another_is_revoked_or_its_caller_may_still_drive() -> None:
    async with script(behind=AnsweringPort(ANSWERS_MS)) as here:
        other, _ = here.entrance.devices.admit("device", "Bert", "driver")
        begun = await here.post("download", groups=[STORES])
        assert (await here.client.delete(f"/api/people/{other.id}", headers=here.owner)).status_code == 204
        path = f"/api/people/{here.token_id}"
        assert (await here.client.patch(path, json={"role": "owner"}, headers=here.owner)).status_code == 200
        await asyncio.sleep(1)
        assert here.control.board.jobs.find(begun.json()["id"]).status == "done"


@in_virtual_time
async def test_only_its_client_adds_to_a_download() -> None:
    """It would end with them."""
    async with script(behind=AnsweringPort(ANSWERS_MS * 2)) as here:
        begun = (await here.post("download", groups=[STORES])).json()
        more = {"groups": [{**STORES, "slot": 3}], "behind": begun["id"]}
        added = await here.post("download", owner=True, take=True, **more)
        assert refusal(added) == (409, "notDriving")
        assert (await here.post("lease", action="take")).status_code == 403
        await here.post("lease", owner=True, action="release")
        assert (await here.post("download", **more)).json()["slots"] == [8, 3]


async def unattended_slot(here: Scripted) -> object:
    listed = (await here.client.get("/api/people", headers=here.owner)).json()["people"]
    return next(one["unattendedSlot"] for one in listed if one["id"] == here.token_id)


async def latest_state(session: Client) -> Any:
    return next(message for message in reversed(await session.heard()) if "unattended" in message)


@in_virtual_time
async def test_a_viewer_stops_the_robot_and_moves_nothing_with_it() -> None:
    async with script("viewer") as here:
        page = Client(here.control, here.entrance.devices.get(here.token_id).caller)
        take(StopMessage(type="stop"), page, here.control)
        await asyncio.sleep(1)
        assert here.sent() == STOPS
