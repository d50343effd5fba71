"""Who may do what at most."""

from servodeck.callers import RANKS, Caller


def test_each_role_may_do_what_those_below_it_may() -> None:
    order = ["stopper", "viewer", "driver", "owner"]
    assert list(RANKS) == order
    for index, role in enumerate(RANKS):
        allowed = [other for other in RANKS if Caller("1", "Phone", role).may(other)]
        assert allowed == order[: index + 1]
