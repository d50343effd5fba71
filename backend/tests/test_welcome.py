"""The first message of a client: the whole state, and the positions of the servos."""

import asyncio

from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Move, Release, ServoTarget
from servodeck.robot.control import Control
from tests.client import Client, driven, gateway_on
from tests.fake_port import FakePort, FakePorts
from tests.samples import BATTERY, BATTERY_REPORT, MOVE
from tests.virtual_time import in_virtual_time, now


@in_virtual_time
async def test_each_client_is_welcomed_and_the_others_hear_how_many_there_are() -> None:
    async with gateway_on() as control:
        anna = Client(control)
        [welcome] = await anna.heard()
        assert welcome["type"] == "welcome"
        assert (welcome["board"], welcome["latch"], welcome["clients"]) == ("doc", False, 1)
        assert welcome["port"]["status"] == "open"
        bert = Client(control)
        assert [message["type"] for message in await bert.heard()] == ["welcome"]
        assert [(message["type"], message["clients"]) for message in await anna.heard()] == [("state", 2)]
        control.leave(bert)
        assert [(message["type"], message["clients"]) for message in await anna.heard()] == [("state", 1)]


# The longest motion that was begun before this gateway opened the port.
OTHERS_MOVE_S = 60


def port_status(control: Control) -> str:
    return control.board.port.status


async def known_servos(control: Control) -> list[int]:
    """The servos whose position a client gets that joins now."""
    newcomer = Client(control)
    [welcome] = await newcomer.heard()
    control.leave(newcomer)
    return [way["servo"] for way in welcome["motion"]["servos"]]


@in_virtual_time
async def test_a_late_client_gets_the_positions_of_the_servos() -> None:
    async with gateway_on() as control:
        assert await known_servos(control) == []
        await Client(control).send(MOVE)
        await asyncio.sleep(2)
        assert await known_servos(control) == [1]


@in_virtual_time
async def test_a_client_that_joins_late_gets_the_positions_that_the_board_has_reported() -> None:
    port = FakePort()

    async def reported(control: Control) -> list[tuple[int, int, int, bool]]:
        newcomer = Client(control)
        [welcome] = await newcomer.heard()
        control.leave(newcomer)
        found = welcome["motion"]["reported"]
        return [(one["servo"], one["position"], one["ageMs"], one["isCurrent"]) for one in found]

    async with gateway_on(port, board="bus-ctrl") as control:
        await asyncio.sleep(OTHERS_MOVE_S)
        assert await reported(control) == []
        port.say(bytes.fromhex("55550c15 03 01 f401 02 5802 03 bc02"))
        await asyncio.sleep(2)
        assert await reported(control) == [(1, 500, 1980, True), (2, 600, 1980, True), (3, 700, 1980, True)]
        await Client(control).send(encode(Move(1000, (ServoTarget(1, 400),)), FAMILIES["bus-ctrl"]))
        anna = control.driving.driver
        assert isinstance(anna, Client)
        await anna.send(encode(Release((2,)), FAMILIES["bus-ctrl"]))
        await asyncio.sleep(1)
        assert [(servo, current) for servo, _, _, current in await reported(control)] == [
            (1, False),
            (3, True),
        ]
        port.unplug()
        await asyncio.sleep(0.1)
        assert await reported(control) == []


@in_virtual_time
async def test_after_a_lost_port_clients_get_no_position_nor_after_its_return() -> None:
    first, second = FakePort(), FakePort()
    async with gateway_on(first, second) as control:
        await Client(control).send(MOVE)
        first.unplug()
        await asyncio.sleep(0.1)
        assert port_status(control) == "lost"
        assert await known_servos(control) == []
        await asyncio.sleep(1)
        assert port_status(control) == "open"
        assert await known_servos(control) == []


@in_virtual_time
async def test_a_board_that_was_silent_may_stand_anywhere() -> None:
    async with driven(BATTERY) as (control, port, anna):
        port.say(BATTERY_REPORT)
        await anna.send(MOVE)
        for _ in range(2):
            assert await known_servos(control) == [1]
            await anna.send(BATTERY)
            await asyncio.sleep(5)
        port.say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
        assert await known_servos(control) == []


@in_virtual_time
async def test_a_port_declared_as_simulated_is_published_so_and_only_that_one() -> None:
    ports = FakePorts(FakePort(), FakePort())
    control = Control(ports, now, "doc", "/dev/board", simulated=True)
    await control.use_port("/dev/board")
    welcome, *_ = await Client(control).heard()
    assert welcome["port"]["simulated"] is True
    await control.use_port("/dev/other")
    assert control.board.port.simulated is False
    await control.board.link.close()
