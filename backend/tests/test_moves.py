"""Moves at the gateway: the newest value of each servo leaves, merged, when the wire is free; first moves
start slowly and one after another; nothing passes a stop, and the last value of a gesture always leaves.
"""

import asyncio
import contextlib
import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import (
    BusyError,
    ExpiredError,
    ForbiddenError,
    GatewayError,
    LatchedError,
    NotDrivingError,
    OutOfRangeError,
)
from servodeck.intents import MoveMessage, Target
from servodeck.port.wire import QUEUE_PER_OWNER, Left
from servodeck.protocol import packets
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.values import Move, ServoTarget
from servodeck.robot.board.move_buffer import FIRST_MOVE_MS, FIRST_MOVE_STAGGER_S
from servodeck.robot.control import Control
from servodeck.robot.lease import COMMAND_S, QUIET_S
from servodeck.snapshots import ServoLimits
from tests.amount import TIMES
from tests.client import ANNA, Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, GAP_MS, RUN
from tests.virtual_time import at, in_virtual_time, now

GUEST = Caller("guest", "Bert", "viewer")
SERVOS = (1, 2, 3)
CENTRE = 1500


@dataclass
class Moved:
    """A move that left, and when its first byte did."""

    at_ms: float
    duration_ms: int
    positions: dict[int, int]


def moves_on(port: FakePort, since: int = 0) -> list[Moved]:
    return moves_in(port.written[since:])


def moves_in(written: Sequence[tuple[float, bytes]]) -> list[Moved]:
    found = []
    for at_s, packet in written:
        command = parse_command(packet)
        if isinstance(command, Move):
            positions = {target.servo: target.position for target in command.targets}
            found.append(Moved(round(at_s * 1000, 3), command.duration_ms, positions))
    return found


def ask(
    client: Client, duration_ms: int = 0, positions: Mapping[int, int] | None = None, **named: int
) -> Left:
    """`s1=1500` for servo 1."""
    asked = dict(positions or {}) | {int(name[1:]): position for name, position in named.items()}
    targets = [ServoTarget(servo, position) for servo, position in asked.items()]
    return client.control.requests.move(client, targets, duration_ms, client.nonce)


async def driver_at_the_centre(control: Control, servos: tuple[int, ...] = SERVOS) -> Client:
    """The driver; those servos stand at their centre, as reported."""
    client = Client(control)
    control.driving.act(client, "request")
    await client.heard()
    await ask(client, positions=dict.fromkeys(servos, CENTRE))
    await asyncio.sleep(3)
    await client.heard()
    client.followed.clear()
    return client


@in_virtual_time
async def test_the_newest_leaves_at_the_wires_own_pace_however_many_are_said() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        begun_ms = now() * 1000
        for number in range(100):
            ask(anna, positions=dict.fromkeys(SERVOS, 1000 + number))
            await asyncio.sleep(0.005)
        await asyncio.sleep(0.1)
        left = moves_on(port, before)
    cycle_ms = (7 + 3 * len(SERVOS)) * 10_000 / 9_600 + GAP_MS
    assert [each.at_ms - left[0].at_ms for each in left] == pytest.approx(
        [cycle_ms * n for n in range(len(left))], abs=0.1
    )
    ages_ms = [each.at_ms - begun_ms - 5 * (each.positions[1] - 1000) for each in left]
    assert max(ages_ms[:-1]) <= 5.1
    assert left[-1].positions == dict.fromkeys(SERVOS, 1099)


@in_virtual_time
async def test_what_waits_leaves_together_and_a_named_time_is_the_time_of_all() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        ask(anna, s1=1490)
        await asyncio.sleep(0.001)
        values = [ask(anna, s2=1510), ask(anna, 700, s3=1520), ask(anna, s2=1511)]
        await asyncio.gather(*values)
        await asyncio.sleep(1)
        first, second, *later = moves_on(port, before)
        assert first.positions == {1: 1490}
        # What names no time arrives as soon as it can, and servo 3 takes its own.
        assert (second.positions[2], second.duration_ms) == (1511, 40)
        assert 1500 < second.positions[3] < 1503
        assert {each.positions.get(2, 1511) for each in later} == {1511}
        assert later[-1].positions[3] == 1520
        assert later[-1].at_ms + later[-1].duration_ms - second.at_ms == pytest.approx(700, abs=20)


