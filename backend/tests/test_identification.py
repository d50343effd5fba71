"""Who is at the other end of the gateway's port: what it asks, what the answers mean, what may be sent before
a person has chosen, and what happens when the board falls silent. Real simulated boards, virtual time; the
page's session does the same on a link of its own: shared/src/robot/identification.test.ts.
"""

import asyncio
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from typing import Any

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.errors import GatewayError
from servodeck.files import Remembered
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.families import FAMILIES, UNKNOWN
from servodeck.robot.control import Control
from tests.client import Client
from tests.lockstep import Simulator, SteppedBoard
from tests.samples import MOVE, RUN, STOP
from tests.virtual_time import in_virtual_time, now

DEVICE = "/dev/board"
STOPS = [STOP] * 3
NAMES = {6: "run", 7: "stop", 15: "battery", 1: "version", 21: "positions", 3: "move", 25: "download"}
GENERIC = ["doc", "lsc-6", "lsc-16", "lsc-24", "lsc-32"]
QUIET = ["doc", "openarm-old", "openarm-new"]
BUS = ["bus-ctrl", "xarm"]
ANSWERS_LIKE = {
    "doc": GENERIC,
    "openarm-old": QUIET,
    "openarm-new": QUIET,
    "lsc-6": GENERIC,
    "lsc-32": GENERIC,
    "bus-ctrl": BUS,
    "xarm": BUS,
    "learm-esp32": ["learm-esp32"],
    "learm-esp32-bus": ["learm-esp32-bus"],
}
# Longer than the questions take, but of a board that is just starting; not so long that it is asked again.
ASKED_S = 2.4


class Here:
    """A gateway that asks the simulated board at its port."""

    def __init__(self, control: Control, board: SteppedBoard) -> None:
        self.control = control
        self.board = board

    def link(self) -> tuple[str, str | None]:
        state = self.control.board.link_state
        return state.status, state.code

    @property
    def candidates(self) -> list[str]:
        return self.control.board.identity.candidates

    def packets(self) -> list[bytes]:
        """What reached the board, on all its openings."""
        return [packet for port in self.board.ports for packet in port.packets()]

    def kinds(self) -> list[str]:
        return [NAMES[packet[COMMAND_AT]] for packet in self.packets()]

    def questions(self) -> list[str]:
        return [kind for kind in self.kinds() if kind in ("battery", "version", "positions")]

    def refusal(self, session: Client, packet: bytes = MOVE) -> str | None:
        """Why that does not leave."""
        try:
            session.send(packet)
        except GatewayError as error:
            return error.code
        return None


@asynccontextmanager
async def asked(
    simulator: Simulator,
    board: str,
    claim: str = UNKNOWN.id,
    *,
    on_for_ms: float = 60_000,
    faults: Sequence[dict[str, Any]] = (),
    remembered: Remembered | None = None,
    polls_battery: bool = False,
) -> AsyncIterator[Here]:
    frames = [{"durationMs": 4000, "targets": [{"servo": 2, "position": 1500}]}]
    history = {"onForMs": on_for_ms, "hasPad": False, "isSlow": False, "unknown": frames}
    stepped = SteppedBoard(simulator, board, history, faults)
    control = Control(
        stepped,
        now,
        claim,
        identifies_board=True,
        polls_battery=polls_battery,
        recalls_board=True,
        remembered=remembered,
    )
    await control.use_port(DEVICE)
    try:
        yield Here(control, stepped)
    finally:
        await control.board.link.close()


@pytest.mark.parametrize("board", ANSWERS_LIKE)
@in_virtual_time
async def test_an_unknown_board_is_asked_and_waits_for_a_person(simulator: Simulator, board: str) -> None:
    async with asked(simulator, board) as here:
        assert here.link() == ("identifying", None)
        await asyncio.sleep(ASKED_S)
        assert here.link() == ("refused", "boardUnknown")
        assert here.candidates == ANSWERS_LIKE[board]
        assert here.kinds()[0] == "stop"
        assert set(here.questions()) <= {"battery", "version", "positions"}


