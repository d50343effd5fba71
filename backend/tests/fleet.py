"""Gateways on a broker for tests: real robot cores in a thread of their own, each on a port of which the test
sees every packet, and the consoles that talk to them.
"""

import asyncio
import threading
import time
from collections.abc import Callable, Coroutine, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from servodeck.fleet.broker import Broker
from servodeck.fleet.console import Console
from servodeck.fleet.gateway import NO_PAGE, FleetGateway
from servodeck.fleet.reports import Page
from servodeck.robot.control import Control
from servodeck.robot.profile import no_robot
from servodeck.snapshots import RobotFacts
from tests.boards import new_board
from tests.fake_port import FakePorts
from tests.mosquitto import LAB, USERS, Mosquitto
from tests.running import DEVICE

T = TypeVar("T")
WAIT_S = 10.0


class Gateway:
    """One robot core and its client on the broker."""

    def __init__(self, name: str, broker: Broker, ahead_s: float = 0.0, page: Page = NO_PAGE) -> None:
        """Its clock is `ahead_s` of this process's, as another computer's is; that may change."""
        self.name = name
        self.ahead_s = ahead_s
        self.board = new_board()
        self.robot: RobotFacts | None = None
        """What its library holds."""
        self.control = Control(
            *(FakePorts(self.board), lambda: time.monotonic() + self.ahead_s, "doc", DEVICE),
            read_robot=self._read_robot,
        )
        self.door = FleetGateway(self.control, broker, LAB, name, page)

    def _read_robot(self, document: str) -> tuple[RobotFacts, int]:
        return (self.robot, 1) if self.robot else no_robot(document)

    async def start(self) -> None:
        await self.control.use_port(DEVICE)
        self.door.start()

    async def end(self) -> None:
        self.door.end()
        await self.control.shut_down()

    def packets(self) -> list[bytes]:
        """All that have been written so far."""
        return self.board.packets()

    def count(self, number: int) -> int:
        """Of the command with that number."""
        return sum(packet[3] == number for packet in self.packets())

    def first_s(self, number: int, since_s: float) -> float | None:
        """When the first such packet since then was written."""
        times_s = (at_s for at_s, packet in self.board.written if packet[3] == number and at_s >= since_s)
        return next(times_s, None)


class Fleet:
    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever)
        self._thread.start()
        self._gateways: list[Gateway] = []

    def add(self, name: str, broker: Broker, ahead_s: float = 0.0, page: Page = NO_PAGE) -> Gateway:
        async def made() -> Gateway:
            gateway = Gateway(name, broker, ahead_s, page)
            await gateway.start()
            return gateway

        gateway = self.do(made())
        self._gateways.append(gateway)
        return gateway

    def join(self, name: str, broker: Broker, ahead_s: float = 0.0, page: Page = NO_PAGE) -> Gateway:
        """As `add`, until the broker has brought back what it said."""
        gateway = self.add(name, broker, ahead_s, page)
        assert eventually(lambda: gateway.door.status().problem is None), gateway.door.status()
        return gateway

    def do(self, work: Coroutine[Any, Any, T]) -> T:
        """On the loop of all gateways."""
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(WAIT_S)

    def call(self, act: Callable[[], T]) -> T:
        async def acted() -> T:
            return act()

        return self.do(acted())

    def end(self) -> None:
        for gateway in self._gateways:
            self.do(gateway.end())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(WAIT_S)
        self._loop.close()


@contextmanager
def fleet_on(mosquitto: Mosquitto, names: Sequence[str]) -> Iterator[tuple[Fleet, list[Gateway]]]:
    fleet = Fleet()
    try:
        yield fleet, [fleet.join(name, mosquitto.broker_for(name)) for name in names]
    finally:
        fleet.end()


@contextmanager
def console_of(mosquitto: Mosquitto, user: str, *expected: str) -> Iterator[Console]:
    """Of that user, once it has heard the gateways that are expected."""
    with Console(mosquitto.broker_for(user), LAB, USERS[user]) as console:
        assert console.until(lambda: all(map(console.is_present, expected)), WAIT_S), console.problem
        yield console


def eventually(is_so: Callable[[], bool], within_s: float = WAIT_S, every_s: float = 0.01) -> bool:
    """Looks again and again what another thread does."""
    deadline_s = time.monotonic() + within_s
    pause = threading.Event()
    while not is_so():
        if time.monotonic() > deadline_s:
            return False
        pause.wait(every_s)
    return True