@in_virtual_time
async def test_a_value_that_waits_to_start_does_not_undo_a_packet_by_hand() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        await anna.heard()
        asked = ask(anna, s1=1400, s2=1410, s3=1420)
        await asyncio.sleep(0.001)
        await anna.send(encode(Move(FIRST_MOVE_MS, (ServoTarget(3, 1500),)), control.board.family))
        await asyncio.wait_for(asked, 2)
        left = [each.positions for each in moves_on(port)]
    assert left == [{1: 1400}, {3: 1500}, {2: 1410}]


@in_virtual_time
async def test_what_is_asked_behind_a_packet_by_hand_leaves_behind_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        ask(anna, s3=1400)
        await asyncio.sleep(0.001)
        ask(anna, s1=1490, s2=1510)
        by_hand = anna.send(encode(Move(700, (ServoTarget(1, 1450),)), control.board.family))
        ask(anna, s1=1480)
        await asyncio.gather(by_hand, ask(anna, s3=1410))
        await asyncio.sleep(0.1)
        left = [set(each.positions.items()) for each in moves_on(port, before)]
        asked = [{(3, 1400)}, {(2, 1510)}, {(1, 1450)}, {(1, 1480), (3, 1410)}]
        assert all(wanted <= each for wanted, each in zip(asked, left, strict=False))


@in_virtual_time
async def test_more_servos_than_a_packet_takes_leave_in_several() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.choose_family("bus-ctrl")
        anna = Client(control)
        control.driving.act(anna, "request")
        await ask(anna, 1500, positions=dict.fromkeys(range(1, 31), 500))
        await asyncio.sleep(2)
        before = len(port.written)
        await ask(anna, 1000, positions=dict.fromkeys(range(1, 31), 600))
        left = moves_on(port, before)
        assert [len(each.positions) for each in left] == [19, 11]
        assert {position for each in left for position in each.positions.values()} == {600}


@in_virtual_time
async def test_first_moves_are_slow_and_one_by_one_and_all_clients_get_the_waiting_servos() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        control.driving.act(anna, "request")
        await bert.heard()
        asked = ask(anna, s3=1000, s1=1200, s2=1100)
        await asyncio.sleep(0.1)
        states = [message for message in await bert.heard() if message["type"] == "state"]
        assert states[-1]["waitingToStart"] == [1, 2]
        for number in range(40):  # a servo that has started follows the pointer, as gently
            ask(anna, s3=1001 + number)
            await asyncio.sleep(0.02)
        await asked
        left = moves_on(port)
        starts = [next(each for each in left if servo in each.positions) for servo in (3, 1, 2)]
        assert all(each.duration_ms >= FIRST_MOVE_MS for each in starts)
        gaps_ms = [later.at_ms - earlier.at_ms for earlier, later in itertools.pairwise(starts)]
        assert all(gap_ms >= FIRST_MOVE_STAGGER_S * 1000 - 1 for gap_ms in gaps_ms)
        assert all(len(each.positions) == 1 for each in starts)
        followers = [each for each in left if each not in starts]
        assert followers
        assert all(each.duration_ms > 500 for each in followers)
        await asyncio.sleep(0.1)
        states = [message for message in await bert.heard() if message["type"] == "state"]
        assert states[-1]["waitingToStart"] == []


@in_virtual_time
async def test_who_waits_to_start_starts_only_while_its_driver_is_heard() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        asked = ask(anna, positions=dict.fromkeys(range(1, 11), 1000))
        await asyncio.sleep(0.6)
        anna.beats = False
        silent_s = now()
        with pytest.raises(GatewayError):
            await asked
        assert now() - silent_s <= QUIET_S
        assert control.latch is True  # it was moving
        await asyncio.sleep(3)
        asked_of = {servo for each in moves_on(port) for servo, at in each.positions.items() if at == 1000}
        assert asked_of < set(range(1, 8))
        assert control.board.moves.waiting_to_start == []


