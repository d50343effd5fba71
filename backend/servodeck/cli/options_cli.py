"""What all commands share that ask a running gateway: the options that say which one and as whom, how an
answer is shown, and what is said with which exit code where there is none.

Knows options and words; no command.
"""

import json
from collections.abc import Callable
from functools import wraps
from inspect import Signature, signature
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from servodeck.cli.exits import FAILURE, UNREACHABLE, USAGE, fail
from servodeck.cli.remote import HERE, RefusedError, Remote, UnreachableError

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
    str, typer.Option(envvar="SERVODECK_TOKEN", help="Who you are; better not where others can read it.")
]
TokenFile = Annotated[
    Path | None,
    typer.Option(envvar="SERVODECK_TOKEN_FILE", help="A file that holds the token and nothing else."),
]
AsJson = Annotated[bool, typer.Option("--json", help="For programs.")]
Take = Annotated[bool, typer.Option("--take", help="As an owner: also from the present driver.")]


def remote_at(url: Url = HERE, token: Token = "", token_file: TokenFile = None) -> Remote:
    try:
        return Remote(url, token or (token_file.read_text("utf-8").strip() if token_file else ""))
    except OSError as error:
        fail(f"The token file {token_file} cannot be read: {error.strerror}.", USAGE)
    except ValueError:
        fail(f"{url} is no address: it begins with http:// or https://, for example {HERE}.", USAGE)


def asking(command: Callable[..., None]) -> Callable[..., None]:
    """Its first argument is the gateway; on the command line that is the options of `remote_at`."""
    where = signature(remote_at).parameters

    @wraps(command)
    def run(**options: Any) -> None:
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
        f"No gateway at {remote.url}: {error}\nIs it running (servodeck serve)? --url names another one.",
        UNREACHABLE,
    )


def show(answer: Any, as_json: bool, words: Callable[[Any], str]) -> None:
    print(json.dumps(answer) if as_json else words(answer))
