"""What was asked of a servo is how fast it goes, whatever is asked of the others meanwhile and at which door:
watched at the pulses of the simulated board, on every family, and on a board whose timing no source says in
both readings. Then what ends a move that leaves in parts. The page's robot: shared/src/robot/parts.test.ts.
"""

import asyncio
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import pairwise
from math import ceil, floor
from typing import Any

import pytest
from fastapi import FastAPI

from servodeck.access.guard import Guard
from servodeck.api.app import create_app
from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import GatewayError, MovingError, OutOfRangeError
from servodeck.intents import StopPlayingMessage, client_message
from servodeck.protocol.families import FAMILIES, Family
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import MOVE, PARTS, wire_ms
from servodeck.protocol.values import Move, Release, RunStarted, ServoTarget
from servodeck.robot.control import Control
from servodeck.robot.motion.parts import interval_ms
from servodeck.robot.scripts import Scripts
from servodeck.snapshots import ServoLimits
from tests.amount import named, seeds
from tests.client import Client, gateway_on
from tests.fake_port import FakePort, FakePorts
from tests.lockstep import Simulator, SteppedBoard
from tests.running import DEVICE, NO_LIBRARY, client_of, entrance_to
from tests.samples import BATTERY, RUN, command_in
from tests.scripted import script
from tests.test_moves import ask, driver_at_the_centre, moves_on
from tests.virtual_time import VirtualTimeLoop, at, in_virtual_time, now

OLGA = Caller("olga", "Olga", "owner")
# Family and simulated board. The commands of an lsc-16 on firmware that re-times every servo, too: no source
# says that it does not.
BOARDS = [
    ("doc", "doc"),
    ("openarm-old", "openarm-old"),
    ("openarm-new", "openarm-new"),
    ("lsc-16", "lsc-16"),
    ("lsc-16", "doc"),
    ("bus-ctrl", "bus-ctrl"),
    ("xarm", "xarm"),
    ("learm-esp32", "learm-esp32"),
    ("learm-esp32-bus", "learm-esp32-bus"),
]
SERVOS = (1, 2, 3, 4, 5, 6)
HISTORIES, USUALLY = 100, 5
SAMPLE_MS = 20
# A window of this many samples sees every short leap, and one of a part sees a rest that is made up for.
WINDOWS = (1, 2, 5, 10, 50)
UNITS = 2
LONGEST_MS = 20_000
FIRST_MOVES_S = 4.0
PLAY_ENDS_WITHIN_S = 0.1
PLAIN_BOARD = {"onForMs": 60_000, "hasPad": False, "isSlow": False, "unknown": []}


@dataclass(frozen=True)
class Way:
    """What was asked of a servo. `duration_ms` 0: as fast as the soft limit and the link allow."""

    servo: int
    to: int
    duration_ms: int
    at_ms: float

    def takes_ms(self, family: Family) -> float:
        return max(self.duration_ms, family.shortest_move_ms) if self.duration_ms else MOVE.range_ms


@dataclass
class Moved:
    """A robot that is moved at one door."""

    family: Family
    board: SteppedBoard
    control: Control
    page: Client
    ways: list[Way] = field(default_factory=list)
    refused: int = 0
    put_off_ms: float = 0.0
    """What is under way gets there so much later at most, because a packet by hand re-times it."""

    def asked(self, targets: Sequence[ServoTarget], duration_ms: int, at_ms: float) -> None:
        self.ways += [Way(target.servo, target.position, duration_ms, at_ms) for target in targets]

    def say(self, **message: Any) -> None:
        if self.control.driving.driver is None:
            self.control.driving.act(self.page, "request")
        asked = {"id": 1, "nonce": self.page.nonce, **message}
        take(client_message.validate_python(asked), self.page, self.control)

    async def by_message(self, targets: Sequence[ServoTarget], duration_ms: int) -> None:
        self.asked(targets, duration_ms, now() * 1000)
        shapes = [{"servo": target.servo, "position": target.position} for target in targets]
        self.say(type="move", targets=shapes, durationMs=duration_ms)

    async def by_packet(self, targets: Sequence[ServoTarget], duration_ms: int) -> None:
        """It leaves as it is, or is refused."""
        asked_ms = now() * 1000
        try:
            await self.page.send(encode(Move(duration_ms, tuple(targets)), self.family))
        except GatewayError:
            self.refused += 1
        else:
            self.asked(targets, max(1, duration_ms), asked_ms)
            self.put_off_ms += duration_ms

    async def by_script(self, targets: Sequence[ServoTarget], duration_ms: int) -> None:
        asked_ms = now() * 1000
        positions = {str(target.servo): target.position for target in targets}
        async with client_of(app_of(self.control)) as client:
            answer = await client.post("/api/move", json={"timeMs": duration_ms, "positions": positions})
        if answer.status_code == 200:
            self.asked(targets, duration_ms, asked_ms)
        else:
            assert answer.json()["code"] == "outOfRange", answer.text
            self.refused += 1

    async def by_play(self, targets: Sequence[ServoTarget], duration_ms: int) -> None:
        """Two frames, the second one on the way back; then as long as both take."""
        begin_ms, lead_ms = now() * 1000, max(duration_ms, MOVE.first_ms)
        if self.control.board.plays.present:
            take(StopPlayingMessage(type="stopPlaying"), self.page, self.control)
        back = [replace(target, position=mirrored(target, self.family)) for target in targets]
        frames = [
            {"durationMs": duration_ms, "positions": {str(to.servo): to.position for to in each}}
            for each in (targets, back)
        ]
        self.say(type="play", frames=frames, times=1, loopFrom=0)
        self.asked(targets, lead_ms, begin_ms)
        await asyncio.sleep((lead_ms + duration_ms) / 1000 + PLAY_ENDS_WITHIN_S)
        self.asked(back, duration_ms, begin_ms + lead_ms)


