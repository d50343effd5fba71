"""The addresses and names of the gateway, as one value from the command line; addresses with invitations, as
text and as QR codes; and the announcement on the local network, by mDNS (`servodeck.local`).

A secret stands behind #, which no server and no log receives. The announcement runs in a thread of its own; a
missing network or a fault of the library is logged and tried again later. Knows names and addresses; no
request, no person, and makes no secret. A request is never trusted for its address.
"""

import io
import ipaddress
import logging
import socket
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal
from urllib.parse import urlsplit

from servodeck import __version__
from servodeck.value import value

if TYPE_CHECKING:
    from segno import QRCode


Mode = Literal["local", "lan", "proxy"]
Scheme = Literal["http", "https"]
LOOPBACK = frozenset({"127.0.0.1", "localhost", "[::1]"})
MDNS_NAME = "servodeck.local"
USUAL_PORTS: dict[str, int] = {"http": 80, "https": 443}


@value
class Access:
    mode: Mode
    scheme: Scheme
    port: int
    names: frozenset[str]
    listens_at: str = "0.0.0.0"

    @property
    def needs_pairing(self) -> bool:
        return self.mode != "local"

    @property
    def is_secure(self) -> bool:
        return self.scheme == "https"

    @property
    def cookie(self) -> str:
        """Browsers send cookies to every port of a host, so the plain one is named after ours; the other
        prefix keeps neighbouring names from setting it.
        """
        return "__Host-servodeck" if self.is_secure else f"servodeck_{self.port}"

    def hosts_at(self, own_address: str | None) -> frozenset[bytes]:
        """The Host values answered on a connection that came in at `own_address`. On a LAN that address is
        one of them: a page cannot make a browser name an address that it did not go to.
        """
        names = self.names
        if self.mode == "lan" and own_address:
            names = names | {bracketed(own_address)}
        return frozenset(self.host_of(name).encode() for name in names) | self._with_usual_port(names)

    def _with_usual_port(self, names: frozenset[str]) -> frozenset[bytes]:
        if self.port != USUAL_PORTS[self.scheme]:
            return frozenset()
        return frozenset(f"{name}:{self.port}".encode() for name in names)

    def host_of(self, name: str) -> str:
        """As a browser writes it: without the usual port."""
        return name if self.port == USUAL_PORTS[self.scheme] else f"{name}:{self.port}"

    def url_of(self, name: str) -> str:
        return f"{self.scheme}://{self.host_of(name)}"


def local(port: int) -> Access:
    """This computer only; every caller on it is an owner."""
    return Access("local", "http", port, LOOPBACK)


def lan(port: int, host_name: str | None = None, *, listens_at: str = "0.0.0.0") -> Access:
    """This computer's own names, and the own address at which a connection came in."""
    name = (host_name or socket.gethostname()).lower()
    own = {name, f"{name.partition('.')[0]}.local", MDNS_NAME}
    return Access("lan", "http", port, LOOPBACK | {one for one in own if is_name(one)}, listens_at)


def behind_proxy(url: str) -> Access:
    """Only that address, whose scheme the proxy speaks. Raises ValueError with what is wrong with it."""
    parts = urlsplit(url)
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ValueError("it must begin with http:// or https:// and name a host")
    if parts.path not in ("", "/") or parts.query or parts.fragment or parts.username is not None:
        raise ValueError("it can only name scheme, host and port")
    scheme: Scheme = "https" if parts.scheme == "https" else "http"
    name = bracketed(parts.hostname) if ":" in parts.hostname else parts.hostname
    return Access("proxy", scheme, parts.port or USUAL_PORTS[scheme], frozenset({name}))


def bracketed(address: str) -> str:
    """An address as it stands in a Host header."""
    parsed = ipaddress.ip_address(address.partition("%")[0])
    if isinstance(parsed, ipaddress.IPv6Address):
        return str(parsed.ipv4_mapped) if parsed.ipv4_mapped else f"[{parsed}]"
    return str(parsed)


def is_name(text: str) -> bool:
    labels = text.split(".")
    return all(label and label.replace("-", "").isalnum() and label.isascii() for label in labels)


def answered_at(host: str, addresses: list[str]) -> list[str]:
    """Those of this computer's addresses where a gateway that listens at `host` answers others."""
    return [one for one in addresses if host in ("0.0.0.0", "::", one)]


def lan_addresses() -> list[str]:
    """This computer's IPv4 addresses that others may reach, for people to read. Never raises."""
    import ifaddr  # here: a gateway for this computer alone needs none

    try:
        adapters = list(ifaddr.get_adapters())
    except OSError:
        return []
    texts = [ip.ip for adapter in adapters for ip in adapter.ips if isinstance(ip.ip, str)]
    found = {ipaddress.IPv4Address(text) for text in texts}
    return [str(one) for one in sorted(found) if not one.is_loopback and not one.is_link_local]


QUIET_MODULES = 3


def link_base(access: Access, host: str) -> str:
    """An address that other devices can reach: the one that the inviting page came by, if it is not this
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


if TYPE_CHECKING:
    from zeroconf import Zeroconf


SERVICE = "_servodeck._tcp.local."
LOOK_AGAIN_S = 20.0
ASK_MS = 1500
GOODBYE_S = 0.5
NAME_BYTES = 40  # a label takes 63, and there are words before it
log = logging.getLogger("servodeck.announcement")


class Announcement:
    def __init__(
        self,
        port: int,
        host_name: str | None = None,
        addresses: Callable[[], list[str]] = lan_addresses,
        look_again_s: float = LOOK_AGAIN_S,
    ) -> None:
        """`addresses` returns the addresses to announce now, possibly none."""
        self._port = port
        self._host_name = (host_name or socket.gethostname()).partition(".")[0][:NAME_BYTES]
        self._addresses = addresses
        self._look_again_s = look_again_s
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="announcement", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def end(self) -> None:
        """Withdraws the announcement if that is quick; others forget it after a while."""
        self._ended.set()
        self._thread.join(GOODBYE_S)

    def _run(self) -> None:
        while not self._ended.is_set():
            try:
                if addresses := self._addresses():
                    self._announce(addresses)
                    continue  # the addresses are others now
            except Exception:  # no network, or any error of the library
                log.warning("this computer cannot be announced", exc_info=True)
            self._ended.wait(self._look_again_s)

    def _announce(self, addresses: list[str]) -> None:
        """Until it has ended or this computer's addresses change."""
        from zeroconf import ServiceInfo, Zeroconf

        with Zeroconf(interfaces=addresses) as network:
            name = self._free_name(network, addresses)
            packed = [socket.inet_aton(address) for address in addresses]
            service = ServiceInfo(
                SERVICE,
                f"Servodeck on {self._host_name}.{SERVICE}",
                port=self._port,
                addresses=packed,
                properties={"path": "/", "version": __version__},
                server=f"{name}.",
            )
            network.register_service(service, allow_name_change=True)
            log.info("announced", extra={"facts": {"name": name, "addresses": addresses}})
            while not self._ended.wait(self._look_again_s) and self._addresses() == addresses:
                pass

    def _free_name(self, network: "Zeroconf", addresses: list[str]) -> str:
        """Two robots in one room cannot both be servodeck.local: the second goes by its computer's name."""
        from zeroconf import AddressResolverIPv4  # type: ignore[attr-defined]  # missing in its __all__ only

        answer = AddressResolverIPv4(f"{MDNS_NAME}.")
        if answer.request(network, ASK_MS) and not set(answer.parsed_addresses()) <= set(addresses):
            return f"{self._host_name}.local"
        return MDNS_NAME
