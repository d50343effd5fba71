"""The command that looks for what keeps a robot from being driven, and says what to do about it.

Prints findings, the good ones too, so that all of it can be sent to a person who helps. Reads a board's
battery and moves nothing.
"""

import platform
import shutil
import sys
from collections.abc import Generator, Iterator
from typing import Annotated, Any, Literal

import typer

from servodeck import __version__
from servodeck.cli.options import FAILURE, Token, TokenFile, Url, remote_at
from servodeck.cli.remote import HERE, RefusedError, Remote, UnreachableError
from servodeck.errors import PortError
from servodeck.port.diagnosis import Heard, access_to, find_rate, has_rates, listen, looks_like
from servodeck.port.hid import ALLOW_HID, is_hid
from servodeck.port.ports import PortInfo, is_same_port, list_devices
from servodeck.protocol.timings import LINE
from servodeck.value import value

NOISE_SHOWN = 32
NOISE_MEANS = {
    "rate": "They look like another speed. Servodeck uses 9600 baud: set the board's port to it.",
    "text": "They are text, so a program on the board prints. On a LeArm AI press K1 once.",
    "other": "Check the wiring: GND to GND, TX to RX, RX to TX.",
}


@value
class Finding:
    sign: Literal["ok", "look", "--"]
    """`look`: something to do."""
    text: str


def doctor(
    url: Url = HERE,
    token: Token = "",
    token_file: TokenFile = None,
    port: Annotated[
        str, typer.Option(help="Look at this port alone; `servodeck ports` lists them.", metavar="DEVICE")
    ] = "",
    rates: Annotated[
        bool, typer.Option(help="Where nothing can be read, listen at other speeds too. Sends nothing there.")
    ] = False,
) -> None:
    """Look for what keeps a robot from being driven: gateway, ports, access, what a board answers."""
    findings = list(findings_of(remote_at(url, token, token_file), port, rates=rates))
    for finding in findings:
        print(f"{finding.sign:<4}  {finding.text}")
    if any(finding.sign == "look" for finding in findings):
        sys.exit(FAILURE)


def findings_of(remote: Remote, device: str, *, rates: bool) -> Iterator[Finding]:
    yield Finding(
        "ok", f"servodeck {__version__}, Python {platform.python_version()}, {platform.platform(terse=True)}"
    )
    status = yield from gateway_findings(remote)
    owned = None if status is None else status["port"]["device"]
    ports = list_devices()
    if device:
        ports = [port for port in ports if is_same_port(port.device, device)] or [
            PortInfo(device, "Named on the command line", likely=True)
        ]
    if not ports:
        yield Finding(
            "look",
            "This computer has no port that could be a board. Plug its cable in, switch the board on, "
            "and try another cable: some carry power only.",
        )
    if shutil.which("brltty"):
        yield Finding("look", "brltty is installed and takes CH340 adapters away: sudo apt remove brltty")
    for port in ports:
        if owned is None or not is_same_port(port.device, owned):
            yield from port_findings(port, is_wanted=bool(device) or port.likely, rates=rates)
        else:
            yield Finding("ok", f"{name_of(port)} is the gateway's.")
            if rates and has_rates(owned):
                yield gateway_rate_finding(remote, name_of(port))


def gateway_findings(remote: Remote) -> Generator[Finding, None, dict[str, Any] | None]:
    """Returns its status, None where it gives none."""
    try:
        status: dict[str, Any] = remote.request("GET", "/api/status")
    except UnreachableError:
        yield Finding("--", f"No gateway answers at {remote.url}: start one with servodeck serve.")
        return None
    except RefusedError as error:
        yield Finding("look", f"The gateway at {remote.url} lets only paired devices in: {error}")
        return None
    yield Finding("ok", f"A gateway answers at {remote.url}, version {status['version']}.")
    port, link = status["port"], status["link"]
    if port["device"] is None:
        yield Finding(
            "look", "It has no port open: choose one on its page, or start it with --serial DEVICE."
        )
    elif link["status"] == "ready":
        yield Finding("ok", f"It drives a board on {port['device']}.")
    else:
        why = port["detail"] or link["detail"] or ""
        yield Finding("look", f"Its link to {port['device']} is {link['status']}. {why}".rstrip())
    for receiver in status["notifications"]:
        what = f"Notifications go to {receiver['kind']} at {receiver['host']}"
        if receiver["latest"] == "dropped":
            advice = "servodeck notify-test tries it."
            yield Finding("look", f"{what}. The latest was dropped: {receiver['detail']} {advice}")
        else:
            yield Finding("ok", f"{what}.")
    if status["latch"]:
        yield Finding("look", "The robot is stopped. Look at it, then: servodeck resume")
    return status


