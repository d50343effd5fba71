"""How often each paired device and token may ask over HTTP, and that a stop is never one too many."""

import asyncio

import pytest
from httpx2 import AsyncClient, Response

from servodeck.access import addresses
from servodeck.access.entrance import OF_DRIVERS, OF_VIEWERS, PAGE_BURST, Entrance
from servodeck.callers import Role
from tests.knocking import NOWHERE
from tests.running import PORT, entrance_to, http_to
from tests.test_people_api import Browser, lan, secret_of
from tests.virtual_time import in_virtual_time, now

RATES: dict[Role, tuple[float, int]] = {"viewer": OF_VIEWERS, "driver": OF_DRIVERS, "owner": OF_DRIVERS}


def token_for(entrance: Entrance, role: Role) -> dict[str, str]:
    _, token = entrance.devices.admit("token", "Script", role)
    return {"authorization": f"Bearer {token}"}


async def statuses(client: AsyncClient, count: int, headers: dict[str, str]) -> list[int]:
    return [(await client.get("/api/status", headers=headers)).status_code for _ in range(count)]


def is_too_many(answer: Response) -> bool:
    return (answer.status_code, answer.json()["code"]) == (429, "tooMany")


@pytest.mark.parametrize("role", RATES)
@in_virtual_time
async def test_a_token_has_a_rate_and_gets_a_time_to_retry(role: Role) -> None:
    per_second, burst = RATES[role]
    async with lan() as (entrance, client, _owner):
        headers, other = token_for(entrance, role), token_for(entrance, role)
        assert await statuses(client, burst, headers) == [200] * burst
        refused = await client.get("/api/status", headers=headers)
        assert is_too_many(refused)
        assert refused.headers["retry-after"] == "1"
        assert await statuses(client, 1, other) == [200]
        await asyncio.sleep(1)
        taken = round(per_second)
        assert await statuses(client, taken + 1, headers) == [200] * taken + [429]


@in_virtual_time
async def test_a_caller_above_its_rate_still_stops_and_pairs_and_gets_its_identity() -> None:
    async with lan() as (entrance, client, _owner):
        headers = token_for(entrance, "viewer")
        await statuses(client, 20, headers)
        for _ in range(50):
            assert (await client.post("/api/stop", headers=headers)).json()["code"] == "closed"  # latched
        assert (await client.get("/api/me", headers=headers)).status_code == 200
        assert is_too_many(await client.get("/api/battery", headers=headers))


@in_virtual_time
async def test_a_page_has_enough_at_once_for_a_library_of_a_hundred_robots() -> None:
    async with lan() as (_, client, owner):
        viewer = Browser(client)
        await viewer.pair(secret=secret_of((await owner.invite("viewer"))["link"]))
        answers = [(await viewer.ask("GET", "/api/status")).status_code for _ in range(PAGE_BURST)]
        assert answers == [200] * PAGE_BURST
        assert is_too_many(await viewer.ask("GET", "/api/status"))


@in_virtual_time
async def test_what_may_not_be_asked_is_refused_for_that_and_not_counted() -> None:
    async with lan() as (entrance, client, _owner):
        headers = token_for(entrance, "viewer")
        for _ in range(20):
            assert (await client.post("/api/resume", headers=headers)).status_code == 403
        assert await statuses(client, 1, headers) == [200]


@in_virtual_time
async def test_this_computer_is_not_counted() -> None:
    async with http_to(NOWHERE, now, device=None, entrance=entrance_to(addresses.local(PORT), now)) as (
        client,
        _,
    ):
        assert await statuses(client, 300, {}) == [200] * 300
