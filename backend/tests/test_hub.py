"""Who finds a seat when many come."""

from itertools import count

from servodeck.callers import Caller, Role
from servodeck.robot.hub import Hub, Session

NUMBERS = count()


def come(hub: Hub, role: Role) -> int:
    """As many devices of that role as find a seat; how many they are."""
    for presence_changed in count():
        caller = Caller(str(next(NUMBERS)), "Somebody", role)
        if not hub.has_room_for(caller):
            return presence_changed
        hub.join(Session(caller))
    raise AssertionError("There is always one more.")


def test_viewers_never_take_the_seats_of_drivers_nor_these_those_of_who_lets_others_in() -> None:
    hub = Hub()
    assert [come(hub, "viewer"), come(hub, "driver"), come(hub, "owner")] == [200, 8, 8]
    assert [come(hub, "viewer"), come(hub, "driver")] == [0, 0]
