"""What a script may set in motion over HTTP, and when it ends."""

import asyncio
import json
from itertools import pairwise
from typing import Any

import pytest
from starlette.types import Message

from servodeck.callers import THIS_COMPUTER
from servodeck.snapshots import ServoLimits
from tests.client import ANNA, Client
from tests.knocking import scope_of
from tests.running import PORT
from tests.samples import STOPS, wire_ms
from tests.scripted import (
    move,
    refusal,
    script,
)
from tests.test_gate import headers_of
from tests.virtual_time import at, in_virtual_time, now


@in_virtual_time
async def test_a_move_answers_when_it_has_left_and_says_when_it_will_be_over() -> None:
    async with script() as here:
        begun = await here.move(1500, s1=2000)
        assert begun.json() == {"packets": 1, "overInMs": 1500, "firstMoves": [1]}
        assert here.sent() == [move(1500, s1=2000)]
        await asyncio.sleep(1.5)
        assert (await here.move(300, s1=1000)).json()["firstMoves"] == []
        assert here.sent()[1:] == [move(300, s1=1000)]


@in_virtual_time
async def test_what_is_asked_with_the_opening_waits_until_the_board_is_identified() -> None:
    async with script(identifies=True) as here:
        begun = await here.move(1500, s1=2000)
        assert begun.json()["packets"] == 1
        assert here.control.board.link_state.status == "ready"
        assert here.sent()[-1] == move(1500, s1=2000)


@in_virtual_time
async def test_where_the_board_stays_unknown_it_is_refused_with_the_reason() -> None:
    async with script(board="unknown", identifies=True) as here:
        assert refusal(await here.move(1500, s1=2000)) == (409, "boardUnknown")


@in_virtual_time
async def test_stop_ends_waiting_requests_even_after_a_resume() -> None:
    async with script(identifies=True) as here:
        waiting = [
            asyncio.create_task(here.move(1500, s1=2000)),
            asyncio.create_task(here.post("slots/5/run")),
        ]
        await asyncio.sleep(0.2)
        here.control.stop()
        here.control.resume(THIS_COMPUTER)
        for asked in waiting:
            assert refusal(await asked) == (409, "cancelled")
        assert not {3, 6} & {packet[3] for packet in here.sent()}


@in_virtual_time
async def test_servos_of_unknown_place_start_a_quarter_of_a_second_apart() -> None:
    async with script() as here:
        refused = await here.move(1000, s1=2000)
        assert refusal(refused) == (422, "outOfRange")
        begun = await here.move(2000, s1=2000, s2=1000, s3=700)
        assert begun.json()["firstMoves"] == [1, 2, 3]
        assert here.sent() == [move(2000, s1=2000), move(2000, s2=1000), move(2000, s3=700)]
        starts = here.port.times_ms()[1:]
        apart = [later - earlier for earlier, later in pairwise(starts)]
        assert apart == pytest.approx([250 + wire_ms(move(2000, s1=2000))] * 2, abs=1)


@in_virtual_time
async def test_the_limits_of_the_robot_hold_for_scripts() -> None:
    async with script() as here:
        here.control.limits.set([ServoLimits(servo=2, name="Elbow", min=900, max=1800)])
        refused = await here.move(1500, s1=1000, s2=1900)
        assert refused.json()["detail"] == "Elbow (servo 2): position is 1900, allowed 900..1800"
        assert "Elbow (servo 2)" in (await here.move(500, s2=1000)).json()["detail"]
        assert refusal(await here.move(1500, s1=400)) == (422, "outOfRange")
        assert refusal(await here.move(1500, s33=1500)) == (422, "outOfRange")
        assert here.sent() == []


@in_virtual_time
async def test_a_script_drives_under_its_name_for_as_long_as_its_move_lasts_and_two_seconds() -> None:
    async with script() as here:
        anna = Client(here.control, ANNA)
        assert anna.lease == {}
        await here.move(3000, s1=2000)
        assert (anna.lease["driver"], anna.lease["drives"]) == ("Dance", False)
        await asyncio.sleep(4.9)
        assert anna.lease["driver"] == "Dance"
        await asyncio.sleep(0.2)
        assert anna.lease["driver"] is None
        assert (here.sent(), here.control.latch) == ([move(3000, s1=2000)], False)


