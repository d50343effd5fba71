"""Promises to start a group at a given time: what keeps one from being kept, in virtual time."""

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field

import pytest

from servodeck.errors import GatewayError
from servodeck.fleet.messages import PrepareRequest, Started
from servodeck.fleet.promises import Promise, Promises
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, ServoTarget
from servodeck.robot.control import Control
from tests.boards import WorkingBoard, new_board
from tests.client import ANNA, Client, gateway_on
from tests.virtual_time import in_virtual_time, now

RUN, STOP = 6, 7
START_S = 2.0


@dataclass
class Stage:
    """A gateway, its driver, and a promise that begins what it says."""

    control: Control
    board: WorkingBoard
    driver: Client
    promises: Promises
    begun: list[asyncio.Task[object]] = field(default_factory=list)
    started: list[Started] = field(default_factory=list)

    def prepare(self, **other: object) -> None:
        usual = {"name": "dance", "slot": 3, "start_ms": START_S * 1000, "uncertainty_ms": 2.0}
        request = PrepareRequest.model_validate({"n": 1, "nonce": "x", **usual, **other})
        self.promises.prepare(self.driver, request)

    def commit(self) -> bool:
        return self.promises.commit(self.driver, "dance")

    def runs_s(self) -> list[float]:
        return [round(at_s, 3) for at_s, packet in self.board.written if packet[3] == RUN]


@asynccontextmanager
async def stage() -> AsyncIterator[Stage]:
    board = new_board()
    async with gateway_on(board) as control:
        driver = Client(control, ANNA)
        control.driving.act(driver, "request")
        begun: list[asyncio.Task[object]] = []
        started: list[Started] = []

        def run(promise: Promise) -> None:
            command = promise.command
            work = control.operations.run(promise, command.slot, command.times)
            begun.append(asyncio.get_running_loop().create_task(work))

        yield Stage(control, board, driver, Promises(control, run, started.append), begun, started)
        await asyncio.gather(*begun, return_exceptions=True)


@in_virtual_time
async def test_a_committed_promise_starts_at_its_time() -> None:
    async with stage() as here:
        here.prepare()
        assert here.commit()
        await asyncio.sleep(START_S - now() - 0.001)
        assert here.runs_s() == []
        await asyncio.sleep(0.5)
        assert here.runs_s() == [START_S]
        assert here.started == [Started(name="dance", late_ms=0.0)]


@in_virtual_time
async def test_nothing_starts_without_a_commit() -> None:
    async with stage() as here:
        here.prepare()
        await asyncio.sleep(START_S)
        assert here.runs_s() == []
        assert here.started == []
        assert not here.commit()


def stopped(here: Stage) -> None:
    here.control.stop()


def stopped_and_resumed(here: Stage) -> None:
    here.control.stop()
    here.control.resume(here.driver.caller, here.driver)


def silent(here: Stage) -> None:
    here.driver.beats = False


def lease_given_up(here: Stage) -> None:
    here.control.driving.act(here.driver, "release")


def lease_given_up_and_back(here: Stage) -> None:
    here.control.driving.act(here.driver, "release")
    here.control.driving.act(here.driver, "request")


def gone(here: Stage) -> None:
    here.control.leave(here.driver)


def moved(here: Stage) -> None:
    here.driver.send(encode(Move(5000, (ServoTarget(1, 2000),)), FAMILIES["doc"]))


def cancelled(here: Stage) -> None:
    assert here.promises.cancel(here.driver, "dance")


@pytest.mark.parametrize(
    "happens",
    [stopped, stopped_and_resumed, silent, lease_given_up, lease_given_up_and_back, gone, moved, cancelled],
)
@in_virtual_time
async def test_what_voids_a_promise(happens: Callable[[Stage], None]) -> None:
    async with stage() as here:
        here.prepare()
        assert here.commit()
        await asyncio.sleep(START_S - 1.0 - now())
        happens(here)
        await asyncio.sleep(2.0)
        assert here.runs_s() == []


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"start_ms": 0.0}, "outOfRange"),
        ({"start_ms": 20_000.0}, "outOfRange"),
        ({"uncertainty_ms": 21.0}, "outOfRange"),
        ({"version": "other"}, "slotChanged"),
    ],
)
@in_virtual_time
async def test_what_is_not_promised(fields: dict[str, object], code: str) -> None:
    async with stage() as here:
        with pytest.raises(GatewayError) as refused:
            here.prepare(**fields)
        assert refused.value.code == code
        assert not here.commit()


@pytest.mark.parametrize(
    ("happens", "code"), [(stopped, "latched"), (lease_given_up, "notDriving"), (moved, "busy")]
)
@in_virtual_time
async def test_when_nothing_is_promised(happens: Callable[[Stage], None], code: str) -> None:
    async with stage() as here:
        happens(here)
        await asyncio.sleep(0.3)
        with pytest.raises(GatewayError) as refused:
            here.prepare()
        assert refused.value.code == code


@in_virtual_time
async def test_only_the_session_that_prepared_it_commits_or_cancels() -> None:
    async with stage() as here:
        here.prepare()
        other = Client(here.control)
        assert not here.promises.commit(other, "dance")
        assert not here.promises.cancel(other, "dance")
        assert not here.promises.commit(here.driver, "another dance")
        await asyncio.sleep(START_S)
        assert here.runs_s() == []


@in_virtual_time
async def test_a_later_promise_takes_the_place_of_an_earlier_one() -> None:
    async with stage() as here:
        here.prepare()
        here.commit()
        here.prepare(name="waltz", start_ms=(START_S + 1) * 1000)
        assert here.promises.commit(here.driver, "waltz")
        await asyncio.sleep(START_S + 1.5 - now())
        assert here.runs_s() == [START_S + 1]
