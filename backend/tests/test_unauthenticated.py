"""Unauthenticated connections, compared with plain lists: how many there may be of one address and of
all, and which one ends where there are too many.
"""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.access import connections
from servodeck.access.connections import MOST, MOST_OF_ONE, Unauthenticated
from servodeck.api.health import WANTED
from servodeck.robot.hub import SESSIONS_AT_MOST
from tests.amount import TIMES

FEW, FEW_OF_ONE = 5, 3
SOURCES = st.sampled_from(["192.168.0.2", "192.168.0.3", "192.168.0.4"])
STEPS = st.lists(
    st.one_of(
        st.tuples(st.just("add"), SOURCES, st.just(0)),
        st.tuples(st.sampled_from(["use", "remove"]), st.just(""), st.integers(0, 7)),
    ),
    max_size=40,
)


class Link:
    def __init__(self) -> None:
        self.has_ended = False

    def abort(self) -> None:
        assert not self.has_ended
        self.has_ended = True


@settings(max_examples=200 * TIMES)
@given(steps=STEPS)
def test_the_least_used_of_one_address_ends_first_else_that_of_all(steps: list[tuple[str, str, int]]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(connections, "MOST", FEW)
        patch.setattr(connections, "MOST_OF_ONE", FEW_OF_ONE)
        links, expected = Unauthenticated(), list[tuple[str, Link]]()
        made, ended = list[Link](), list[Link]()
        for what, source, number in steps:
            if what == "add":
                made.append(Link())
                links.add(made[-1], source)
                expected.append((source, made[-1]))
                own = [one for one in expected if one[0] == source]
                too_many = own if len(own) > FEW_OF_ONE else expected if len(expected) > FEW else []
                if too_many:
                    ended.append(too_many[0][1])
                    expected.remove(too_many[0])
            elif number < len(made):
                link = made[number]
                (links.use if what == "use" else links.remove)(link)
                if waiting := next((one for one in expected if one[1] is link), None):
                    expected.remove(waiting)
                    expected += [waiting] if what == "use" else []
            assert [link for link in made if link.has_ended] == [link for link in made if link in ended]


def test_all_of_them_and_every_seat_leave_descriptors_for_a_stop() -> None:
    assert MOST_OF_ONE < MOST
    assert MOST + max(SESSIONS_AT_MOST.values()) <= WANTED / 2
