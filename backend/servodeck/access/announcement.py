"""Tells the local network that a Servodeck is here and by which name: `servodeck.local`, by mDNS.

Runs beside everything in a thread of its own and fails alone: no network, a changed network or a fault of the
library is a line in the log and another try later. Knows addresses and names, nothing of the gateway.
"""

import logging
import socket
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from servodeck import __version__
from servodeck.access.addresses import MDNS_NAME, lan_addresses

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
        """`addresses` tells on which of this computer's networks it shall be heard now, maybe on none."""
        self._port = port
        self._host_name = (host_name or socket.gethostname()).partition(".")[0][:NAME_BYTES]
        self._addresses = addresses
        self._look_again_s = look_again_s
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="announcement", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def end(self) -> None:
        """Takes it back where that is quick; others forget it by themselves after a while."""
        self._ended.set()
        self._thread.join(GOODBYE_S)

    def _run(self) -> None:
        while not self._ended.is_set():
            try:
                if addresses := self._addresses():
                    self._announce(addresses)
                    continue  # the addresses are others now
            except Exception:  # no network, or whatever a library raises that nobody here can name
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
