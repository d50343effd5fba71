"""Who is at the door: joins where we answer, who is paired and who is invited. Local mode knows everybody.

Knows headers; no route, no board and no page.
"""

from collections.abc import Callable

from servodeck.access.addresses import Access
from servodeck.access.credentials import Invite, Pairing, credential_of
from servodeck.access.devices import Device, Devices
from servodeck.access.rates import Rates
from servodeck.callers import THIS_COMPUTER, Caller, Role
from servodeck.errors import NotPairedError, PairingError


class Entrance:
    def __init__(self, access: Access, devices: Devices, now: Callable[[], float]) -> None:
        self.access = access
        self.devices = devices
        self.pairing = Pairing(now)
        self._rates = Rates(now)

    def find(self, headers: list[tuple[bytes, bytes]]) -> Caller | None:
        """Whoever has proved who they are; None for a stranger."""
        if not self.access.needs_pairing:
            return THIS_COMPUTER
        credential = credential_of(headers, self.access.cookie)
        device = self.devices.find(credential) if credential else None
        return device.caller if device else None

    def judge(self, headers: list[tuple[bytes, bytes]], role: Role) -> Caller:
        """Raises NotPairedError for a stranger, ForbiddenError for somebody who may do less."""
        caller = self.find(headers)
        if caller is None:
            raise NotPairedError("This device is not paired with the gateway.")
        caller.require(role)
        return caller

    def still_lets_in(self, caller: Caller) -> bool:
        """Whoever was let in a moment ago may have been revoked since, or have another role."""
        return not self.access.needs_pairing or self.devices.role_of(caller.id) == caller.role

    def count(self, caller: Caller) -> None:
        """One more request of theirs. Raises TooManyError."""
        if caller is not THIS_COMPUTER:
            self._rates.take(self.devices.get(caller.id))

    def accept_invite(self, invite: Invite, name: str, present: Caller | None) -> tuple[Caller, str | None]:
        """Uses the invitation up: who they are from now on, and their new credential. Whoever may do as much
        already stays who they are, and the invitation stays open for somebody else; whoever may less keeps
        their name.
        """
        if present and present.may(invite.role):
            return present, None
        before = present if present and present.role != "stopper" else None
        if before:
            self.devices.revoke(before.id)
        called = invite.name or (before.name if before else name) or "Somebody"
        device, credential = self.devices.admit("device", called, invite.role)
        self.pairing.withdraw(invite.id)
        return device.caller, credential

    def stop_link(self, credential: str) -> Device:
        """The stop-only link that this is. Raises PairingError."""
        device = self.devices.find(credential)
        if device is None or device.kind != "stopLink":
            raise PairingError("This stop-only link is no longer valid. Ask for a new one.")
        return device
