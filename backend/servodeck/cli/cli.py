"""The command line. Parses, prints and sets exit codes; the work is done elsewhere.

Imports the gateway only where it is served, so that the small commands answer at once.
"""

import ipaddress
import json
import os
import socket
import sys
import time
import webbrowser
from contextlib import suppress
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from servodeck.cli.config import PREFIX, commands_of, settings_of, take_file, toml_line
from servodeck.cli.download_cli import download
from servodeck.cli.library_cli import library, pose, poses
from servodeck.cli.options_cli import Token, TokenFile, asked, remote_at
from servodeck.cli.remote_cli import COMMANDS
from servodeck.port.ports import PortInfo, list_devices
from servodeck.protocol.describe import describe
from servodeck.protocol.families import FAMILIES, UNKNOWN
from servodeck.protocol.limits import PacketError
from servodeck.run.logs import Form, Level

if TYPE_CHECKING:
    from servodeck.access.access import Access
    from servodeck.access.entrance import Entrance

DEFAULT_LISTEN = "127.0.0.1:8300"
LAN_LISTEN = "0.0.0.0:8300"
USAGE, FAILURE = 2, 1

app = typer.Typer(
    help="Servodeck: drives LewanSoul, Lobot and Hiwonder servo controllers.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


for command in (*COMMANDS, pose, poses, download, library):
    app.command()(command)


def fail(message: str, code: int = FAILURE) -> NoReturn:
    print(message, file=sys.stderr)
    raise typer.Exit(code)


@app.command(context_settings={"auto_envvar_prefix": PREFIX})
def serve(
    config: Annotated[  # noqa: ARG001 (its callback reads it)
        Path | None,
        typer.Option(
            callback=take_file,
            is_eager=True,
            help="TOML file of these options; left out: this user's own or /etc/servodeck/config.toml.",
        ),
    ] = None,
    listen: Annotated[
        str,
        typer.Option(
            help="HOST:PORT of this computer; port 0 takes a free one. "
            f"Left out: {DEFAULT_LISTEN}, with --lan {LAN_LISTEN}."
        ),
    ] = "",
    lan: Annotated[bool, typer.Option("--lan", help="Let other devices in, once they are paired.")] = False,
    public_url: Annotated[
        str, typer.Option(help="The one address of a proxy in front, for example https://robot.example.")
    ] = "",
    invite: Annotated[
        bool, typer.Option("--invite", help="Show a link for one more owner, also where there is one.")
    ] = False,
    serial: Annotated[str, typer.Option(help="Serial device, or socket://HOST:PORT.")] = "",
    board: Annotated[
        str, typer.Option(help=f"Board family: {', '.join(FAMILIES)}. Left out: as it was last, else ask it.")
    ] = "",
    simulated: Annotated[
        bool, typer.Option("--simulated", help="Tell everyone that the device is no real board.")
    ] = False,
    data: Annotated[
        Path | None, typer.Option(help="Folder of the library; left out: one of this user's own.")
    ] = None,
    open_page: Annotated[
        bool | None,
        typer.Option(
            "--open/--no-open",
            envvar=f"{PREFIX}_OPEN",
            help="Show the page; by default where a person looks on.",
        ),
    ] = None,
    log_level: Annotated[Level, typer.Option(help="The least that the log on stderr tells.")] = "info",
    log_format: Annotated[Form, typer.Option(help="For people, or a JSON object a line.")] = "text",
    exit_with_stdin: Annotated[
        bool, typer.Option("--exit-with-stdin", help="End when stdin ends: with whoever started us.")
    ] = False,
) -> None:
    """Serve the page and own the serial port. Each option may also come from SERVODECK_NAME or a file."""
    from servodeck.access import access
    from servodeck.access.greeting import greeting, urls_for_others
    from servodeck.board.slot_memory import SlotMemory
    from servodeck.cli.data_folder import data_folder
    from servodeck.driving.control import Control
    from servodeck.driving.epoch import first_epoch
    from servodeck.errors import StorageError
    from servodeck.files.remembered import Remembered
    from servodeck.library.library import Library
    from servodeck.port.background import BackgroundPorts
    from servodeck.run.announcement import Announcement
    from servodeck.run.app import create_app
    from servodeck.run.logs import set_up_logs
    from servodeck.run.server import Server, leave_with_stdin
    from servodeck.web.library_api import robots_in

    recalls_board = not board
    board = board or ("doc" if simulated else UNKNOWN.id)
    if board not in FAMILIES:
        fail(f"There is no board family {board}. Choose one of: {', '.join(FAMILIES)}.", USAGE)
    proxied = parse_public_url(public_url) if public_url else None
    listener = bind(*parse_listen(listen or (LAN_LISTEN if lan else DEFAULT_LISTEN), lan=lan))
    folder = data or data_folder()
    host, port = listener.getsockname()[:2]
    by_address = access.lan(port, listens_at=host) if lan else access.local(port)
    entrance = entrance_to(proxied or by_address, folder)
    log = set_up_logs(log_level, log_format)
    url = url_of(listener)

    def reachable() -> list[str]:
        return access.answered_at(host, access.lan_addresses())

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
        simulated=simulated,
        epoch=first_epoch(folder),
        slot_memory=SlotMemory(folder),
        remembered=remembered,
        recalls_board=recalls_board,
        read_robot=robots_in(library),
    )

    def ready() -> None:
        print(f"Servodeck is at {url}", flush=True)
        if entrance.access.needs_pairing:
            others = urls_for_others(entrance.access, reachable(), url)
            is_alone = entrance.access.mode == "lan" and is_loopback(host)
            only_here = LAN_LISTEN if is_alone else ""
            print(greeting(entrance, others, invites=invite, only_here=only_here), flush=True)
        if sys.stdout.isatty() if open_page is None else open_page:
            webbrowser.open(url)

    app = create_app(control, library, entrance)
    server = Server(app, control, device, ready)
    if exit_with_stdin:
        leave_with_stdin(server.leave)
    if announcement:
        announcement.start()
    server.run([listener])
    if announcement:
        announcement.end()
    library.close()
    with suppress(StorageError):
        entrance.devices.close()
    log.close()
    # Python itself would wait for every thread that a disk or a driver still holds.
    os._exit(0)


