"""The program, with its command `servodeck serve`: reads HOST:PORT and binds it, puts the gateway together
and ends it. The other commands are loaded only where one of them is requested (main.py).

Imports the gateway only where it is served, so that the small commands answer at once.
"""

import ipaddress
import os
import socket
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer.main import get_command

from servodeck import __version__
from servodeck.cli import end_loading
from servodeck.cli.broker import (
    USUAL_SITE,
    FleetPassword,
    FleetPasswordFile,
    FleetUrl,
    MqttCa,
    MqttCert,
    MqttKey,
    MqttOptions,
    MqttPassword,
    MqttPasswordFile,
    MqttSite,
    MqttUrl,
    fleet_at,
    on_broker_of,
    read_membership,
)
from servodeck.cli.options import PREFIX, USAGE, Form, Level, fail, take_file
from servodeck.protocol.families import FAMILIES, UNKNOWN

if TYPE_CHECKING:
    from servodeck.access.addresses import Access
    from servodeck.access.entrance import Entrance
    from servodeck.api.cameras import Camera
    from servodeck.library.library import Library
    from servodeck.notify.notifications import Notifications
    from servodeck.notify.sender import Sender
    from servodeck.robot.profile import ReadFacts
    from servodeck.snapshots import RobotFacts


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
            f"Cannot listen on {host}:{port} ({error.strerror}). Is another Servodeck running? "
            f"--listen {host}:0 takes a free port."
        )


def url_of(listener: socket.socket) -> str:
    """The address for this computer itself."""
    host, port = listener.getsockname()[:2]
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"


Listen = Annotated[
    str,
    typer.Option(
        help="HOST:PORT of this computer; port 0 takes a free one. "
        f"Default: {DEFAULT_LISTEN}, with --lan {LAN_LISTEN}."
    ),
]
Lan = Annotated[bool, typer.Option("--lan", help="Let other devices in, once they are paired.")]
PublicUrl = Annotated[
    str, typer.Option(help="Address of a reverse proxy in front, for example https://robot.example.")
]
Data = Annotated[
    Path | None,
    typer.Option(help="Folder of the library and settings. Default: in this user's data folder."),
]
OpenPage = Annotated[
    bool | None,
    typer.Option(
        "--open/--no-open",
        envvar=f"{PREFIX}_OPEN",
        help="Open the page in a browser. Default: if started from a terminal.",
    ),
]
FLEET_PAGE = "fleet.html"


