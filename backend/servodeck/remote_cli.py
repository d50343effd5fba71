"""The commands that ask a running gateway: what it has to say, and what the robot shall do.

Parses, prints and sets exit codes; what may be done the gateway decides.
"""

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from servodeck.remote import HERE, RefusedError, Remote, UnreachableError

USAGE, REFUSED, UNREACHABLE, INTERRUPTED = 2, 1, 3, 130
BEAT_S = 1.0
# Servos of unknown place start a quarter of a second apart.
MOVE_WAIT_S = 90.0
WHAT_TO_DO = {
    "notPaired": "An owner's page makes tokens (People). Give one by --token-file or SERVODECK_TOKEN.",
    "latched": "Look at the robot, then: servodeck resume",
    "notDriving": "Wait, ask there, or as an owner add --take.",
    "closed": "Open one on the page, or start the gateway with --serial DEVICE. servodeck ports lists them.",
    "lost": "It is tried again by itself. servodeck status tells how it stands.",
    "noAnswer": "Is the board switched on?",
}

Url = Annotated[str, typer.Option(envvar="SERVODECK_URL", help="The gateway's address.")]
Token = Annotated[
    str, typer.Option(envvar="SERVODECK_TOKEN", help="Who you are; better not where others can read it.")
]
TokenFile = Annotated[
    Path | None,
    typer.Option(envvar="SERVODECK_TOKEN_FILE", help="A file that holds the token and nothing else."),
]
AsJson = Annotated[bool, typer.Option("--json", help="For programs.")]
Take = Annotated[bool, typer.Option("--take", help="As an owner: also from whoever drives.")]


def fail(message: str, code: int) -> NoReturn:
    print(message, file=sys.stderr)
    raise typer.Exit(code)


def remote_at(url: str, token: str, token_file: Path | None) -> Remote:
    try:
        return Remote(url, token or (token_file.read_text("utf-8").strip() if token_file else ""))
    except OSError as error:
        fail(f"The token file {token_file} cannot be read: {error.strerror}.", USAGE)
    except ValueError:
        fail(f"{url} is no address: it begins with http:// or https://, for example {HERE}.", USAGE)


def asked(remote: Remote, method: str, path: str, body: object = None, **how: float) -> Any:
    """The answer; where there is none the program ends with what to do about it."""
    try:
        return remote.ask(method, path, body, **how)
    except RefusedError as error:
        explain(error)
    except UnreachableError as error:
        explain_silence(remote, error)


def explain(error: RefusedError) -> NoReturn:
    hint = WHAT_TO_DO.get(error.code)
    fail(f"{error.detail} ({error.code}){f'{chr(10)}{hint}' if hint else ''}", REFUSED)


def explain_silence(remote: Remote, error: UnreachableError) -> NoReturn:
    fail(
        f"No gateway at {remote.url}: {error}\nIs it running (servodeck serve)? --url names another one.",
        UNREACHABLE,
    )


def show(answer: Any, as_json: bool, words: Callable[[Any], str]) -> None:
    print(json.dumps(answer) if as_json else words(answer))


def status(url: Url = HERE, token: Token = "", token_file: TokenFile = None, as_json: AsJson = False) -> None:
    """How everything stands: port, board, who drives, what runs."""
    show(asked(remote_at(url, token, token_file), "GET", "/api/status"), as_json, status_words)


def status_words(state: dict[str, Any]) -> str:
    port, run, alone = state["port"], state["running"], state["unattended"]
    lines = [
        f"port     {port['status']} {port['device'] or ''} {port['detail'] or ''}".rstrip(),
        f"board    {state['board']}",
        f"motion   {'stopped, waits for resume' if state['latch'] else 'allowed'}",
        f"driver   {state['driver'] or 'nobody'}",
    ]
    if run:
        lines.append(f"running  slot {run['slot']}, {run['times'] or 'endless'} times, as far as is known")
    if alone:
        lines.append(f"alone    without {alone['by']}, {alone['endsInMs'] / 1000:.0f} s at most")
    return "\n".join(lines)


