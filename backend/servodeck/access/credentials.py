"""What a request brings to prove who sends it, how a secret is made, stored and compared, and invitations: a
secret for a link and eight digits for a keyboard, once, for two minutes. Pure: time comes in.

A cookie counts only for our own page: with its Origin, which a browser adds to whatever may change something,
or with the page's own header, which no other page can add to a GET without leave. Programs send a token. Five
wrong codes spend all codes that are open, from whatever devices; links, which cannot be guessed, stay valid.
"""

import hashlib
import hmac
import secrets
from collections.abc import Callable
from dataclasses import replace

from servodeck.callers import Role
from servodeck.errors import BusyError, ForbiddenError, NotFoundError, PairingError, PairingLockedError
from servodeck.value import value

PAGE_HEADER = b"x-servodeck-page"
SECRET_BYTES = 24
BEARER = b"bearer "
MAX_LENGTH = 200


def credential_of(headers: list[tuple[bytes, bytes]], cookie: str) -> str | None:
    """ID.SECRET, not yet looked at. Raises ForbiddenError for a header that came twice."""
    origin, page = only(headers, b"origin"), only(headers, PAGE_HEADER)
    authorization, cookies = only(headers, b"authorization"), only(headers, b"cookie")
    if origin is None and authorization is not None:
        is_bearer = authorization[: len(BEARER)].lower() == BEARER
        return text_of(authorization[len(BEARER) :]) if is_bearer else None
    if origin is not None or page is not None:
        return cookie_of(cookies or b"", cookie.encode())
    return None


def cookie_of(cookies: bytes, name: bytes) -> str | None:
    """None also where it came twice: who knows which one is ours."""
    found = [
        value
        for key, _, value in (part.strip().partition(b"=") for part in cookies.split(b";"))
        if key == name
    ]
    return text_of(found[0]) if len(found) == 1 else None


def text_of(value: bytes) -> str | None:
    return value.decode() if value.isascii() and 0 < len(value) <= MAX_LENGTH else None


def only(headers: list[tuple[bytes, bytes]], name: bytes) -> bytes | None:
    """The header's one value. Raises ForbiddenError for several: who knows which one counts."""
    values = [value for key, value in headers if key == name]
    if len(values) > 1:
        raise ForbiddenError(f"The header {name.decode('ascii')} came more than once.")
    return values[0] if values else None


def make_secret() -> str:
    return secrets.token_urlsafe(SECRET_BYTES)


def make_id() -> str:
    return secrets.token_hex(8)


def digest_of(secret: str) -> bytes:
    """What is stored of a secret. A fast hash will do: the secret is random and too long to be guessed."""
    return hashlib.sha256(secret.encode()).digest()


def matches(secret: str, digest: bytes) -> bool:
    return hmac.compare_digest(digest_of(secret), digest)


def same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode())


INVITE_S = 120.0
CODE_DIGITS = 8
CODE_TRIES = 5
MAX_OPEN = 8


@value
class Invite:
    """`code` is None once codes are spent. `name` may be empty: the device that comes says its own."""

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
            raise BusyError("Too many invitations are open. Each expires after two minutes: try again then.")
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
