"""The program itself, with `serve`, which does not wait for the other commands to be loaded (main.py)."""

from typing import Annotated, Any

import typer

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


def serve_alone() -> None:
    new_program()(obj=whole_program)


def whole_program() -> Any:
    from servodeck.cli.main import app

    return typer.main.get_command(app)
