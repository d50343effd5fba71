"""The program itself, with `serve`, which does not wait for the other commands to be loaded (main.py)."""

from collections.abc import Callable
from typing import Annotated

import typer
from typer.main import get_command

from servodeck import __version__
from servodeck.cli.config import PREFIX
from servodeck.cli.serve import serve


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
    """`whole` loads the program with all its commands, for whoever has to name one."""
    new_program()(obj=lambda: get_command(whole()))
