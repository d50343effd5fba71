"""A packet that was cut by the port's loss: filler ends it before the stop where the board bears that
(docs/adr/0007), and where it does not, nothing is taken as heard until the board answers.
"""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

import pytest

from servodeck.errors import GatewayError
from servodeck.port.link import RETRIES_S
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, Move, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.control import Control
from tests.client import ANNA, Client
from tests.fake_port import FakePort, FakePorts
from tests.samples import MOVE, RUN, STOPS
from tests.virtual_time import at, in_virtual_time, now

OPEN_FIRMWARE = ("doc", "openarm-old", "openarm-new")
RETURNED_S = 1.6
HALF_OF_MOVE_S = 0.005
FRAME = Frame(500, (ServoTarget(1, 1500),))


@asynccontextmanager
async def gateway(board: str, *ports: FakePort) -> AsyncIterator[tuple[Control, Client]]:
    control = Control(FakePorts(*ports), now, board)
    await control.use_port("/dev/board")
    await asyncio.sleep(0.1)
    yield control, Client(control)
    await control.board.link.close()


async def lose_behind(client: Client, packet: bytes, port: FakePort, after_s: float = HALF_OF_MOVE_S) -> None:
    """Comes back when the port is open again."""
    at(now() + after_s, port.unplug)
    with suppress(GatewayError):
        await client.send(packet)
    await asyncio.sleep(RETURNED_S)


@pytest.mark.parametrize("board", OPEN_FIRMWARE)
@in_virtual_time
async def test_filler_ends_a_cut_move_before_the_stop(board: str) -> None:
    first, second = FakePort(), FakePort()
    async with gateway(board, first, second) as (_, anna):
        await lose_behind(anna, MOVE, first)
        assert second.packets() == [b"\x00" + b"\xfd" * len(MOVE), *STOPS]


@pytest.mark.parametrize("board", OPEN_FIRMWARE)
@in_virtual_time
async def test_a_cut_run_is_ended_without_naming_slot_0(board: str) -> None:
    first, second = FakePort(), FakePort()
    async with gateway(board, first, second) as (_, anna):
        await lose_behind(anna, RUN, first, 0.004)
        assert second.packets() == [b"\xfd" * 253, *STOPS]


@in_virtual_time
async def test_a_cut_frame_of_a_download_is_ended_too() -> None:
    first, second = FakePort(), FakePort()
    async with gateway("doc", first, second) as (control, _):
        at(now() + 0.005, first.unplug)
        packets = list(packets_of(Group(5, "", [FRAME]), "doc"))
        control.requests.download([made_of(Group(5, "", [FRAME]), packets, "doc")], ANNA, lambda: None)
        await asyncio.sleep(RETURNED_S)
        assert second.packets() == [b"\xfd" * 253, *STOPS]


@in_virtual_time
async def test_what_had_left_is_not_ended() -> None:
    first, second = FakePort(), FakePort()
    async with gateway("doc", first, second) as (_, anna):
        await lose_behind(anna, MOVE, first, after_s=0.02)
        assert second.packets() == STOPS


@in_virtual_time
async def test_filler_that_is_cut_itself_is_sent_again_and_then_no_more() -> None:
    ports = [FakePort() for _ in range(4)]
    async with gateway("doc", *ports) as (_, anna):
        at(now() + 0.27, ports[1].unplug)
        await lose_behind(anna, MOVE, ports[0])
        await asyncio.sleep(1)
        filler = b"\x00" + b"\xfd" * len(MOVE)
        assert ports[1].packets() == [filler]
        assert ports[2].packets() == [filler, *STOPS]
        ports[2].unplug()
        await asyncio.sleep(2)
        assert ports[3].packets() == STOPS


@in_virtual_time
async def test_the_filler_goes_before_a_stop_that_is_pressed_at_once() -> None:
    first, second = FakePort(), FakePort()
    async with gateway("doc", first, second) as (control, anna):
        at(now() + HALF_OF_MOVE_S, first.unplug)
        with suppress(GatewayError):
            await anna.send(MOVE)
        await asyncio.sleep(RETRIES_S[0] + 0.001)
        await control.stop()
        filler, *stops = second.packets()
        assert filler == b"\x00" + b"\xfd" * len(MOVE)
        assert stops[:3] == STOPS


@in_virtual_time
async def test_another_port_gets_none_of_it() -> None:
    first, second = FakePort(), FakePort()
    async with gateway("doc", first, second) as (control, anna):
        at(now() + HALF_OF_MOVE_S, first.unplug)
        with suppress(GatewayError):
            await anna.send(MOVE)
        await control.use_port("/dev/other")
        await asyncio.sleep(RETURNED_S)
        assert second.packets() == STOPS


@pytest.mark.parametrize("board", ["lsc-6", "xarm", "learm-esp32"])
@in_virtual_time
async def test_a_board_that_bears_no_filler_may_have_heard_no_stop(board: str) -> None:
    first, second = FakePort(), FakePort()
    async with gateway(board, first, second) as (control, anna):
        await asyncio.sleep(31)
        move = encode(Move(1000, (ServoTarget(2, 600),)), FAMILIES[board])
        await lose_behind(anna, move, first)
        assert second.packets() == STOPS
        await asyncio.sleep(40)
        await control.stop()
        # As many stops as its parser can miss have left; a LeArm may have been overrun by them (L3).
        assert (control.unheld is None) is (board != "learm-esp32")


@in_virtual_time
async def test_its_first_answer_has_it_stopped_once_more() -> None:
    first, second = FakePort(), FakePort()
    async with gateway("learm-esp32", first, second) as (control, anna):
        await asyncio.sleep(31)
        move = encode(Move(1000, (ServoTarget(2, 600),)), FAMILIES["learm-esp32"])
        await lose_behind(anna, move, first)
        await control.stop()
        await anna.send(bytes.fromhex("55550201"))
        before = len(second.packets())
        second.say(bytes.fromhex("555504010101"))
        await asyncio.sleep(1)
        assert second.packets()[before:] == STOPS
        await asyncio.sleep(33)
        await control.stop()
        assert control.unheld is None
