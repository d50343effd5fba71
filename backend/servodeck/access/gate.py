"""Which requests may come in, by their head: Host, Origin, forwarding, kind and size of the body. Pure
functions.

Denies by default: only the names of `access` pass, the page served under them, and programs, which have no
Origin.
"""

from collections.abc import Iterable

from servodeck.access.addresses import Access
from servodeck.errors import (
    ForbiddenError,
    TooLargeError,
    WrongTypeError,
)

FORWARDING = frozenset(
    {b"forwarded", b"via", b"x-real-ip", b"x-client-ip", b"true-client-ip", b"cf-connecting-ip"}
)
FORWARDING_PREFIX = b"x-forwarded-"
BODY_METHODS = frozenset({"POST", "PUT", "PATCH", "DELETE"})

Headers = Iterable[tuple[bytes, bytes]]


def judge_handshake(headers: Headers, access: Access, own_address: str | None) -> str:
    """The Host of an acceptable request or upgrade that came in at `own_address`. Raises ForbiddenError with
    the reason.
    """
    found = list(headers)
    if access.mode != "proxy":
        judge_forwarding(found)
    host = only(found, b"host")
    if host is None or host not in access.hosts_at(own_address):
        raise ForbiddenError(
            "This gateway answers only to its own address on this computer; the Host header names another."
            if access.mode == "local"
            else "This gateway answers only to its own names and addresses; the Host header names another."
        )
    origin = only(found, b"origin")
    if origin is not None and origin != access.scheme.encode() + b"://" + host:
        raise ForbiddenError(
            "Requests from other sites are refused: the Origin header names another address."
        )
    judge_site(found)
    return host.decode("ascii")


def judge_forwarding(headers: list[tuple[bytes, bytes]]) -> None:
    for name, _ in headers:
        if name in FORWARDING or name.startswith(FORWARDING_PREFIX):
            raise ForbiddenError(
                "This gateway was not told of a proxy (--public-url); "
                f"the header {name.decode('latin-1')} says that one passed the request on."
            )


def judge_body_type(method: str, headers: Headers) -> None:
    """Raises WrongTypeError for a body that is not called JSON: a form of another site cannot call it so."""
    found = list(headers)
    has_body = only(found, b"transfer-encoding") or only(found, b"content-length") not in (None, b"0")
    kind = (only(found, b"content-type") or b"").partition(b";")[0].strip().lower()
    if method in BODY_METHODS and has_body and kind != b"application/json":
        raise WrongTypeError("The body must be application/json.")


def judge_body_size(headers: Headers, limit: int) -> None:
    """What is announced; what comes without being announced is counted as it comes. Raises TooLargeError."""
    announced = only(list(headers), b"content-length")
    if announced is not None and int(announced) > limit:  # a number: the server has read it
        raise TooLargeError(f"The request is larger than {limit} bytes.")


def is_upgrade(headers: Headers) -> bool:
    return any(name == b"upgrade" and value.lower() == b"websocket" for name, value in headers)


def judge_site(headers: list[tuple[bytes, bytes]]) -> None:
    """A browser may leave Origin out of a plain GET, but says whether another site asks. Following a link is
    fine.
    """
    site = only(headers, b"sec-fetch-site")
    if site in (None, b"same-origin", b"none") or only(headers, b"sec-fetch-mode") == b"navigate":
        return
    raise ForbiddenError(
        "Requests from other sites are refused: the header Sec-Fetch-Site names another site."
    )


def judge_script(headers: Headers) -> None:
    """For routes that act: not even a link of another site may lead here."""
    if only(list(headers), b"sec-fetch-site") not in (None, b"same-origin", b"none"):
        raise ForbiddenError("Requests from other sites are refused: a link on another site led here.")


def only(headers: list[tuple[bytes, bytes]], name: bytes) -> bytes | None:
    """The header's one value. Raises ForbiddenError for several: who knows which one counts."""
    values = [value for key, value in headers if key == name]
    if len(values) > 1:
        raise ForbiddenError(f"The header {name.decode('ascii')} came more than once.")
    return values[0] if values else None
