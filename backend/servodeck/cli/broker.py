"""The options of a broker, for `serve` and the commands of a fleet, and what they say as one value.

Loads the library of MQTT only where a broker is named.
"""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol

import typer

from servodeck.cli.options import PREFIX, USAGE, fail

if TYPE_CHECKING:
    from servodeck.access.devices import Devices
    from servodeck.fleet.broker import Broker
    from servodeck.fleet.service import FleetService
    from servodeck.fleet.topics import Site
    from servodeck.robot.control import Control
    from servodeck.snapshots import FleetStatus

MqttUrl = Annotated[
    str,
    typer.Option(
        "--mqtt",
        envvar=f"{PREFIX}_MQTT",
        help="An MQTT 5 broker: mqtts://NAME@HOST, mqtt:, wss: or ws:. Default: none.",
    ),
]
MqttSite = Annotated[
    str,
    typer.Option(envvar=f"{PREFIX}_MQTT_SITE", help="The robots there that belong together."),
]
MqttPassword = Annotated[
    str,
    typer.Option(
        envvar=f"{PREFIX}_MQTT_PASSWORD",
        help="Other users can see command lines: better in a file or variable.",
    ),
]
MqttPasswordFile = Annotated[
    Path | None,
    typer.Option(envvar=f"{PREFIX}_MQTT_PASSWORD_FILE", help="A file that holds it and nothing else."),
]
MqttCa = Annotated[
    Path | None,
    typer.Option(envvar=f"{PREFIX}_MQTT_CA", help="Certificates (PEM) that vouch for the broker."),
]
MqttCert = Annotated[
    Path | None, typer.Option(envvar=f"{PREFIX}_MQTT_CERT", help="This client's own certificate (PEM).")
]
MqttKey = Annotated[Path | None, typer.Option(envvar=f"{PREFIX}_MQTT_KEY", help="The key of that (PEM).")]
FleetUrl = Annotated[
    str,
    typer.Option(
        "--fleet",
        envvar=f"{PREFIX}_FLEET",
        help="Serve the page of all robots of the site, too, as that user of the broker, who may drive: "
        "mqtts://USER@HOST. Default: no such page.",
    ),
]
FleetPassword = Annotated[
    str, typer.Option(envvar=f"{PREFIX}_FLEET_PASSWORD", help="Of the user of --fleet.")
]
FleetPasswordFile = Annotated[
    Path | None,
    typer.Option(envvar=f"{PREFIX}_FLEET_PASSWORD_FILE", help="A file that holds it and nothing else."),
]
USUAL_SITE = "home"


class MqttOptions(NamedTuple):
    """As they were given; an empty `url`: no broker."""

    url: str
    site: str
    password: str
    password_file: Path | None
    ca: Path | None
    cert: Path | None
    key: Path | None


def broker_of(options: MqttOptions) -> "Broker":
    """Ends the program with what is wrong with one of them."""
    from servodeck.fleet.broker import parse_broker

    password, file = options.password, options.password_file
    try:
        password = password or (file.read_text("utf-8").strip() if file else "")
    except OSError as error:
        fail(f"The password file {file} cannot be read: {error.strerror}.", USAGE)
    try:
        return parse_broker(options.url, password or None, options.ca, options.cert, options.key)
    except OSError as error:
        fail(f"A certificate of --mqtt cannot be used: {error}.", USAGE)
    except ValueError as error:
        fail(f"--mqtt {options.url} is not valid: {error}.", USAGE)


def site_of(options: MqttOptions) -> "Site":
    """Ends the program where there can be no such site."""
    from servodeck.fleet.topics import Site

    try:
        return Site(options.site)
    except ValueError as error:
        fail(f"--mqtt-site is not valid: {error}.", USAGE)


def gateway_name(wanted: str, broker: "Broker", folder: Path) -> str:
    """As its option calls it, else as the broker knows it, else as it has called itself."""
    from servodeck.fleet.identity import own_name, this_hardware
    from servodeck.fleet.topics import is_gateway_name

    name = wanted or broker.user or own_name(folder, this_hardware())
    if not is_gateway_name(name):
        fail(f"A gateway cannot be called {name} on a broker: set --mqtt-name, of letters and digits.", USAGE)
    return name


class Membership(NamedTuple):
    """Which gateway joins which site. `home_assistant`: the prefix at which that looks for devices; empty:
    not announced.
    """

    broker: "Broker"
    site: "Site"
    name: str
    home_assistant: str
    folder: Path


def read_membership(options: MqttOptions, name: str, home_assistant: str, folder: Path) -> Membership | None:
    """None without a broker. Ends the program with what is wrong with one of the options."""
    if not options.url:
        if home_assistant:
            fail("--home-assistant needs --mqtt: it is found on a broker.", USAGE)
        return None
    broker = broker_of(options)
    judge_prefix(home_assistant)
    return Membership(broker, site_of(options), gateway_name(name, broker, folder), home_assistant, folder)


def judge_prefix(home_assistant: str) -> None:
    """Ends the program where it is no prefix of topics."""
    from servodeck.fleet.home_assistant import is_prefix

    if home_assistant and not is_prefix(home_assistant):
        fail(f"--home-assistant {home_assistant} is not valid: the usual prefix is homeassistant.", USAGE)


def fleet_at(options: MqttOptions, folder: Path) -> "FleetService | None":
    """None without an address. Ends the program with what is wrong with one of the options."""
    if not options.url:
        return None
    from servodeck.fleet.service import FleetService
    from servodeck.library.library import wall_clock_ms

    try:
        return FleetService(broker_of(options), site_of(options), folder, wall_clock_ms)
    except ValueError as error:
        fail(f"--fleet {options.url} is not valid: {error}.", USAGE)


class OnBroker(Protocol):
    """The gateway as a client of a broker. `start` is called on its loop, `end` when it has ended."""

    def start(self) -> None: ...

    def end(self) -> None: ...

    def status(self) -> "FleetStatus | None": ...


class OnNoBroker:
    def start(self) -> None:
        """Nothing to do."""

    def end(self) -> None:
        """Nothing to do."""

    def status(self) -> None:
        return None


def on_broker_of(
    membership: Membership | None, control: "Control", page: Callable[[], str], devices: "Devices"
) -> OnBroker:
    """`page`: its address for others; empty where they reach none. There the robots' page may stop the robot
    straight, as a stop-only link does; an owner sees and revokes it among these.
    """
    if membership is None:
        return OnNoBroker()
    from servodeck.errors import OutOfRangeError
    from servodeck.fleet.gateway import FleetGateway
    from servodeck.fleet.home_assistant import HomeAssistant
    from servodeck.fleet.reports import Page

    broker, site, name, prefix, folder = membership
    announced = HomeAssistant(site, name, prefix, folder).messages
    address, token = page(), ""
    if address:
        with suppress(OutOfRangeError):  # as many as there may be are paired: it is stopped over the broker
            token = devices.admit_again("stopLink", f"Robots of {site.name}", "stopper")[1]
    return FleetGateway(control, broker, site, name, Page(address, token), announced)
