"""Tasks of a fleet's page in virtual time on a console of the test: what is left of one that is cancelled."""

import asyncio
import threading
from concurrent.futures import Future
from typing import Any, cast

import pytest

from servodeck.fleet.console import Console
from servodeck.fleet.driving import FleetDriver
from servodeck.fleet.messages import Done
from tests.test_fleet_drive import FakeConsole, SomebodyElse

ARMS = ("arm-1", "arm-2", "arm-3")


class SlowConsole(FakeConsole):
    """Gives the lease at once, but answers nothing else."""

    def request(self, gateway: str, verb: str, **fields: Any) -> "Future[Done]":
        if fields.get("action") == "release":
            self.asked.append((0.0, verb, {**fields, "robot": gateway}))
            return Future()
        return super().request(gateway, verb, **fields)


async def test_no_robot_stays_with_a_start_that_is_cancelled_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    goes_on = threading.Event()
    monkeypatch.setattr("servodeck.fleet.driving.start_together", lambda *_, **__: goes_on.wait())
    console = SlowConsole()
    driver = FleetDriver(cast("Console", console), lambda: True)
    task = asyncio.create_task(driver.start_together(dict.fromkeys(ARMS, 3), 1))
    await asyncio.sleep(0.1)
    task.cancel()
    await asyncio.sleep(0.1)
    task.cancel()  # STOP was pressed again
    await asyncio.gather(task, return_exceptions=True)
    goes_on.set()
    assert [driver.claim(robot, SomebodyElse()) for robot in ARMS] == [None] * 3
    released = [fields["robot"] for _, _, fields in console.asked if fields.get("action") == "release"]
    assert released == list(ARMS)