@in_virtual_time
async def test_it_gets_nothing_but_stops_before_and_after_it_was_asked(simulator: Simulator) -> None:
    async with asked(simulator, "openarm-new") as here:
        anna = Client(here.control)
        for _ in range(2):
            assert here.refusal(anna) is not None
            assert here.refusal(anna, RUN) is not None
            await asyncio.sleep(ASKED_S)
        await here.control.stop()
        assert here.packets()[-3:] == STOPS
        assert "move" not in here.kinds()


@in_virtual_time
async def test_it_is_ready_as_soon_as_it_is_named_without_another_question(
    simulator: Simulator,
) -> None:
    async with asked(simulator, "lsc-16") as here:
        await asyncio.sleep(ASKED_S)
        questions = here.questions()
        here.control.name_board(THIS_COMPUTER, "lsc-16")
        assert here.link() == ("ready", None)
        await asyncio.sleep(1)
        assert here.questions() == questions
        assert here.refusal(Client(here.control)) is None
        await asyncio.sleep(0.1)
        assert "move" in here.kinds()


@in_virtual_time
async def test_it_is_not_taken_for_what_its_answers_rule_out_and_that_is_not_remembered(
    simulator: Simulator,
) -> None:
    remembered = Remembered()
    async with asked(simulator, "learm-esp32", remembered=remembered) as here:
        await asyncio.sleep(ASKED_S)
        here.control.name_board(THIS_COMPUTER, "lsc-6")
        assert here.link() == ("refused", "wrongBoard")
        assert here.control.board.family_id == UNKNOWN.id
        assert remembered.board_at(DEVICE) is None
        here.control.name_board(THIS_COMPUTER, "learm-esp32")
        assert here.link() == ("ready", None)
        assert remembered.board_at(DEVICE) == "learm-esp32"


@in_virtual_time
async def test_one_that_restarts_in_front_of_us_is_given_the_time_to_start(simulator: Simulator) -> None:
    key = {"name": "modeKey", "afterMs": 3100}
    async with asked(simulator, "learm-esp32", on_for_ms=0, faults=[key]) as here:
        await asyncio.sleep(6)
        assert here.candidates == ["learm-esp32"]
        assert here.control.board.identity.evidence[-1].kind == "noise"


@in_virtual_time
async def test_a_stop_pressed_meanwhile_goes_first_and_the_questions_continue(simulator: Simulator) -> None:
    async with asked(simulator, "bus-ctrl") as here:
        await asyncio.sleep(0.205)
        await here.control.stop()
        await asyncio.sleep(ASKED_S)
        assert here.kinds().count("stop") >= 4
        assert here.candidates == BUS


@in_virtual_time
async def test_a_line_that_sends_everything_back_is_named_for_what_it_is(simulator: Simulator) -> None:
    async with asked(simulator, "openarm-new", "doc", faults=[{"name": "loopback"}]) as here:
        await asyncio.sleep(ASKED_S)
        assert here.link() == ("refused", "echo")
        assert here.candidates == []


@pytest.mark.parametrize("board", ANSWERS_LIKE)
@in_virtual_time
async def test_a_board_that_is_known_is_ready_only_if_it_answers_so(simulator: Simulator, board: str) -> None:
    for claim in FAMILIES:
        if claim == UNKNOWN.id:
            continue
        async with asked(simulator, board, claim) as here:
            await asyncio.sleep(ASKED_S)
            status, _ = here.link()
            assert (status == "ready") == (claim in ANSWERS_LIKE[board]), claim
            assert status in ("ready", "stale", "refused")
            assert set(here.kinds()) <= {"stop", "battery", "version", "positions"}


@in_virtual_time
async def test_one_that_is_switched_off_is_waited_for_without_a_client(
    simulator: Simulator,
) -> None:
    off = {"name": "brownOut", "afterMs": 0, "offMs": 20_000}
    async with asked(simulator, "lsc-16", "lsc-16", faults=[off]) as here:
        await asyncio.sleep(ASKED_S)
        assert here.link() == ("stale", "boardSilent")
        assert here.refusal(Client(here.control)) == "boardSilent"
        await asyncio.sleep(25)
        assert here.link() == ("ready", None)
        assert "move" not in here.kinds()


