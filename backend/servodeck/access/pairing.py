"""Invitations: a secret for a link and eight digits for a keyboard, once, for two minutes.

Pure: time comes in; no device, no request, no disk. Five wrong codes spend all codes that are open, whoever
typed them; links, which nobody can guess, go on.
"""

import secrets
from collections.abc import Callable
from dataclasses import dataclass, replace

from servodeck.access.credentials import make_id, make_secret, same
from servodeck.callers import Role
from servodeck.errors import BusyError, NotFoundError, PairingError, PairingLockedError

INVITE_S = 120.0
CODE_DIGITS = 8
CODE_TRIES = 5
MAX_OPEN = 8


@dataclass(frozen=True, slots=True)
class Invite:
    """`code` is None once codes are spent. `name` may be empty: whoever comes says theirs."""

    id: str
    role: Role
    name: str
    secret: str
    code: str | None
    until_s: float


class Pairing:
    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._invites: dict[str, Invite] = {}
        self._wrong_codes = 0

    def invite(self, role: Role, name: str) -> Invite:
        """Raises BusyError where too many are open."""
        if len(self.open) >= MAX_OPEN:
            raise BusyError("Enough invitations are open. They end after two minutes.")
        if not any(invite.code for invite in self.open):
            self._wrong_codes = 0
        code = "".join(secrets.choice("0123456789") for _ in range(CODE_DIGITS))
        made = Invite(make_id(), role, name, make_secret(), code, self._now() + INVITE_S)
        self._invites[made.id] = made
        return made

    @property
    def open(self) -> list[Invite]:
        """Those that still hold."""
        now = self._now()
        self._invites = {one.id: one for one in self._invites.values() if one.until_s > now}
        return list(self._invites.values())

    def seconds_left(self, invite: Invite) -> float:
        return max(0.0, invite.until_s - self._now())

    def withdraw(self, invite: str) -> None:
        if self._invites.pop(invite, None) is None:
            raise NotFoundError("That invitation is over.")

    def find_by_link(self, secret: str) -> Invite:
        """The open invitation of that link; `withdraw` uses it up. Raises PairingError."""
        found = [one for one in self.open if same(one.secret, secret)]
        if not found:
            raise PairingError("This link was used already or is older than two minutes. Ask for a new one.")
        return found[0]

    def find_by_code(self, code: str) -> Invite:
        """Raises PairingError, and PairingLockedError where codes are spent."""
        if self._wrong_codes >= CODE_TRIES:
            raise locked()
        found = [one for one in self.open if one.code and same(one.code, code)]
        if found:
            return found[0]
        self._wrong_codes += 1
        if self._wrong_codes >= CODE_TRIES:
            self._invites = {one.id: replace(one, code=None) for one in self._invites.values()}
            raise locked()
        raise PairingError("That code is wrong or older than two minutes.")


def locked() -> PairingLockedError:
    return PairingLockedError(
        "Five wrong codes: no code counts any more. Ask for a new one, or scan the link."
    )
