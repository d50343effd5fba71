"""Where a program's robot is: a gateway's address, or a port of this computer; and the token for it.

Knows the variables of the environment that the command line has too.
"""

import os
from pathlib import Path

from servodeck.client.gateway import Gateway
from servodeck.client.transport import HttpTransport

HERE = "http://127.0.0.1:8300"
TIMEOUT_S = 10.0


def gateway_at(
    where: str | None, token: str | None, board: str | None, robot: str | Path | None, timeout_s: float
) -> Gateway:
    """Raises ValueError for options that do not belong together, GatewayError where a port cannot be used."""
    place = where or os.environ.get("SERVODECK_URL") or HERE
    if not place.startswith(("http://", "https://")):
        from servodeck.client.direct import DirectTransport

        if token is not None:
            raise ValueError("A port needs no token.")
        if board is None:
            raise ValueError('A port needs the family of its board, for example board="xarm".')
        return Gateway(DirectTransport(place, board, robot), "", timeout_s)
    if board is not None or robot is not None:
        raise ValueError("A gateway knows its board and its robot: leave out board and robot.")
    return Gateway(HttpTransport(place), token_of(token), timeout_s)


def token_of(token: str | None) -> str:
    if token is not None:
        return token
    if file := os.environ.get("SERVODECK_TOKEN_FILE"):
        return Path(file).read_text("utf-8").strip()
    return os.environ.get("SERVODECK_TOKEN", "")