Door = Callable[[Moved, Sequence[ServoTarget], int], Any]
# Those that a history goes through, the usual one first.
DOORS: dict[str, Sequence[Door]] = {
    "page": [Moved.by_message],
    "packets": [Moved.by_message, Moved.by_packet],
    "HTTP": [Moved.by_script],
    "play": [Moved.by_message, Moved.by_play],
}


@cache
def the_app() -> Guard:
    """Making one takes longer than a history."""
    guard = create_app(Control(FakePorts(), now, "doc"), NO_LIBRARY, entrance_to(now=now))
    assert isinstance(guard, Guard)
    return guard


def app_of(control: Control) -> Guard:
    app = the_app()
    assert isinstance(app.app, FastAPI)
    if app.app.state.control is not control:
        app.app.state.control = control
        app.app.state.scripts = Scripts(control, lambda _caller: True)
    return app


def mirrored(target: ServoTarget, family: Family) -> int:
    allowed = family.position_of(target.servo)
    return allowed.min + allowed.max - target.position


def some_duration_ms(draw: random.Random, family: Family) -> int:
    longest = min(family.duration_ms.max, LONGEST_MS)
    return draw.choice([0, 100, draw.randint(20, 600), draw.randint(20, longest)])


def some_targets(draw: random.Random, family: Family) -> list[ServoTarget]:
    servos = sorted(draw.sample(SERVOS, draw.randint(1, len(SERVOS))))
    allowed = [family.position_of(servo) for servo in servos]
    return [
        ServoTarget(servo, draw.randint(one.min, one.max)) for servo, one in zip(servos, allowed, strict=True)
    ]


async def moved_through(door: str, draw: random.Random, here: Moved) -> None:
    for _ in range(draw.randint(2, 8)):
        if draw.random() < 0.5:
            await asyncio.sleep(draw.choice([0.06, 1.2, 6.0]) * draw.random())
        else:
            move = draw.choice(DOORS[door])
            await move(here, some_targets(draw, here.family), some_duration_ms(draw, here.family))


def fastest_of(here: Moved, servo: int, pulses: Sequence[int]) -> float:
    """Units a millisecond, the fastest of what was asked of it: from where it was while the order waited for
    the wire.
    """
    family = here.family
    tick_ms, range_units = family.motion.tick_ms, family.position.max - family.position.min
    waits = 1 + ceil(2 * interval_ms(len(SERVOS), family) / SAMPLE_MS)
    speeds = [0.0]
    for way in here.ways:
        if way.servo != servo:
            continue
        if way.duration_ms == 0:
            speeds.append(range_units / MOVE.range_ms)
            continue
        sampled = int(way.at_ms / SAMPLE_MS)
        farthest = max(abs(way.to - pulse) for pulse in pulses[max(0, sampled - 2) : sampled + waits])
        # Pulses are whole numbers: the way may be a unit longer.
        speeds.append(
            (farthest + 1) / max(family.shortest_move_ms, floor(way.duration_ms / tick_ms) * tick_ms, tick_ms)
        )
    return max(speeds)


