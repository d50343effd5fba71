"""A start together that is given up while its clocks are measured: nothing starts any more, nor later."""

import asyncio
import threading
from concurrent.futures import Future
from typing import Any, cast

import pytest

from servodeck.fleet.clocks import Reading
from servodeck.fleet.console import Console
from servodeck.fleet.driving import FleetDriver
from servodeck.fleet.messages import Done
from tests.fleet import eventually
from tests.test_fleet_drive import FakeConsole

ARMS = ("arm-1", "arm-2")


class Measured(FakeConsole):
    """Its robots say their clocks when `say` is set."""

    now_s = 0.0

    def __init__(self) -> None:
        super().__init__()
        self.say = threading.Event()
        self.is_asked = threading.Event()
        self.committed: list[str] = []

    def clock(self, _: str) -> Reading:
        self.is_asked.set()
        self.say.wait()
        return Reading(0.0, 0.0, 0.0)

    def beat(self, gateways: Any) -> None:
        """Not of interest."""

    def request(self, gateway: str, verb: str, **fields: Any) -> "Future[Done]":
        self.asked.append((0.0, verb, fields))
        self.has_lease = fields.get("action") != "release"
        answered: Future[Done] = Future()
        answered.set_result(Done(gateway=gateway, n=1, nonce="n", epoch=1, drives=self.has_lease))
        return answered

    def result_of(self, _: str, answered: "Future[Done]", timeout_s: float) -> Done:
        return answered.result(timeout_s)

    def commit(self, name: str, gateways: Any, _: float) -> set[str]:
        self.committed.append(name)
        return set(gateways)

    def cancel(self, *_: Any) -> set[str]:
        return set()

    def until(self, *_: Any) -> bool:
        self.now_s += 1
        return False


@pytest.mark.parametrize("why", ["stopped", "nobody watches", "one is stopped"])
async def test_nothing_starts_together_that_was_given_up(why: str, monkeypatch: pytest.MonkeyPatch) -> None:
    console, is_watched = Measured(), True
    before = {*threading.enumerate()}
    monkeypatch.setattr("servodeck.fleet.driving.stop_robots", lambda *_: None)
    driver = FleetDriver(cast("Console", console), lambda: is_watched)
    driver.start()
    task = asyncio.create_task(driver.start_together(dict.fromkeys(ARMS, 3), 1))
    assert await asyncio.to_thread(console.is_asked.wait, 5)
    if why == "stopped":
        task.cancel()
    elif why == "one is stopped":
        await driver.stop(["arm-2"])
    else:
        is_watched = False
    await asyncio.sleep(0.4)
    console.say.set()
    await asyncio.wait([task])
    assert await asyncio.to_thread(eventually, lambda: not working_since(before))
    assert "prepare" not in console.verbs()
    assert console.committed == []
    await driver.end()


def working_since(before: set[threading.Thread]) -> list[str]:
    """Threads of the start, by name."""
    names = [thread.name for thread in threading.enumerate() if thread not in before]
    return [name for name in names if name.startswith(("in the background", "ThreadPool"))]
