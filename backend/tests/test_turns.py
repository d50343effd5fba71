"""How the requests of the unauthenticated wait, and who keeps a place."""

import asyncio
from collections.abc import Callable

from servodeck.access.entrance import RequestQueue
from servodeck.callers import Rate
from tests.virtual_time import in_virtual_time, now


class Caller:
    """A connection that its other end may close."""

    def __init__(self) -> None:
        self._lost: list[Callable[[], None]] = []
        self.is_lost = False

    def when_lost(self, lost: Callable[[], None]) -> None:
        self._lost.append(lost)
        if self.is_lost:
            lost()

    def close(self) -> None:
        self.is_lost = True
        for lost in self._lost:
            lost()


def turns_of_two_and_one_a_second() -> RequestQueue:
    return RequestQueue(Rate(1, 2, now))


@in_virtual_time
async def test_above_the_rate_they_wait_in_the_order_in_which_they_came() -> None:
    turns = turns_of_two_and_one_a_second()
    came: list[tuple[int, float]] = []

    async def ask(number: int) -> None:
        assert await turns.wait(Caller())
        came.append((number, round(now(), 2)))

    await asyncio.gather(*map(ask, range(5)))
    assert came == [(0, 0), (1, 0), (2, 1), (3, 2), (4, 3)]


@in_virtual_time
async def test_a_caller_that_leaves_is_noticed_at_once_and_delays_no_other() -> None:
    turns = turns_of_two_and_one_a_second()
    callers = [Caller() for _ in range(1000)]
    waiting = [asyncio.create_task(turns.wait(caller)) for caller in callers]
    await asyncio.sleep(0)
    for caller in callers[2:]:
        caller.close()
    assert await asyncio.gather(*waiting) == [True, True] + [False] * 998
    assert now() == 0
    last = Caller()
    assert await turns.wait(last)
    assert now() == 1


@in_virtual_time
async def test_who_has_left_before_gets_no_turn() -> None:
    turns = turns_of_two_and_one_a_second()
    for _ in range(2):
        assert await turns.wait(Caller())
    gone = Caller()
    gone.close()
    assert not await turns.wait(gone)
    assert now() == 0
