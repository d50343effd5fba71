"""Which clients get a place when many connect, and how often a state is published that changes often."""

import asyncio
from itertools import count

import pytest

from servodeck.callers import Caller, Role
from servodeck.robot.hub import Hub, Session, Throttle
from tests.virtual_time import in_virtual_time, now

NUMBERS = count()


def come(hub: Hub, role: Role) -> int:
    """As many devices of that role as find a seat; how many they are."""
    for presence_changed in count():
        caller = Caller(str(next(NUMBERS)), "A device", role)
        if not hub.has_room_for(caller):
            return presence_changed
        hub.join(Session(caller))
    raise AssertionError("There is always one more.")


def test_viewers_never_take_the_seats_of_drivers_nor_these_those_of_who_lets_others_in() -> None:
    hub = Hub()
    assert [come(hub, "viewer"), come(hub, "driver"), come(hub, "owner")] == [200, 8, 8]
    assert [come(hub, "viewer"), come(hub, "driver")] == [0, 0]


@in_virtual_time
async def test_a_state_that_changes_often_is_published_at_once_then_in_its_time_and_at_its_end() -> None:
    begun_s, states, published = now(), list[int](), list[tuple[float, int]]()
    throttle = Throttle(lambda: published.append((now() - begun_s, states[-1])), 0.1, now)
    for state in range(9):
        states.append(state)
        throttle.soon()
        await asyncio.sleep(0.03)
    throttle.at_once()
    await asyncio.sleep(1)
    assert [each for _, each in published] == [0, 3, 6, 8]
    assert [at_s for at_s, _ in published] == pytest.approx([0, 0.1, 0.2, 0.27])
