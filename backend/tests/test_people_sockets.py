"""Rights of the roles on the WebSocket, and how clients are disconnected."""

import json
from collections.abc import AsyncIterator

import pytest
from httpx2 import AsyncClient
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from servodeck.access import addresses
from servodeck.callers import Role
from tests.fake_port import FakePort, FakePorts
from tests.running import Running, server_on
from tests.samples import ERASE, MOVE, STOP
from tests.test_clients import drive, hear, hear_until, say

pytestmark = pytest.mark.slow


@pytest.fixture
def port() -> FakePort:
    return FakePort()


@pytest.fixture
async def gateway(port: FakePort) -> AsyncIterator[Running]:
    async with server_on(FakePorts(port), make_access=addresses.lan) as running:
        yield running


def token_for(gateway: Running, role: Role) -> tuple[str, dict[str, str]]:
    device, token = gateway.entrance.devices.admit("token", role, role)
    return device.id, {"Authorization": f"Bearer {token}"}


async def test_no_stranger_and_no_stopper_gets_a_connection(gateway: Running) -> None:
    _, stopper = token_for(gateway, "stopper")
    for headers, status, code in (({}, 401, "notPaired"), (stopper, 403, "forbidden")):
        with pytest.raises(InvalidStatus) as refused:
            async with connect(gateway.ws, additional_headers=headers):
                pass
        assert refused.value.response.status_code == status
        assert json.loads(refused.value.response.body)["code"] == code


async def test_a_revoked_client_is_disconnected_at_once(gateway: Running) -> None:
    device, driver = token_for(gateway, "driver")
    _, owner = token_for(gateway, "owner")
    async with connect(gateway.ws, additional_headers=driver) as client:
        await hear_until(client, "welcome")
        async with AsyncClient(base_url=f"http://{gateway.host}", headers=owner) as http:
            assert (await http.delete(f"/api/people/{device}")).status_code == 204
        with pytest.raises(ConnectionClosed):
            await hear_until(client, "nothing")
        assert (client.close_code, client.close_reason) == (1008, "This device is not paired any more.")
    with pytest.raises(InvalidStatus):
        await connect(gateway.ws, additional_headers=driver)


async def test_a_viewer_sees_and_stops_and_nothing_more(port: FakePort, gateway: Running) -> None:
    _, viewer = token_for(gateway, "viewer")
    async with connect(gateway.ws, additional_headers=viewer) as client:
        await hear_until(client, "welcome")
        await say(client, type="packet", id=1, bytes=MOVE.hex())
        assert (await hear(client))["code"] == "forbidden"
        for message in (
            {"type": "resume"},
            {"type": "board", "id": 2, "board": "lsc-16"},
            {"type": "calibrate", "servo": 1},
        ):
            await say(client, **message)
            assert (await hear_until(client, "refused"))["code"] == "forbidden"
        await say(client, type="stop")
        assert (await hear_until(client, "state"))["latch"] is True
        await hear_until(client, "halted")
    assert set(port.packets()) == {STOP}


async def test_a_driver_does_not_erase(port: FakePort, gateway: Running) -> None:
    _, driver = token_for(gateway, "driver")
    _, owner = token_for(gateway, "owner")
    async with connect(gateway.ws, additional_headers=driver) as client:
        await say(client, type="packet", id=1, bytes=ERASE.hex())
        assert (await hear_until(client, "refused"))["code"] == "forbidden"
    async with connect(gateway.ws, additional_headers=owner) as client:
        nonce = await drive(client)
        await say(client, type="packet", id=2, bytes=ERASE.hex(), nonce=nonce)
        assert (await hear_until(client, "done"))["id"] == 2


async def test_one_device_takes_no_more_than_its_share_of_seats(gateway: Running) -> None:
    _, viewer = token_for(gateway, "viewer")
    _, other = token_for(gateway, "viewer")
    open_ones = [await connect(gateway.ws, additional_headers=viewer) for _ in range(8)]
    with pytest.raises(InvalidStatus) as refused:
        await connect(gateway.ws, additional_headers=viewer)
    assert refused.value.response.status_code == 429
    async with connect(gateway.ws, additional_headers=other) as client:
        await hear_until(client, "welcome")
    for client in open_ones:
        await client.close()
