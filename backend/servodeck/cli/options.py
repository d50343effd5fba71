"""Shared parts of the commands: options that several take, where the options of `servodeck serve` come from
(flag, then environment, then a TOML file, then default), how a command sends requests to the gateway, and
how it ends when it cannot do what was requested: a sentence on stderr and an exit code.

Knows options by their names; not what any of them means.
"""

import json
import os
import re
import sys
import time
from collections.abc import Callable, Collection, Iterable, Iterator
from functools import wraps
from inspect import Signature, signature
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, NoReturn

import typer
from typer.core import TyperGroup

from servodeck.cli import end_loading
from servodeck.cli.remote import HERE, RefusedError, Remote, UnreachableError
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
    "lost": "It is tried again by itself. servodeck status shows how it stands.",
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
Anyway = Annotated[
    bool, typer.Option("--anyway", help="Also while the battery is at its alarm and new runs are refused.")
]
Take = Annotated[bool, typer.Option("--take", help="Take the robot from its present driver (owners only).")]
MoveTime = Annotated[int, typer.Option("--time", help="Milliseconds; a servo's first move takes 1500.")]
Times = Annotated[int, typer.Option(help="0: until stopped.")]


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


def request(remote: Remote, method: str, path: str, body: object = None, **how: float) -> Any:
    """The answer; where there is none the program ends with what to do about it."""
    try:
        return remote.request(method, path, body, **how)
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


BATTERY_UNKNOWN = "the battery could not be judged before this run: the board did not tell its voltage."


def say_of_battery(begun: Any) -> None:
    """Beside the answer, where a run begins although its battery is not known."""
    if begun.get("batteryUnknown"):
        print(f"Note: {BATTERY_UNKNOWN}", file=sys.stderr)


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
        request(remote, "PUT", "/api/board", {"board": family})
    show(once_identified(remote), as_json, board_words)


def once_identified(remote: Remote) -> dict[str, Any]:
    """The state, once the gateway neither opens the port nor identifies the board."""
    until_s = time.monotonic() + IDENTIFIED_WITHIN_S
    while True:
        state: dict[str, Any] = request(remote, "GET", "/api/status")
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


PREFIX = "SERVODECK"
FILE = "config.toml"
SYSTEM_FILE = Path("/etc/servodeck") / FILE
# In no file, and not shown either: a password has a file of its own.
FILE_KEYS_LEFT_OUT = frozenset({"config", "help", "mqtt-password"})


class Setting(NamedTuple):
    """`origin`: the flag, the variable or the file that said so, or `default`."""

    name: str
    value: object
    origin: str


def config_folder() -> Path:
    """The folder of this system for a user's settings."""
    return user_folder(("APPDATA", "AppData/Roaming"), ("XDG_CONFIG_HOME", ".config"))


def take_file(context: typer.Context, path: Path | None) -> Path | None:
    """The callback of `--config`, before all other options: its values stand in for their defaults. The file
    in use; without one named, the user's own or else the system's, whole.
    """
    variables = {name for name in os.environ if name.startswith(f"{PREFIX}_")}
    if not variables <= variables_of([context.command]):
        refuse_unknown(variables, variables_of(commands_of(context).values()), "the environment")
    named = path or next((one for one in (config_folder() / FILE, SYSTEM_FILE) if one.is_file()), None)
    if named is None:
        return None
    options = {name: key for key, name in names_of(context) if name not in FILE_KEYS_LEFT_OUT}
    values = read_file(named)
    refuse_unknown(values, options, str(named))
    repeated = {option.name for option in context.command.params if getattr(option, "multiple", False)}
    context.default_map = {
        options[name]: file_value(named, name, value, is_repeated=options[name] in repeated)
        for name, value in values.items()
    }
    return named


def read_file(path: Path) -> dict[str, Any]:
    import tomllib  # most starts have no file

    try:
        return tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise typer.BadParameter(f"{path} cannot be read: {error.strerror}.") from error
    except ValueError as error:  # no TOML, or no UTF-8
        raise typer.BadParameter(f"{path} is no TOML file: {error}.") from error


