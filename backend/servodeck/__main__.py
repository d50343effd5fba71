"""The entry of the program. A bare `servodeck stop` is sent before the rest of the command line is loaded,
which takes longer than all else of it.
"""

import os
import sys

TYPE_CHECKING = False  # typing takes longer to load
if TYPE_CHECKING:
    from typer import Typer


def main() -> None:
    if sys.argv[1:] == ["stop"] and is_stopped():
        return
    from servodeck.cli import begin_loading

    begin_loading()
    if sys.argv[1:2] == ["serve"]:
        from servodeck.cli.serve import serve_alone

        serve_alone(all_commands)
    else:
        all_commands()()


def all_commands() -> "Typer":
    from servodeck.cli.main import app

    return app


def is_stopped() -> bool:
    """After any error the command line sends the stop again, which does no harm, and explains the error."""
    from servodeck.cli.remote import HERE, Remote, stopped_words

    try:
        token = os.environ.get("SERVODECK_TOKEN") or token_in(os.environ.get("SERVODECK_TOKEN_FILE"))
        stopped = Remote(os.environ.get("SERVODECK_URL") or HERE, token).request("POST", "/api/stop")
        words = stopped_words(stopped)
    except Exception:  # noqa: BLE001 (nothing may keep the second try from being made)
        return False
    sys.stdout.write(f"{words}\n")
    return True


def token_in(file: str | None) -> str:
    if not file:
        return ""
    with open(file, encoding="utf-8") as opened:  # noqa: PTH123 (pathlib takes longer to load)
        return opened.read().strip()


if __name__ == "__main__":
    main()
