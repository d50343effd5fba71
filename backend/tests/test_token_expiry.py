"""A token that expires is refused at every door and loses at that instant what it holds, as if it had been
revoked.
"""

import asyncio
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Never

import pytest
from fastapi import FastAPI

from servodeck.access.devices import EXPIRED, FILE, DeviceFile, Devices
from servodeck.access.expiry import LOOK_S, Expiry
from servodeck.access.guard import Guard
from servodeck.api.people import MAX_TOKEN_DAYS, MS_PER_DAY
from servodeck.api.robot import EventStream
from tests.client import Client
from tests.downloading import AnsweringPort
from tests.knocking import knock, scope_of
from tests.running import PORT
from tests.samples import MOVE, RUN, STOPS
from tests.scripted import Scripted, move, refusal, script
from tests.virtual_time import in_virtual_time, now

LATEST = 10_000


def clock_ms() -> int:
    return round(now() * 1000)


def expiry_of(here: Scripted) -> Expiry:
    assert isinstance(here.app, Guard)
    assert isinstance(here.app.app, FastAPI)
    expiry = here.app.app.state.expiry
    assert isinstance(expiry, Expiry)
    return expiry


def until_expiry(here: Scripted) -> float:
    expiry_of(here).plan()
    left_ms = here.entrance.devices.next_expiry_ms
    assert left_ms is not None
    return left_ms / 1000


@in_virtual_time
async def test_an_expired_token_is_refused_at_every_door_with_what_to_do() -> None:
    async with script(clock_ms=clock_ms, valid_ms=LATEST) as here:
        token = here.client.headers["authorization"].encode()
        headers = [(b"host", f"127.0.0.1:{PORT}".encode()), (b"authorization", token)]
        doors = [("http", "/api/status"), ("http", "/api/events"), ("websocket", "/ws"), ("http", "/metrics")]
        for kind, path in doors:
            assert await knock(here.app, scope_of(kind, "GET", path, headers)) in (101, 200), path
        await asyncio.sleep(until_expiry(here))
        for kind, path in doors:
            assert await knock(here.app, scope_of(kind, "GET", path, headers)) == 401, path
        refused = await here.post("move", timeMs=1500, positions={"1": 1000})
        assert refused.json() == {"code": "notPaired", "detail": EXPIRED}
        assert (await here.client.post("/api/stop")).status_code == 401


@pytest.mark.parametrize("after_s", [0.03, 0.1, 0.4])
@in_virtual_time
async def test_what_a_script_has_begun_ends_at_that_instant(after_s: float) -> None:
    async with script(clock_ms=clock_ms, valid_ms=LATEST) as here:
        await asyncio.sleep(until_expiry(here) - after_s)
        waiting = asyncio.create_task(here.move(1500, s1=2000, s2=2000, s3=2000))
        await asyncio.sleep(after_s)
        await asyncio.sleep(0.001)
        assert waiting.done()
        assert here.control.driving.driver is None
        assert here.control.latch
        already = len(here.sent())
        await asyncio.sleep(3)
        assert {packet[3] for packet in here.sent()[already:]} <= {STOPS[0][3], MOVE[3]}
        assert move(1500, s3=2000) not in here.sent()
        assert refusal(await waiting) == (409, "cancelled")
        assert here.control.driving.driver is None


@in_virtual_time
async def test_a_page_that_drives_by_it_is_sent_away_and_its_queue_is_empty() -> None:
    async with script(clock_ms=clock_ms, valid_ms=LATEST) as here:
        page = Client(here.control, here.entrance.devices.get(here.token_id).caller)
        stream = EventStream(page.caller, here.control, None)
        streaming = asyncio.create_task(stream(scope_of("http", "GET", "/api/events", []), never, ignored))
        await asyncio.sleep(until_expiry(here) - 0.02)
        await page.send(move(1500, s1=2000))
        waiting = [page.send(move(1500, s1=1000 + each)) for each in range(3)]
        await asyncio.sleep(0.02)
        await asyncio.sleep(0.001)
        assert all(one.done() for one in waiting)
        assert page.close_reason
        assert page.close_reason.reason == EXPIRED
        await streaming
        assert here.control.driving.driver is None
        assert not here.control.hub.holds(page.caller.id)
        already = len(here.sent())
        await asyncio.sleep(2)
        late = {packet[5:7] for packet in here.sent()[already:]}
        assert late.isdisjoint({move(1500, s1=1000)[5:7]})
        assert STOPS[0] in here.sent()


@in_virtual_time
async def test_a_run_that_it_let_continue_is_stopped() -> None:
    async with script(clock_ms=clock_ms, valid_ms=LATEST) as here:
        wait_s = until_expiry(here)
        await here.post("slots/8/run", times=1, continueForMs=60_000)
        begun_s = now()
        assert RUN in here.sent()
        await asyncio.sleep(wait_s - 0.01 - (begun_s - 0.1))
        assert here.control.board.unattended.snapshot()
        await asyncio.sleep(1)
        assert here.control.board.unattended.snapshot() is None
        assert here.control.latch
        assert here.sent()[1:4] == STOPS


