"""Frames that the gateway plays for a page, in virtual time: what leaves when, what ends it, who hears of
it.
"""

import asyncio
import itertools
from collections.abc import Awaitable, Callable, Sequence
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import GatewayError, MovingError, OutOfRangeError
from servodeck.intents import FrameBody, PlayMessage, StopMessage, StopPlayingMessage
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.values import Frame, Move, ServoTarget
from servodeck.robot.control import Control
from servodeck.snapshots import ServoLimits
from tests.amount import TIMES
from tests.client import ANNA, Client, driven, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, DOWNLOAD, ERASE, MOVE, RUN, STOP, wire_ms
from tests.virtual_time import hold_up, in_virtual_time, now

BERT = Caller("bert", "Bert", "driver")
LEAD_S = 1.5


def frame(duration_ms: int, **positions: int) -> Frame:
    return Frame(duration_ms, tuple(ServoTarget(int(key[1:]), at) for key, at in positions.items()))


WAVE = [frame(200, s1=1000), frame(300, s1=2000), frame(250, s1=1500)]


def ask(session: Client, frames: Sequence[Frame] = WAVE, times: int = 1, loop_from: int = 0) -> None:
    """As a page, with the newest nonce; its answer has id 7."""
    bodies = [
        FrameBody(duration_ms=one.duration_ms, positions={str(to.servo): to.position for to in one.targets})
        for one in frames
    ]
    nonce = session.nonce or "none"
    wish = PlayMessage(type="play", id=7, frames=bodies, times=times, loop_from=loop_from, nonce=nonce)
    take(wish, session, session.control)


def moves(port: FakePort) -> list[tuple[float, Move]]:
    """When each began to leave, since the first."""
    found = [(at_s, parse_command(packet)) for at_s, packet in port.written]
    of_moves = [(at_s, command) for at_s, command in found if isinstance(command, Move)]
    return [(round(at_s - of_moves[0][0], 6), move) for at_s, move in of_moves]


async def answer(session: Client, kind: str = "played") -> Any:
    """The newest of that kind, or None."""
    return next((message for message in reversed(await session.heard()) if message["type"] == kind), None)


@in_virtual_time
async def test_it_goes_gently_to_the_first_frame_and_then_keeps_each_deadline() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna)
        await asyncio.sleep(4)
        assert [at_s for at_s, _ in moves(port)] == [0, 1.5, 1.8]
        assert [move.duration_ms for _, move in moves(port)] == [1500, 300, 250]
        played = await answer(anna)
        assert (played["id"], played["play"]["status"]) == (7, "done")
        assert (played["play"]["skippedFrames"], played["play"]["lateFrames"]) == (0, 0)
        assert control.board.plays.present is None


@given(
    st.lists(st.tuples(st.integers(30, 400), st.integers(500, 2500)), min_size=1, max_size=20),
    st.integers(1, 3),
)
@settings(max_examples=20 * TIMES)
@in_virtual_time
async def test_each_frame_begins_to_leave_at_its_instant_however_often_it_is_played(
    steps: list[tuple[int, int]], times: int
) -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(duration_ms, s1=position) for duration_ms, position in steps], times)
        durations_ms = [duration_ms for duration_ms, _ in steps] * times
        durations_ms[0] = 1500
        await asyncio.sleep(sum(durations_ms) / 1000 + 1)
        due_s = [sum(durations_ms[:count]) / 1000 for count in range(len(durations_ms))]
        assert [at_s for at_s, _ in moves(port)] == pytest.approx(due_s, abs=1e-4)
        assert (await answer(anna))["play"]["skippedFrames"] == 0


@in_virtual_time
async def test_every_client_gets_its_progress_and_later_ones_too() -> None:
    async with driven() as (control, _port, anna):
        bert = Client(control, BERT)
        control.driving.act(anna, "request")
        ask(anna, times=2)
        await asyncio.sleep(1.6)
        await bert.heard()
        await asyncio.sleep(0.3)
        play = (await answer(bert, "play"))["play"]
        assert (play["status"], play["frameIndex"], play["frameCount"], play["times"]) == ("playing", 2, 3, 2)
        welcome = (await Client(control, BERT).heard())[0]
        assert welcome["play"] == play
        await asyncio.sleep(3)
        assert (await answer(bert, "play"))["play"]["status"] == "done"
        assert await answer(bert) is None


