"""Addresses that let somebody in, as text and as QR codes. What is secret stands behind #, which no server
and no log gets to see.

Knows how an address is written; makes no secret.
"""

import io
from typing import TYPE_CHECKING

from servodeck.access.access import LOOPBACK, Access, answered_at, lan_addresses

if TYPE_CHECKING:
    from segno import QRCode

QUIET_MODULES = 3


def link_base(access: Access, host: str) -> str:
    """An address that other devices can reach: the one that whoever invites came by, if it is not this
    computer's own, or if no other one answers.
    """
    if access.mode == "lan" and any(host == access.host_of(name) for name in LOOPBACK):
        return next(iter(reachable_urls(access)), f"{access.scheme}://{host}")
    return f"{access.scheme}://{host}"


def reachable_urls(access: Access) -> list[str]:
    return [access.url_of(address) for address in answered_at(access.listens_at, lan_addresses())]


def pair_link(base: str, secret: str) -> str:
    return f"{base}/#pair={secret}"


def stop_link(base: str, credential: str) -> str:
    return f"{base}/#stop={credential}"


def picture_of(link: str) -> str:
    """An address that holds the whole SVG image, black on white so that it can be read in any theme."""
    return code_of(link).svg_data_uri(border=QUIET_MODULES, light="#fff", dark="#000")


def drawn_for_terminal(link: str) -> str:
    text = io.StringIO()
    code_of(link).terminal(text, border=2, compact=True)
    return text.getvalue()


def code_of(link: str) -> "QRCode":
    import segno  # here: most starts draw none

    return segno.make(link, micro=False)