def too_fast(here: Moved, pulses_of: dict[int, list[int]], since: int) -> list[str]:
    """Windows in which a servo went farther than the fastest of what was asked of it lets it."""
    traits, found = here.family.motion, []
    for servo, pulses in pulses_of.items():
        fastest = fastest_of(here, servo, pulses)
        for width in WINDOWS:
            window_ms = width * SAMPLE_MS
            # Pulses are whole numbers.
            limit = ceil(fastest * (window_ms + traits.tick_ms + traits.talk_ms) + UNITS)
            ways = [abs(pulses[at + width] - pulses[at]) for at in range(since, len(pulses) - width)]
            if max(ways, default=0) > limit:
                found.append(f"servo {servo} went {max(ways)} in {window_ms} ms, limit {limit}")
    return found


async def wrongs_of(simulator: Simulator, board: tuple[str, str], door: str, seed: int) -> list[str]:
    family, draw = FAMILIES[board[0]], random.Random(f"{board} {door} {seed}")
    sampled = {"servos": SERVOS, "everyMs": SAMPLE_MS}
    stepped = SteppedBoard(simulator, board[1], PLAIN_BOARD, sampled=sampled)
    control = Control(stepped, now, board[0])
    await control.use_port(DEVICE)
    await asyncio.sleep(0.5)
    here = Moved(family, stepped, control, Client(control, OLGA))
    middles = [family.position_of(servo) for servo in SERVOS]
    centre = [
        ServoTarget(servo, (one.min + one.max) // 2) for servo, one in zip(SERVOS, middles, strict=True)
    ]
    await (Moved.by_script if door == "HTTP" else Moved.by_message)(here, centre, 1500)
    await asyncio.sleep(FIRST_MOVES_S)
    here.ways.clear()
    since = ceil(now() * 1000 / SAMPLE_MS)
    await moved_through(door, draw, here)
    last = {way.servo: way for way in here.ways}
    slack_ms = (
        here.put_off_ms
        + PARTS.rest_ms
        + 3 * interval_ms(len(SERVOS), family)
        + 2 * family.motion.tick_ms
        + 50
    )
    ends_ms = [way.at_ms + way.takes_ms(family) + slack_ms for way in last.values()]
    await asyncio.sleep(max(0.0, max(ends_ms, default=0) / 1000 - now()))
    stepped.run_on(now())
    pulses_of = {servo: [sample[index] for sample in stepped.samples] for index, servo in enumerate(SERVOS)}
    missed = [
        f"servo {servo} is at {pulses_of[servo][-1]}, asked for {way.to}"
        for servo, way in last.items()
        if pulses_of[servo][-1] != way.to
    ]
    wrongs = too_fast(here, pulses_of, since) + missed
    await control.board.link.close()
    return wrongs


@pytest.mark.slow
@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("board", BOARDS, ids=" on ".join)
def test_no_servo_goes_faster_than_what_was_asked_of_it_and_each_arrives_in_time(
    simulator: Simulator, board: tuple[str, str], door: str
) -> None:
    for seed in seeds(HISTORIES, USUALLY):
        with (
            named("test_parts.py", seed, f"{board} at {door}"),
            asyncio.Runner(loop_factory=VirtualTimeLoop) as runner,
        ):
            assert runner.run(wrongs_of(simulator, board, door, seed)) == []


LONG_MS = 20_000


def places_of(servo: int, written: Sequence[tuple[float, bytes]]) -> list[tuple[float, int]]:
    """Where the packets send it, and when they have the board done: a packet takes whole ticks."""
    found = []
    for at_s, packet in written:
        command = command_in(packet)
        if isinstance(command, Move):
            done_ms = at_s * 1000 + wire_ms(len(packet)) + command.duration_ms // 20 * 20
            found += [(done_ms, target.position) for target in command.targets if target.servo == servo]
    return found


@in_virtual_time
async def test_a_short_move_of_a_script_does_not_hasten_another_servo() -> None:
    async with script() as here:
        await here.move(1500, s6=600)
        await asyncio.sleep(1.6)
        await here.move(1500, s4=1500)
        await asyncio.sleep(1.6)
        before = len(here.port.written)
        await here.move(LONG_MS, s6=2400)
        begun_ms = now() * 1000
        await asyncio.sleep(0.7)
        asked_ms = now() * 1000
        await here.move(100, s4=1520)
        await asyncio.sleep(22)
    written = here.port.written[before:]
    fourth = places_of(4, written)
    assert {position for _, position in fourth} == {1520}
    assert fourth[0][0] == pytest.approx(asked_ms + 100, abs=PARTS.rest_ms)
    sixth = places_of(6, written)
    assert sixth[-1][1] == 2400
    assert sixth[-1][0] == pytest.approx(begun_ms + LONG_MS, abs=PARTS.rest_ms)
    for done_ms, position in sixth:
        assert position == pytest.approx(600 + 1800 * (done_ms - begun_ms) / LONG_MS, abs=5)
    assert max(command_in(packet).duration_ms for _, packet in written) <= 1000  # type: ignore[union-attr]


@in_virtual_time
async def test_a_servo_of_unknown_place_takes_its_full_time_in_one_packet_whatever_else_is_under_way() -> (
    None
):
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control, (1,))
        before = len(port.written)
        ask(anna, 5000, s1=2000)
        await asyncio.sleep(0.3)
        ask(anna, LONG_MS, s2=2500)
        await asyncio.sleep(25)
        of_second = [each for each in moves_on(port, before) if 2 in each.positions]
        assert [(each.duration_ms, each.positions[2]) for each in of_second] == [(LONG_MS, 2500)]


