"""Callers: their name, role and rate. Knows no socket, no credential and no rule of motion."""

from collections.abc import Callable
from dataclasses import replace
from typing import Literal

from servodeck.errors import ForbiddenError
from servodeck.value import value

Role = Literal["stopper", "viewer", "driver", "owner"]
RANKS: dict[Role, int] = {"stopper": 0, "viewer": 1, "driver": 2, "owner": 3}


@value
class Caller:
    """`id` stays the same for a device or script; two tabs of one browser share it. `name` is for people."""

    id: str
    name: str
    role: Role

    def may(self, role: Role) -> bool:
        """Whether `role` is enough for what is requested: each role may do all that the ones below it may."""
        return RANKS[self.role] >= RANKS[role]

    def require(self, role: Role) -> None:
        """Raises ForbiddenError where it is not."""
        if not self.may(role):
            raise ForbiddenError(f"{self.name} has the role {self.role}; this needs the role {role}.")


THIS_COMPUTER = Caller("local", "This computer", "owner")
"""A caller on the gateway's own computer owns it."""

LOCAL_SCRIPT = replace(THIS_COMPUTER, name="A script on this computer")
LOCAL_NAMES = frozenset({THIS_COMPUTER.name, LOCAL_SCRIPT.name})


def as_script(caller: Caller) -> Caller:
    """A token has its name already; this computer's page and its scripts shall have different names."""
    return LOCAL_SCRIPT if caller is THIS_COMPUTER else caller


# A clock's rounding must not make a timer fire for ever at the same instant.
SHORTEST_WAIT_S = 0.001


class Rate:
    """So many a second, and `burst` at once after a rest."""

    def __init__(self, per_second: float, burst: int, now: Callable[[], float]) -> None:
        self._per_second = per_second
        self.burst = burst
        self._now = now
        self._left = float(burst)
        self._counted_at_s = now()

    def take(self) -> bool:
        self._count()
        if self._left < 1:
            return False
        self._left -= 1
        return True

    @property
    def wait_s(self) -> float:
        """Until one more may be taken."""
        self._count()
        return max(SHORTEST_WAIT_S, (1 - self._left) / self._per_second)

    def _count(self) -> None:
        now_s = self._now()
        self._left = min(self.burst, self._left + (now_s - self._counted_at_s) * self._per_second)
        self._counted_at_s = now_s
