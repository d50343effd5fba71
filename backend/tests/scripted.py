"""A script with a token at a gateway on a LAN: what it asks over HTTP, and what reached its board."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import Any

from httpx2 import AsyncClient, Response
from starlette.types import ASGIApp

from servodeck.access import access
from servodeck.callers import Caller, Role
from servodeck.driving.control import Control
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, ServoTarget
from servodeck.run.app import create_app
from tests.fake_port import FakePort, FakePorts
from tests.running import DEVICE, NO_LIBRARY, PORT, client_of, entrance_to
from tests.virtual_time import now

RUN_TAKEN = bytes.fromhex("55550206")
RUN_ENDED = bytes.fromhex("55550207")
ERASED = bytes.fromhex("55550208")
ANNA = Caller("anna", "Anna", "driver")


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

    async def post(self, path: str, *, owner: bool = False, **body: Any) -> Response:
        return await self.client.post(f"/api/{path}", json=body, headers=self.owner if owner else {})

    async def move(
        self, time_ms: int, *, take: bool = False, owner: bool = False, **positions: int
    ) -> Response:
        named = {name[1:]: position for name, position in positions.items()}
        return await self.post("move", owner=owner, timeMs=time_ms, positions=named, take=take)

    def sent(self) -> list[bytes]:
        """Behind the stop at the opening."""
        return self.port.packets()[1:]


@asynccontextmanager
async def script(role: Role = "driver") -> AsyncIterator[Scripted]:
    port, entrance = FakePort(), entrance_to(access.lan(PORT), now)
    _, owner = entrance.devices.admit("device", "Olga", "owner")
    device, token = entrance.devices.admit("token", "Dance", role)
    control = Control(FakePorts(port), now, "doc")
    await control.use_port(DEVICE)
    await asyncio.sleep(0.1)
    app = create_app(control, NO_LIBRARY, entrance)
    async with client_of(app) as client:
        client.headers["authorization"] = f"Bearer {token}"
        yield Scripted(client, control, port, app, {"authorization": f"Bearer {owner}"}, device.id)
    await control.board.link.close()


def refusal(answer: Response) -> tuple[int, str]:
    return answer.status_code, answer.json()["code"]
