"""Stands before everything the gateway serves: judges the head of each request and upgrade (Host, Origin,
forwarding, kind and size of the body), makes unknown callers wait where many ask at once, adds the security
headers, and logs refusals. An address with its version (`/api/v1/…`) is the one without.

Denies by default: only the names of `access` pass, the page served under them, and programs, which have no
Origin. Pure ASGI, because ordinary middleware does not see WebSockets. Knows no route.
"""

import logging
import re
import time
from collections.abc import Iterable

from starlette.datastructures import MutableHeaders
from starlette.exceptions import HTTPException
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from servodeck.access.addresses import Access
from servodeck.access.connections import connection_of
from servodeck.access.entrance import Entrance, RequestQueue, only
from servodeck.callers import Rate
from servodeck.errors import (
    ForbiddenError,
    GatewayError,
    NotPairedError,
    TooLargeError,
    WrongTypeError,
)

LOGGER = "servodeck.access"
# Of a text from an unknown client.
MAX_CHARACTERS = 100
log = logging.getLogger(LOGGER)


def log_refusal(scope: Scope, error: GatewayError) -> None:
    client = scope.get("client")
    facts = {
        "from": client[0] if client else None,
        "type": "websocket" if is_upgrade(scope["headers"]) else scope["type"],
        "path": scope["path"][:MAX_CHARACTERS],
        "code": error.code,
        "reason": error.detail[:MAX_CHARACTERS],
    }
    log.info("refused", extra={"facts": facts})


BODY_BYTES = 16 * 1024
LARGER_BODIES = (
    # A document as text inside JSON, where every quote of it takes two characters.
    (re.compile(r"/api/library/.*"), 3 * 1024 * 1024),
    # Reading one takes 15 ms, in which a stop waits. The largest group there is, or 90 of the usual size.
    (re.compile(r"/api/(download|play|fleet/download)"), 512 * 1024),
)
# Requests of unauthenticated callers, all together: a refusal takes up to a millisecond, in which a stop
# waits, on a small computer three.
OF_UNKNOWN = (200.0, 10)
STARTS = frozenset({"http.response.start", "websocket.http.response.start"})

CONTENT_POLICY = (
    # The page's SQLite is WebAssembly of its own origin; this allows no other evaluation.
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
    "img-src 'self' data:; font-src 'self'; connect-src 'self' {socket}; "
    "worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
FIXED_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    # Web Bluetooth is left to the own origin by default; a browser without it warns of its name at each load.
    "Permissions-Policy": "serial=(self), hid=(self), camera=(self)",
}


# Programs name the version that they were written for; without one an address means the newest, which is the
# only one so far.
VERSIONED, PLAIN = "/api/v1/", "/api/"


def unversioned(scope: Scope) -> Scope:
    """The address without its version, so that one rule and one route stand for both."""
    if not scope["path"].startswith(VERSIONED):
        return scope
    raw = scope.get("raw_path")
    return {
        **scope,
        "path": PLAIN + scope["path"].removeprefix(VERSIONED),
        "raw_path": raw and PLAIN.encode() + raw.removeprefix(VERSIONED.encode()),
    }


class Guard:
    def __init__(self, app: ASGIApp, entrance: Entrance) -> None:
        self.app = app
        self._entrance = entrance
        self._access = entrance.access
        self._queue_of_unknown = RequestQueue(Rate(*OF_UNKNOWN, time.monotonic))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            return await self.app(scope, receive, send)
        scope = unversioned(scope)
        own_address = scope["server"][0] if scope.get("server") else None
        upgrades = is_upgrade(scope["headers"])
        try:
            host = judge_handshake(scope["headers"], self._access, own_address)
            if scope["type"] == "http":
                judge_body_type(scope["method"], scope["headers"])
                judge_body_size(scope["headers"], body_bytes(scope["path"]))
            is_known = self._entrance.find(scope["headers"]) is not None
            if upgrades and not is_known:
                raise NotPairedError("This device is not paired with the gateway.")
        except GatewayError as error:
            if not await self._wait_of_unknown(scope):
                return None
            log_refusal(scope, error)
            # The Host is not to be trusted here, so it does not appear in the policy.
            refusal = JSONResponse({"code": error.code, "detail": error.detail}, error.status)
            if upgrades:  # what follows it is not read
                refusal.headers["Connection"] = "close"
            return await refusal(scope, receive, with_headers(send, "'self'"))
        if not is_known and not await self._wait_of_unknown(scope):
            return None
        limited = limit_body(receive, body_bytes(scope["path"])) if scope["type"] == "http" else receive
        socket = f"{'wss' if self._access.is_secure else 'ws'}://{host}"
        return await self.app(scope, limited, with_headers(send, socket))

    def may_upgrade(self, headers: list[tuple[bytes, bytes]], own_address: str | None) -> bool:
        """Whether a known caller requests the upgrade. The route judges the role."""
        try:
            judge_handshake(headers, self._access, own_address)
            return self._entrance.find(headers) is not None
        except GatewayError:
            return False

    async def _wait_of_unknown(self, scope: Scope) -> bool:
        """False where the client has gone."""
        connection = connection_of(scope)
        return connection is None or await self._queue_of_unknown.wait(connection)


def with_headers(send: Send, socket: str) -> Send:
    async def send_with_headers(message: Message) -> None:
        if message["type"] in STARTS:
            headers = MutableHeaders(scope=message)
            headers["Content-Security-Policy"] = CONTENT_POLICY.format(socket=socket)
            headers.update(FIXED_HEADERS)
            headers.setdefault("Cache-Control", "no-store")
        await send(message)

    return send_with_headers


def body_bytes(path: str) -> int:
    """The largest body that this address takes."""
    return next((size for shape, size in LARGER_BODIES if shape.fullmatch(path)), BODY_BYTES)


def limit_body(receive: Receive, limit: int) -> Receive:
    total_bytes = 0

    async def receive_limited() -> Message:
        nonlocal total_bytes
        message = await receive()
        total_bytes += len(message.get("body", b""))
        if total_bytes > limit:
            raise HTTPException(413, f"The request is larger than {limit} bytes.")
        return message

    return receive_limited


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
                "This gateway was started without a proxy (--public-url); "
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
    """Judges the announced size; other bodies are counted while they arrive. Raises TooLargeError."""
    announced = only(list(headers), b"content-length")
    if announced is not None and int(announced) > limit:  # a number: the server has read it
        raise TooLargeError(f"The request is larger than {limit} bytes.")


def is_upgrade(headers: Headers) -> bool:
    return any(name == b"upgrade" and value.lower() == b"websocket" for name, value in headers)


def judge_site(headers: list[tuple[bytes, bytes]]) -> None:
    """A browser may leave Origin out of a plain GET, but says whether the request comes from another
    site. Following a link is fine.
    """
    site = only(headers, b"sec-fetch-site")
    if site in (None, b"same-origin", b"none") or only(headers, b"sec-fetch-mode") == b"navigate":
        return
    raise ForbiddenError(
        "Requests from other sites are refused: the header Sec-Fetch-Site names another site."
    )


def judge_script(headers: Headers) -> None:
    """For routes that act: not even a link on another site may lead to them."""
    if only(list(headers), b"sec-fetch-site") not in (None, b"same-origin", b"none"):
        raise ForbiddenError("Requests from other sites are refused: a link on another site led here.")
