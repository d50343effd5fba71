"""What is known of a board belongs to its port: a port that is opened later is identified whatever the
program was started with, and nothing of the board before is true of the next one.
"""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import Any

from httpx2 import AsyncClient

from servodeck.api.app import create_app
from servodeck.files import Remembered
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.control import Control
from tests.boards import old_board
from tests.client import Client
from tests.downloading import ended
from tests.fake_port import FakePort, FakePorts
from tests.lockstep import Simulator, SteppedBoard
from tests.running import NO_LIBRARY, client_of, entrance_to
from tests.samples import BATTERY_REPORT
from tests.scripted import refusal
from tests.virtual_time import in_virtual_time, now

STARTED, OTHER = "/dev/started", "/dev/other"
QUESTIONS = {1, 15, 21}
ASKED_S = 3.0
HISTORY = {"onForMs": 60_000, "hasPad": False, "isSlow": False, "unknown": []}


class TwoPorts(SteppedBoard):
    """The simulated board is at `stepped`; at every other port, one whose other end is the test."""

    def __init__(self, simulator: Simulator, board: str, stepped: str) -> None:
        super().__init__(simulator, board, HISTORY)
        self._stepped = stepped
        self.plain: list[FakePort] = []

    async def open(self, device: str) -> FakePort:
        if device == self._stepped:
            return await super().open(device)
        self.plain.append(FakePort())
        return self.plain[-1]


@dataclass
class Here:
    client: AsyncClient
    control: Control
    ports: TwoPorts
    page: Client

    async def open(self, device: str) -> None:
        answer = await self.client.put("/api/port", json={"device": device})
        assert answer.is_success, answer.text

    async def name(self, board: str) -> tuple[str, str | None]:
        """The state of the link once the board was asked."""
        answer = await self.client.put("/api/board", json={"board": board})
        assert answer.is_success, answer.text
        await asyncio.sleep(ASKED_S)
        return await self.link()

    async def link(self) -> tuple[str, str | None]:
        link = (await self.status())["link"]
        return link["status"], link["code"]

    async def status(self) -> dict[str, Any]:
        answer: dict[str, Any] = (await self.client.get("/api/status")).json()
        return answer

    async def move(self, position: int = 1500) -> tuple[int, str] | None:
        """Why it is refused."""
        body = {"timeMs": 2000, "positions": {"1": position}}
        answer = await self.client.post("/api/move", json=body)
        return None if answer.is_success else refusal(answer)

    def asked(self) -> list[int]:
        """The questions that reached the simulated board."""
        packets = [packet for port in self.ports.ports for packet in port.packets()]
        return [packet[COMMAND_AT] for packet in packets if packet[COMMAND_AT] in QUESTIONS]


@asynccontextmanager
async def started(
    simulator: Simulator,
    board: str = "xarm",
    claim: str = "doc",
    *,
    stepped: str = OTHER,
    simulated: bool = True,
    remembered: Remembered | None = None,
) -> AsyncIterator[Here]:
    """As `servodeck serve --serial STARTED`, with `--simulated --board CLAIM`, or with `--board CLAIM`."""
    ports = TwoPorts(simulator, board, stepped)
    control = Control(
        ports,
        now,
        claim,
        STARTED,
        simulated=simulated,
        remembered=remembered,
        slot_memory=SlotMemory(),
        recalls_board=not (simulated or claim != "unknown"),
        identifies_board=True,
        polls_battery=True,
    )
    await control.use_port(STARTED)
    await asyncio.sleep(ASKED_S)
    async with client_of(create_app(control, NO_LIBRARY, entrance_to(now=now))) as client:
        yield Here(client, control, ports, Client(control))
    await control.board.link.close()


@in_virtual_time
async def test_behind_a_simulated_board_the_next_port_is_identified_and_nothing_moves_before(
    simulator: Simulator,
) -> None:
    async with started(simulator) as here:
        assert await here.link() == ("ready", None)
        assert await here.move() is None
        await here.open(OTHER)
        assert await here.link() == ("identifying", None)
        await asyncio.sleep(ASKED_S)
        assert await here.link() == ("refused", "boardUnknown")
        assert (await here.status())["identity"]["candidates"] == ["bus-ctrl", "xarm"]
        assert await here.move(500) == (409, "boardUnknown")
        assert set(here.asked()) == {15, 21}
        assert await here.name("lsc-16") == ("refused", "wrongBoard")
        assert await here.name("xarm") == ("ready", None)
        assert await here.move(500) is None


@in_virtual_time
async def test_the_simulated_board_is_what_its_starter_says_also_when_a_person_comes_back_to_it(
    simulator: Simulator,
) -> None:
    async with started(simulator) as here:
        await here.open(OTHER)
        await here.name("xarm")
        await here.open(STARTED)
        assert await here.link() == ("ready", None)
        status = await here.status()
        assert (status["board"], status["port"]["simulated"]) == ("doc", True)
        assert await here.move() is None
        await here.open(OTHER)
        await asyncio.sleep(ASKED_S)
        status = await here.status()
        assert (status["board"], status["link"]["status"]) == ("xarm", "ready"), "named for that port"


