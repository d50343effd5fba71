"""Commands that left the wire, as clients get them: which clients, when, and how many."""

import asyncio

from hypothesis import given
from hypothesis import strategies as st

from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode, parse_command
from servodeck.robot.hub import newest
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, MOVE, MOVE_S, RUN, STOP, hold_at
from tests.virtual_time import in_virtual_time

OTHER_SERVO = MOVE[:7] + b"\x02" + MOVE[8:]


@in_virtual_time
async def test_every_client_gets_the_commands_that_left_from_any_client() -> None:
    async with gateway_on() as control:
        anna, bert = Client(control), Client(control)
        for packet in (MOVE, BATTERY):
            await anna.send(packet)
        await asyncio.sleep(MOVE_S)
        await anna.send(RUN)
        await asyncio.sleep(0.2)
        await anna.heard()
        await bert.heard()
        assert anna.followed == bert.followed == [MOVE, BATTERY, RUN]


@in_virtual_time
async def test_every_client_gets_a_stop_with_the_pose_it_holds() -> None:
    async with gateway_on() as control:
        anna, bert = Client(control), Client(control)
        await anna.send(MOVE)
        await asyncio.sleep(MOVE_S + 0.1)
        for client in (anna, bert):
            await client.heard()
            client.followed.clear()
        await control.stop()
        await asyncio.sleep(0.2)
        await anna.heard()
        await bert.heard()
        assert anna.followed[:5] == [STOP, hold_at(2000), STOP, STOP, hold_at(2000)]
        assert bert.followed == anna.followed


@in_virtual_time
async def test_a_drag_reaches_a_viewer_twenty_times_a_second_and_ends_where_it_ends() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        count = 0
        for position in range(1000, 2000, 10):
            await anna.send(MOVE[:8] + position.to_bytes(2, "little"))
            count += bert.waiting
            await bert.heard()
        await asyncio.sleep(0.2)
        await bert.heard()
        took_s = port.written[-1][0] - port.written[1][0]
        assert count <= took_s * 20 + 1
        assert bert.followed[-1] == port.packets()[-1]
        assert len(bert.followed) < 100


@in_virtual_time
async def test_a_client_that_does_not_read_has_one_such_message_waiting_at_most() -> None:
    async with gateway_on() as control:
        anna, deaf = Client(control), Client(control)
        await deaf.heard()
        for _ in range(50):
            await anna.send(MOVE)
            await anna.send(OTHER_SERVO)
        await asyncio.sleep(0.2)
        assert deaf.waiting == 1
        await deaf.heard()
        assert deaf.followed == [MOVE, OTHER_SERVO]


moves = st.builds(
    lambda servo, position: MOVE[:7] + bytes([servo]) + position.to_bytes(2, "little"),
    st.integers(1, 4),
    st.integers(500, 2500),
)


@given(st.lists(st.one_of(moves, st.sampled_from([STOP, RUN])), max_size=20))
def test_left_out_commands_are_void_and_the_others_stay_in_order(packets: list[bytes]) -> None:
    commands = tuple(command for packet in packets if (command := parse_command(packet)))
    left = newest(commands)
    assert newest(left) == left
    sent = [encode(command, FAMILIES["doc"]) for command in left]
    assert [packet for packet in sent if packet in (STOP, RUN)] == [p for p in packets if p in (STOP, RUN)]
    rest = iter(packets)
    assert all(packet in rest for packet in sent)
    last = {packet[7]: packet for packet in packets if packet[3] == 3}
    assert {packet[7]: packet for packet in sent if packet[3] == 3} == last