def file_value(path: Path, name: str, value: object, *, is_repeated: bool) -> object:
    """As the option takes it: a list of texts where it may be repeated, else one value."""
    if is_repeated:
        texts = value if isinstance(value, list) else [value]
        if all(isinstance(text, str) for text in texts):
            return texts
        raise typer.BadParameter(f"{path}: {name} takes a text, or a list of texts.")
    if not isinstance(value, str | bool | int):
        raise typer.BadParameter(f"{path}: {name} takes one value, a text or true or false.")
    return value


def settings_of(context: typer.Context) -> Iterator[Setting]:
    """The settings of that parsed context, in the order in which the command declares them."""
    for key, name in names_of(context):
        if name not in FILE_KEYS_LEFT_OUT:
            source = context.get_parameter_source(key)
            origins = {
                "COMMANDLINE": f"--{name}",
                "ENVIRONMENT": variable_of(name),
                "DEFAULT_MAP": str(context.params["config"]),
            }
            yield Setting(name, context.params[key], origins.get(source.name if source else "", "default"))


def toml_line(setting: Setting) -> str:
    """The setting as a line of a file; a comment if it is not set."""
    name, value, origin = setting
    if value is None:
        return f"# {name}: not set"
    shown = value if isinstance(value, bool | int) else hidden(name, value)
    return f"{name} = {json.dumps(shown, ensure_ascii=False)}  # {origin}"


def hidden(name: str, value: Any) -> Any:
    """As others may see it: no passwords, and of an address its host alone, with the user at a broker."""
    if isinstance(value, list):
        return [hidden(name, each) for each in value]
    text = str(value)
    if name.endswith("password"):
        return HIDDEN if text else text
    return hidden_address(text, is_named=name in ("mqtt", "fleet"))


HIDDEN = "***"


def hidden_address(text: str, *, is_named: bool) -> str:
    """A key may stand in front of the host (`is_named`: only behind the user's name), in the path or in the
    query. All up to the last @ counts as in front: a password may have signs of the others in it.
    """
    scheme, mark, rest = text.partition("://")
    user, at, place = rest.rpartition("@")
    host = re.split("[/?#]", place, maxsplit=1)[0]
    if not mark:
        return text
    name, colon, _ = user.partition(":")
    front = f"{name}:{HIDDEN}" if is_named and colon else name if is_named else HIDDEN
    behind = f"/{HIDDEN}" if place[len(host) :].strip("/") else place[len(host) :]
    return f"{scheme}://{front + at if at else ''}{host}{behind}"


def names_of(context: typer.Context) -> Iterator[tuple[str, str]]:
    """Each option's name in Python and the one people use, without its dashes."""
    for option in context.command.params:
        yield option.name or "", option.opts[0].removeprefix("--")


def variable_of(name: str) -> str:
    return f"{PREFIX}_{name.upper().replace('-', '_')}"


def variables_of(commands: Iterable[Any]) -> set[str]:
    """The variable of one is no mistake under another."""
    options = [option for command in commands for option in command.params]
    return {variable_of(option.opts[0].removeprefix("--")) for option in options if option.opts}


def commands_of(context: typer.Context) -> dict[str, Any]:
    """All there are: the program may have been loaded without the others, and then brings what loads them."""
    root = context.find_root()
    program = root.obj() if root.obj else root.command
    return dict(program.commands) if isinstance(program, TyperGroup) else {}


def refuse_unknown(given: Iterable[str], known: Collection[str], where: str) -> None:
    import difflib  # most starts have no mistake

    for name in sorted(set(given) - set(known)):
        close = difflib.get_close_matches(name, known, n=1)
        hint = f"Did you mean {close[0]}?" if close else f"There are: {', '.join(sorted(known))}."
        raise typer.BadParameter(f"{name} is no option. {hint}", param_hint=where)


def data_folder() -> Path:
    return user_folder(("LOCALAPPDATA", "AppData/Local"), ("XDG_DATA_HOME", ".local/share"))


def user_folder(on_windows: tuple[str, str], elsewhere: tuple[str, str]) -> Path:
    """Ours in the folder that a variable names, or else in that one of the home folder."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Servodeck"
    variable, usual = on_windows if sys.platform == "win32" else elsewhere
    name = "Servodeck" if sys.platform == "win32" else "servodeck"
    return Path(os.environ.get(variable) or Path.home() / usual) / name


Level = Literal["debug", "info", "warning", "error"]
Form = Literal["text", "json"]
