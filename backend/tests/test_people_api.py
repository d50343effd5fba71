"""How people come in over HTTP, what owners see and change, and who is sent away."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import pytest
from httpx2 import AsyncClient, Response

from servodeck.access import addresses
from servodeck.access.entrance import Entrance
from servodeck.callers import Caller, Role
from servodeck.intents import LeaseAction
from servodeck.robot.control import Control
from tests.client import Client
from tests.knocking import NOWHERE
from tests.running import PORT, entrance_to, http_to
from tests.virtual_time import in_virtual_time, now

BASE = f"http://127.0.0.1:{PORT}"
PAGE = {"origin": BASE}
COOKIE = f"servodeck_{PORT}"


class Browser:
    """A page on a device of its own, as far as headers and cookies go."""

    def __init__(self, client: AsyncClient) -> None:
        self._client = client
        self.cookie: str | None = None

    async def ask(self, method: str, path: str, **more: Any) -> Response:
        headers = dict(PAGE) | ({"cookie": f"{COOKIE}={self.cookie}"} if self.cookie else {})
        answer = await self._client.request(method, path, headers=headers, **more)
        if COOKIE in answer.cookies:
            self.cookie = answer.cookies[COOKIE]
        self._client.cookies.clear()
        return answer

    async def pair(self, **wish: str) -> Response:
        return await self.ask("POST", "/api/pair", json=wish)

    async def you(self) -> Any:
        return (await self.ask("GET", "/api/me")).json()["you"]

    async def invite(self, role: Role, name: str = "") -> dict[str, str]:
        answer = await self.ask("POST", "/api/invites", json={"role": role, "name": name})
        assert answer.status_code == 200
        made: dict[str, str] = answer.json()
        return made


def secret_of(link: str) -> str:
    return link.partition("=")[2]


@asynccontextmanager
async def lan() -> AsyncIterator[tuple[Entrance, AsyncClient, Browser]]:
    """A gateway on a LAN and its owner's browser."""
    async with lan_with_control() as (entrance, client, owner, _):
        yield entrance, client, owner


@asynccontextmanager
async def lan_with_control() -> AsyncIterator[tuple[Entrance, AsyncClient, Browser, Control]]:
    entrance = entrance_to(addresses.lan(PORT, "robot"), now)
    async with http_to(NOWHERE, now, device=None, entrance=entrance) as (client, control):
        owner = Browser(client)
        invite = entrance.pairing.invite("owner", "Anna")
        assert (await owner.pair(secret=invite.secret)).json()["role"] == "owner"
        yield entrance, client, owner, control


@in_virtual_time
async def test_a_stranger_sees_that_and_no_more() -> None:
    async with lan() as (_, client, _owner):
        stranger = Browser(client)
        assert (await stranger.ask("GET", "/api/me")).json() == {
            "mode": "lan",
            "overheard": True,
            "you": None,
            "pages": [],
        }
        refused = await stranger.ask("GET", "/api/status")
        assert (refused.status_code, refused.json()["code"]) == (401, "notPaired")


@in_virtual_time
async def test_a_link_lets_one_device_in_with_role_and_name() -> None:
    async with lan() as (_, client, owner):
        made = await owner.invite("driver", "Ben")
        assert made["link"].startswith("http://")
        assert made["picture"].startswith("data:image/svg+xml")
        ben, late = Browser(client), Browser(client)
        entered = await ben.pair(secret=secret_of(made["link"]), name="Bertram")
        assert entered.json() == await ben.you()
        assert entered.json()["name"] == "Ben"
        cookie = entered.headers["set-cookie"]
        assert "HttpOnly" in cookie
        assert "SameSite=strict" in cookie
        assert "Path=/" in cookie
        assert "Secure" not in cookie
        refused = await late.pair(secret=secret_of(made["link"]))
        assert (refused.status_code, refused.json()["code"]) == (403, "pairingFailed")
        assert await late.you() is None
        assert (await ben.ask("POST", "/api/resume")).status_code == 200
        assert (await ben.ask("GET", "/api/people")).status_code == 403


@in_virtual_time
async def test_a_code_pairs_once_and_a_device_without_a_name_sends_its_own() -> None:
    async with lan() as (_, client, owner):
        made = await owner.invite("viewer")
        ben = Browser(client)
        assert (await ben.pair(code=made["code"], name="Ben")).json()["name"] == "Ben"
        again = await Browser(client).pair(code=made["code"])
        assert (again.status_code, again.json()["code"]) == (403, "pairingFailed")