def serve(
    config: Annotated[  # noqa: ARG001 (its callback reads it)
        Path | None,
        typer.Option(
            callback=take_file,
            is_eager=True,
            help="TOML file of these options. Default: this user's own, or /etc/servodeck/config.toml.",
        ),
    ] = None,
    listen: Listen = "",
    lan: Lan = False,
    public_url: PublicUrl = "",
    invite: Annotated[bool, typer.Option("--invite", help="Print an invitation for another owner.")] = False,
    serial: Annotated[
        str,
        typer.Option(
            help="Serial device, socket://HOST:PORT, hid:SERIAL, or hid for the only board on its USB cable."
        ),
    ] = "",
    board: Annotated[
        str,
        typer.Option(
            help=f"Board family: {', '.join(FAMILIES)}. Default: the last one, else it is identified."
        ),
    ] = "",
    camera: Annotated[
        list[str],
        typer.Option(help="NAME=URL of a camera that sends motion JPEG, for the page. May be repeated."),
    ] = [],  # noqa: B006 (typer copies it)
    notify: Annotated[
        list[str],
        typer.Option(
            metavar="URL",
            help="Notify there when the battery is low, the robot is stopped or the link is lost: https://… "
            "(webhook) or ntfy://HOST/TOPIC. May be repeated. Other users see command lines: better a file.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    notify_file: Annotated[
        Path | None, typer.Option(help="A file of such addresses, one in each line.")
    ] = None,
    mqtt: MqttUrl = "",
    mqtt_site: MqttSite = USUAL_SITE,
    mqtt_name: Annotated[
        str, typer.Option(help="This gateway's name there. Default: the user of --mqtt, else one of its own.")
    ] = "",
    mqtt_password: MqttPassword = "",
    mqtt_password_file: MqttPasswordFile = None,
    mqtt_ca: MqttCa = None,
    mqtt_cert: MqttCert = None,
    mqtt_key: MqttKey = None,
    home_assistant: Annotated[
        str,
        typer.Option(
            metavar="PREFIX",
            help="Let Home Assistant find this robot, below its prefix, homeassistant. Default: not.",
        ),
    ] = "",
    fleet: FleetUrl = "",
    fleet_password: FleetPassword = "",
    fleet_password_file: FleetPasswordFile = None,
    simulated: Annotated[bool, typer.Option("--simulated", help="The device is a simulated board.")] = False,
    data: Data = None,
    open_page: OpenPage = None,
    log_level: Annotated[Level, typer.Option(help="Lowest level that is logged on stderr.")] = "info",
    log_format: Annotated[Form, typer.Option(help="Text for people, or one JSON object per line.")] = "text",
    exit_with_stdin: Annotated[
        bool,
        typer.Option(
            "--exit-with-stdin", help="End when stdin is closed, with the program that started this one."
        ),
    ] = False,
) -> None:
    """Serve the page and the serial port. Each option can also be set as SERVODECK_NAME or in a file."""
    from servodeck.access import addresses
    from servodeck.access.addresses import Announcement
    from servodeck.access.audit import Audit
    from servodeck.access.audit_file import AuditFile
    from servodeck.api.app import create_app
    from servodeck.api.health import allow_descriptors
    from servodeck.api.server import Server, ignore_signals, leave_with_stdin
    from servodeck.cli.options import data_folder
    from servodeck.cli.terminal import greeting, set_up_logs, urls_for_others
    from servodeck.errors import StorageError
    from servodeck.files import Remembered
    from servodeck.library.library import Library, wall_clock_ms
    from servodeck.port.link import BackgroundPorts
    from servodeck.robot.board.slots import SlotMemory
    from servodeck.robot.control import Control
    from servodeck.robot.driving import first_epoch

    allow_descriptors()
    # Without a port named, the one that is opened is a remembered one, which no option describes.
    is_simulated = simulated and bool(serial)
    recalls_board = not (board or is_simulated)
    board = board or ("doc" if is_simulated else UNKNOWN.id)
    if board not in FAMILIES:
        fail(f"There is no board family {board}. Choose one of: {', '.join(FAMILIES)}.", USAGE)
    senders = senders_to(notify, notify_file)
    proxied = parse_public_url(public_url) if public_url else None
    folder = data or data_folder()
    mqtt_options = MqttOptions(
        mqtt, mqtt_site, mqtt_password, mqtt_password_file, mqtt_ca, mqtt_cert, mqtt_key
    )
    membership = read_membership(mqtt_options, mqtt_name, home_assistant, folder)
    fleet_service = fleet_at(
        mqtt_options._replace(url=fleet, password=fleet_password, password_file=fleet_password_file), folder
    )
    listener = bind(*parse_listen(listen or (LAN_LISTEN if lan else DEFAULT_LISTEN), lan=lan))
    host, port = listener.getsockname()[:2]
    by_address = addresses.lan(port, listens_at=host) if lan else addresses.local(port)
    entrance = entrance_to(proxied or by_address, folder)
    log = set_up_logs(log_level, log_format)
    url = url_of(listener)

    def reachable() -> list[str]:
        return addresses.answered_at(host, addresses.lan_addresses())

    page = partial(page_for_others, entrance.access, reachable)
    is_heard = entrance.access.mode == "lan" and not is_loopback(host)
    announcement = Announcement(entrance.access.port, addresses=reachable) if is_heard else None
    library = Library(folder)
    remembered = Remembered(folder)
    device = serial or remembered.port

    control = Control(
        BackgroundPorts(),
        time.monotonic,
        board,
        serial or None,
        simulated=is_simulated,
        epoch=first_epoch(folder),
        slot_memory=SlotMemory(folder),
        remembered=remembered,
        recalls_board=recalls_board,
        identifies_board=True,
        polls_battery=True,
        is_monitored=bool(senders),
        read_robot=robots_in(library),
    )

    on_broker = on_broker_of(membership, control, page, entrance.devices)

    def show(address: str) -> None:
        import webbrowser

        webbrowser.open(address)

    places = [f"Servodeck is at {url}", *([f"The fleet is at {url}/{FLEET_PAGE}"] if fleet else [])]

    def ready() -> None:
        on_broker.start()
        end_loading()
        print("\n".join(places), flush=True)
        if entrance.access.needs_pairing:
            others = urls_for_others(entrance.access, reachable(), url)
            is_alone = entrance.access.mode == "lan" and is_loopback(host)
            only_here = LAN_LISTEN if is_alone else ""
            print(greeting(entrance, others, invites=invite, only_here=only_here), flush=True)
        if sys.stdout.isatty() if open_page is None else open_page:
            # Without a robot of its own, the fleet is what there is to see.
            show(f"{url}/{FLEET_PAGE}" if fleet and not (device or mqtt) else url)

    audit = Audit(AuditFile(folder), wall_clock_ms)
    app = create_app(
        control,
        library,
        entrance,
        cameras=cameras_from(camera),
        notifications=notifications_to(senders, page),
        audit=audit,
        on_broker=on_broker.status,
        fleet=fleet_service,
    )
    server = Server(app, control, device, ready)
    if exit_with_stdin:
        leave_with_stdin(server.leave)
    if announcement:
        announcement.start()
    server.run([listener])
    ignore_signals()
    if announcement:
        announcement.end()
    on_broker.end()
    library.close()
    audit.close()
    with suppress(StorageError):
        entrance.devices.close()
    log.close()
    # Python itself would wait for every thread that a disk or a driver still holds.
    os._exit(0)


def robots_in(library: "Library") -> "ReadFacts":
    """As api/library.py has it, which is loaded when the first robot is read."""

    def read(document: str) -> "tuple[RobotFacts, int]":
        from servodeck.api.library import robots_in

        return robots_in(library)(document)

    return read


def entrance_to(where: "Access", folder: Path) -> "Entrance":
    """Ends the program with an explanation where it cannot be read who is paired."""
    from servodeck.access.devices import DeviceFile, Devices, NoDeviceStore
    from servodeck.access.entrance import Entrance
    from servodeck.errors import StorageError
    from servodeck.library.library import wall_clock_ms

    try:
        store = DeviceFile(folder) if where.needs_pairing else NoDeviceStore()
        return Entrance(where, Devices(store, wall_clock_ms), time.monotonic)
    except StorageError as error:
        fail(error.detail)


def cameras_from(texts: Sequence[str]) -> "list[Camera]":
    if not texts:
        return []
    from servodeck.api.cameras import parse_camera

    found = []
    for text in texts:
        try:
            found.append(parse_camera(text))
        except ValueError as error:
            fail(f"--camera {text} is not valid: {error}.", USAGE)
    return found


def senders_to(addresses: Sequence[str], file: Path | None) -> "list[Sender]":
    if not addresses and not file:
        return []
    from servodeck.cli.notify import receivers
    from servodeck.notify.sender import Sender

    return [Sender(receiver) for receiver in receivers(addresses, file)]


def page_for_others(access: "Access", reachable: Callable[[], list[str]]) -> str:
    """Empty where others can open none."""
    from servodeck.cli.terminal import urls_for_others

    return urls_for_others(access, reachable(), "")[0] if access.needs_pairing else ""


def notifications_to(senders: "list[Sender]", page: Callable[[], str]) -> "Notifications | None":
    if not senders:
        return None
    from servodeck.notify.notifications import Notifications

    return Notifications(senders, page)


def parse_public_url(url: str) -> "Access":
    from servodeck.access.addresses import behind_proxy

    try:
        return behind_proxy(url)
    except ValueError as error:
        fail(f"--public-url {url} is not valid: {error}.", USAGE)


def show_version(is_wanted: bool) -> None:
    if is_wanted:
        print(f"servodeck {__version__}")
        raise typer.Exit


def main_options(
    _version: Annotated[
        bool, typer.Option("--version", callback=show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Drives LewanSoul, Lobot and Hiwonder servo controllers."""


def new_program() -> typer.Typer:
    program = typer.Typer(
        help="Servodeck: drives LewanSoul, Lobot and Hiwonder servo controllers.",
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    program.callback()(main_options)
    program.command(context_settings={"auto_envvar_prefix": PREFIX})(serve)
    return program


def serve_alone(whole: Callable[[], typer.Typer]) -> None:
    """`whole` loads the program with all its commands, where a command has to be named."""
    new_program()(obj=lambda: get_command(whole()))
