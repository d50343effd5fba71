"""Clients that say too much: they go, and whoever stops the robot meanwhile is heard."""

import asyncio
import time
from contextlib import suppress

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from tests.amount import TIMES
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.samples import STOP
from tests.test_clients import hear_until, say

FLOODERS = TIMES  # ten of them in a long run
CLOSED_WITHIN_S = 3.0
TOO_MANY = 1008


async def flood(gateway: Running) -> tuple[float, int | None]:
    """How long it was let, and the code that ended it."""
    begun_s = time.monotonic()
    async with connect(gateway.ws) as client:
        listening = asyncio.create_task(drain(client))
        with suppress(ConnectionClosed):
            for _ in range(20_000):
                await say(client, type="calibrate", servo=None)
        await listening
        return time.monotonic() - begun_s, client.close_code


async def drain(client: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        async for _ in client:
            pass


async def test_flooders_are_closed_and_a_stop_is_heard_meanwhile() -> None:
    port = FakePort()
    async with server_on(FakePorts(port)) as gateway, connect(gateway.ws) as calm:
        await hear_until(calm, "welcome")
        floods = [asyncio.create_task(flood(gateway)) for _ in range(FLOODERS)]
        await say(calm, type="stop", hold=None)
        await hear_until(calm, "halted")
        for lasted_s, code in await asyncio.gather(*floods):
            assert code == TOO_MANY
            assert lasted_s <= CLOSED_WITHIN_S * FLOODERS
        assert port.packets().count(STOP) >= 4
        await say(calm, type="resume")
        while (await hear_until(calm, "state"))["latch"]:
            pass
