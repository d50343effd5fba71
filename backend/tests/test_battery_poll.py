"""The battery, which the gateway reads once for all clients: when, and the messages that they get. Real
simulated boards, virtual time; the page does the same on a link of its own:
frontend/src/features/battery/batteryPoll.test.ts.
"""

import asyncio
from collections.abc import Sequence
from typing import Any

from servodeck.api.websocket import take
from servodeck.intents import ReadMessage
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, Move, Run, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.hub import Session
from tests.client import ANNA, Client
from tests.lockstep import Simulator
from tests.samples import BATTERY
from tests.test_identification import Here, asked
from tests.virtual_time import in_virtual_time

# Until the board is known and its battery was asked for.
READY_S = 2.0
SERVO = 1


def batteries_in(messages: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    return [message["battery"] for message in messages if message["type"] == "battery"]


async def batteries(here: Here, for_s: float) -> int:
    """How often it was asked meanwhile."""
    before = here.questions().count("battery")
    await asyncio.sleep(for_s)
    return here.questions().count("battery") - before


@in_virtual_time
async def test_it_is_read_at_once_and_every_5_s_and_all_clients_get_it(simulator: Simulator) -> None:
    async with asked(simulator, "lsc-6", "lsc-6", polls_battery=True) as here:
        anna, bert = Client(here.control), Client(here.control)
        await asyncio.sleep(READY_S)
        await anna.heard()
        await bert.heard()
        assert await batteries(here, 20) == 4
        for session in (anna, bert):
            heard = await session.heard()
            assert [one["batteryMv"] for one in batteries_in(heard)] == [7500] * 4
            assert BATTERY in session.followed
        late = await Client(here.control).heard()
        assert late[0]["battery"]["kind"] == "read"
        assert late[0]["battery"]["ageMs"] < 5000


@in_virtual_time
async def test_a_question_is_sent_to_clients_before_its_answer(simulator: Simulator) -> None:
    async with asked(simulator, "lsc-6", "lsc-6", polls_battery=True) as here:
        await asyncio.sleep(READY_S)
        anna = Client(here.control)
        await asyncio.sleep(4.5)
        kinds = []
        while anna.waiting:
            text = await Session.next(anna)
            kinds += [kind for kind in ("left", "received", "battery") if f'"type":"{kind}"' in text]
        assert kinds == ["left", "received", "battery"]


@in_virtual_time
async def test_nothing_is_asked_without_clients_and_at_once_when_one_joins(
    simulator: Simulator,
) -> None:
    async with asked(simulator, "lsc-6", "lsc-6", polls_battery=True) as here:
        await asyncio.sleep(READY_S)
        assert await batteries(here, 30) == 0
        anna = Client(here.control)
        assert await batteries(here, 0.1) == 1
        here.control.leave(anna)
        assert await batteries(here, 30) == 0


@in_virtual_time
async def test_nothing_is_asked_while_something_moves_and_soon_after_a_run(simulator: Simulator) -> None:
    async with asked(simulator, "lsc-6", "lsc-6", polls_battery=True) as here:
        await asyncio.sleep(READY_S)
        anna = Client(here.control)
        await asyncio.sleep(1)
        await anna.send(encode(Move(12_000, (ServoTarget(SERVO, 1600),)), FAMILIES["lsc-6"]))
        assert await batteries(here, 11) == 0
        assert await batteries(here, 7) >= 1
        await anna.send(encode(Run(8, 3), FAMILIES["lsc-6"]))
        before = 0
        while here.control.board.motion.run:
            before = here.questions().count("battery")
            await asyncio.sleep(0.05)
        assert here.questions().count("battery") == before
        assert await batteries(here, 1) == 1


@in_virtual_time
async def test_nothing_is_asked_while_the_board_works_on_its_flash(simulator: Simulator) -> None:
    async with asked(simulator, "doc", "doc", polls_battery=True) as here:
        Client(here.control)
        await asyncio.sleep(READY_S)
        group = Group(1, "", [Frame(100, (ServoTarget(1, 1500),))] * 200)
        part = made_of(group, list(packets_of(group, "doc")), "doc")
        job = here.control.requests.download([part], ANNA, lambda: None)
        before = 0
        while here.control.board.jobs.find(job.id).status == "running":
            before = here.questions().count("battery")
            await asyncio.sleep(0.05)
        assert here.control.board.jobs.find(job.id).status == "done"
        assert here.questions().count("battery") == before == 2


@in_virtual_time
async def test_a_board_that_stays_silent_is_asked_again_only_by_a_person(simulator: Simulator) -> None:
    async with asked(simulator, "openarm-new", "doc", polls_battery=True) as here:
        anna = Client(here.control)
        await asyncio.sleep(READY_S + 20)
        assert batteries_in(await anna.heard())[-1] == {"kind": "silent", "lastMv": None}
        assert await batteries(here, 30) == 0
        await anna.heard()  # what others began before the opening has ended by now
        take(ReadMessage(type="read", id=7, what="battery", servos=[]), anna, here.control)
        assert await batteries(here, 1) == 1
        assert [(one["type"], one.get("code")) for one in await anna.heard()] == [("refused", "noAnswer")]


@in_virtual_time
async def test_a_reading_on_request_goes_to_every_client(simulator: Simulator) -> None:
    async with asked(simulator, "lsc-6", "lsc-6", polls_battery=True) as here:
        anna, bert = Client(here.control), Client(here.control)
        await asyncio.sleep(READY_S + 1)
        await anna.heard()
        await bert.heard()
        for session, number in ((anna, 1), (bert, 2)):
            take(ReadMessage(type="read", id=number, what="battery", servos=[]), session, here.control)
        assert await batteries(here, 0.5) == 1
        for session in (anna, bert):
            kinds = [message["type"] for message in await session.heard()]
            assert kinds == ["received", "battery", "done"]


@in_virtual_time
async def test_a_board_that_does_not_tell_its_battery_is_not_asked(simulator: Simulator) -> None:
    async with asked(simulator, "openarm-new", "openarm-new", polls_battery=True) as here:
        anna = Client(here.control)
        await asyncio.sleep(READY_S)
        assert await batteries(here, 30) == 0
        take(ReadMessage(type="read", id=1, what="battery", servos=[]), anna, here.control)
        await asyncio.sleep(1)
        assert (await anna.heard())[-1]["code"] == "notSupported"