@in_virtual_time
async def test_a_download_ends_with_its_token() -> None:
    async with script(behind=AnsweringPort(), clock_ms=clock_ms, valid_ms=LATEST) as here:
        frames = [{"durationMs": 500, "positions": {"1": 1500}}] * 255
        await asyncio.sleep(until_expiry(here) - 0.5)
        begun = await here.post("download", groups=[{"slot": 5, "frames": frames}])
        await asyncio.sleep(2)
        ended = here.control.board.jobs.find(begun.json()["id"])
        assert (ended.code, ended.detail) == ("cancelled", EXPIRED)


@in_virtual_time
async def test_owners_see_how_long_a_token_is_valid_and_remove_it() -> None:
    async with script(clock_ms=clock_ms) as here:
        made = await here.post("tokens", owner=True, name="Fair", role="driver", expiresInDays=1)
        made_ms = clock_ms()
        here.client.headers["authorization"] = f"Bearer {made.json()['token']}"
        assert (await here.client.get("/api/status")).status_code == 200
        assert await expires_in_ms(here, made.json()["id"]) == MS_PER_DAY - clock_ms() + made_ms
        await asyncio.sleep(MS_PER_DAY / 1000)
        assert await expires_in_ms(here, made.json()["id"]) == 0
        assert (await here.client.get("/api/status")).status_code == 401
        gone = await here.client.delete(f"/api/people/{made.json()['id']}", headers=here.owner)
        assert gone.status_code == 204
        unlimited = await here.post("tokens", owner=True, name="For good", role="viewer")
        assert await expires_in_ms(here, unlimited.json()["id"]) is None
        for days in (0, -1, MAX_TOKEN_DAYS + 1, 1.5):
            refused = await here.post("tokens", owner=True, name="x", role="viewer", expiresInDays=days)
            assert refusal(refused) == (422, "malformed"), days


async def expires_in_ms(here: Scripted, device: str) -> int | None:
    answer = (await here.client.get("/api/people", headers=here.owner)).json()
    [found] = [each["expiresInMs"] for each in answer["people"] if each["id"] == device]
    assert found is None or isinstance(found, int)
    return found


@in_virtual_time
async def test_a_clock_that_jumps_back_revives_no_token_and_one_that_jumps_ahead_ends_it() -> None:
    offset_ms = 0
    async with script(clock_ms=lambda: clock_ms() + offset_ms, valid_ms=LATEST) as here:
        page = Client(here.control, here.entrance.devices.get(here.token_id).caller)
        until_expiry(here)
        offset_ms = LATEST
        await asyncio.sleep(LOOK_S + 0.001)
        assert page.ended.is_set()
        offset_ms = -LATEST
        assert (await here.client.get("/api/status")).status_code == 401
        assert await expires_in_ms(here, here.token_id) == 0


async def test_an_expired_token_is_expired_after_a_restart_whatever_the_clock_says(tmp_path: Path) -> None:
    devices = Devices(DeviceFile(tmp_path), lambda: 100)
    made, credential = devices.admit("token", "Dance", "driver", valid_ms=0)
    assert [one.id for one in devices.expire()] == [made.id]
    assert devices.expire() == []
    await devices.save()
    again = Devices(DeviceFile(tmp_path), lambda: 0)
    assert again.role_of(made.id) is None
    with pytest.raises(Exception, match="expired"):
        again.find(credential)


VERSION_1 = """
CREATE TABLE device (id TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, role TEXT NOT NULL,
  digest BLOB NOT NULL, paired_at_ms INTEGER NOT NULL, last_seen_ms INTEGER);
INSERT INTO device VALUES ('aa', 'device', 'Anna', 'owner', x'00', 1, 2);
INSERT INTO device VALUES ('bb', 'token', 'Dance', 'driver', x'01', 3, NULL);
PRAGMA user_version = 1;
"""


async def test_a_file_of_version_1_is_read_and_becomes_one_of_version_2(tmp_path: Path) -> None:
    with closing(sqlite3.connect(tmp_path / FILE)) as db:
        db.executescript(VERSION_1)
    before = (tmp_path / FILE).read_bytes()
    devices = Devices(DeviceFile(tmp_path), lambda: 7)
    assert [(one.name, one.role, one.expires_at_ms) for one in devices.all] == [
        ("Anna", "owner", None),
        ("Dance", "driver", None),
    ]
    assert (tmp_path / FILE).read_bytes() == before
    devices.admit("token", "Fair", "viewer", valid_ms=5)
    await devices.save()
    found = {one.name: one for one in DeviceFile(tmp_path).load()}
    assert found.keys() == {"Anna", "Dance", "Fair"}
    assert (found["Anna"].last_seen_ms, found["Fair"].expires_at_ms) == (2, 12)


async def never() -> Never:
    await asyncio.Event().wait()
    raise AssertionError


async def ignored(_message: object) -> None:
    """Unread."""
