"""What every page shows as the robot's activity, against what the simulated board does: over generated
histories no pulse changes while a page shows "Idle", whoever began the motion. The page shows what the
gateway says (frontend/src/robot/links/gatewaySnapshot.ts); where it shows a stop or a link that is
down, it says nothing of motion.

Not known to the gateway, and so left out: motion that a pad or key of a board begins that reports no run
(OpenArm), and what others began before the port was opened.
"""

import asyncio
import json
from typing import Any

import pytest

from servodeck.robot.control import Control
from tests.amount import named, seeds
from tests.client import Client
from tests.lockstep import ENTRY, NODE, History, Simulator, SteppedBoard
from tests.samples import RUN
from tests.scripted import RUN_ENDED, RUN_TAKEN, script
from tests.stop_under_test import GUEST, Driven
from tests.test_stop_says import BOARDS, own_seed
from tests.virtual_time import VirtualTimeLoop, in_virtual_time, now

HISTORIES = 40
# No move is longer, and no group of theirs ends later where it is not repeated.
REST_S = 36.0
# The simulated board does a tick that is due at that very moment.
GRAIN_S = 1e-4
needs_simulator = pytest.mark.skipif(
    NODE is None or not ENTRY.exists(), reason="Node is not installed, or the simulator is not built"
)


class Page(Client):
    """A viewer's: notes how long it shows "Idle", and what moved meanwhile."""

    def __init__(self, control: Control, board: SteppedBoard) -> None:
        self._board = board
        self._state: dict[str, Any] = {}
        self._job: dict[str, Any] | None = None
        self._play: dict[str, Any] | None = None
        self._idle_since_s: float | None = None
        self.idle_s = 0.0
        self.moved: list[str] = []
        super().__init__(control, GUEST)

    def put(self, text: str) -> None:
        message = json.loads(text)
        kind = message["type"]
        if kind in ("welcome", "state"):
            self._state = message
        if kind in ("welcome", "job"):
            self._job = message["job"]
        if kind in ("welcome", "play"):
            self._play = message["play"]
        super().put(text)
        self.look()

    def look(self) -> None:
        if self._idle_since_s is not None:
            self._look_back(self._idle_since_s)
        self._idle_since_s = now() if self._shows_idle() else None

    def _shows_idle(self) -> bool:
        is_calm = self._state["link"]["status"] == "ready" and self._state["latchedBy"] is None
        is_storing = self._job is not None and self._job["status"] == "running"
        is_playing = self._play is not None and self._play["status"] == "playing"
        is_active = self.activity["running"] is not None or self.activity["mayMove"]
        return is_calm and not (is_storing or is_playing or is_active)

    def _look_back(self, since_s: float) -> None:
        self.idle_s += now() - since_s
        if now() > since_s:
            while self._board.run_on(now()) < now():
                pass
            last_s = max(self._board.moved_s)
            if last_s > since_s + GRAIN_S:
                self.moved.append(f"idle since {since_s:.4f} s, a pulse changed at {last_s:.4f} s")


async def shown(simulator: Simulator, family: str, history: History) -> Page:
    board = SteppedBoard(simulator, family, history)
    here = Driven(board, family)
    await here.prepare(history)
    page = Page(here.control, board)
    for step in history["steps"]:
        await here.take(step)
        page.look()
    for _ in range(round(REST_S)):
        await asyncio.sleep(1)
        page.look()
    await here.control.board.link.close()
    return page


@needs_simulator
@pytest.mark.slow
@pytest.mark.parametrize("board", BOARDS)
def test_no_page_shows_idle_while_a_pulse_changes(board: str) -> None:
    simulator = Simulator()
    idle_s = 0.0
    for seed in seeds(1):
        drawn = own_seed(board, seed)
        for history in simulator.draw(board, drawn, HISTORIES):
            with (
                named("test_activity_says.py", seed, f"{board}: {json.dumps(history)}"),
                asyncio.Runner(loop_factory=VirtualTimeLoop) as runner,
            ):
                page = runner.run(shown(simulator, board, history))
                assert page.moved == []
                idle_s += page.idle_s
    simulator.end()
    assert idle_s > HISTORIES, "else it would be right never to say it"


@in_virtual_time
async def test_a_run_that_a_script_began_is_shown_to_every_page_until_it_has_ended() -> None:
    async with script(board="doc") as here:
        await asyncio.sleep(1)
        page = Client(here.control, GUEST)
        assert page.activity == {"running": None, "mayMove": False}
        running = asyncio.create_task(here.post("slots/8/run"))
        await asyncio.sleep(0.02)
        assert (page.activity["running"]["slot"], page.activity["running"]["acknowledged"]) == (8, False)
        here.port.say(RUN_TAKEN)
        assert (await running).status_code == 200
        assert page.activity["running"]["acknowledged"] is True
        await asyncio.sleep(0.6)
        late = Client(here.control, GUEST)
        assert late.activity["running"]["begunMsAgo"] > 600
        here.port.say(RUN_ENDED)
        await asyncio.sleep(0.3)
        assert page.activity == late.activity == {"running": None, "mayMove": False}


@in_virtual_time
async def test_a_move_is_shown_until_it_rests_and_quick_moves_are_one() -> None:
    async with script(board="doc") as here:
        await asyncio.sleep(1)
        page, seen = Client(here.control, GUEST), []
        for _ in range(40):
            assert (await here.move(1500, s1=1500)).status_code == 200
            await asyncio.sleep(1.55)
            seen.append(page.activity["mayMove"])
        assert all(seen)
        await asyncio.sleep(0.2)
        assert page.activity["mayMove"] is False


@in_virtual_time
async def test_a_run_of_the_pad_that_the_board_reports_is_shown() -> None:
    async with script(board="xarm") as here:
        page = Client(here.control, GUEST)
        here.port.say(bytes.fromhex("55550506080100"))
        await asyncio.sleep(0.1)
        assert page.activity["running"]["slot"] == 8
        assert RUN not in here.sent()
