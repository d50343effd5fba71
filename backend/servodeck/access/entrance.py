"""Who is at the door, and how fast they may ask over HTTP: joins where the gateway answers, who is paired and
who is invited. Local mode knows everybody.

Each paired device and each token has its rate (docs/adr/0013); unauthenticated callers share one and wait in
a queue, in which those who leave give up their place at once. This computer's own page and scripts share one
name and are never counted: a script that runs away would shut the page out. Knows headers and time; no route,
no board and no page.
"""

import asyncio
from collections.abc import Callable
from typing import Protocol

from servodeck.access.addresses import Access
from servodeck.access.credentials import Invite, Pairing, credential_of
from servodeck.access.devices import MAX_DEVICES, Device, Devices
from servodeck.callers import THIS_COMPUTER, Caller, Role
from servodeck.errors import NotPairedError, PairingError, TooManyError
from servodeck.rate import Rate


class Entrance:
    def __init__(self, access: Access, devices: Devices, now: Callable[[], float]) -> None:
        self.access = access
        self.devices = devices
        self.pairing = Pairing(now)
        self._rates = Rates(now)

    def find(self, headers: list[tuple[bytes, bytes]]) -> Caller | None:
        """The caller, where they have proved who they are; else None."""
        if not self.access.needs_pairing:
            return THIS_COMPUTER
        credential = credential_of(headers, self.access.cookie)
        device = self.devices.find(credential) if credential else None
        return device.caller if device else None

    def judge(self, headers: list[tuple[bytes, bytes]], role: Role) -> Caller:
        """Raises NotPairedError for an unauthenticated caller, ForbiddenError for one who may do less."""
        caller = self.find(headers)
        if caller is None:
            raise NotPairedError("This device is not paired with the gateway.")
        caller.require(role)
        return caller

    def still_lets_in(self, caller: Caller) -> bool:
        """A caller who was let in a moment ago may have been revoked since, or have another role."""
        return not self.access.needs_pairing or self.devices.role_of(caller.id) == caller.role

    def count(self, caller: Caller) -> None:
        """One more request of theirs. Raises TooManyError."""
        if caller is not THIS_COMPUTER:
            self._rates.take(self.devices.get(caller.id))

    def accept_invite(self, invite: Invite, name: str, present: Caller | None) -> tuple[Caller, str | None]:
        """Uses the invitation up: who they are from now on, and their new credential. A caller who may do as
        much already stays who they are, and the invitation stays open for somebody else; one who may do less
        keeps their name.
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


class Connection(Protocol):
    def when_lost(self, lost: Callable[[], None]) -> None:
        """Once, and at once where it is lost already."""


class RequestQueue:
    def __init__(self, rate: Rate) -> None:
        self._rate = rate
        # The one that came first comes first.
        self._waiting: dict[Connection, asyncio.Future[bool]] = {}
        self._timer: asyncio.TimerHandle | None = None

    async def wait(self, connection: Connection) -> bool:
        """In the order in which they came; false where it was lost before."""
        if not self._waiting and self._rate.take():
            return True
        place: asyncio.Future[bool] = asyncio.get_running_loop().create_future()
        self._waiting[connection] = place
        connection.when_lost(lambda: self._give(connection, is_there=False))
        self._call_later()
        return await place

    def _give(self, connection: Connection, *, is_there: bool) -> None:
        place = self._waiting.pop(connection, None)
        if place is not None and not place.done():
            place.set_result(is_there)

    def _call_later(self) -> None:
        if self._waiting and self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(self._rate.wait_s, self._call)

    def _call(self) -> None:
        self._timer = None
        if self._waiting and self._rate.take():
            self._give(next(iter(self._waiting)), is_there=True)
        self._call_later()


# Requests a second, and at once after a rest.
OF_DRIVERS, OF_VIEWERS = (30.0, 60), (2.0, 10)
# A page that opens reads each robot of the library at once: 57 requests were counted with 50 of them.
PAGE_BURST = 200


class Rates:
    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._rates: dict[tuple[str, Role], Rate] = {}

    def take(self, device: Device) -> None:
        """One more request of theirs. Raises TooManyError."""
        rate = self._rate_of(device)
        if not rate.take():
            raise TooManyError(
                f"{device.name} sends too many requests: try again in {rate.wait_s:.1f} s.", rate.wait_s
            )

    def _rate_of(self, device: Device) -> Rate:
        key = device.id, device.role
        if key not in self._rates:
            if len(self._rates) >= 2 * MAX_DEVICES:  # one that was revoked meanwhile
                del self._rates[next(iter(self._rates))]
            per_second, burst = OF_DRIVERS if device.caller.may("driver") else OF_VIEWERS
            is_page = device.kind == "device"
            self._rates[key] = Rate(per_second, PAGE_BURST if is_page else burst, self._now)
        return self._rates[key]