@in_virtual_time
async def test_it_is_asked_again_each_time_the_port_comes_back(simulator: Simulator) -> None:
    async with asked(simulator, "lsc-6", "lsc-6") as here:
        await asyncio.sleep(ASKED_S)
        asked_once = here.questions().count("positions")
        here.board.lose(0.1)
        await asyncio.sleep(0.6)
        assert here.link() == ("identifying", None)
        here.control.resume(THIS_COMPUTER)
        assert here.refusal(Client(here.control)) == "busy"
        await asyncio.sleep(ASKED_S)
        assert here.link() == ("ready", None)
        assert here.questions().count("positions") == 2 * asked_once


@pytest.mark.parametrize(
    ("board", "question"),
    [("lsc-6", "battery"), ("bus-ctrl", "battery"), ("learm-esp32", "version")],
)
@in_virtual_time
async def test_an_idle_board_is_asked_the_cheapest_question_every_5_s(
    simulator: Simulator, board: str, question: str
) -> None:
    async with asked(simulator, board, board) as here:
        await asyncio.sleep(ASKED_S)
        identified = len(here.questions())
        await asyncio.sleep(20)
        assert len(here.questions()) == identified, "no client is connected"
        Client(here.control)
        await asyncio.sleep(20)
        assert here.questions()[identified:] == [question] * 4


@in_virtual_time
async def test_a_board_that_may_stay_silent_is_not_asked_whether_it_is_there(simulator: Simulator) -> None:
    async with asked(simulator, "openarm-new", "openarm-new") as here:
        await asyncio.sleep(ASKED_S)
        questions = here.questions()
        Client(here.control)
        await asyncio.sleep(30)
        assert here.questions() == questions


@in_virtual_time
async def test_nothing_is_asked_while_a_group_runs(simulator: Simulator) -> None:
    async with asked(simulator, "learm-esp32", "learm-esp32") as here:
        await asyncio.sleep(ASKED_S)
        questions = here.questions()
        anna = Client(here.control)
        await anna.send(RUN)
        await asyncio.sleep(18)
        assert here.control.board.motion.group_may_run(now())
        assert here.questions() == questions


@in_virtual_time
async def test_one_lost_answer_means_nothing_and_two_that_the_board_is_gone(simulator: Simulator) -> None:
    off = {"name": "brownOut", "afterMs": 7000, "offMs": 12_000}
    async with asked(simulator, "lsc-6", "lsc-6", faults=[off]) as here:
        await asyncio.sleep(2)
        anna = Client(here.control)
        await anna.send(MOVE)
        await asyncio.sleep(10)
        assert here.link() == ("ready", None)
        await asyncio.sleep(2.5)
        assert here.link() == ("stale", "boardSilent")
        assert here.control.latch
        assert here.control.board.motion.is_unknown(1, now())
        before = len(here.kinds())
        await anna.heard()
        await asyncio.sleep(10)
        assert here.link() == ("ready", None)
        assert here.control.latch
        halted, *_ = [message for message in await anna.heard() if message["type"] == "halted"]
        assert halted["unheld"]["servos"] is None, "other commands may have moved it meanwhile"
        assert here.kinds()[before:].count("positions") == 2, "asked anew who it is"
        assert here.kinds()[before:].count("stop") >= 3
        assert here.kinds().count("move") == 1


@in_virtual_time
async def test_a_question_that_such_a_board_does_not_know_makes_no_secret_of_the_first_move(
    simulator: Simulator,
) -> None:
    async with asked(simulator, "doc", "doc") as here:
        await asyncio.sleep(1.5)
        assert here.link() == ("ready", None)
        await Client(here.control).send(MOVE)
        assert not here.control.board.motion.is_unknown(1, now())
        assert here.control.board.motion.is_moving(now())
