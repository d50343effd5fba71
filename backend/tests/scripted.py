"""A script with a token at a gateway on a LAN: what it asks over HTTP, and what reached its board."""

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import Any

from httpx2 import AsyncClient, Response
from starlette.types import ASGIApp

from servodeck.access import addresses
from servodeck.access.devices import Devices, DeviceStore, NoDeviceStore
from servodeck.access.entrance import Entrance
from servodeck.api.app import create_app
from servodeck.callers import Role
from servodeck.library.library import wall_clock_ms
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, ServoTarget
from servodeck.robot.control import Control
from servodeck.robot.profile import ReadFacts, no_robot
from servodeck.snapshots import JobState
from tests.downloading import ended
from tests.fake_port import FakePort, FakePorts
from tests.running import DEVICE, NO_LIBRARY, PORT, client_of
from tests.virtual_time import now

RUN_TAKEN = bytes.fromhex("55550206")
RUN_ENDED = bytes.fromhex("55550207")
ERASED = bytes.fromhex("55550208")


def move(time_ms: int, **positions: int) -> bytes:
    targets = tuple(ServoTarget(int(name[1:]), position) for name, position in positions.items())
    return encode(Move(time_ms, targets), FAMILIES["doc"])


@dataclass
class Scripted:
    """A script with a token at a gateway on a LAN."""

    client: AsyncClient
    control: Control
    port: FakePort
    app: ASGIApp
    owner: dict[str, str]
    token_id: str
    entrance: Entrance

    async def post(self, path: str, *, owner: bool = False, **body: Any) -> Response:
        return await self.client.post(f"/api/{path}", json=body, headers=self.owner if owner else {})

    async def move(
        self, time_ms: int, *, take: bool = False, owner: bool = False, **positions: int
    ) -> Response:
        named = {name[1:]: position for name, position in positions.items()}
        return await self.post("move", owner=owner, timeMs=time_ms, positions=named, take=take)

    async def download(self, *slots: int, duration_ms: int = 500, frames: int = 1) -> JobState:
        """How it ended; the frames take servo 1 to 1500, 1600 and so on."""
        frame_list = [(duration_ms, 1500 + 100 * (index % 10)) for index in range(frames)]
        return await self.download_frames(*slots, frames=frame_list)

    async def download_frames(self, *slots: int, frames: Sequence[tuple[int, int]]) -> JobState:
        """Each: its time, and where servo 1 goes."""
        shapes = [{"durationMs": duration_ms, "positions": {"1": at}} for duration_ms, at in frames]
        groups = [{"slot": slot, "frames": shapes} for slot in slots]
        begun = await self.post("download", groups=groups)
        assert begun.status_code == 202, begun.text
        return await ended(self.control, self.control.board.jobs.find(begun.json()["id"]))

    def sent(self) -> list[bytes]:
        """Behind the stop at the opening."""
        return self.port.packets()[1:]


class DevicesInMemory(Devices):
    async def keep(self) -> None:
        """At once: virtual time would go on while a thread works."""


@asynccontextmanager
async def script(
    role: Role = "driver",
    board: str = "doc",
    behind: FakePort | None = None,
    *,
    identifies: bool = False,
    clock_ms: Callable[[], int] = wall_clock_ms,
    valid_ms: int | None = None,
    store: DeviceStore | None = None,
    read_robot: ReadFacts = no_robot,
) -> AsyncIterator[Scripted]:
    """`behind` the port. `identifies`: the board is asked who it is from now on. `clock_ms`: of the list of
    devices, by which the token expires after `valid_ms`.
    """
    port = behind or FakePort()
    entrance = Entrance(addresses.lan(PORT), DevicesInMemory(store or NoDeviceStore(), clock_ms), now)
    _, owner = entrance.devices.admit("device", "Olga", "owner")
    device, token = entrance.devices.admit("token", "Dance", role, valid_ms)
    control = Control(FakePorts(port), now, board, identifies_board=identifies, read_robot=read_robot)
    await control.use_port(DEVICE)
    await asyncio.sleep(0.1)
    app = create_app(control, NO_LIBRARY, entrance)
    async with client_of(app) as client:
        client.headers["authorization"] = f"Bearer {token}"
        yield Scripted(client, control, port, app, {"authorization": f"Bearer {owner}"}, device.id, entrance)
    await control.board.link.close()


def refusal(answer: Response) -> tuple[int, str]:
    return answer.status_code, answer.json()["code"]