@in_virtual_time
async def test_a_swift_move_takes_the_soft_limits_time_from_where_the_servo_is() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        await ask(anna, s1=2500)
        await ask(anna, s2=1501)
        [far, near] = moves_on(port, before)
        assert far.duration_ms == 360  # half of the whole range, which takes 0.7 s, in whole ticks
        # Boards of this kind re-time every servo (S26): servo 1 goes on as fast as before.
        assert (near.positions[2], near.duration_ms) == (1501, 40)
        went_ms = near.at_ms + near.duration_ms - far.at_ms
        assert near.positions[1] == pytest.approx(1500 + 1000 * went_ms / 360, abs=10)
        await asyncio.sleep(1)
        assert moves_on(port, before)[-1].positions == {1: 2500}
        await ask(anna, 50, s3=2500)
        assert moves_on(port, before)[-1].duration_ms == 50


@in_virtual_time
async def test_the_driver_hears_at_once_what_of_it_has_left_and_others_soon() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        bert = Client(control)
        await bert.heard()
        bert.followed.clear()
        await anna.heard()
        await ask(anna, s1=1510)
        await asyncio.sleep(0.001)
        assert await anna.heard() == []
        assert anna.followed == [port.packets()[-1]]
        assert bert.followed == []
        await asyncio.sleep(0.1)
        await bert.heard()
        assert bert.followed == anna.followed


@in_virtual_time
async def test_a_move_is_encoded_once_and_its_packet_never_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    done: list[str] = []

    def count(name: str) -> None:
        work = getattr(packets, name)

        def counted(*given: object) -> object:
            done.append(name)
            return work(*given)

        monkeypatch.setattr(packets, name, counted)

    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        bert = Client(control)
        before = len(port.written)
        count("params_of")
        count("whole_packet")
        targets = [Target(servo=1, position=1510), Target(servo=2, position=1490)]
        move = MoveMessage(type="move", id=1, targets=targets, duration_ms=0, nonce=anna.nonce)
        take(move, anna, control)
        await asyncio.sleep(0.1)
        assert done == ["params_of"]
        await bert.heard()
        [left] = moves_on(port, before)
        assert left.positions == {1: 1510, 2: 1490}
        assert len(bert.followed) == 1


@in_virtual_time
async def test_only_refusals_are_answered() -> None:
    async with gateway_on() as control:
        anna = await driver_at_the_centre(control)
        bert, guest = Client(control), Client(control, ANNA)
        for client, number, position in ((anna, 1, 1510), (anna, 2, 3000), (guest, 3, 1510)):
            targets = [Target(servo=1, position=position)]
            message = MoveMessage(type="move", id=number, targets=targets, duration_ms=0, nonce=client.nonce)
            take(message, client, control)
        await asyncio.sleep(0.1)
        await bert.heard()
        answers = [message for client in (anna, guest) for message in await client.heard()]
        refused = [(message["id"], message["code"]) for message in answers if message["type"] == "refused"]
        assert refused == [(2, "outOfRange"), (3, "notDriving")]
        assert not {message["type"] for message in answers} - {"refused", "welcome", "state"}


@in_virtual_time
async def test_who_may_move_and_how_far_is_judged_when_it_is_asked_and_when_it_leaves() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, viewer = await driver_at_the_centre(control), Client(control, GUEST)
        with pytest.raises(ForbiddenError):
            ask(viewer, s1=1500)
        with pytest.raises(NotDrivingError):
            ask(Client(control), s1=1500)
        control.limits.set([ServoLimits(servo=1, name="Head", min=1000, max=1600)])
        with pytest.raises(OutOfRangeError, match=r"Head \(servo 1\): position is 1700, allowed 1000..1600"):
            ask(anna, s1=1700)
        before = len(port.written)
        ask(anna, s2=1510)
        await asyncio.sleep(0)
        waiting = ask(anna, s1=1550)
        control.limits.set([ServoLimits(servo=1, name="Head", min=1000, max=1500)])
        with pytest.raises(OutOfRangeError):
            await waiting
        assert [each.positions for each in moves_on(port, before)] == [{2: 1510}]