def stop(url: Url = HERE, token: Token = "", token_file: TokenFile = None, as_json: AsJson = False) -> None:
    """STOP: ends what moves, and refuses motion until `servodeck resume`."""
    answer = asked(remote_at(url, token, token_file), "POST", "/api/stop")
    show(answer, as_json, lambda _: "Stopped. servodeck resume allows motion again.")


def resume(url: Url = HERE, token: Token = "", token_file: TokenFile = None, as_json: AsJson = False) -> None:
    """Allow motion again. Moves nothing."""
    answer = asked(remote_at(url, token, token_file), "POST", "/api/resume")
    show(answer, as_json, lambda _: "Motion is allowed.")


def move(
    targets: Annotated[
        list[str], typer.Argument(metavar="SERVO=POSITION...", help="For example 1=1500 2=900")
    ],
    time_ms: Annotated[
        int, typer.Option("--time", help="Milliseconds; a servo's first move takes 1500.")
    ] = 1500,
    take: Take = False,
    url: Url = HERE,
    token: Token = "",
    token_file: TokenFile = None,
    as_json: AsJson = False,
) -> None:
    """Move servos together, in the board's unit."""
    body = {"timeMs": time_ms, "positions": positions_in(targets), "take": take}
    answer = asked(remote_at(url, token, token_file), "POST", "/api/move", body, wait_s=MOVE_WAIT_S)
    show(answer, as_json, lambda begun: f"On its way, over in {begun['overInMs'] / 1000:.1f} s.")


def positions_in(targets: list[str]) -> dict[str, int]:
    try:
        pairs = [target.split("=") for target in targets]
        return {str(int(servo)): int(position) for servo, position in pairs}
    except ValueError:
        fail("A target is SERVO=POSITION, for example 1=1500.", USAGE)


def run(
    slot: Annotated[int, typer.Argument(help="Of the board, from 0.")],
    times: Annotated[int, typer.Option(help="0: until stopped.")] = 1,
    go_on: Annotated[
        int | None,
        typer.Option("--continue", metavar="SECONDS", help="Return at once; it goes on for so long at most."),
    ] = None,
    take: Take = False,
    url: Url = HERE,
    token: Token = "",
    token_file: TokenFile = None,
    as_json: AsJson = False,
) -> None:
    """Run a group of the board and watch over it: Ctrl-C ends it."""
    remote = remote_at(url, token, token_file)
    body = {"times": times, "take": take, "continueForMs": None if go_on is None else go_on * 1000}
    answer = asked(remote, "POST", f"/api/slots/{slot}/run", body)
    show(answer, as_json, lambda begun: f"Slot {slot}: {begun['outcome']}.")
    if go_on is None:
        watch(remote)


def watch(remote: Remote) -> None:
    """Beats until the board has said that it is over; else until a person ends it."""
    try:
        while asked(remote, "GET", "/api/status")["running"]:
            asked(remote, "POST", "/api/lease", {"action": "beat"})
            time.sleep(BEAT_S)
    except KeyboardInterrupt:
        asked(remote, "POST", "/api/lease", {"action": "release"})
        fail("Ended.", INTERRUPTED)


def battery(
    url: Url = HERE, token: Token = "", token_file: TokenFile = None, as_json: AsJson = False
) -> None:
    """Ask the board for its battery voltage."""
    answer = asked(remote_at(url, token, token_file), "GET", "/api/battery")
    show(answer, as_json, lambda read: f"{read['batteryMv'] / 1000:.2f} V")


def events(url: Url = HERE, token: Token = "", token_file: TokenFile = None) -> None:
    """Show what happens, a JSON object a line, until Ctrl-C."""
    remote = remote_at(url, token, token_file)
    try:
        for line in remote.events():
            print(line, flush=True)
    except RefusedError as error:
        explain(error)
    except UnreachableError as error:
        explain_silence(remote, error)
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None


COMMANDS: tuple[Callable[..., None], ...] = (status, stop, resume, move, run, battery, events)