@in_virtual_time
async def test_frames_of_20_ms_are_published_no_more_often_than_can_be_seen() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(20, s1=1000 + index) for index in range(100)])
        await asyncio.sleep(5)
        messages = [message for message in await anna.heard() if message["type"] == "play"]
        assert len(messages) <= 100 * 0.02 / 0.05 + 4
        assert len(moves(port)) == 100


@in_virtual_time
async def test_it_repeats_without_drift_until_it_is_stopped() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, times=0)
        await asyncio.sleep(1.5 + 0.55 + 0.75 * 9 + 0.04)
        take(StopPlayingMessage(type="stopPlaying"), anna, control)
        await asyncio.sleep(5)
        assert len(moves(port)) == 1 + 2 + 27 + 1
        assert moves(port)[-1][0] == pytest.approx(1.5 + 0.55 + 0.75 * 9, abs=1e-6)
        assert (await answer(anna))["play"]["code"] == "cancelled"
        assert (STOP in port.packets()[1:], control.latch) == (False, False)


@in_virtual_time
async def test_each_pass_but_the_first_begins_at_loop_from() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, times=3, loop_from=1)
        await asyncio.sleep(6)
        assert [at_s for at_s, _ in moves(port)] == pytest.approx([0, 1.5, 1.8, 2.05, 2.35, 2.6, 2.9])
        assert (await answer(anna))["play"]["status"] == "done"


@in_virtual_time
async def test_a_gateway_that_is_held_up_plays_each_frame_later_makes_up_for_it_and_says_so() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(40, s1=1000 + 10 * (index % 20)) for index in range(55)])
        await asyncio.sleep(1.901)
        hold_up(0.3)
        await asyncio.sleep(0.2)
        hold_up(0.12)
        await asyncio.sleep(6)
        at_s = [one for one, _ in moves(port)]
        assert len(at_s) == 55
        assert min(b - a for a, b in itertools.pairwise(at_s)) >= 0.036 - 1e-6
        assert at_s[-1] < 1.5 + 53 * 0.04 + 0.26
        play = (await answer(anna))["play"]
        assert play["lateFrames"] > 0
        assert play["latestMs"] > 200
        assert play["skippedFrames"] == 0


@in_virtual_time
async def test_servos_of_unknown_place_start_one_after_another_and_the_next_frame_waits_for_them() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(200, s1=1000, s2=1000, s3=1000), frame(300, s1=2000, s2=2000, s3=2000)])
        await asyncio.sleep(4)
        left = moves(port)
        assert [round(at_s, 3) for at_s, _ in left] == [0, 0.25, 0.5, 2.0]
        assert [(len(move.targets), move.duration_ms) for _, move in left] == [(1, 1500)] * 3 + [(3, 300)]


@in_virtual_time
async def test_a_servo_that_a_later_frame_names_first_goes_slowly_there_too() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(200, s1=1000), frame(300, s1=2000, s2=2000, s3=2000)])
        await asyncio.sleep(6)
        starts = {
            servo: next(
                (at_s, move) for at_s, move in moves(port) if servo in [one.servo for one in move.targets]
            )
            for servo in (2, 3)
        }
        of_new = sorted(starts.values(), key=lambda start: start[0])
        assert all(move.duration_ms >= 1500 for _, move in of_new)
        assert of_new[1][0] - of_new[0][0] >= 0.22


@in_virtual_time
async def test_limits_are_judged_for_all_frames_before_the_first_one_leaves() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(200, s1=1000), frame(200, s1=2600)])
        assert (await answer(anna, "refused"))[
            "detail"
        ] == "position of servo 1 is 2600, allowed 500..2500 µs"
        ask(anna, [frame(200, s1=1000), frame(30_001, s1=2000)])
        assert (await answer(anna, "refused"))["code"] == "outOfRange"
        ask(anna, loop_from=3)
        assert (await answer(anna, "refused"))["detail"] == "loopFrom is 3, allowed 0..2"
        control.limits.set([ServoLimits(servo=1, name="Elbow", min=900, max=1800)])
        ask(anna)
        refused = await answer(anna, "refused")
        assert (refused["id"], refused["code"]) == (7, "outOfRange")
        assert "Elbow" in refused["detail"]
        await asyncio.sleep(1)
        assert moves_or_none(port) == []


def moves_or_none(port: FakePort) -> list[bytes]:
    return [packet for packet in port.packets() if packet[3] == MOVE[3]]


