"""Decides who may ask and what may go on the wire. Pure functions: no socket, no port, no clock, no state.

Denies by default. The rules are those of one computer on its own: its loopback names, the page served under
them, and programs of the same computer, which have no Origin.
"""

from collections.abc import Iterable

from servodeck.decoder import COMMAND_AT
from servodeck.errors import (
    ForbiddenError,
    GatewayError,
    LatchedError,
    MalformedError,
    NotSupportedError,
    OutOfRangeError,
)
from servodeck.packets import FAMILIES, PacketError, check_command

MOVE, RUN, STOP = 3, 6, 7
BATTERY, POSITIONS, VERSION, ALL_POSITIONS, OFFSETS = 15, 21, 1, 13, 2
PASS_WHILE_LATCHED = frozenset({STOP, BATTERY, POSITIONS, VERSION, ALL_POSITIONS, OFFSETS})

FORWARDING = frozenset(
    {b"forwarded", b"via", b"x-real-ip", b"x-client-ip", b"true-client-ip", b"cf-connecting-ip"}
)
FORWARDING_PREFIX = b"x-forwarded-"
HTTP_PORT = 80

Headers = Iterable[tuple[bytes, bytes]]


def allowed_hosts(port: int) -> frozenset[bytes]:
    """The only Host values answered; a browser leaves the usual port out."""
    names = (b"127.0.0.1", b"localhost", b"[::1]")
    exact = {b"%s:%d" % (name, port) for name in names}
    return frozenset(exact | set(names) if port == HTTP_PORT else exact)


def judge_handshake(headers: Headers, hosts: frozenset[bytes]) -> str:
    """The Host of an acceptable request or upgrade. Raises ForbiddenError with the reason."""
    found = list(headers)
    for name, _ in found:
        if name in FORWARDING or name.startswith(FORWARDING_PREFIX):
            raise ForbiddenError(
                "This gateway answers its own computer only; "
                f"the header {name.decode('latin-1')} says that a proxy passed the request on."
            )
    host = only(found, b"host")
    if host is None or host not in hosts:
        raise ForbiddenError(
            "This gateway answers only to its own address on this computer; the Host header names another."
        )
    origin = only(found, b"origin")
    if origin is not None and origin != b"http://" + host:
        raise ForbiddenError(
            "Only the page that this gateway serves may ask; the Origin header names another."
        )
    judge_site(found)
    return host.decode("ascii")


def judge_site(headers: list[tuple[bytes, bytes]]) -> None:
    """A browser may leave Origin out of a plain GET, but says whether another site asks. Following a link is
    fine.
    """
    site = only(headers, b"sec-fetch-site")
    if site in (None, b"same-origin", b"none") or only(headers, b"sec-fetch-mode") == b"navigate":
        return
    raise ForbiddenError(
        "Only the page that this gateway serves may ask; the browser says another site does."
    )


def judge_script(headers: Headers) -> None:
    """For routes that act: not even a link of another site may lead here."""
    if only(list(headers), b"sec-fetch-site") not in (None, b"same-origin", b"none"):
        raise ForbiddenError(
            "Only the page that this gateway serves may ask; a link of another site led here."
        )


def only(headers: list[tuple[bytes, bytes]], name: bytes) -> bytes | None:
    """The header's one value. Raises ForbiddenError for several: who knows which one counts."""
    values = [value for key, value in headers if key == name]
    if len(values) > 1:
        raise ForbiddenError(f"The header {name.decode('ascii')} came more than once.")
    return values[0] if values else None


def judge_packet(text: str, board: str) -> bytes:
    """The packet in `text` (hex) when it is one command that board can take. Raises what is wrong with it."""
    try:
        packet = bytes.fromhex(text)
    except ValueError:
        raise MalformedError("The packet is not written in hex digits.") from None
    try:
        check_command(packet, FAMILIES[board])
    except PacketError as error:
        raise refusal_of(error) from error
    return packet


def refusal_of(error: PacketError) -> GatewayError:
    if error.code == "malformed":
        return MalformedError(error.detail)
    return (NotSupportedError if error.field == "command" else OutOfRangeError)(error.detail)


def judge_hold(text: str | None, board: str) -> bytes | None:
    """The pose to hold after a stop: one move packet."""
    if text is None:
        return None
    packet = judge_packet(text, board)
    if packet[COMMAND_AT] != MOVE:
        raise MalformedError("Only a move can hold the pose after a stop.")
    return packet


def judge_latch(packet: bytes, latch: bool) -> None:
    """While stopped, only what moves nothing and stores nothing passes. Raises LatchedError."""
    if latch and packet[COMMAND_AT] not in PASS_WHILE_LATCHED:
        raise LatchedError("Stopped. Motion waits for Resume.")
