"""Downloads over HTTP: who may begin one, how it is looked at and called off, what is refused."""

import asyncio
import json
from typing import Any

import pytest

from servodeck.errors import NotFoundError
from tests.client import Client
from tests.downloading import AnsweringPort
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to
from tests.samples import STOP
from tests.test_jobs import PUPIL, SLOT, broken
from tests.virtual_time import in_virtual_time, now

FRAMES = [{"durationMs": 500, "positions": {"1": 1500}}]


def wish(frames: Any, slot: Any = SLOT) -> dict[str, Any]:
    return {"groups": [{"slot": slot, "frames": frames}]}


@in_virtual_time
async def test_a_script_begins_one_looks_at_it_and_calls_it_off() -> None:
    async with http_to(FakePorts(AnsweringPort([[180]])), now) as (client, control):
        begun = await client.post("/api/download", json=wish(FRAMES * 4))
        assert begun.status_code == 202
        job = begun.json()
        assert (job["slot"], job["status"], job["frameCount"]) == (SLOT, "running", 4)
        await asyncio.sleep(0.3)
        assert (await client.get(f"/api/jobs/{job['id']}")).json()["framesStored"] == 1
        await client.delete(f"/api/jobs/{job['id']}")
        await asyncio.sleep(1)
        found = (await client.get(f"/api/jobs/{job['id']}")).json()
        assert (found["status"], found["code"]) == ("cancelled", "cancelled")
        assert (await client.get("/api/jobs/other")).status_code == 404
        with pytest.raises(NotFoundError):
            control.board.jobs.cancel("other")


@in_virtual_time
async def test_over_http_only_the_driver_begins_one_and_the_job_needs_no_client_afterwards() -> None:
    async with http_to(FakePorts(AnsweringPort([[1500], [1500]] * 2)), now) as (client, control):
        path, body = "/api/download", wish(FRAMES * 2)
        anna = Client(control, PUPIL)
        control.driving.act(anna, "request")
        for each in (body, {**body, "nonce": anna.nonce}):
            refused = await client.post(path, json=each)
            assert (refused.status_code, refused.json()["code"]) == (409, "notDriving")
            assert "Anna drives" in refused.json()["detail"]
        taken = (await client.post(path, json={**body, "take": True})).json()
        assert taken["by"] == anna.lease["driver"] == "A script on this computer"
        await asyncio.sleep(2.1)
        assert anna.lease["driver"] is None
        assert (await client.get(f"/api/jobs/{taken['id']}")).json()["status"] == "running"
        await asyncio.sleep(2)
        page = Client(control)
        control.driving.act(page, "request")
        begun = await client.post(path, json={**body, "nonce": page.nonce})
        assert (begun.status_code, begun.json()["by"]) == (202, "This computer")
        assert page.lease["drives"] is True


@pytest.mark.parametrize(
    ("slot", "frames", "code"),
    [
        (300, FRAMES, "malformed"),
        ("8", FRAMES, "malformed"),
        (8, [], "malformed"),
        (8, [{"durationMs": 500, "positions": {"0": 1500}}], "malformed"),
        (8, [{"durationMs": 500, "positions": {"33": 1500}}], "outOfRange"),
        (8, [{"durationMs": 500, "positions": {"1": 2600}}], "outOfRange"),
        (8, [{"durationMs": 40_000, "positions": {}}], "outOfRange"),
        (8, [{"durationMs": 500, "positions": {}, "more": 1}], "malformed"),
    ],
)
@in_virtual_time
async def test_what_the_board_cannot_store_is_refused_before_anything_is_sent(
    slot: str, frames: Any, code: str
) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, control):
        answer = await client.post("/api/download", json=wish(frames, slot))
        assert (answer.status_code, answer.json()["code"]) == (422, code)
        assert (broken(control), set(port.packets()) - {STOP}) == ([], set())


@in_virtual_time
async def test_the_largest_group_there_is_fits_into_one_request() -> None:
    frame = {"durationMs": 30_000, "positions": {str(servo): 2500 for servo in range(1, 33)}}
    async with http_to(FakePorts(FakePort()), now) as (client, _):
        text = json.dumps(wish([frame] * 255), indent=1)
        headers = {"content-type": "application/json"}
        assert (await client.post("/api/download", content=text, headers=headers)).status_code == 202
        too_large = await client.post("/api/download", content=text * 5, headers=headers)
        assert too_large.status_code == 413
