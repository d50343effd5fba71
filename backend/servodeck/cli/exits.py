"""How a command ends that cannot do what it was asked: what it says on stderr, and its exit codes."""

import sys
from typing import NoReturn

import typer

FAILURE, USAGE, UNREACHABLE, TIMED_OUT, INTERRUPTED = 1, 2, 3, 4, 130


def fail(message: str, code: int = FAILURE) -> NoReturn:
    print(message, file=sys.stderr)
    raise typer.Exit(code)
