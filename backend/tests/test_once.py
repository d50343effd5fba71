"""A repeated request with an Idempotency-Key gets the first answer, and nothing moves again."""

import asyncio
import json
from typing import Any

import pytest
from httpx2 import Response
from starlette.types import Message

from servodeck.api import once
from servodeck.callers import THIS_COMPUTER
from tests.knocking import scope_of
from tests.running import PORT
from tests.samples import RUN, STOPS
from tests.scripted import RUN_TAKEN, Scripted, move, refusal, script
from tests.test_gate import headers_of
from tests.virtual_time import at, in_virtual_time, now

TO_2000 = {"timeMs": 1500, "positions": {"1": 2000}}
FRAMES = [{"durationMs": 1500, "positions": {"1": 1500}}]


async def post(here: Scripted, path: str, key: str, body: dict[str, Any], *, owner: bool = False) -> Response:
    headers = {"idempotency-key": key} | (here.owner if owner else {})
    return await here.client.post(f"/api/{path}", json=body, headers=headers)


@in_virtual_time
async def test_a_repeat_gets_the_first_answer_for_ten_minutes_and_moves_nothing() -> None:
    async with script() as here:
        first = await post(here, "move", "a", TO_2000)
        assert first.json() == {"packets": 1, "overInMs": 1500, "firstMoves": [1]}
        await asyncio.sleep(599)
        repeat = await post(here, "move", "a", TO_2000)
        assert (repeat.status_code, repeat.json()) == (200, first.json())
        assert repeat.headers["content-type"] == "application/json"
        assert here.sent() == [move(1500, s1=2000)]
        await asyncio.sleep(2)
        assert (await post(here, "move", "a", TO_2000)).json()["firstMoves"] == []
        assert len(here.sent()) == 2


@in_virtual_time
async def test_repeats_at_the_same_time_wait_for_the_one_answer() -> None:
    async with script() as here:
        body = {"timeMs": 2000, "positions": {"1": 2000, "2": 2000, "3": 2000}}
        answers = await asyncio.gather(*(post(here, "move", "a", body) for _ in range(5)))
        assert {answer.text for answer in answers} == {'{"packets":3,"overInMs":2000,"firstMoves":[1,2,3]}'}
        assert len(here.sent()) == 3


@in_virtual_time
async def test_a_group_is_run_once_and_each_repeat_gets_the_outcome_of_the_board() -> None:
    async with script() as here:
        at(now() + 0.05, lambda: here.port.say(RUN_TAKEN))
        answers = await asyncio.gather(*(post(here, "slots/8/run", "a", {}) for _ in range(3)))
        assert [answer.json()["outcome"] for answer in answers] == ["acknowledged"] * 3
        assert here.sent() == [RUN]


@in_virtual_time
async def test_downloads_and_plays_begin_once() -> None:
    wave = {"groups": [{"slot": 5, "frames": FRAMES}]}
    async with script() as here:
        jobs = [await post(here, "download", "a", wave) for _ in range(2)]
        assert [answer.status_code for answer in jobs] == [202, 202]
        assert jobs[0].json() == jobs[1].json()
    async with script() as here:
        played = [await post(here, "play", "b", {"frames": FRAMES}) for _ in range(2)]
        assert [answer.status_code for answer in played] == [202, 202]
        assert played[0].json() == played[1].json()


@in_virtual_time
async def test_a_key_with_another_body_or_address_is_refused_with_a_code() -> None:
    async with script() as here:
        await post(here, "move", "a", TO_2000)
        other = await post(here, "move", "a", TO_2000 | {"timeMs": 1600})
        assert refusal(other) == (422, "malformed")
        assert "Idempotency-Key" in other.json()["detail"]
        assert refusal(await post(here, "slots/8/run", "a", TO_2000)) == (422, "malformed")
        assert here.sent() == [move(1500, s1=2000)]


@in_virtual_time
async def test_keys_are_of_one_caller_each() -> None:
    async with script() as here:
        await post(here, "move", "a", TO_2000)
        refused = await post(here, "move", "a", TO_2000, owner=True)
        assert refusal(refused) == (409, "notDriving")


@in_virtual_time
async def test_a_refusal_is_repeated_too_so_that_nothing_moves_by_surprise_after_a_resume() -> None:
    async with script() as here:
        here.control.stop()
        refused = await post(here, "move", "a", TO_2000)
        assert refusal(refused) == (409, "latched")
        here.control.resume(THIS_COMPUTER)
        repeat = await post(here, "move", "a", TO_2000)
        assert (repeat.status_code, repeat.json()) == (409, refused.json())
        await asyncio.sleep(0.5)
        assert here.sent() == STOPS


@in_virtual_time
async def test_a_request_that_cannot_be_read_does_not_use_up_its_key() -> None:
    async with script() as here:
        assert refusal(await post(here, "move", "a", TO_2000 | {"speed": 3})) == (422, "malformed")
        assert (await post(here, "move", "a", TO_2000)).status_code == 200


@pytest.mark.parametrize("key", ["", "a b", "x" * 65, "a/b"])
@in_virtual_time
async def test_a_key_of_another_shape_is_refused(key: str) -> None:
    async with script() as here:
        assert refusal(await post(here, "move", key, TO_2000)) == (422, "malformed")
        assert here.sent() == []


@in_virtual_time
async def test_the_memory_is_bounded_and_no_key_is_forgotten_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(once, "MOST_OF_ONE", 2)
    async with script() as here:
        for key in ("a", "b"):
            await post(here, "move", key, TO_2000)
        assert refusal(await post(here, "move", "c", TO_2000)) == (429, "busy")
        assert (await here.move(1500, s1=1000)).status_code == 200
        assert (await post(here, "move", "a", TO_2000)).status_code == 200
        assert here.sent() == [move(1500, s1=2000)] * 2 + [move(1500, s1=1000)]
        await asyncio.sleep(601)
        assert (await post(here, "move", "c", TO_2000)).status_code == 200


@in_virtual_time
async def test_a_request_whose_repeat_waits_is_carried_out_although_its_own_connection_is_lost() -> None:
    async with script() as here:
        body = {"timeMs": 1500, "positions": {"1": 2000, "2": 2000, "3": 2000}}
        text = json.dumps(body, separators=(",", ":")).encode()
        headers = [*headers_of(f"localhost:{PORT}", None), (b"content-type", b"application/json")]
        token = here.client.headers["authorization"].encode()
        headers += [(b"authorization", token), (b"idempotency-key", b"a")]
        heard, hung_up = [{"type": "http.request", "body": text}], asyncio.Event()

        async def receive() -> Message:
            if not heard:
                await hung_up.wait()
            return heard.pop() if heard else {"type": "http.disconnect"}

        async def send(_message: Message) -> None:
            """Lost."""

        async def repeat_later() -> Response:
            await asyncio.sleep(0.05)
            return await post(here, "move", "a", body)

        at(now() + 0.1, hung_up.set)
        first = here.app(scope_of("http", "POST", "/api/move", headers), receive, send)
        _, repeat = await asyncio.gather(first, repeat_later())
        assert repeat.json()["packets"] == 3
        assert len(here.sent()) == 3
