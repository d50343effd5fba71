"""Generated histories of two drivers, a person who stops, and a broker that repeats, keeps, delays and goes
away, in virtual time. What must hold is looked at with each run that is written to the port.
"""

import asyncio
import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.errors import GatewayError
from servodeck.fleet.messages import REQUESTS, Done, Refused, TimelyRequest
from servodeck.fleet.reports import Nonces, Page, Reports
from servodeck.fleet.rules import Accepted, Judge, Received, Stop
from servodeck.fleet.sessions import FleetSession, Sessions
from servodeck.fleet.topics import Verb
from servodeck.intents import LeaseAction
from servodeck.robot.control import Control
from servodeck.robot.latch import Cause
from tests.amount import IS_EXHAUSTIVE, TIMES
from tests.boards import new_board
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.mosquitto import LAB
from tests.virtual_time import in_virtual_time, now

HISTORIES = 1000 * TIMES if IS_EXHAUSTIVE else 100
RUN = 6
YOUNG_S = 0.5
# For the end of the motion before, or of a stop.
WAITS_S = 1.0
Step = tuple[Any, ...]


@dataclass
class Wanted:
    """A run that somebody wanted: it may leave in that time."""

    user: str
    from_s: float
    until_s: float
    is_committed: bool = True


class Broker:
    """Delivers to the gateway what a history says, as the connection's thread does."""

    def __init__(self, control: Control) -> None:
        self.control = control
        self.judge = Judge(LAB, "arm-1", control.now)
        self.nonces = Nonces(control, "i", self.judge.issued)
        self.sessions = Sessions(
            control, "arm-1", self.nonces, Reports(control, "arm-1", "i", Page(), self.nonces)
        )
        self.page = Client(control)
        self.said: list[tuple[str, bytes, bool]] = []
        self.n = 0
        self.wanted: list[Wanted] = []

    def send(self, user: str, verb: Verb, *, is_retained: bool = False, **fields: Any) -> None:
        self.n += 1
        body = {"v": 1, "n": self.n, **fields}
        if issubclass(REQUESTS[verb], TimelyRequest):
            body = {"nonce": self.nonces.newest(), **body}
        topic = f"sd/1/lab/arm-1/do/driver/{user}/{verb}"
        self.deliver(topic, json.dumps(body).encode(), is_retained=is_retained)

    def deliver(self, topic: str, payload: bytes, *, is_retained: bool) -> None:
        self.said.append((topic, payload, is_retained))
        user = topic.split("/")[-2]
        verdict = self.judge.judge(Received(topic, payload, is_retained, now(), f"sd/1/lab/reply/{user}/s"))
        match verdict:
            case Stop(name):
                self.wanted.clear()
                self.control.stop(Cause("person", name))
            case Accepted() as accepted:
                self.sessions.carry_out(accepted, self.answered)

    def answered(self, answer: Done | Refused) -> None:
        """Nobody reads it."""


async def wait(_broker: Broker, seconds: float) -> None:
    await asyncio.sleep(seconds)


async def ask(broker: Broker, user: str, action: str) -> None:
    broker.send(user, "ask", action=action)


async def beat(broker: Broker, user: str) -> None:
    broker.send(user, "beat", nonces={"arm-1": broker.nonces.newest()})


async def run(broker: Broker, user: str, is_retained: bool) -> None:
    if not is_retained:
        broker.wanted.append(Wanted(user, now(), now() + WAITS_S))
    broker.send(user, "run", slot=3, is_retained=is_retained)


async def late_run(broker: Broker, user: str, late_s: float) -> None:
    nonce = broker.nonces.newest()
    await asyncio.sleep(late_s)
    if late_s < YOUNG_S:
        broker.wanted.append(Wanted(user, now(), now() + WAITS_S))
    broker.send(user, "run", slot=3, nonce=nonce)


async def prepare(broker: Broker, user: str, in_s: float) -> None:
    at_s = now() + in_s
    broker.wanted.append(Wanted(user, at_s, at_s + WAITS_S, is_committed=False))
    broker.send(user, "prepare", name="x", slot=3, start_ms=(now() + in_s) * 1000, uncertainty_ms=1.0)