@in_virtual_time
async def test_a_packet_by_hand_that_would_hasten_another_servo_is_refused() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, LONG_MS, s1=2500)
        await asyncio.sleep(0.3)
        before = len(port.written)
        with pytest.raises(OutOfRangeError, match=r"^Another servo is under way for \d+ ms more"):
            await anna.send(encode(Move(100, (ServoTarget(2, 1600),)), FAMILIES["doc"]))
        assert port.written[before:] == []
        await anna.send(encode(Move(1000, (ServoTarget(2, 1600),)), FAMILIES["doc"]))
        assert moves_on(port, before)[0].positions == {2: 1600}


@in_virtual_time
async def test_where_each_servo_has_its_own_time_a_packet_by_hand_hastens_none() -> None:
    port = FakePort()
    async with gateway_on(port, board="bus-ctrl") as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        await ask(anna, s1=500, s2=500)
        await asyncio.sleep(3)
        ask(anna, LONG_MS, s1=900)
        await asyncio.sleep(0.3)
        before = len(port.written)
        await anna.send(encode(Move(100, (ServoTarget(2, 600),)), FAMILIES["bus-ctrl"]))
        assert moves_on(port, before)[0].positions == {2: 600}


@in_virtual_time
async def test_what_a_packet_by_hand_has_put_off_goes_on_no_faster() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        before = len(port.written)
        ask(anna, 10_000, s1=2500)
        await asyncio.sleep(0.3)
        await anna.send(encode(Move(4000, (ServoTarget(2, 1600),)), FAMILIES["doc"]))
        await asyncio.sleep(16)
        places = places_of(1, port.written[before:])
        # The packet has the first part, of a second, end with it.
        places[0] = (places_of(2, port.written[before:])[0][0], places[0][1])
        speeds = [
            (position - last) / (done_ms - last_ms)
            for (last_ms, last), (done_ms, position) in pairwise(places)
            if done_ms - last_ms > PARTS.rest_ms
        ]
        assert max(speeds) <= 1000 / 10_000 * 1.03
        assert places[-1][1] == 2500


@in_virtual_time
async def test_a_run_by_hand_is_refused_while_a_move_has_parts_to_come() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, 5000, s1=2500)
        await asyncio.sleep(3)
        before = len(port.written)
        with pytest.raises(MovingError):
            anna.send(RUN)
        await asyncio.sleep(3)
        assert RUN not in [packet for _, packet in port.written[before:]]
        await anna.send(RUN)
        assert port.packets()[-1] == RUN


@in_virtual_time
async def test_a_run_by_hand_does_not_leave_behind_a_move_that_waited_before_it() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        anna.send(BATTERY)
        await asyncio.sleep(0.001)
        ask(anna, 500, s1=1600)
        run = anna.send(RUN)
        with pytest.raises(MovingError):
            await run
        await asyncio.sleep(1)
        assert RUN not in port.packets()


@in_virtual_time
async def test_a_move_is_refused_while_a_group_may_run_or_waits_to() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        run = anna.send(RUN)
        left = ask(anna, 300, s1=1600)
        await run
        with pytest.raises(MovingError):
            await left
        with pytest.raises(MovingError):
            ask(anna, 300, s1=1600)
        await asyncio.sleep(1)
        assert port.packets()[-1] == RUN