@in_virtual_time
async def test_one_thing_at_a_time() -> None:
    async with driven() as (control, _port, anna):
        control.driving.act(anna, "request")
        ask(anna, times=0)
        await asyncio.sleep(0.1)
        ask(anna)
        refused = await answer(anna, "refused")
        assert (refused["code"], "frame 1 of 3" in refused["detail"]) == ("busy", True)
        for packet in (RUN, ERASE):
            with pytest.raises(MovingError):
                anna.send(packet)
        with pytest.raises(GatewayError):
            anna.send(DOWNLOAD)
        take(StopPlayingMessage(type="stopPlaying"), anna, control)
        await asyncio.sleep(2)
        await anna.send(RUN)
        ask(anna)
        assert (await answer(anna, "refused"))["code"] == "busy"


@in_virtual_time
async def test_a_slider_of_its_driver_moves_meanwhile_and_the_next_frame_takes_the_servo_back() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna)
        await asyncio.sleep(1.6)
        await anna.send(MOVE)
        await asyncio.sleep(3)
        targets = [move.targets[0].position for _, move in moves(port)]
        assert targets == [1000, 2000, 2000, 1500]
        assert (await answer(anna))["play"]["skippedFrames"] == 0


@in_virtual_time
async def test_a_servo_that_no_frame_names_is_the_sliders_throughout_also_where_frames_name_none() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(200), frame(300, s2=2000), frame(250)])
        await asyncio.sleep(1.6)
        # Any sooner, and it would make the first move of servo 2 faster.
        with pytest.raises(OutOfRangeError):
            await anna.send(MOVE)
        await anna.send(encode(Move(1600, (ServoTarget(1, 2000),)), FAMILIES["doc"]))
        await asyncio.sleep(3)
        targets = [(to.servo, to.position) for _, move in moves(port) for to in move.targets]
        assert sorted(targets) == [(1, 2000), (2, 2000)]
        played = (await answer(anna))["play"]
        assert (played["status"], played["skippedFrames"], played["frameCount"]) == ("done", 0, 3)


async def presses_stop(control: Control, _: FakePort, anna: Client) -> None:
    take(StopMessage(type="stop"), Client(control, Caller("v", "Vera", "viewer")), control)


async def sends_a_plain_stop(control: Control, _: FakePort, anna: Client) -> None:
    control.requests.send(Client(control, Caller("v", "Vera", "viewer")), STOP.hex())


async def falls_silent(control: Control, _: FakePort, anna: Client) -> None:
    anna.beats = False
    await asyncio.sleep(0.76)


async def leaves(control: Control, _: FakePort, anna: Client) -> None:
    control.leave(anna)


async def lets_go(control: Control, _: FakePort, anna: Client) -> None:
    control.driving.act(anna, "release")


async def is_taken_over(control: Control, _: FakePort, anna: Client) -> None:
    control.driving.act(Client(control), "take")


async def is_revoked(control: Control, _: FakePort, anna: Client) -> None:
    control.disconnect(ANNA.id, "Revoked.", "Olga")


async def loses_the_port(control: Control, port: FakePort, anna: Client) -> None:
    port.unplug()
    await asyncio.sleep(0.001)


async def closes_the_port(control: Control, _: FakePort, anna: Client) -> None:
    await control.close_port()


async def stops_playing(control: Control, _: FakePort, anna: Client) -> None:
    take(StopPlayingMessage(type="stopPlaying"), anna, control)


ENDS: dict[str, Callable[[Control, FakePort, Client], Awaitable[None]]] = {
    one.__name__: one
    for one in (
        presses_stop,
        sends_a_plain_stop,
        falls_silent,
        leaves,
        lets_go,
        is_taken_over,
        is_revoked,
        loses_the_port,
        closes_the_port,
        stops_playing,
    )
}
LATCHING = {"presses_stop", "falls_silent", "leaves", "is_revoked", "loses_the_port"}


INSTANTS_S = st.one_of(st.sampled_from([0.0, 1.495, 1.5, 1.505, 2.4, 3.0]), st.floats(0, 9))


@pytest.mark.parametrize("end", ENDS)
@given(after_s=INSTANTS_S)
@settings(max_examples=10 * TIMES)
def test_after_any_end_at_any_instant_none_of_its_frames_leaves(end: str, after_s: float) -> None:
    end_it(end, after_s)


