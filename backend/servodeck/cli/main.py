"""The command line: all its commands, and the small ones that need no gateway. Parses, prints and sets exit
codes; the work is done elsewhere.
"""

import json
import subprocess
from dataclasses import asdict, fields
from typing import Annotated, Any

import typer

from servodeck.cli.assistant import mcp
from servodeck.cli.backup import backup, restore
from servodeck.cli.commands import COMMANDS, library, pose, poses
from servodeck.cli.doctor import doctor
from servodeck.cli.fleet import fleet
from servodeck.cli.groups import download, play
from servodeck.cli.notify import notify_test
from servodeck.cli.options import (
    FAILURE,
    PREFIX,
    USAGE,
    Token,
    TokenFile,
    commands_of,
    fail,
    remote_at,
    request,
    settings_of,
    toml_line,
)
from servodeck.cli.serve import new_program
from servodeck.errors import MalformedError
from servodeck.port.hid import UDEV_RULE, UDEV_RULE_FILE
from servodeck.port.ports import PortInfo, list_devices
from servodeck.protocol.describe import Piece, pieces_of
from servodeck.protocol.pasted import bytes_in

# The gateway listens for modules that long before it answers, and a busy computer needs a moment more.
SCAN_WAIT_S = 15.0

app = new_program()
for command in (*COMMANDS, pose, poses, download, play, library):
    app.command()(command)

app.add_typer(fleet)
app.command()(doctor)
app.command()(backup)
app.command()(restore)
app.command()(mcp)
AS_SERVE = {"allow_extra_args": True, "ignore_unknown_options": True}
app.command(context_settings=AS_SERVE)(notify_test)


# Its number comes before 73-seat-late.rules, which gives what `uaccess` promises.
RULE_FILE = UDEV_RULE_FILE
UDEV_COMMANDS = (("udevadm", "control", "--reload"), ("udevadm", "trigger", "--subsystem-match=hidraw"))


@app.command()
def udev_rule(
    install: Annotated[
        bool, typer.Option("--install", help="Write it to /etc/udev/rules.d, as root, and apply it.")
    ] = False,
) -> None:
    """Show the udev rule (Linux) that lets you use a board on its own USB cable, or install it."""
    if not install:
        print(UDEV_RULE)
        return
    try:
        RULE_FILE.write_text(f"{UDEV_RULE}\n", "utf-8")
        for command in UDEV_COMMANDS:
            subprocess.run(command, check=True, capture_output=True)
    except PermissionError:
        fail(f"{RULE_FILE} cannot be written. Run this as root, with sudo.", FAILURE)
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"udev does not take the rule: {error}.", FAILURE)
    print(f"{RULE_FILE} is installed. Plug the board's cable in again.")


@app.command("config", context_settings=AS_SERVE)
def show_config(context: typer.Context) -> None:
    """Show the settings that `serve` would use with the same options, and where each comes from."""
    commands = commands_of(context)
    with commands["serve"].make_context("serve", context.args, parent=context.parent) as made:
        for setting in settings_of(made):
            print(toml_line(setting))


@app.command()
def ports(
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    url: Annotated[
        str, typer.Option(envvar=f"{PREFIX}_URL", help="List the ports of this gateway's computer instead.")
    ] = "",
    token: Token = "",
    token_file: TokenFile = None,
    bluetooth: Annotated[
        bool, typer.Option("--bluetooth", help="Listen for Bluetooth modules, too; takes a few seconds.")
    ] = False,
) -> None:
    """List the ports of this computer, serial and HID, the likely ones first."""
    if url:
        remote = remote_at(url, token, token_file)
        names = [field.name for field in fields(PortInfo)]
        query = "?bluetooth=true" if bluetooth else ""
        listed = request(remote, "GET", f"/api/ports{query}", wait_s=SCAN_WAIT_S)
        found = [PortInfo(**{name: port[name] for name in names}) for port in listed]
    else:
        found = [*(modules_heard() if bluetooth else []), *list_devices()]
    if as_json:
        print(json.dumps([asdict(port) for port in found]))
    elif not found:
        print("No port found. Is the cable plugged in?")
    for port in () if as_json else found:
        print(f"{port.device}  {port.description}{'  (likely)' if port.likely else ''}")
        if port.lasting:
            print(f"    lasting name: {port.lasting}")


def modules_heard() -> list[PortInfo]:
    """Ends the program with the reason where Bluetooth cannot be had."""
    from servodeck.errors import PortError
    from servodeck.port.bluetooth import this_computer

    try:
        return this_computer().scan()
    except PortError as error:
        fail(error.detail)


@app.command()
def decode(
    text: Annotated[
        list[str] | None, typer.Argument(metavar="HEX...", help="Bytes, e.g. 55 55 02 07")
    ] = None,
    file: Annotated[
        typer.FileText | None,
        typer.Option(help="A file with the bytes, such as the export of a logic analyser; - for stdin."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON, an object for each packet.")] = False,
) -> None:
    """Explain packets in words: those of a host, those of a board, and what is between them."""
    if not text and file is None:
        fail("Give the bytes, or --file FILE.", USAGE)
    try:
        pieces = list(pieces_of(bytes_in(" ".join(text or ()) if file is None else file.read())))
    except MalformedError as error:
        fail(str(error), USAGE)
    if not any(piece.is_packet for piece in pieces):
        fail("No packet is in these bytes: 55 55, LEN, CMD, LEN - 2 more.")
    for piece in pieces:
        print(json.dumps(facts_of(piece)) if as_json else piece.text)


def facts_of(piece: Piece) -> dict[str, Any]:
    from servodeck.packet_models import command_model, report_model  # with pydantic, which text does not need

    if not piece.is_packet:
        return {"noise": piece.data.hex()}
    # A packet says nothing of later ones.
    command = piece.command and command_model(piece.command).model_dump(by_alias=True, exclude={"goals"})
    reports = [report_model(report).model_dump(by_alias=True) for report in piece.reports]
    return {"packet": piece.data.hex(), "command": command, "reports": reports, "text": piece.text}


def main() -> None:
    app()
