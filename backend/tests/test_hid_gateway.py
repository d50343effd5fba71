"""The gateway on a board's own USB cable: what leaves in parts, and what that cable is not to carry."""

import asyncio

import pytest

from servodeck.errors import NotOnThisCableError
from servodeck.protocol.packets import parse_command
from servodeck.protocol.values import Frame, Move, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.board.move_buffer import FIRST_MOVE_STAGGER_S
from servodeck.robot.control import Control
from tests.client import ANNA, Client, gateway_on
from tests.fake_port import FakeHidPort
from tests.samples import BATTERY, BATTERY_REPORT, ERASE, STOP
from tests.virtual_time import in_virtual_time, now

SERVOS = range(1, 25)
IN_A_REPORT = 19
WAVE = Group(3, "", [Frame(100, (ServoTarget(1, 1500),))])
REFUSED = "own USB cable carries no"


async def move_all(control: Control, client: Client, position: int, duration_ms: int) -> None:
    targets = [ServoTarget(servo, position) for servo in SERVOS]
    await control.requests.move(client, targets, duration_ms, client.nonce)


def servos_of(packet: bytes) -> list[int]:
    command = parse_command(packet)
    return sorted(target.servo for target in command.targets) if isinstance(command, Move) else []


async def all_at_rest(control: Control) -> Client:
    """Who drives; every servo has been moved and stands."""
    client = Client(control)
    control.driving.act(client, "request")
    await move_all(control, client, 1500, 20)
    await asyncio.sleep(len(SERVOS) * FIRST_MOVE_STAGGER_S + 2)
    return client


@in_virtual_time
async def test_a_move_of_more_servos_than_a_report_holds_is_two_moves_back_to_back() -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        client = await all_at_rest(control)
        before = len(port.written)
        await move_all(control, client, 1600, 1000)
        (first_s, first), (second_s, second) = port.written[before:]
    assert [len(servos_of(first)), len(servos_of(second))] == [IN_A_REPORT, 5]
    assert sorted(servos_of(first) + servos_of(second)) == list(SERVOS)
    assert second_s - first_s < 0.08


@in_virtual_time
async def test_stop_holds_all_servos_in_as_many_packets_as_it_takes() -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        client = await all_at_rest(control)
        await move_all(control, client, 2000, 5000)
        await asyncio.sleep(1)
        before = len(port.written)
        await control.stop()
        left = port.packets()[before:]
        assert control.unheld is None
    assert [packet for packet in left if packet == STOP] == [STOP] * 3
    assert [len(servos_of(packet)) for packet in left] == [0, IN_A_REPORT, 5, 0, 0, IN_A_REPORT, 5]
    for first, second in ((left[1], left[2]), (left[5], left[6])):
        assert sorted(servos_of(first) + servos_of(second)) == list(SERVOS)


@in_virtual_time
async def test_a_packet_by_hand_that_is_longer_than_a_report_is_refused() -> None:
    port = FakeHidPort()
    targets = b"".join(bytes((servo, 0xDC, 0x05)) for servo in range(1, 21))
    async with gateway_on(port) as control:
        client = Client(control)
        with pytest.raises(Exception, match="67 bytes, this port carries 64"):
            client.send(bytes.fromhex("5555410314e803") + targets)


@in_virtual_time
async def test_download_and_erase_are_refused_with_the_reason() -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        client = Client(control)
        with pytest.raises(NotOnThisCableError, match=f"{REFUSED} erase"):
            client.send(ERASE)
        part = made_of(WAVE, list(packets_of(WAVE, "doc")), "doc")
        with pytest.raises(NotOnThisCableError, match=f"{REFUSED} download"):
            control.requests.download([part], ANNA, lambda: None)
        assert port.packets() == [STOP]


@in_virtual_time
async def test_an_answer_is_believed_as_soon_as_its_report_is_there() -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        asked = asyncio.create_task(control.board.battery.read())
        await port.until_written(2)
        assert port.packets() == [STOP, BATTERY]
        await asyncio.sleep(0.05)
        port.say(BATTERY_REPORT)
        said_s = now()
        assert await asked == 7500
        assert now() == pytest.approx(said_s, abs=0.001)


@in_virtual_time
async def test_pages_get_the_commands_that_the_cable_does_not_carry() -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        assert control.board.port.withheld == ["download", "erase"]


@in_virtual_time
async def test_answers_that_were_not_requested_are_logged_once(caplog: pytest.LogCaptureFixture) -> None:
    port = FakeHidPort()
    async with gateway_on(port) as control:
        asked = asyncio.create_task(control.board.battery.read())
        await port.until_written(2)
        port.say(BATTERY_REPORT)
        await asked
        for _ in range(4):
            await asyncio.sleep(5)
            port.say(BATTERY_REPORT)
        await asyncio.sleep(0.1)
    warned = [record for record in caplog.records if "another program" in record.message]
    assert len(warned) == 1
