"""Where the options of `servodeck serve` come from: flag, then environment, then a TOML file, then default.

Knows options by their names, as the command line declares them; not what any of them means.
"""

import json
import os
import sys
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path
from typing import Any, Literal, NamedTuple

import typer
from typer.core import TyperGroup

PREFIX = "SERVODECK"
FILE = "config.toml"
SYSTEM_FILE = Path("/etc/servodeck") / FILE
FILE_KEYS_LEFT_OUT = frozenset({"config", "help"})


class Setting(NamedTuple):
    """`origin`: the flag, the variable or the file that said so, or `default`."""

    name: str
    value: object
    origin: str


def config_folder() -> Path:
    """Where this system wants a program to keep a user's settings."""
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA") or home / "AppData" / "Roaming") / "Servodeck"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "Servodeck"
    return Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "servodeck"


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
    context.default_map = {options[name]: value for name, value in values.items()}
    return named


def read_file(path: Path) -> dict[str, Any]:
    import tomllib  # most starts have no file

    try:
        values = tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise typer.BadParameter(f"{path} cannot be read: {error.strerror}.") from error
    except ValueError as error:  # no TOML, or no UTF-8
        raise typer.BadParameter(f"{path} is no TOML file: {error}.") from error
    for name, value in values.items():
        if not isinstance(value, str | bool | int):
            raise typer.BadParameter(f"{path}: {name} takes one value, a text or true or false.")
    return values


def settings_of(context: typer.Context) -> Iterator[Setting]:
    """What holds in that parsed context, in the order in which the command declares it."""
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
    """That setting as a line of a file; what is not set is a comment."""
    name, value, origin = setting
    if value is None:
        return f"# {name}: not set"
    text = json.dumps(value if isinstance(value, bool | int) else str(value), ensure_ascii=False)
    return f"{name} = {text}  # {origin}"


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
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local") / "Servodeck"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "Servodeck"
    return Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share") / "servodeck"


Level = Literal["debug", "info", "warning", "error"]
Form = Literal["text", "json"]
