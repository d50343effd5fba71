"""What a request brings to prove who sends it, and how a secret is made, kept and compared. Pure.

A cookie counts only for our own page: with its Origin, which a browser adds to whatever may change
something, or with the page's own header, which no other page can add to a GET without leave. Programs have
neither and bring a bearer token.
"""

import hashlib
import hmac
import secrets

from servodeck.access.gate import only

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


def make_secret() -> str:
    return secrets.token_urlsafe(SECRET_BYTES)


def make_id() -> str:
    return secrets.token_hex(8)


def digest_of(secret: str) -> bytes:
    """What is kept of a secret. A fast hash will do: it is random and long, nobody can guess through it."""
    return hashlib.sha256(secret.encode()).digest()


def matches(secret: str, digest: bytes) -> bool:
    return hmac.compare_digest(digest_of(secret), digest)


def same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode())
