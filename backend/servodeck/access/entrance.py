"""Finds the caller of a request, pairs devices by invitation, and limits the rate of each caller over HTTP.
In local mode every caller is this computer.

Knows headers and time; no route, no board and no page.
"""

import asyncio
import secrets
from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from servodeck.access.addresses import Access
from servodeck.access.devices import MAX_DEVICES, Device, Devices, make_id, make_secret, same
from servodeck.callers import THIS_COMPUTER, Caller, Rate, Role
from servodeck.errors import (
    BusyError,
    ForbiddenError,
    NotFoundError,
    NotPairedError,
    PairingError,
    PairingLockedError,
    TooManyError,
)
from servodeck.value import value

PAGE_HEADER = b"x-servodeck-page"
BEARER = b"bearer "
MAX_LENGTH = 200


def credential_of(headers: list[tuple[bytes, bytes]], cookie: str) -> str | None:
    """ID.SECRET, not yet compared. Raises ForbiddenError for a header that came twice.

    A cookie counts only for our own page: with its Origin, which a browser adds to every request that may
    change something, or with the page's own header, which no other page can add to a GET without leave.
    Programs send a token.
    """
    origin, page = only(headers, b"origin"), only(headers, PAGE_HEADER)
    authorization, cookies = only(headers, b"authorization"), only(headers, b"cookie")
    if origin is None and authorization is not None:
        is_bearer = authorization[: len(BEARER)].lower() == BEARER
        return text_of(authorization[len(BEARER) :]) if is_bearer else None
    if origin is not None or page is not None:
        return cookie_of(cookies or b"", cookie.encode())
    return None


def cookie_of(cookies: bytes, name: bytes) -> str | None:
    """None also where it came twice: which one is ours is unknown."""
    found = [
        value
        for key, _, value in (part.strip().partition(b"=") for part in cookies.split(b";"))
        if key == name
    ]
    return text_of(found[0]) if len(found) == 1 else None


def text_of(value: bytes) -> str | None:
    return value.decode() if value.isascii() and 0 < len(value) <= MAX_LENGTH else None


def only(headers: list[tuple[bytes, bytes]], name: bytes) -> bytes | None:
    """The header's one value. Raises ForbiddenError for several, because it is unknown which one counts."""
    values = [value for key, value in headers if key == name]
    if len(values) > 1:
        raise ForbiddenError(f"The header {name.decode('ascii')} came more than once.")
    return values[0] if values else None


INVITE_S = 120.0
CODE_DIGITS = 8
CODE_TRIES = 5
MAX_OPEN = 8


@value
class Invite:
    """`code` is None once codes are void. `name` may be empty: then the device sends its own."""

    id: str
    role: Role
    name: str
    secret: str
    code: str | None
    until_s: float


class Pairing:
    """Invitations: a secret for a link and eight digits for a keyboard, valid once and for two minutes. Five
    wrong codes, from whichever devices, void all open codes; links, which cannot be guessed, stay valid.
    """

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._invites: dict[str, Invite] = {}
        self._wrong_codes = 0

    def invite(self, role: Role, name: str) -> Invite:
        """Raises BusyError where too many are open."""
        if len(self.open) >= MAX_OPEN:
            raise BusyError("Too many invitations are open. Each expires after two minutes: try again then.")
        if not any(invite.code for invite in self.open):
            self._wrong_codes = 0
        code = "".join(secrets.choice("0123456789") for _ in range(CODE_DIGITS))
        made = Invite(make_id(), role, name, make_secret(), code, self._now() + INVITE_S)
        self._invites[made.id] = made
        return made

    @property
    def open(self) -> list[Invite]:
        """Those that are still valid."""
        now = self._now()
        self._invites = {one.id: one for one in self._invites.values() if one.until_s > now}
        return list(self._invites.values())

    def seconds_left(self, invite: Invite) -> float:
        return max(0.0, invite.until_s - self._now())

    def withdraw(self, invite: str) -> None:
        if self._invites.pop(invite, None) is None:
            raise NotFoundError("That invitation has expired.")

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
        "Five wrong codes: all open codes are void. Ask for a new code, or scan the link."
    )


class Entrance:
    def __init__(self, access: Access, devices: Devices, now: Callable[[], float]) -> None:
        self.access = access
        self.devices = devices
        self.pairing = Pairing(now)
        self._rates = Rates(now)

    def find(self, headers: list[tuple[bytes, bytes]]) -> Caller | None:
        """The authenticated caller, else None. Raises TokenExpiredError."""
        if not self.access.needs_pairing:
            return THIS_COMPUTER
        credential = credential_of(headers, self.access.cookie)
        device = self.devices.find(credential) if credential else None
        return device.caller if device else None

    def judge(self, headers: list[tuple[bytes, bytes]], role: Role) -> Caller:
        """Raises NotPairedError for an unauthenticated caller, or one whose token has expired, ForbiddenError
        for one who may do less.
        """
        caller = self.find(headers)
        if caller is None:
            raise NotPairedError("This device is not paired with the gateway.")
        caller.require(role)
        return caller

    def still_lets_in(self, caller: Caller) -> bool:
        """A caller that was authenticated a moment ago may have been revoked since, have expired, or have
        another role.
        """
        return not self.access.needs_pairing or self.devices.role_of(caller.id) == caller.role

    def count(self, caller: Caller) -> None:
        """Counts one more request. Raises TooManyError."""
        if caller is not THIS_COMPUTER:
            self._rates.take(self.devices.get(caller.id))

    def accept_invite(self, invite: Invite, name: str, present: Caller | None) -> tuple[Caller, str | None]:
        """Uses the invitation and returns the caller with its new credential. A caller that has at least the
        role stays as it is, and the invitation stays open; a caller with a lesser role keeps its name.
        """
        if present and present.may(invite.role):
            return present, None
        before = present if present and present.role != "stopper" else None
        if before:
            self.devices.revoke(before.id)
        called = invite.name or (before.name if before else name) or "Device"
        device, credential = self.devices.admit("device", called, invite.role)
        self.pairing.withdraw(invite.id)
        return device.caller, credential

    def stop_link(self, credential: str) -> Device:
        """The stop-only link of that credential. Raises PairingError."""
        device = self.devices.find(credential)
        if device is None or device.kind != "stopLink":
            raise PairingError("This stop-only link is no longer valid. Ask for a new one.")
        return device


class Connection(Protocol):
    def when_lost(self, lost: Callable[[], None]) -> None:
        """Once, and at once where it is lost already."""


class RequestQueue:
    """Requests of unauthenticated callers, which share one rate. A caller who leaves gives up its place."""

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
    """A rate for each paired device and each token (docs/adr/0013). This computer is never counted: its page
    and its scripts share one name, and a script that runs away would shut the page out.
    """

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
