"""A word that a door does not know, and a name that is given twice, are refused by name: no default and no
last one is taken in silence.
"""

from typing import Any

import pytest
from httpx2 import AsyncClient, Response

from servodeck.errors import OutOfRangeError
from servodeck.protocol.values import ServoTarget
from tests.client import driven
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to
from tests.samples import STOP
from tests.scripted import script
from tests.virtual_time import in_virtual_time, now

JSON = {"content-type": "application/json"}
FRAMES = [{"durationMs": 1500, "positions": {"1": 1500}}]
BODIES: dict[str, dict[str, Any]] = {
    "/api/move": {"timeMs": 1500, "positions": {"1": 1500}},
    "/api/poses/home/apply": {},
    "/api/slots/8/run": {},
    "/api/play": {"frames": FRAMES},
    "/api/download": {"groups": [{"slot": 8, "frames": FRAMES}]},
}


def refusal(answer: Response) -> tuple[int, str, str]:
    body = answer.json()
    return answer.status_code, body["code"], body["detail"]


@in_virtual_time
@pytest.mark.parametrize("path", BODIES)
async def test_a_field_that_a_request_has_not_is_named(path: str) -> None:
    async with script() as here:
        for word in ("units", "mode", "loop"):
            answer = await here.client.post(path, json={**BODIES[path], word: "deg"})
            assert refusal(answer)[:2] == (422, "malformed")
            assert word in refusal(answer)[2]
        assert here.sent() == []


@in_virtual_time
async def test_a_servo_that_is_named_twice_in_a_request_is_named() -> None:
    async with script() as here:
        twice = '{"1": 1500, "2": 1500, "1": 900}'
        for path, text in (
            ("/api/move", f'{{"timeMs": 1500, "positions": {twice}}}'),
            ("/api/play", f'{{"frames": [{{"durationMs": 1500, "positions": {twice}}}]}}'),
        ):
            answer = await here.client.post(path, content=text, headers=JSON)
            assert refusal(answer) == (422, "malformed", "1 is given twice.")
        assert here.sent() == []


@in_virtual_time
async def test_a_servo_that_is_named_twice_in_a_move_of_a_page_is_named() -> None:
    async with driven() as (control, port, anna):
        targets = [ServoTarget(1, 1500), ServoTarget(2, 1500), ServoTarget(1, 900)]
        with pytest.raises(OutOfRangeError, match=r"Servo 1 is named twice\."):
            control.requests.move(anna, targets, 1500, anna.nonce)
        assert port.packets() == [STOP]


async def asked(client: AsyncClient, method: str, path: str) -> tuple[int, str, str]:
    return refusal(await client.request(method, path))


@in_virtual_time
async def test_a_parameter_behind_an_address_that_a_route_has_not_is_named() -> None:
    async with http_to(FakePorts(FakePort()), now) as (client, _):
        assert await asked(client, "GET", "/api/status?mode=long") == (
            422,
            "malformed",
            "mode is no parameter here, allowed: none",
        )
        assert await asked(client, "GET", "/api/audit?limt=5") == (
            422,
            "malformed",
            "limt is no parameter here, allowed: act, before, limit, who",
        )
        for path in ("move", "slots/5/run", "play", "download", "poses/home/apply", "erase", "resume"):
            assert await asked(client, "POST", f"/api/{path}?beats=true") == (
                422,
                "malformed",
                "beats is no parameter here, allowed: none",
            )
        assert (await client.get("/api/audit?limit=5")).status_code == 200
        assert (await client.get("/api/audit/file?format=xml")).status_code == 422


@in_virtual_time
async def test_a_stop_is_done_whatever_it_carries() -> None:
    async with http_to(FakePorts(FakePort()), now) as (client, control):
        answer = await client.post("/api/stop?mode=gentle", content='{"a": 1, "a": 2}', headers=JSON)
        assert (answer.status_code, control.latch) == (200, True)
