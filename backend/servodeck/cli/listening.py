"""Where `servodeck serve` listens: reads and binds its HOST:PORT, or ends the program with what to do."""

import ipaddress
import socket

from servodeck.cli.exits import USAGE, fail

DEFAULT_LISTEN = "127.0.0.1:8300"
LAN_LISTEN = "0.0.0.0:8300"


def parse_listen(text: str, *, lan: bool) -> tuple[str, int]:
    """HOST:PORT of this computer; ends the program with an explanation for anything else."""
    host, separator, port = text.rpartition(":")
    host = host.removeprefix("[").removesuffix("]")
    if not separator or not port.isascii() or not port.isdigit() or int(port) > 0xFFFF:
        fail(f"--listen takes HOST:PORT, for example {DEFAULT_LISTEN}; got {text}.", USAGE)
    if not lan and not is_loopback(host):
        fail(
            f"{host} can be reached from other computers. Add --lan to let paired devices in; "
            "without it Servodeck listens on 127.0.0.1, [::1] or localhost only.",
            USAGE,
        )
    return host, int(port)


def is_loopback(host: str) -> bool:
    try:
        # Exactly these: the page is answered under no other name or address.
        return host == "localhost" or str(ipaddress.ip_address(host)) in ("127.0.0.1", "::1")
    except ValueError:
        return False


def bind(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=512)
    except OSError as error:
        fail(
            f"Cannot listen on {host}:{port} ({error.strerror}). Does another Servodeck run? "
            f"--listen {host}:0 takes a free port."
        )


def url_of(listener: socket.socket) -> str:
    """Where this computer itself reaches it."""
    host, port = listener.getsockname()[:2]
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