@in_virtual_time
async def test_after_five_wrong_codes_the_right_one_counts_no_more() -> None:
    async with lan() as (_, client, owner):
        made = await owner.invite("viewer")
        guess = "00000000" if made["code"] != "00000000" else "11111111"
        codes = [(await Browser(client).pair(code=guess)).json()["code"] for _ in range(5)]
        assert codes == ["pairingFailed"] * 4 + ["pairingLocked"]
        refused = await Browser(client).pair(code=made["code"])
        assert (refused.status_code, refused.json()["code"]) == (429, "pairingLocked")
        people = (await owner.ask("GET", "/api/people")).json()
        assert (people["openInvites"], people["openCodes"]) == ([made["id"]], [])
        assert (await Browser(client).pair(secret=secret_of(made["link"]))).status_code == 200


@in_virtual_time
async def test_an_invitation_ends_after_two_minutes_or_when_it_is_withdrawn() -> None:
    async with lan() as (_, client, owner):
        first, second = await owner.invite("viewer"), await owner.invite("viewer")
        assert (await owner.ask("DELETE", f"/api/invites/{second['id']}")).status_code == 204
        people = (await owner.ask("GET", "/api/people")).json()
        assert people["openInvites"] == people["openCodes"] == [first["id"]]
        await asyncio.sleep(121)
        for made in (first, second):
            assert (await Browser(client).pair(secret=secret_of(made["link"]))).status_code == 403


@in_virtual_time
async def test_who_may_as_much_already_stays_and_leaves_the_invitation_to_others() -> None:
    async with lan() as (entrance, client, owner):
        made = await owner.invite("viewer", "Ben")
        before = await owner.you()
        assert (await owner.pair(secret=secret_of(made["link"]))).json() == before
        ben = Browser(client)
        await ben.pair(secret=secret_of(made["link"]))
        promoted = await owner.invite("driver")
        await ben.pair(secret=secret_of(promoted["link"]), name="Linux")
        assert (await ben.you())["role"] == "driver"
        assert [device.name for device in entrance.devices.all] == ["Anna", "Ben"]


@in_virtual_time
async def test_owners_rename_promote_and_revoke() -> None:
    async with lan() as (_, client, owner):
        ben = Browser(client)
        await ben.pair(secret=secret_of((await owner.invite("viewer", "Ben"))["link"]))
        path = f"/api/people/{(await ben.you())['id']}"
        changed = await owner.ask("PATCH", path, json={"name": "Bert", "role": "driver"})
        assert (changed.json()["name"], changed.json()["role"]) == ("Bert", "driver")
        assert (await ben.you())["role"] == "driver"
        for wrong in ({"role": "stopper"}, {"name": ""}, {"name": "a\nb"}, {"name": "x" * 65}, {"more": 1}):
            assert (await owner.ask("PATCH", path, json=wrong)).status_code == 422
        assert (await owner.ask("DELETE", path)).status_code == 204
        assert await ben.you() is None
        assert (await owner.ask("DELETE", path)).status_code == 404
        last = await owner.ask("DELETE", f"/api/people/{(await owner.you())['id']}")
        assert (last.status_code, last.json()["code"]) == (403, "forbidden")


@in_virtual_time
async def test_everybody_says_their_own_name_and_nothing_of_theirs_ends_by_it() -> None:
    async with lan_with_control() as (entrance, client, owner, control):
        ben = Browser(client)
        await ben.pair(secret=secret_of((await owner.invite("driver"))["link"]), name="Android")
        device = (await ben.you())["id"]
        entered = next(one for one in entrance.devices.all if one.id == device)
        session, other = Client(control, entered.caller), Client(control, Caller("x", "Cleo", "viewer"))
        control.driving.act(session, "request")
        said = await ben.ask("PATCH", "/api/me", json={"name": "Ben"})
        assert said.json() == await ben.you() == {"id": device, "name": "Ben", "role": "driver"}
        assert other.lease["driver"] == "Ben"
        renamed = await owner.ask("PATCH", f"/api/people/{device}", json={"name": "Benno"})
        assert renamed.json()["name"] == other.lease["driver"] == "Benno"
        assert not session.ended.is_set()
        await owner.ask("PATCH", f"/api/people/{device}", json={"role": "viewer"})
        assert session.ended.is_set()
        for wrong in ({"name": ""}, {"name": "a\nb"}, {"name": "x" * 65}, {"name": "Ben", "role": "owner"}):
            assert (await ben.ask("PATCH", "/api/me", json=wrong)).status_code == 422


@in_virtual_time
async def test_a_script_and_a_stop_only_link_keep_the_name_that_an_owner_gave_them() -> None:
    async with lan() as (_, client, owner):
        made = (await owner.ask("POST", "/api/tokens", json={"name": "Script", "role": "owner"})).json()
        bearer = {"authorization": f"Bearer {made['token']}"}
        refused = await client.patch("/api/me", json={"name": "Anna"}, headers=bearer)
        assert (refused.status_code, refused.json()["code"]) == (403, "forbidden")
        link = (await owner.ask("POST", "/api/stop-links", json={"name": "On the robot"})).json()["link"]
        passer = Browser(client)
        await passer.pair(stop=secret_of(link))
        assert (await passer.ask("PATCH", "/api/me", json={"name": "Anna"})).status_code == 403


