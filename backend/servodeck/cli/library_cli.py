"""The commands about what is kept: the poses of the robot on the board, the groups and robots of the library.

Parses and prints; which pose a name means, and who may go there, the gateway decides.
"""

from typing import Annotated, Any
from urllib.parse import quote

import typer

from servodeck.cli.board_cli import when_asked
from servodeck.cli.options_cli import AsJson, Take, asked, asking, show
from servodeck.cli.remote import Remote
from servodeck.cli.remote_cli import MOVE_WAIT_S, begun_words


@asking
def poses(remote: Remote, as_json: AsJson = False) -> None:
    """List the poses of the robot on the board, by number and name."""
    show(asked(remote, "GET", "/api/poses"), as_json, poses_words)


def poses_words(book: dict[str, Any]) -> str:
    if not book["poses"]:
        return f"{book['robot'] or 'The robot on the board'} has no poses yet: capture one on a page."
    return "\n".join(f"{one['id']:>3}  {one['name']}" for one in book["poses"])


@asking
def pose(
    remote: Remote,
    wanted: Annotated[str, typer.Argument(metavar="POSE", help="Its name or its number; 0 is home.")],
    time_ms: Annotated[
        int, typer.Option("--time", help="Milliseconds; a servo's first move takes 1500.")
    ] = 1500,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Go to a pose of the robot on the board."""
    when_asked(remote)
    path = f"/api/poses/{quote(wanted, safe='')}/apply"
    begun = asked(remote, "POST", path, {"timeMs": time_ms, "take": take}, wait_s=MOVE_WAIT_S)
    show(begun, as_json, begun_words)


@asking
def library(remote: Remote, as_json: AsJson = False) -> None:
    """List the groups and robots of the library."""
    show(asked(remote, "GET", "/api/library"), as_json, library_words)


def library_words(listing: dict[str, Any]) -> str:
    kept = [one for one in listing["documents"] if not one["isRemoved"]]
    return "\n".join(map(document_words, kept)) or "The library is empty."


def document_words(document: dict[str, Any]) -> str:
    facts = document["facts"]
    about = f"{facts['frames']} frames, {facts['durationMs'] / 1000:.1f} s" if "frames" in facts else "robot"
    return f"{document['id']}  {facts['name']}  ({about})"
