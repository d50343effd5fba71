"""A gateway with a described robot for programs, in a thread of its own: on the simulated board behind a real
serial device, or on a port of which the test sees each packet.
"""

import asyncio
import json
import threading
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from servodeck.access import addresses
from servodeck.access.addresses import Access
from servodeck.client.direct import facts_of
from servodeck.library.library import Library
from servodeck.port.link import BackgroundPorts, Ports
from servodeck.snapshots import NamedPose, PoseTarget
from tests.running import DEVICE, Running, server_on

T = TypeVar("T")
ROBOT = "arm"


def servo(number: int, name: str, **other: Any) -> dict[str, Any]:
    return {
        "servo": number,
        "name": name,
        "group": "",
        "min": 600,
        "max": 2400,
        "home": 1500,
        "isReversed": False,
        "trim": 0,
        "degreesPerUnit": 0.1,
        "mirror": None,
        "place": {"x": 0, "y": 0},
        **other,
    }


SERVOS = [servo(1, "Base"), servo(2, "Elbow", isReversed=True, trim=20, min=900), servo(3, "Gripper")]
# As the page exports it.
FILE = {
    "format": "servodeck-robot",
    "version": 1,
    "robot": {"name": "Arm", "board": "doc", "body": "arm", "battery": "adapter", "servos": SERVOS},
}
KIT = {"robot": json.dumps(FILE), "poses": None, "buttons": None, "pad": None}
GREETING = NamedPose(id=1, name="Greeting", unit="us", targets=[PoseTarget(servo=1, position=1700)])


@dataclass
class Served:
    url: str
    running: Running
    loop: asyncio.AbstractEventLoop

    def at_gateway(self, work: Coroutine[Any, Any, T]) -> T:
        """On its own event loop."""
        return asyncio.run_coroutine_threadsafe(work, self.loop).result(10)


def describe_robot(library: Library) -> None:
    text = json.dumps({"format": "servodeck-robot-kit", "version": 1, "kit": KIT})
    facts = facts_of(json.dumps(FILE), "doc")
    facts = facts.model_copy(update={"poses": [*facts.poses, GREETING]})
    library.write(ROBOT, text, facts.model_dump_json(), 0, kind="robot")


@contextmanager
def served(
    folder: Path,
    ports: Ports | None = None,
    device: str = DEVICE,
    make_access: Callable[[int], Access] = addresses.local,
) -> Iterator[Served]:
    library = Library(folder / "data")
    describe_robot(library)
    found: list[Served] = []
    is_ready, may_end = threading.Event(), threading.Event()

    async def live() -> None:
        async with server_on(ports or BackgroundPorts(), None, make_access, library) as running:
            await running.control.use_port(device)
            await running.control.robot.put(ROBOT, None)
            found.append(Served(f"http://{running.host}", running, asyncio.get_running_loop()))
            is_ready.set()
            await asyncio.to_thread(may_end.wait)

    thread = threading.Thread(target=lambda: asyncio.run(live()))
    thread.start()
    assert is_ready.wait(10)
    try:
        yield found[0]
    finally:
        may_end.set()
        thread.join(10)
        library.close()
