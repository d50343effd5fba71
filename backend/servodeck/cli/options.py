"""What the commands share: options that several take, how a command asks the gateway for its board, and how
it ends when it cannot do what it was asked: a sentence on stderr and an exit code.
"""

import json
import sys
import time
from collections.abc import Callable
from functools import wraps
from inspect import Signature, signature
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from servodeck.cli.remote import HERE, RefusedError, Remote, UnreachableError
from servodeck.loading import end_loading
from servodeck.protocol.families import FAMILIES, UNKNOWN

FAILURE, USAGE, UNREACHABLE, TIMED_OUT, INTERRUPTED = 1, 2, 3, 4, 130


def fail(message: str, code: int = FAILURE) -> NoReturn:
    print(message, file=sys.stderr)
    raise typer.Exit(code)


WHAT_TO_DO = {
    "notPaired": "An owner's page makes tokens (People). Give one by --token-file or SERVODECK_TOKEN.",
    "latched": "Look at the robot, then: servodeck resume",
    "notDriving": "Wait, ask there, or as an owner add --take.",
    "closed": "Open one on the page, or start the gateway with --serial DEVICE. servodeck ports lists them.",
    "lost": "It is tried again by itself. servodeck status tells how it stands.",
    "noAnswer": "Is the board switched on?",
    "boardUnknown": "servodeck board shows what it answered.",
    "wrongBoard": "servodeck board shows what it answered.",
}

Url = Annotated[str, typer.Option(envvar="SERVODECK_URL", help="The gateway's address.")]
Token = Annotated[
    str,
    typer.Option(
        envvar="SERVODECK_TOKEN",
        help="Access token. Other users can see command lines: better in a file or variable.",
    ),
]
TokenFile = Annotated[
    Path | None,
    typer.Option(envvar="SERVODECK_TOKEN_FILE", help="A file that holds the token and nothing else."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Take = Annotated[bool, typer.Option("--take", help="Take the robot from its present driver (owners only).")]


def remote_at(url: Url = HERE, token: Token = "", token_file: TokenFile = None) -> Remote:
    try:
        return Remote(url, token or (token_file.read_text("utf-8").strip() if token_file else ""))
    except OSError as error:
        fail(f"The token file {token_file} cannot be read: {error.strerror}.", USAGE)
    except ValueError:
        fail(f"{url} is not an address: begin with http:// or https://, for example {HERE}.", USAGE)


def asking(command: Callable[..., None]) -> Callable[..., None]:
    """Its first argument is the gateway; on the command line that is the options of `remote_at`."""
    where = signature(remote_at).parameters

    @wraps(command)
    def run(**options: Any) -> None:
        end_loading()
        command(remote_at(**{name: options.pop(name) for name in where}), **options)

    own = list(signature(command).parameters.values())[1:]
    run.__signature__ = Signature([*own, *where.values()])  # type: ignore[attr-defined]  # read by typer
    return run


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
    fail(f"{error.detail} ({error.code}){f'{chr(10)}{hint}' if hint else ''}", FAILURE)


def explain_silence(remote: Remote, error: UnreachableError) -> NoReturn:
    fail(
        f"No gateway at {remote.url}: {error}\nIs it running (servodeck serve)? --url sets another address.",
        UNREACHABLE,
    )


def show(answer: Any, as_json: bool, words: Callable[[Any], str]) -> None:
    print(json.dumps(answer) if as_json else words(answer))


# As long as a board may take that has just started.
IDENTIFIED_WITHIN_S = 10.0
RETRY_S = 0.1
QUESTIONS = {"readBattery": "battery", "readVersion": "version", "readPositions": "position of servo 1"}


@asking
def board(
    remote: Remote,
    family: Annotated[
        str | None,
        typer.Argument(metavar="FAMILY", help=f"{', '.join(FAMILIES)}; unknown: identify it again."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show how the board was identified, or choose its family."""
    if family is not None:
        asked(remote, "PUT", "/api/board", {"board": family})
    show(when_asked(remote), as_json, board_words)


def when_asked(remote: Remote) -> dict[str, Any]:
    """How everything stands once the gateway neither opens the port nor asks the board who it is."""
    until_s = time.monotonic() + IDENTIFIED_WITHIN_S
    while True:
        state: dict[str, Any] = asked(remote, "GET", "/api/status")
        if state["link"]["status"] not in ("opening", "identifying") or time.monotonic() > until_s:
            return state
        time.sleep(RETRY_S)


def board_words(state: dict[str, Any]) -> str:
    link, identity = state["link"], state["identity"]
    why = f" ({link['code']})" if link["code"] else ""
    lines = [f"board    {state['board']}, {link['status']}{why}"]
    lines += [f"         {evidence_words(one)}" for one in identity["evidence"]]
    if state["board"] == UNKNOWN.id and identity["candidates"]:
        lines += [
            f"         It answers like: {', '.join(identity['candidates'])}.",
            "         Name it: servodeck board FAMILY",
        ]
    elif link["detail"]:
        lines.append(f"         {link['detail']}")
    return "\n".join(lines)


def evidence_words(evidence: dict[str, Any]) -> str:
    match evidence["kind"]:
        case "answered":
            return f"It reported its {QUESTIONS[evidence['question']]}."
        case "silent":
            return f"It did not report its {QUESTIONS[evidence['question']]}."
        case "echoed":
            return "The request itself came back."
        case _:
            return f"{evidence['byteCount']} bytes came that are not packets."