@app.command("config", context_settings={"allow_extra_args": True, "ignore_unknown_options": True})
def show_config(context: typer.Context) -> None:
    """Show what `serve` with the same options would go by, and where each value comes from."""
    commands = commands_of(context)
    with commands["serve"].make_context("serve", context.args, parent=context.parent) as made:
        for setting in settings_of(made):
            print(toml_line(setting))


@app.command()
def ports(
    as_json: Annotated[bool, typer.Option("--json", help="For programs.")] = False,
    url: Annotated[
        str, typer.Option(envvar=f"{PREFIX}_URL", help="Those of the computer of that gateway.")
    ] = "",
    token: Token = "",
    token_file: TokenFile = None,
) -> None:
    """List the serial ports of this computer, the likely ones first."""
    if url:
        remote = remote_at(url, token, token_file)
        names = [field.name for field in fields(PortInfo)]
        listed = asked(remote, "GET", "/api/ports")
        found = [PortInfo(**{name: port[name] for name in names}) for port in listed]
    else:
        found = list_devices()
    if as_json:
        print(json.dumps([asdict(port) for port in found]))
    elif not found:
        print("No serial port found. Is the cable plugged in?")
    for port in () if as_json else found:
        print(f"{port.device}  {port.description}{'  (likely)' if port.likely else ''}")
        if port.lasting:
            print(f"    lasting name: {port.lasting}")


@app.command()
def decode(
    hex_bytes: Annotated[list[str], typer.Argument(metavar="HEX...", help="Bytes, e.g. 55 55 02 07")],
    report: Annotated[bool, typer.Option("--report", help="From the board, not to it.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="For programs.")] = False,
) -> None:
    """Say in words what a packet means."""
    try:
        packet = bytes.fromhex(" ".join(hex_bytes))
        words = describe(packet, "report" if report else "command")
    except ValueError:
        fail("That is not a sequence of hex digits, two for each byte.", USAGE)
    except PacketError as error:
        fail(str(error))
    print(json.dumps({"packet": packet.hex(), "text": words}) if as_json else words)


def entrance_to(where: "Access", folder: Path) -> "Entrance":
    """Ends the program with an explanation where nobody can tell who is paired."""
    from servodeck.access.device_file import DeviceFile
    from servodeck.access.devices import Devices, NoShelf
    from servodeck.access.entrance import Entrance
    from servodeck.errors import StorageError
    from servodeck.library.library import wall_clock_ms

    try:
        shelf = DeviceFile(folder) if where.needs_pairing else NoShelf()
        return Entrance(where, Devices(shelf, wall_clock_ms), time.monotonic)
    except StorageError as error:
        fail(error.detail)


def parse_public_url(url: str) -> "Access":
    from servodeck.access.access import behind_proxy

    try:
        return behind_proxy(url)
    except ValueError as error:
        fail(f"--public-url {url} cannot be: {error}.", USAGE)


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


def main() -> None:
    app()
