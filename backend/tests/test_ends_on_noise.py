"""Every end of a run without the latch stops the robot, also behind a stray byte on the line, which makes the
board take the first stops for the rest of a packet (S3, S4). The latch: test_opening.py and noise.test.ts.
"""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

import pytest

from servodeck.callers import Caller
from servodeck.errors import MovingError
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Command, Move, Run, ServoTarget
from servodeck.robot.control import Control
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.lockstep import Simulator, SteppedBoard
from tests.running import DEVICE
from tests.test_moves import ask, driver_at_the_centre, moves_on
from tests.virtual_time import in_virtual_time, now

OLGA = Caller("olga", "Olga", "owner")
SLOT = 7
FRAMES = [{"durationMs": 300, "targets": [{"servo": 2, "position": at}]} for at in (1200, 1700)]
HISTORY = {"onForMs": 60_000, "hasPad": False, "isSlow": False, "unknown": FRAMES}
NOISES = ["", "55", "5555FE030EF0"]
# Three stops, all that a stray byte can swallow, and the rest of a frame.
WITHIN_S = 1.5


@dataclass
class Here:
    control: Control
    page: Client
    board: str


async def lets_go(here: Here) -> None:
    here.control.driving.act(here.page, "release")


async def is_taken_over(here: Here) -> None:
    here.control.driving.act(Client(here.control, OLGA), "take")


async def ends_the_group(here: Here) -> None:
    await here.control.operations.end_group(here.page)


async def closes_the_port(here: Here) -> None:
    await here.control.close_port()


async def takes_another_port(here: Here) -> None:
    await here.control.use_port("/dev/other")


async def shuts_down(here: Here) -> None:
    await here.control.shut_down()


async def may_continue_no_longer(here: Here) -> None:
    here.control.allow_unattended(here.page, 400)
    here.control.leave(here.page)
    await asyncio.sleep(0.5)


ENDS = [
    lets_go,
    is_taken_over,
    ends_the_group,
    closes_the_port,
    takes_another_port,
    shuts_down,
    may_continue_no_longer,
]


async def running(stepped: SteppedBoard, board: str) -> Here:
    control = Control(stepped, now, board)
    await control.use_port(DEVICE)
    await control.until_identified()
    page = Client(control, OLGA)
    control.driving.act(page, "request")
    await page.send(encode(Run(SLOT, 0), FAMILIES[board]))
    await asyncio.sleep(0.65)
    assert stepped.is_running
    return Here(control, page, board)


@pytest.mark.parametrize("board", ["doc", "openarm-old", "openarm-new"])
@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("end", ENDS)
@in_virtual_time
async def test_no_group_runs_on(
    simulator: Simulator, board: str, noise: str, end: Callable[[Here], Awaitable[Any]]
) -> None:
    stepped = SteppedBoard(simulator, board, HISTORY)
    here = await running(stepped, board)
    if noise:
        stepped.disturb(noise)
    ended_s = now()
    await end(here)
    await asyncio.sleep(6)
    stepped.run_on(now())
    assert not stepped.is_running
    assert max(stepped.moved_s) - ended_s <= WITHIN_S
    await here.control.board.link.close()


@pytest.mark.parametrize("again", ["move", "run"])
@in_virtual_time
async def test_what_is_requested_next_is_not_stopped(simulator: Simulator, again: str) -> None:
    stepped = SteppedBoard(simulator, "doc", HISTORY)
    here = await running(stepped, "doc")
    await here.control.operations.end_group(here.page)
    await asyncio.sleep(0.1)
    family = FAMILIES["doc"]
    commands: dict[str, Command] = {"move": Move(1500, (ServoTarget(1, 1800),)), "run": Run(SLOT, 0)}
    await here.page.send(encode(commands[again], family))
    sent_s = now()
    await asyncio.sleep(3)
    stepped.run_on(now())
    assert stepped.is_running == (again == "run")
    assert max(stepped.moved_s) - sent_s > 1.4
    await here.control.board.link.close()


@pytest.mark.parametrize("family", ["openarm-new", "lsc-6", "learm-esp32"])
@in_virtual_time
async def test_no_other_family_is_chosen_while_it_moves(simulator: Simulator, family: str) -> None:
    stepped = SteppedBoard(simulator, "doc", HISTORY)
    here = await running(stepped, "doc")
    with pytest.raises(MovingError):
        here.control.choose_family(family)
    assert here.control.board.activity.running() is not None
    await here.control.stop()
    here.control.choose_family(family)
    assert here.control.board.family_id == family
    stepped.run_on(now())
    assert not stepped.is_running
    await here.control.board.link.close()


@in_virtual_time
async def test_end_group_takes_no_hold_from_an_end_that_follows_at_once() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, 900, s1=2500)
        await asyncio.sleep(0.1)
        ending = asyncio.create_task(control.operations.end_group(anna))
        await asyncio.sleep(0.05)
        before = len(port.written)
        control.driving.act(anna, "release")
        await ending
        await asyncio.sleep(2)
        # The sequence holds twice, and the stops that go on twice more.
        assert len(moves_on(port, before)) == 4
