"""Who asks, and what they may do at most. Knows no socket, no credential and no rule of motion."""

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
        """Whether `role` is enough for what is asked: each role may do all that the ones below it may."""
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