def name_of(port: PortInfo) -> str:
    return f"{port.device} ({port.description})"


def port_findings(port: PortInfo, *, is_wanted: bool, rates: bool) -> Iterator[Finding]:
    name = name_of(port)
    if problem := access_problem(name, port.device):
        yield Finding("look", problem)
        return
    if not is_wanted:
        yield Finding("--", f"{name} is no usual cable of a board. To ask it: --port {port.device}")
        return
    try:
        heard = listen(port.device)
        yield from heard_findings(name, heard, is_on_hid=is_hid(port.device))
        if rates and has_rates(port.device) and not heard.packets:
            found = find_rate(port.device)
            yield rate_finding(name, found and (found[0], "packets" if found[1].packets else "text"))
    except PortError as error:
        yield Finding("look", error.detail)


def access_problem(name: str, device: str) -> str | None:
    """Why this account cannot have it, and what to do; None where it can, or where only opening it tells."""
    if "://" in device:
        return None
    try:
        access = access_to(device)
    except PortError as error:
        return error.detail
    if access.held_by:
        return f"{name} is open in {', '.join(access.held_by)}: close it there."
    if access.may_open:
        return None
    if is_hid(device):
        return f"This account may not open {name}: {ALLOW_HID}, then plug it in again."
    return f"This account may not open {name}: sudo usermod -aG {access.group} $USER, then log in again."


def heard_findings(name: str, heard: Heard, *, is_on_hid: bool) -> Iterator[Finding]:
    if heard.battery_mv is not None:
        yield Finding(
            "ok",
            f"A board answers on {name} after {heard.answered_ms or 0:.0f} ms; its battery has "
            f"{heard.battery_mv / 1000:.2f} V.",
        )
    elif heard.packets:
        yield Finding("ok", f"A board sends on {name} and does not report its battery, as some do not.")
    elif not heard.noise and is_on_hid:
        yield Finding(
            "look",
            f"Nothing answers on {name}. Every board on such a cable answers: switch it on, the cable alone "
            "does not power it. Is it the board? Other devices share its numbers.",
        )
    elif not heard.noise:
        yield Finding(
            "look",
            f"Nothing answers on {name}. Switch the board on and check that TX goes to RX. "
            "OpenArm and LeArm may have no battery answer: connect, and choose the board by hand. "
            "--rates listens at other speeds.",
        )
    if heard.noise:
        shown = heard.noise[:NOISE_SHOWN].hex(" ")
        means = NOISE_MEANS[looks_like(heard.noise)]
        yield Finding(
            "look", f"{len(heard.noise)} bytes on {name} are no packets. {means} They begin {shown}"
        )


def gateway_rate_finding(remote: Remote, name: str) -> Finding:
    """The gateway gives its port up for that."""
    try:
        found = remote.request("POST", "/api/port/listen", wait_s=LINE.listened_within_ms / 1000)
    except (RefusedError, UnreachableError) as error:
        return Finding("look", f"The gateway does not listen at other speeds on {name}: {error}")
    return rate_finding(name, None if found["baud"] is None else (found["baud"], found["kind"]))


def rate_finding(name: str, found: tuple[int, str] | None) -> Finding:
    if found is None:
        rates = ", ".join(str(rate) for rate in LINE.other_rates)
        return Finding("--", f"At {rates} baud nothing that can be read arrives on {name} by itself.")
    rate, kind = found
    if kind == "packets":
        return Finding("look", f"At {rate} baud packets arrive on {name}: set the board's port to 9600 baud.")
    return Finding("look", f"At {rate} baud text arrives on {name}. {NOISE_MEANS['text']}")