@in_virtual_time
async def test_a_stop_of_any_client_drops_it_and_later_moves_wait_for_resume() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        await ask(anna, s1=1510)
        waiting = ask(anna, s1=1520)
        starting = ask(anna, s9=1500)
        before = len(port.written)
        control.stop()
        for left in (waiting, starting):
            with pytest.raises(LatchedError):
                await left
        with pytest.raises(LatchedError):
            ask(anna, s1=1530)
        await asyncio.sleep(1)
        assert not [each for each in moves_on(port, before) if 1520 in each.positions.values()]
        assert not [each for each in moves_on(port, before) if 9 in each.positions]


@in_virtual_time
async def test_one_that_waits_behind_questions_for_too_long_does_not_leave() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        await asyncio.sleep(0.2)
        anna.beats = False
        await asyncio.sleep(COMMAND_S - 0.1)
        questions = [control.requests.send(anna, BATTERY.hex()) for _ in range(QUEUE_PER_OWNER)]
        with pytest.raises(ExpiredError):
            await ask(anna, s1=1600)
        await asyncio.gather(*questions)
        assert 1600 not in [position for each in moves_on(port) for position in each.positions.values()]


@in_virtual_time
async def test_another_driver_begins_with_nothing_of_the_one_before() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, carl = await driver_at_the_centre(control), Client(control)
        asked = ask(anna, s9=1000, s10=1000)
        await asyncio.sleep(0.02)
        control.driving.act(carl, "take")
        await asyncio.sleep(0.5)
        with pytest.raises(GatewayError):
            await asked
        assert control.board.moves.is_empty
        await ask(carl, s1=1510)


wishes = st.lists(
    st.tuples(
        st.integers(0, 400),
        st.one_of(
            st.sampled_from(["battery", "stop and resume"]),
            st.dictionaries(st.sampled_from(SERVOS), st.just(0), min_size=1),
        ),
    ),
    min_size=1,
    max_size=40,
)


@settings(max_examples=60 * TIMES)
@given(wishes)
def test_each_servo_ends_at_its_last_target(
    asked: list[tuple[int, str | dict[int, int]]],
) -> None:
    check(sorted(asked, key=lambda each: each[0]))


@in_virtual_time
async def check(asked: list[tuple[int, str | dict[int, int]]]) -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        begun_s = now()
        last: dict[int, int] = {}
        asked_ms: dict[int, float] = {}
        stops: list[tuple[int, float]] = []
        said: list[Left] = []

        def act(number: int, what: str | dict[int, int]) -> None:
            if what == "battery":
                with contextlib.suppress(BusyError):
                    control.requests.send(anna, BATTERY.hex())
            elif isinstance(what, str):
                control.stop()
                control.resume(anna.caller)
                last.clear()
                stops.append((number, now() * 1000))
            else:
                position = 1000 + number
                asked_ms[position] = now() * 1000
                last.update(dict.fromkeys(what, position))
                said.append(ask(anna, positions=dict.fromkeys(what, position)))

        wished: list[tuple[float, bytes]] = []
        write = port.write

        def note(data: bytes) -> None:
            """The hold of a stop was not requested."""
            if not control.board.link.wire().is_halting:
                wished.append((now(), data))
            write(data)

        port.write = note  # type: ignore[method-assign]
        for number, (at_ms, what) in enumerate(asked):
            at(begun_s + at_ms / 1000 + number / 1e6, partial(act, number, what))
        await asyncio.sleep(4)
        left = moves_in([each for each in port.written if each in wished])
        assert all(each.done() for each in said)
    ended: dict[int, int] = {}
    for each in left:
        # Others are places on the way that another servo's packet carries.
        for servo, position in ((one, to) for one, to in each.positions.items() if to in asked_ms):
            assert position >= ended.get(servo, 0)  # never back to an older value
            assert each.at_ms - asked_ms[position] <= 500
            ended[servo] = position
    assert {servo: ended[servo] for servo in last} == last
    for number, stopped_ms in stops:
        behind = [each for each in left if each.at_ms > stopped_ms + 0.001]
        assert all(min(each.positions.values()) > 1000 + number for each in behind)


@in_virtual_time
async def test_a_run_of_the_same_driver_keeps_its_place() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        await ask(anna, s1=1510)
        anna.run(RUN)
        await asyncio.sleep(1)
        # What moved is held before the frames of the group could make it faster.
        assert [packet[3] for packet in port.packets()[before:]] == [3, 7, 3, 7, 7, 3, 6]
