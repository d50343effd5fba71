"""`servodeck fleet broker-config`: options that become the configuration of a broker. fleet/broker_config.py
decides what is in it.
"""

import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from servodeck.callers import RANKS, Role
from servodeck.cli.broker import USUAL_SITE
from servodeck.cli.options import USAGE, fail

if TYPE_CHECKING:
    from servodeck.fleet.broker_config import Listener


def broker_config(
    folder: Annotated[Path, typer.Argument(help="Where the files go.")],
    gateway: Annotated[list[str], typer.Option(help="The name of a robot. May be repeated.")],
    user: Annotated[
        list[str],
        typer.Option(metavar="NAME=ROLE", help="stopper, viewer, driver or owner. May be repeated."),
    ],
    site: Annotated[str, typer.Option(help="As in --mqtt-site.")] = USUAL_SITE,
    listen: Annotated[str, typer.Option(help="HOST:PORT of the broker.")] = "0.0.0.0:8883",
    websocket: Annotated[
        str, typer.Option(help="HOST:PORT of a second listener, for browsers. Default: none.")
    ] = "",
    cert: Annotated[Path | None, typer.Option(help="The broker's certificate (PEM), for TLS.")] = None,
    key: Annotated[Path | None, typer.Option(help="The key of that (PEM).")] = None,
    clients_ca: Annotated[
        Path | None, typer.Option(help="Each client needs a certificate of this authority (PEM).")
    ] = None,
    home_assistant: Annotated[
        str,
        typer.Option(
            metavar="PREFIX",
            help="Home Assistant, too, as the user homeassistant: it sees, stops, and presses buttons.",
        ),
    ] = "",
    emqx: Annotated[
        bool, typer.Option("--emqx", help="For EMQX: it reads no listener and certificate from here.")
    ] = False,
) -> None:
    """Write the configuration of a Mosquitto for a site: who may write what, and a password for each.
    Passwords that are there stay.
    """
    from servodeck.fleet.broker_config import Encryption, Plan, write_config
    from servodeck.fleet.emqx_config import write_emqx

    if (cert is None) != (key is None):
        fail("--cert and --key belong together.", USAGE)
    encryption = Encryption(cert, key, clients_ca) if cert and key else None
    try:
        users = dict(role_of(text) for text in user)
        second = listener_of(websocket) if websocket else None
        plan = Plan(site, gateway, users, listener_of(listen), second, encryption, home_assistant)
        (write_emqx if emqx else write_config)(plan, folder)
    except ValueError as error:
        fail(f"That cannot be: {error}.", USAGE)
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"The configuration cannot be written: {error}.")
    if not emqx:
        print(f"Start it with: mosquitto -c {folder / 'mosquitto.conf'}")
    print(f"The password of each is in {folder / 'secrets'}, for --mqtt-password-file.")


def role_of(text: str) -> tuple[str, Role]:
    name, _, role = text.partition("=")
    if role not in RANKS:
        raise ValueError(f"--user is NAME=ROLE, with a role of {', '.join(RANKS)}; got {text}")
    return name, role


def listener_of(text: str) -> "Listener":
    from servodeck.fleet.broker_config import Listener

    host, _, port = text.rpartition(":")
    if not host or not port.isdecimal() or not 0 < int(port) < 0x10000:
        raise ValueError(f"{text} is no HOST:PORT")
    return Listener(int(port), host)
