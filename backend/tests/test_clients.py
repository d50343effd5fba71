"""Real WebSocket clients on a real server."""

import asyncio
import json
import time
from collections.abc import AsyncIterator
from typing import Any, cast

import pytest
from starlette.websockets import WebSocket
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Origin

from servodeck.access import sockets
from servodeck.api.websocket import read_all
from servodeck.callers import THIS_COMPUTER
from servodeck.errors import PortMissingError
from servodeck.events import PROTOCOL
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from tests.client import deaf_at
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.samples import BATTERY, BATTERY_HEARD, BATTERY_REPORT, MOVE, RUN, STOP

pytestmark = pytest.mark.slow

PATIENCE_S = 3


def done(number: int) -> dict[str, object]:
    """What a page hears of a request that has left."""
    return {"type": "done", "id": number, "outcome": "sent", "batteryUnknown": False}


@pytest.fixture
def port() -> FakePort:
    return FakePort()


@pytest.fixture
async def gateway(port: FakePort) -> AsyncIterator[Running]:
    async with server_on(FakePorts(port)) as running:
        yield running


async def hear_all(client: ClientConnection) -> dict[str, Any]:
    message = json.loads(await asyncio.wait_for(client.recv(), PATIENCE_S))
    assert isinstance(message, dict)
    return message


async def hear(client: ClientConnection) -> dict[str, Any]:
    """What is not about the lease."""
    while (message := await hear_all(client))["type"] in ("lease", "tick"):
        pass
    return message


async def hear_until(client: ClientConnection, kind: str) -> dict[str, Any]:
    while (message := await hear_all(client))["type"] != kind:
        pass
    return message


async def drive(client: ClientConnection) -> str:
    """Gets the lease; the nonce holds for half a second."""
    await say(client, type="lease", action="request")
    nonce = (await hear_until(client, "tick"))["nonce"]
    assert isinstance(nonce, str)
    return nonce


async def say(client: ClientConnection, **message: object) -> None:
    if message["type"] in ("packet", "run", "move"):
        message.setdefault("nonce", None)
    await client.send(json.dumps(message))


async def test_a_conversation_from_welcome_to_resume(port: FakePort, gateway: Running) -> None:
    async with connect(
        f"{gateway.ws}?protocol={PROTOCOL}", origin=Origin(f"http://{gateway.host}")
    ) as client:
        assert (await hear(client))["type"] == "welcome"
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=MOVE.hex(), nonce=nonce)
        await say(client, type="packet", id=2, bytes=BATTERY.hex())
        assert await hear_until(client, "done") == done(1)
        assert await hear_until(client, "done") == done(2)
        port.say(BATTERY_REPORT)
        # That the question has left may be said behind that it is done.
        assert await hear_until(client, "received") == BATTERY_HEARD
        assert (await hear(client))["battery"]["batteryMv"] == 7500
        await say(client, type="packet", id=3, bytes="55550203")
        assert (await hear(client))["code"] == "malformed"
        await say(client, type="stop", hold=RUN.hex())  # an older page: unknown fields are ignored
        assert (await hear(client))["latch"] is True
        assert (await hear_until(client, "halted"))["unheld"]["servos"] is None
        await say(client, type="packet", id=4, bytes=MOVE.hex(), nonce=nonce)
        refused = await hear(client)
        assert (refused["id"], refused["code"]) == (4, "latched")
        await say(client, type="resume")
        assert (await hear(client))["latch"] is False
        assert port.packets() == [STOP, MOVE, BATTERY, STOP, STOP, STOP]