@in_virtual_time
async def test_a_token_has_a_fixed_role_and_is_shown_once() -> None:
    async with lan() as (_, client, owner):
        made = (await owner.ask("POST", "/api/tokens", json={"name": "Script", "role": "viewer"})).json()
        bearer = {"authorization": f"Bearer {made['token']}"}
        assert (await client.get("/api/status", headers=bearer)).status_code == 200
        assert (await client.post("/api/resume", headers=bearer)).status_code == 403
        assert made["token"] not in (await owner.ask("GET", "/api/people")).text
        await owner.ask("DELETE", f"/api/people/{made['id']}")
        assert (await client.get("/api/status", headers=bearer)).status_code == 401


@in_virtual_time
async def test_over_http_too_only_the_driver_or_an_owner_resumes() -> None:
    async with lan_with_control() as (_, client, owner, control):
        wish = {"name": "Grader", "role": "driver"}
        token = (await owner.ask("POST", "/api/tokens", json=wish)).json()["token"]
        bearer = {"authorization": f"Bearer {token}"}
        anna = Client(control, Caller("anna", "Anna", "driver"))
        control.driving.act(anna, "request")
        await client.post("/api/stop", headers=bearer)
        [*_, state] = [message for message in await anna.heard() if message["type"] == "state"]
        assert (state["latchedBy"], state["stoppedBy"]) == ("person", "Grader")
        refused = await client.post("/api/resume", headers=bearer)
        assert (refused.status_code, refused.json()) == (
            409,
            {"code": "notDriving", "detail": "Anna drives: only Anna or an owner may resume."},
        )
        assert control.latch is True
        assert (await owner.ask("POST", "/api/resume")).json()["latch"] is False


@in_virtual_time
async def test_the_list_says_who_drives() -> None:
    async with lan_with_control() as (entrance, _, owner, control):
        ben, _secret = entrance.devices.admit("device", "Ben", "driver")
        session = Client(control, ben.caller)
        actions: list[tuple[LeaseAction, list[str]]] = [("request", ["Ben"]), ("release", [])]
        for action, drives in actions:
            control.driving.act(session, action)
            listed = (await owner.ask("GET", "/api/people")).json()["people"]
            assert [one["name"] for one in listed if one["drives"]] == drives


@in_virtual_time
async def test_a_stop_only_link_stops_and_does_nothing_else_for_any_number_of_people() -> None:
    async with lan() as (_, client, owner):
        made = (await owner.ask("POST", "/api/stop-links", json={"name": "On the robot"})).json()
        first, second = Browser(client), Browser(client)
        for anyone in (first, second):
            assert (await anyone.pair(stop=secret_of(made["link"]))).json()["role"] == "stopper"
            assert (await anyone.ask("POST", "/api/stop")).json()["code"] == "closed"  # no port: latched
            for method, path in (("GET", "/api/status"), ("POST", "/api/resume"), ("GET", "/api/people")):
                assert (await anyone.ask(method, path)).status_code == 403
        assert (await owner.pair(stop=secret_of(made["link"]))).json()["role"] == "owner"
        await owner.ask("DELETE", f"/api/people/{made['id']}")
        assert (await first.ask("POST", "/api/stop")).status_code == 401
        assert (await Browser(client).pair(stop=secret_of(made["link"]))).status_code == 403


@in_virtual_time
async def test_a_token_or_a_cookie_is_no_stop_only_link() -> None:
    async with lan() as (_, client, owner):
        assert owner.cookie
        assert (await Browser(client).pair(stop=owner.cookie)).status_code == 403


@in_virtual_time
async def test_behind_a_proxy_the_cookie_is_for_https_only() -> None:
    entrance = entrance_to(addresses.behind_proxy("https://robot.example"))
    async with http_to(NOWHERE, now, device=None, entrance=entrance) as (client, _):
        invite = entrance.pairing.invite("owner", "Anna")
        headers = {"host": "robot.example", "origin": "https://robot.example", "x-forwarded-for": "1.2.3.4"}
        answer = await client.post("/api/pair", json={"secret": invite.secret}, headers=headers)
        assert answer.headers["set-cookie"].startswith("__Host-servodeck=")
        assert "Secure" in answer.headers["set-cookie"]
        assert "connect-src 'self' wss://robot.example;" in answer.headers["content-security-policy"]
        assert answer.json()["role"] == "owner"


@pytest.mark.parametrize("wish", [{}, {"code": "1234567"}, {"code": "1234567x"}, {"secret": "x" * 201}])
@in_virtual_time
async def test_what_cannot_be_a_way_in_is_malformed(wish: dict[str, str]) -> None:
    async with lan() as (_, client, _owner):
        assert (await Browser(client).pair(**wish)).status_code == 422
