"""All that the page of a fleet needs, put together: a console on the broker, what it has heard, and what
people ask of several robots at once.

Knows no HTTP. `start` and `end` are called on the gateway's loop.
"""

import asyncio
from collections.abc import Callable
from pathlib import Path

from servodeck.callers import Role
from servodeck.fleet.broker import Broker
from servodeck.fleet.console import Console
from servodeck.fleet.drive import DriveSession
from servodeck.fleet.driving import FleetDriver
from servodeck.fleet.tasks import Tasks
from servodeck.fleet.topics import Site
from servodeck.fleet.view import FleetView
from servodeck.threads import in_thread

# The broker's access list says what this user may do; the page's own roles say what people may.
ROLE: Role = "driver"


class FleetService:
    def __init__(self, broker: Broker, site: Site, folder: Path | None, now_ms: Callable[[], int]) -> None:
        """`broker` with a user that may drive. `folder` keeps the groups of robots. Raises ValueError without
        a user.
        """
        self._console = Console(broker, site, ROLE, changed=lambda _: self.driver.heard())
        self.view = FleetView(self._console, site.name, folder, now_ms)
        self.driver = FleetDriver(self._console, lambda: self.view.is_watched)
        self.tasks = Tasks(self.view)

    def drive(self, robot: str, name: str) -> DriveSession:
        """For one page. `name` of the person."""
        return DriveSession(robot, name, self._console, self.driver, asyncio.get_running_loop().time)

    def start(self) -> None:
        self.driver.start()
        self._console.start()

    async def end(self) -> None:
        self.tasks.cancel_all()
        await self.driver.end()
        await in_thread(self._console.end)