async def test_more_than_eight_waiting_packets_are_refused_as_busy(gateway: Running) -> None:
    async with connect(gateway.ws) as client:
        nonce = await drive(client)
        for number in range(20):
            await say(client, type="packet", id=number, bytes=MOVE.hex(), nonce=nonce)
        assert (await hear_until(client, "refused"))["code"] == "busy"


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"X-Forwarded-For": "10.0.0.1"},
        {"Sec-Fetch-Site": "cross-site"},
    ],
)
async def test_another_page_gets_no_connection_but_a_reason(
    gateway: Running, headers: dict[str, str]
) -> None:
    with pytest.raises(InvalidStatus) as refused:
        async with connect(gateway.ws, additional_headers=headers):
            pass
    assert refused.value.response.status_code == 403
    assert json.loads(refused.value.response.body)["code"] == "forbidden"


@pytest.mark.parametrize("query", ["", "?protocol=1", "?protocol=", f"?protocol={PROTOCOL}0"])
async def test_a_page_of_another_version_is_asked_to_reload(gateway: Running, query: str) -> None:
    async with connect(f"{gateway.ws}{query}", origin=Origin(f"http://{gateway.host}")) as client:
        with pytest.raises(ConnectionClosed):
            await client.recv()
        assert (client.close_code, client.close_reason) == (
            4001,
            "This page and the gateway have different versions: reload the page.",
        )
    assert len(gateway.control.hub) == 0


async def test_bytes_and_giants_end_the_connection(gateway: Running) -> None:
    for message, code in ((b"\x55\x55\x02\x07", 1003), ("x" * 20_000, 1009)):
        async with connect(gateway.ws) as client:
            await hear(client)
            await client.send(message)
            with pytest.raises(ConnectionClosed):
                await hear_until(client, "nothing")
            assert client.close_code == code


async def test_a_client_that_never_reads_is_dropped_and_the_others_lose_nothing(
    port: FakePort, gateway: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sockets, "CLOSE_S", 0.1)
    lazy = await deaf_at(gateway.address)
    async with connect(gateway.ws, max_queue=None) as client:
        await hear_until(client, "welcome")
        noises, rounds = 0, 0
        while len(gateway.control.hub) == 2 and rounds < 2000:
            port.say(b"\x00" * 64 * 32)
            rounds += 1
            while noises < rounds * 32:
                await hear_until(client, "noise")
                noises += 1
        assert len(gateway.control.hub) == 1
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=MOVE.hex(), nonce=nonce)
        assert await hear_until(client, "done") == done(1)
        async with asyncio.timeout(PATIENCE_S):
            while len(gateway.server.server_state.connections) > 1:  # noqa: ASYNC110 (nothing announces it)
                await asyncio.sleep(0.01)
    lazy.close()


async def test_when_the_last_window_closes_a_running_group_is_stopped(
    port: FakePort, gateway: Running
) -> None:
    async with connect(gateway.ws) as client:
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=RUN.hex(), nonce=nonce)
        await hear_until(client, "done")
    await asyncio.wait_for(port.until_written(5), PATIENCE_S)
    assert port.packets() == [STOP, RUN, STOP, STOP, STOP]


async def test_at_the_end_the_robot_is_stopped_and_clients_are_notified(port: FakePort) -> None:
    async with server_on(FakePorts(port)) as running:
        client = await connect(running.ws)
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=RUN.hex(), nonce=nonce)
        await hear_until(client, "done")
    with pytest.raises(ConnectionClosed):
        await hear_until(client, "nothing")
    assert client.close_code == 1012
    assert port.packets() == [STOP, RUN, STOP, STOP, STOP]


class Pouring:
    """A socket from which messages never end, all of them here already."""

    taken = 0

    async def receive(self) -> dict[str, str]:
        self.taken += 1
        return {"type": "websocket.receive", "text": '{"type":"calibrate","servo":null}'}


async def test_a_busy_client_does_not_delay_others() -> None:
    pouring, control = Pouring(), Control(FakePorts(PortMissingError("")), time.monotonic, "doc")
    session = Session(THIS_COMPUTER)
    reading = asyncio.create_task(read_all(cast("WebSocket", pouring), session, control))
    for grant in range(5):
        assert pouring.taken <= grant + 1
        await asyncio.sleep(0)
    reading.cancel()
