"""How fast a client is listened to."""

import asyncio

from hypothesis import given
from hypothesis import strategies as st

from servodeck.api.intake import Intake, merged
from servodeck.callers import Rate
from servodeck.intents import AnyClientMessage, MoveMessage, PacketMessage, ResumeMessage, StopMessage, Target
from tests.virtual_time import in_virtual_time, now

STOP = StopMessage(type="stop")


class Listener:
    """An intake that takes two at once and one a second, and what came of each message."""

    def __init__(self, per_second: float = 1, burst: int = 2) -> None:
        self.taken: list[tuple[float, AnyClientMessage]] = []
        self.replaced: list[AnyClientMessage] = []
        self.overruns = 0
        rate = Rate(per_second, burst, now)
        self.intake = Intake(rate, self._take, merged, self.replaced.append, self._overrun)

    def _take(self, message: AnyClientMessage) -> None:
        self.taken.append((round(now(), 3), message))

    def _overrun(self) -> None:
        self.overruns += 1

    def send(self, *ids: int) -> None:
        for each in ids:
            self.intake.offer(sent(each))


def moved(number: int, *servos: int, duration_ms: int = 0) -> MoveMessage:
    targets = [Target(servo=servo, position=number) for servo in servos]
    return MoveMessage(type="move", id=number, targets=targets, duration_ms=duration_ms, nonce="1-1")


def sent(number: int) -> PacketMessage:
    return PacketMessage(type="packet", id=number, bytes="", nonce=None)


@in_virtual_time
async def test_above_the_rate_the_newest_waits_and_older_ones_are_refused() -> None:
    listener = Listener()
    listener.send(1, 2, 3, 4)
    assert listener.replaced == [sent(3)]
    await asyncio.sleep(5)
    assert listener.taken == [(0, sent(1)), (0, sent(2)), (1, sent(4))]
    listener.send(5)
    assert listener.taken[-1] == (5, sent(5))
    assert listener.overruns == 0


@in_virtual_time
async def test_far_above_the_rate_it_is_over() -> None:
    listener = Listener()
    listener.send(*range(5))
    assert listener.overruns == 0
    listener.send(5)
    assert listener.overruns == 1


@in_virtual_time
async def test_a_little_above_for_long_only_loses_what_is_too_much() -> None:
    listener = Listener()
    for number in range(40):
        listener.send(number)
        await asyncio.sleep(0.8)
    assert listener.overruns == 0
    assert len(listener.taken) >= 32


@in_virtual_time
async def test_above_the_rate_no_servos_last_value_is_lost() -> None:
    listener = Listener()
    for message in (moved(1, 1), moved(2, 1), moved(3, 1, 2), moved(4, 2, 3)):
        listener.intake.offer(message)
    assert listener.replaced == []
    await asyncio.sleep(2)
    [_, _, (_, last)] = listener.taken
    assert isinstance(last, MoveMessage)
    assert (last.id, {target.servo: target.position for target in last.targets}) == (4, {1: 3, 2: 4, 3: 4})
    for message in (moved(5, 1), moved(6, 1), moved(7, 1), moved(8, 2, duration_ms=500)):
        listener.intake.offer(message)
    assert listener.replaced == [moved(7, 1)]  # who has asked hears of it


@in_virtual_time
async def test_a_stop_passes_at_any_rate_and_nothing_that_waited_comes_behind_it() -> None:
    listener = Listener()
    listener.send(1, 2)
    listener.intake.offer(ResumeMessage(type="resume"))
    for _ in range(100):
        listener.intake.take_at_once(STOP)
    assert [message for _, message in listener.taken[2:]] == [STOP] * 100
    assert listener.replaced == [ResumeMessage(type="resume")]
    await asyncio.sleep(10)
    assert len(listener.taken) == 102
    assert listener.overruns == 0


@in_virtual_time
async def test_messages_of_a_client_that_left_are_ignored() -> None:
    listener = Listener()
    listener.send(1, 2, 3)
    listener.intake.close()
    await asyncio.sleep(10)
    assert [message for _, message in listener.taken] == [sent(1), sent(2)]


@given(st.lists(st.floats(min_value=0, max_value=3), max_size=60))
def test_never_more_than_the_rate_allows_and_the_last_one_always_arrives(pauses_s: list[float]) -> None:
    check_rate(pauses_s)


@in_virtual_time
async def check_rate(pauses_s: list[float]) -> None:
    listener = Listener()
    for number, pause_s in enumerate(pauses_s):
        listener.send(number)
        await asyncio.sleep(pause_s)
    await asyncio.sleep(2)
    times_s = [at_s for at_s, _ in listener.taken]
    for first, at_s in enumerate(times_s):
        within = sum(at_s <= other <= at_s + 10 for other in times_s[first:])
        assert within <= 2 + 10 + 1
    ids = [message.id for _, message in listener.taken if isinstance(message, PacketMessage)]
    assert ids == sorted(ids)
    assert not pauses_s or ids[-1] == len(pauses_s) - 1