async def presses_stop(control: Control, anna: Client) -> None:
    await control.stop()


async def lets_go(control: Control, anna: Client) -> None:
    control.driving.act(anna, "release")


async def is_taken_over(control: Control, anna: Client) -> None:
    control.driving.act(Client(control), "take")


async def is_gone(control: Control, anna: Client) -> None:
    control.leave(anna)


async def falls_silent(control: Control, anna: Client) -> None:
    anna.beats = False


async def finds_a_limit(control: Control, anna: Client) -> None:
    control.limits.set([ServoLimits(servo=1, name="Elbow", min=1400, max=2000)])


async def takes_another_port(control: Control, anna: Client) -> None:
    await control.use_port("/dev/other")


ENDS = [
    presses_stop,
    lets_go,
    is_taken_over,
    is_gone,
    falls_silent,
    finds_a_limit,
    takes_another_port,
]


@pytest.mark.parametrize("end", ENDS)
@in_virtual_time
async def test_what_is_left_of_a_move_ends(end: Callable[[Control, Client], Any]) -> None:
    ports = FakePort(), FakePort()
    async with gateway_on(*ports) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, 10_000, s1=2500)
        await asyncio.sleep(2.2)
        await end(control, anna)
        # The holds of a STOP that the board does not confirm have left by then.
        await asyncio.sleep(2)
        written = [each for port in ports for each in port.written]
        before = len(written)
        # So far it had gone a third of the way at most, or a hold has sent it back to where it was.
        assert all(position <= 1850 for _, position in places_of(1, written))
        await asyncio.sleep(15)
        written = [each for port in ports for each in port.written]
        assert places_of(1, written[before:]) == []
        assert control.board.moves.is_empty


@in_virtual_time
async def test_what_is_left_of_a_move_ends_as_a_servo_is_released() -> None:
    port = FakePort()
    async with gateway_on(port, board="bus-ctrl") as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        await ask(anna, s1=500)
        await asyncio.sleep(3)
        ask(anna, 10_000, s1=900)
        await asyncio.sleep(2.2)
        await anna.send(encode(Release((1,)), FAMILIES["bus-ctrl"]))
        before = len(port.written)
        await asyncio.sleep(15)
        assert moves_on(port, before) == []
        assert control.board.moves.is_empty


@in_virtual_time
async def test_the_last_frame_of_a_play_leaves_also_where_the_wire_is_taken_at_its_end() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        frames = [{"durationMs": 0, "positions": {"1": at}} for at in (1000, 2000)]
        play = {"type": "play", "id": 1, "frames": frames, "times": 1, "loopFrom": 0, "nonce": anna.nonce}
        take(client_message.validate_python(play), anna, control)
        at(now() + 1.495, lambda: anna.send(BATTERY))
        await asyncio.sleep(3)
        assert moves_on(port, 0)[-1].positions == {1: 2000}


@in_virtual_time
async def test_a_newer_order_takes_the_place_of_what_is_left() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, 10_000, s1=2500)
        await asyncio.sleep(2.2)
        before = len(port.written)
        ask(anna, 500, s1=1000)
        await asyncio.sleep(10)
        assert [each.positions for each in moves_on(port, before)] == [{1: 1000}]


@in_virtual_time
async def test_a_place_that_is_lost_on_the_way_ends_it() -> None:
    """The gateway keeps nothing for it that would be due for ever."""
    port = FakePort()
    async with gateway_on(port) as control:
        anna = await driver_at_the_centre(control)
        ask(anna, 10_000, s1=2500)
        await asyncio.sleep(2.2)
        control.board.activity.heard(RunStarted(8, 1), 6)
        before = len(port.written)
        await asyncio.sleep(20)
        assert moves_on(port, before) == []
        assert control.board.moves.is_empty


def test_a_family_whose_parts_are_off_is_moved_by_one_packet(monkeypatch: pytest.MonkeyPatch) -> None:
    doc = FAMILIES["doc"]
    monkeypatch.setitem(FAMILIES, "doc", replace(doc, motion=replace(doc.motion, part_ms=None)))

    @in_virtual_time
    async def moved() -> None:
        port = FakePort()
        async with gateway_on(port) as control:
            anna = await driver_at_the_centre(control)
            before = len(port.written)
            ask(anna, 10_000, s1=2500)
            await asyncio.sleep(12)
            [one] = moves_on(port, before)
            assert (one.duration_ms, one.positions) == (10_000, {1: 2500})

    moved()
