"""STOP of a move that began behind a run of a slot without a group: where the gateway knows that the slot is
empty, the move is held. Where it does not, nothing is held, because a group may have the servo elsewhere, and
that is published.
"""

import asyncio
from collections.abc import Awaitable, Callable
from itertools import dropwhile

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import MovingError
from servodeck.intents import StopMessage
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.packets import MOVE, RUN, encode
from servodeck.protocol.values import Command, Erase, Move, Run, ServoTarget
from tests.amount import TIMES
from tests.boards import WorkingBoard, new_board, old_board
from tests.client import Client
from tests.samples import STOP, hold_at, is_held_ahead, wire_ms
from tests.scripted import Scripted, script
from tests.virtual_time import in_virtual_time

BOARDS: dict[str, Callable[[], WorkingBoard]] = {"openarm-old": old_board, "openarm-new": new_board}
OLGA = Caller("olga", "Olga", "owner")
GUEST = Caller("guest", "Bert", "viewer")
NEVER_STORED, SLOT = 77, 5
START, END, MOVE_MS = 1000, 2000, 10_000
# No frame is longer.
LONGEST_FRAME_MS = 30_000

Unheld = dict[str, object] | None
Press = Callable[[Scripted], Awaitable[Unheld]]


class Page:
    def __init__(self, here: Scripted) -> None:
        self._here = here
        self._session = Client(here.control, OLGA)

    async def send(self, command: Command) -> None:
        await self._session.send(encode(command, self._here.control.board.family))

    async def move(self, position: int, duration_ms: int) -> None:
        await self.send(Move(duration_ms, (ServoTarget(1, position),)))

    async def slide(self, position: int, duration_ms: int) -> None:
        """Not by a packet of its own."""
        session = self._session
        targets = [ServoTarget(1, position)]
        await self._here.control.requests.move(session, targets, duration_ms, session.nonce)

    async def run(self, slot: int) -> None:
        await self.send(Run(slot, 1))

    async def erase(self) -> None:
        await self.send(Erase())


class Program:
    def __init__(self, here: Scripted) -> None:
        self._here = here

    async def move(self, position: int, duration_ms: int) -> None:
        assert (await self._here.move(duration_ms, s1=position)).status_code == 200

    async def run(self, slot: int) -> None:
        assert (await self._here.post(f"slots/{slot}/run")).status_code == 200

    async def erase(self) -> None:
        assert (await self._here.post("erase")).status_code == 200


async def press_over_http(here: Scripted) -> Unheld:
    unheld: Unheld = (await here.post("stop")).json()["unheld"]
    return unheld


async def press_on_a_page(here: Scripted) -> Unheld:
    session = Client(here.control, GUEST)
    take(StopMessage(type="stop"), session, here.control)
    await asyncio.sleep(0.3)
    [halted] = [message for message in await session.heard() if message["type"] == "halted"]
    unheld: Unheld = halted["unheld"]
    return unheld


DRIVERS: dict[str, Callable[[Scripted], Page | Program]] = {"HTTP": Program, "page": Page}
PRESSES: dict[str, Press] = {"HTTP": press_over_http, "page": press_on_a_page}

boards = pytest.mark.parametrize("board", BOARDS)
presses = pytest.mark.parametrize("press", PRESSES)
instants = st.floats(0.05, 9.5)


async def is_under_way(driver: Page | Program, after_s: float) -> None:
    await driver.move(END, MOVE_MS)
    await asyncio.sleep(after_s)


def place_when_left(here: Scripted, hold_left_s: float) -> float:
    """Of servo 1, by the time since the move of 10 s, or its first part, had arrived."""
    behind_run = dropwhile(lambda left: left[1][COMMAND_AT] != RUN, here.port.written)
    left_s, packet = next(left for left in behind_run if left[1][COMMAND_AT] == MOVE)
    return START + (END - START) * ((hold_left_s - left_s) * 1000 - wire_ms(packet)) / MOVE_MS


@boards
@presses
@pytest.mark.parametrize("drives", DRIVERS)
@given(after_s=instants)
@settings(max_examples=2 * TIMES)
@in_virtual_time
async def test_behind_a_run_of_an_erased_slot_all_is_held(
    board: str, press: str, drives: str, after_s: float
) -> None:
    async with script(role="owner", board=board, behind=BOARDS[board]()) as here:
        driver = DRIVERS[drives](here)
        await driver.move(START, 1500)
        await asyncio.sleep(2)
        await driver.erase()
        await asyncio.sleep(0.1)
        await driver.run(SLOT)
        await is_under_way(driver, after_s)
        before = len(here.port.written)
        unheld = await PRESSES[press](here)
        [first, hold, *repeats, again] = here.port.written[before : before + 5]
        assert [first[1], *(packet for _, packet in repeats)] == [STOP] * 3
        assert is_held_ahead(hold[1], place_when_left(here, hold[0]), END)
        assert again[1] == hold_at(int.from_bytes(hold[1][8:10], "little"))
        assert unheld is None


@boards
@presses
@given(after_s=instants)
@settings(max_examples=2 * TIMES)
@in_virtual_time
async def test_behind_a_run_of_an_unknown_slot_a_move_is_refused_and_a_stop_says_that_anything_may_move(
    board: str, press: str, after_s: float
) -> None:
    async with script(role="owner", board=board, behind=BOARDS[board]()) as here:
        driver = Page(here)
        await driver.move(START, 1500)
        await asyncio.sleep(2)
        await driver.run(NEVER_STORED)
        await asyncio.sleep(after_s)
        before = len(here.port.written)
        for move in (driver.move, driver.slide):
            with pytest.raises(MovingError):
                await move(END, MOVE_MS)
        assert here.port.written[before:] == []
        unheld = await PRESSES[press](here)
        assert [packet for _, packet in here.port.written[before:]] == [STOP] * 3
        assert unheld is not None
        assert unheld["servos"] is None
        # A tick for each hold that is to follow.
        assert unheld["forMs"] == pytest.approx(LONGEST_FRAME_MS + wire_ms(STOP) + 50, abs=50)