async def decide(broker: Broker, user: str, verb: Verb) -> None:
    promises = [one for one in broker.wanted if one.user == user and one.from_s > now()]
    for one in promises:
        one.is_committed = verb == "commit"
    broker.send(user, verb, name="x")


async def again(broker: Broker, back: int) -> None:
    topic, payload, is_retained = broker.said[-1 - back % len(broker.said)]
    broker.deliver(topic, payload, is_retained=is_retained)


async def stop(broker: Broker, payload: bytes, is_retained: bool) -> None:
    broker.deliver("sd/1/lab/all/do/stopper/stan/stop", payload, is_retained=is_retained)


async def resume(broker: Broker, user: str) -> None:
    broker.send(user, "resume")


async def lose(broker: Broker) -> None:
    broker.wanted.clear()
    broker.sessions.lose("The broker was lost.")


async def use_page(broker: Broker, action: LeaseAction) -> None:
    with suppress(GatewayError):  # another one has requested it already
        broker.control.driving.act(broker.page, action)


def step(do: Callable[..., Any], *how: st.SearchStrategy[Any]) -> st.SearchStrategy[Step]:
    return st.tuples(st.just(do), *how)


USER = st.sampled_from(["anna", "ben"])
STEPS = st.one_of(
    step(wait, st.sampled_from([0.01, 0.2, 0.6, 0.8, 2.1])),
    step(ask, USER, st.sampled_from(["request", "release"])),
    step(beat, USER),
    step(run, USER, st.booleans()),
    step(late_run, USER, st.sampled_from([0.4, 0.6])),
    step(prepare, USER, st.sampled_from([0.06, 0.5, 1.0])),
    step(decide, USER, st.sampled_from(["commit", "cancel"])),
    step(again, st.integers(0, 5)),
    step(stop, st.sampled_from([b"", b"\xff"]), st.booleans()),
    step(resume, USER),
    step(lose),
    step(use_page, st.sampled_from(["request", "take", "release"])),
)
# Without a driver most histories would move nothing, and while a run may go on nothing is promised.
DRIVEN: list[Step] = [(ask, "anna", "request")]
BEGINNINGS: list[list[Step]] = [
    [*DRIVEN, (run, "anna", False), (wait, 0.1)],
    [*DRIVEN, (prepare, "anna", 0.5)],
    [*DRIVEN, (prepare, "anna", 0.5), (decide, "anna", "commit")],
]


def watched(board: FakePort, look: Callable[[], None]) -> None:
    """`look` is called with each run, before it is written."""
    write = board.write

    def watching(data: bytes) -> Any:
        if data[3] == RUN:
            look()
        return write(data)

    board.write = watching  # type: ignore[method-assign]


def is_due(wanted: Wanted, driver: str) -> bool:
    return wanted.is_committed and wanted.user == driver and wanted.from_s <= now() <= wanted.until_s


@settings(max_examples=HISTORIES)
@given(st.sampled_from(BEGINNINGS), st.lists(STEPS, max_size=25))
@in_virtual_time
async def test_a_run_leaves_only_for_a_driver_who_is_heard_and_never_behind_a_stop(
    beginning: list[Step], steps: list[Step]
) -> None:
    board = new_board()
    async with gateway_on(board) as control:
        broker = Broker(control)
        runs: list[float] = []

        def look() -> None:
            runs.append(now())
            driver = control.driving.driver
            assert not control.latch
            assert isinstance(driver, FleetSession)
            assert control.driving.lease.silence == "none"
            wanted = [one for one in broker.wanted if is_due(one, driver.caller.name)]
            assert wanted, "nobody wanted it any more"
            broker.wanted.remove(wanted[0])

        watched(board, look)
        for do, *how in [*beginning, *steps]:
            await do(broker, *how)
            await asyncio.sleep(0)
        await asyncio.sleep(3.0)
        assert runs or beginning is not BEGINNINGS[0]