@in_virtual_time
async def end_it(end: str, after_s: float) -> None:
    port, later = FakePort(), FakePort()
    async with gateway_on(port, later) as control:
        anna = Client(control, ANNA)
        control.driving.act(anna, "request")
        ask(anna, [*WAVE, frame(5000)], times=0)  # in the pause nothing moves
        await asyncio.sleep(after_s)
        await ENDS[end](control, port, anna)
        ended_s = now()
        await asyncio.sleep(0)
        assert control.board.plays.present is None
        await asyncio.sleep(12)
        behind = [packet for at_s, packet in (*port.written, *later.written) if at_s > ended_s + 1e-9]
        held = [packet for packet in behind if isinstance(parse_command(packet), Move)]
        assert set(held) <= holds_of(port), (after_s, [packet.hex() for packet in behind])
        assert control.latch is (end in LATCHING)
        assert control.board.plays.latest is not None
        assert control.board.plays.latest.status == "ended"


def holds_of(port: FakePort) -> set[bytes]:
    """Those that come right behind a stop."""
    written = [packet for _, packet in port.everything()]
    return {packet for before, packet in itertools.pairwise(written) if before.endswith(STOP)}


@in_virtual_time
async def test_a_stop_holds_the_servo_on_its_way_and_a_resume_does_not_bring_it_back() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        ask(anna, [frame(1500, s1=1000), frame(2000, s1=2000)], times=0)
        await asyncio.sleep(2.5)
        await control.stop()
        *_, hold = [move for _, move in moves(port)]
        assert 1000 < hold.targets[0].position < 2000
        count = len(port.written)
        control.resume(anna.caller)
        await asyncio.sleep(10)
        assert len(port.written) == count
        play = (await answer(anna))["play"]
        assert (play["status"], play["code"]) == ("ended", "latched")


@in_virtual_time
async def test_a_way_to_the_first_frame_that_waits_for_the_wire_is_not_cut_short() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        await anna.send(MOVE)
        await asyncio.sleep(2)
        for _ in range(8):
            anna.send(BATTERY)
        ask(anna)
        await asyncio.sleep(5)
        waited_s = moves(port)[1][0] - 2 - wire_ms(MOVE) / 1000
        assert waited_s > 0.1
        begun = [(at_s, move.targets[0].position) for at_s, move in moves(port)[1:]]
        # The way to the first frame is 1.5 s long and leaves in two parts.
        lead_s, rest_s, second_s, third_s = (at_s for at_s, _ in begun)
        assert lead_s < rest_s < second_s
        assert second_s - lead_s == pytest.approx(1.5)
        assert third_s - second_s == pytest.approx(0.3)


@in_virtual_time
async def test_the_way_to_the_first_frame_that_cannot_leave_in_time_keeps_the_others_back() -> None:
    async with driven() as (control, port, anna):
        control.driving.act(anna, "request")
        long_move = encode(
            Move(1000, tuple(ServoTarget(servo, 1500) for servo in range(1, 33))), FAMILIES["doc"]
        )
        for _ in range(8):
            anna.send(long_move)
        await asyncio.sleep(0.01)
        ask(anna, [frame(100, s1=1000), frame(100, s1=2000)], times=0)
        await asyncio.sleep(5)
        play = (await answer(anna))["play"]
        assert (play["status"], play["code"]) == ("ended", "expired")
        assert {len(move.targets) for _, move in moves(port)} == {32}


@in_virtual_time
async def test_what_was_asked_before_a_stop_does_not_begin_behind_its_resume() -> None:
    async with driven() as (control, _port, anna):
        control.driving.act(anna, "request")
        await asyncio.sleep(0.01)
        control.stop()
        control.resume(anna.caller)
        ask(anna)
        assert (await answer(anna, "refused"))["code"] == "cancelled"
        await asyncio.sleep(0.3)
        ask(anna)
        assert await answer(anna, "refused") is None


@in_virtual_time
async def test_no_client_plays_without_the_lease_or_with_an_old_nonce() -> None:
    async with driven() as (control, port, anna):
        bert = Client(control, BERT)
        ask(bert)
        assert (await answer(bert, "refused"))["code"] == "notDriving"
        vera = Client(control, Caller("v", "Vera", "viewer"))
        ask(vera)
        assert (await answer(vera, "refused"))["code"] == "forbidden"
        control.driving.act(anna, "request")
        anna.beats = False
        await asyncio.sleep(0.55)
        ask(anna)
        assert (await answer(anna, "refused"))["code"] == "expired"
        assert moves_or_none(port) == []