@in_virtual_time
async def test_while_another_client_drives_it_is_refused_by_name_and_an_owner_may_take_it() -> None:
    async with script() as here:
        anna = Client(here.control, ANNA)
        await anna.send(move(1500, s1=2000))
        refused = await here.move(1500, s1=1000)
        assert refusal(refused) == (409, "notDriving")
        assert refused.json()["detail"].startswith("Anna drives")
        assert refusal(await here.move(1500, take=True, s1=1000)) == (403, "forbidden")
        await asyncio.sleep(1.5)
        assert (await here.move(900, take=True, owner=True, s1=1000)).status_code == 200
        assert anna.lease["driver"] == "Olga"
        assert here.sent()[1:] == [move(900, s1=1000)]


@in_virtual_time
async def test_a_page_requests_the_lease_of_a_script_and_motion_is_stopped_first() -> None:
    async with script() as here:
        anna = Client(here.control, ANNA)
        await here.move(30_000, s1=2000)
        here.control.driving.act(anna, "request")
        await asyncio.sleep(4.9)
        assert here.sent() == [move(30_000, s1=2000)]
        await asyncio.sleep(0.5)
        assert anna.lease["drives"] is True
        assert here.sent()[1:] == STOPS


@in_virtual_time
async def test_a_stop_ends_waiting_moves_even_if_a_client_resumes_at_once() -> None:
    async with script() as here:
        waiting = asyncio.create_task(here.move(1500, s1=2000, s2=2000, s3=2000))
        await asyncio.sleep(0.1)
        here.control.stop()
        here.control.resume(THIS_COMPUTER)
        assert refusal(await waiting) == (409, "cancelled")
        await asyncio.sleep(1)
        assert here.sent() == [move(1500, s1=2000), *STOPS]
        here.control.stop()
        assert refusal(await here.move(1500, s1=2000)) == (409, "latched")


@in_virtual_time
async def test_a_takeover_between_two_first_moves_ends_the_waiting_ones() -> None:
    async with script() as here:
        waiting = asyncio.create_task(here.move(1500, s1=2000, s2=2000))
        await asyncio.sleep(0.1)
        owner = Client(here.control)
        here.control.driving.act(owner, "take")
        here.control.driving.act(owner, "release")
        assert refusal(await waiting) == (409, "cancelled")
        await asyncio.sleep(1)
        assert here.sent() == [move(1500, s1=2000), *STOPS]


@in_virtual_time
async def test_a_request_of_a_client_that_left_is_not_sent() -> None:
    async with script() as here:
        body = json.dumps({"timeMs": 1500, "positions": {"1": 2000, "2": 2000, "3": 2000}}).encode()
        headers = [*headers_of(f"localhost:{PORT}", None), (b"content-type", b"application/json")]
        headers.append((b"authorization", here.owner["authorization"].encode()))
        heard = [{"type": "http.request", "body": body}]
        hung_up, answers = asyncio.Event(), []

        async def receive() -> Message:
            if not heard:
                await hung_up.wait()
            return heard.pop() if heard else {"type": "http.disconnect"}

        async def send(message: Message) -> None:
            answers.append(message)

        at(now() + 0.1, hung_up.set)
        await here.app(scope_of("http", "POST", "/api/move", headers), receive, send)
        await asyncio.sleep(1)
        assert here.sent() == [move(1500, s1=2000)]
        assert answers[0]["status"] == 409


@pytest.mark.parametrize(
    "body",
    [
        {"timeMs": 1500, "positions": {}},
        {"timeMs": 1500, "positions": {"0": 1500}},
        {"timeMs": 1500, "positions": {"one": 1500}},
        {"timeMs": 1500, "positions": {"1": 1500.5}},
        {"timeMs": 1500, "positions": {"1": "1500"}},
        {"timeMs": -1, "positions": {"1": 1500}},
        {"timeMs": 1500, "positions": {"1": 1500}, "speed": 3},
    ],
)
@in_virtual_time
async def test_what_cannot_be_read_is_refused_and_moves_nothing(body: dict[str, Any]) -> None:
    async with script() as here:
        assert refusal(await here.post("move", **body)) == (422, "malformed")
        assert here.sent() == []