@in_virtual_time
async def test_a_simulated_board_contradicts_who_takes_it_for_another(simulator: Simulator) -> None:
    async with started(simulator, claim="xarm", stepped=STARTED) as here:
        assert await here.link() == ("ready", None)
        assert await here.name("xarm") == ("ready", None)
        assert 21 not in here.asked()
        assert await here.name("lsc-16") == ("refused", "wrongBoard")
        assert await here.move(1500) == (409, "wrongBoard")
        assert await here.name("xarm") == ("ready", None)
        await here.open(OTHER)
        await here.open(STARTED)
        assert ((await here.status())["board"], await here.link()) == ("xarm", ("ready", None))


@in_virtual_time
async def test_a_simulated_board_is_not_asked_while_it_moves(simulator: Simulator) -> None:
    async with started(simulator, claim="xarm", stepped=STARTED) as here:
        assert await here.move(500) is None
        answer = await here.client.put("/api/board", json={"board": "lsc-16"})
        assert refusal(answer) == (409, "busy")


@in_virtual_time
async def test_a_family_that_was_named_for_one_port_is_not_taken_for_the_next(simulator: Simulator) -> None:
    remembered = Remembered()
    for claim in ("xarm", "unknown"):
        async with started(
            simulator, claim=claim, stepped=STARTED, simulated=False, remembered=remembered
        ) as here:
            if claim == "unknown":
                assert await here.name("xarm") == ("ready", None)
            assert (await here.status())["board"] == "xarm"
            await here.open(OTHER)
            assert await here.link() == ("identifying", None)
            await asyncio.sleep(ASKED_S)
            assert ((await here.status())["board"], (await here.link())[0]) == ("unknown", "refused")
            await here.open(STARTED)
            await asyncio.sleep(ASKED_S)
            assert ((await here.status())["board"], (await here.link())[0]) == ("xarm", "ready")


@in_virtual_time
async def test_a_remembered_family_is_the_one_by_which_its_motion_is_judged(simulator: Simulator) -> None:
    remembered = Remembered()
    remembered.remember_board(STARTED, "xarm")
    async with started(
        simulator, claim="unknown", stepped=STARTED, simulated=False, remembered=remembered
    ) as here:
        assert await here.link() == ("ready", None)
        assert here.control.board.motion.family.id == "xarm"


@in_virtual_time
async def test_nothing_that_was_said_of_the_board_before_is_said_of_the_next(simulator: Simulator) -> None:
    async with started(simulator) as here:
        here.ports.plain[0].say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
        assert (await here.status())["battery"] is not None
        assert await here.move() is None
        board = here.control.board
        board.slot_memory.store(board.link.place, 5, "one")
        board.slot_memory.breaks(board.link.place, 6)
        # What it has heard of a move is of the family before.
        await asyncio.sleep(2)
        await here.page.heard()
        await here.open(OTHER)
        heard = await here.page.heard()
        states = [message for message in heard if message["type"] == "state"]
        assert [state["port"]["status"] for state in states[:2]] == ["opening", "open"]
        for state in states:
            assert (state["slotVersions"], state["brokenSlots"]) == ({}, [])
            assert (state["board"], state["identity"]["evidence"]) == ("unknown", [])
        assert {"type": "battery", "battery": {"kind": "unread"}} in heard
        [welcome] = await Client(here.control).heard()
        assert welcome["battery"] == {"kind": "unread"}
        assert (welcome["motion"]["servos"], welcome["motion"]["reported"]) == ([], [])
        assert (await here.status())["battery"] is None


@in_virtual_time
async def test_a_port_that_is_closed_leaves_no_battery_behind(simulator: Simulator) -> None:
    async with started(simulator) as here:
        here.ports.plain[0].say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
        await here.client.delete("/api/port")
        assert (await here.status())["battery"] is None


@in_virtual_time
async def test_behind_a_restart_a_run_of_a_known_group_is_known_at_once() -> None:
    """Taken for a board that might answer the questions of its identification, it was taken to be deaf."""
    remembered = Remembered()
    remembered.remember_board(STARTED, "openarm-old")
    control = Control(
        FakePorts(old_board()),
        now,
        "unknown",
        remembered=remembered,
        recalls_board=True,
        identifies_board=True,
    )
    await control.use_port(STARTED)
    await control.until_identified()
    # Until then what was begun before the restart may still move it, and a download waits.
    await asyncio.sleep(31)
    frames = [{"durationMs": 500, "positions": {"1": 1500}}]
    async with client_of(create_app(control, NO_LIBRARY, entrance_to(now=now))) as client:
        job = await client.post("/api/download", json={"groups": [{"slot": 5, "frames": frames}]})
        await ended(control, control.board.jobs.find(job.json()["id"]))
        assert (await client.post("/api/slots/5/run", json={"times": 1})).is_success
        assert (await client.get("/api/status")).json()["running"]["endsInMs"] <= 510
        await asyncio.sleep(0.7)
        job = await client.post("/api/download", json={"groups": [{"slot": 5, "frames": frames}]})
        assert job.is_success, job.text
        await ended(control, control.board.jobs.find(job.json()["id"]))
    assert not control.latch
    await control.board.link.close()
