"""The command about which board it is: what it answered, and a person's word on its family.

Parses and prints; what may be driven the gateway decides.
"""

import time
from typing import Annotated, Any

import typer

from servodeck.cli.options_cli import AsJson, asked, asking, show
from servodeck.cli.remote import Remote
from servodeck.protocol.families import FAMILIES, UNKNOWN

# As long as a board may take that has just started.
ASKED_WITHIN_S = 10.0
LOOK_S = 0.1
QUESTIONS = {"readBattery": "battery", "readVersion": "version", "readPositions": "position of servo 1"}


@asking
def board(
    remote: Remote,
    family: Annotated[
        str | None,
        typer.Argument(metavar="FAMILY", help=f"{', '.join(FAMILIES)}; unknown: ask it again."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show what the board answered when it was asked who it is, or say of which family it is."""
    if family is not None:
        asked(remote, "PUT", "/api/board", {"board": family})
    show(when_asked(remote), as_json, board_words)


def when_asked(remote: Remote) -> dict[str, Any]:
    """How everything stands once the gateway does not ask the board who it is."""
    until_s = time.monotonic() + ASKED_WITHIN_S
    while True:
        state: dict[str, Any] = asked(remote, "GET", "/api/status")
        if state["link"]["status"] != "identifying" or time.monotonic() > until_s:
            return state
        time.sleep(LOOK_S)


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
            return f"It told its {QUESTIONS[evidence['question']]}."
        case "silent":
            return f"It did not tell its {QUESTIONS[evidence['question']]}."
        case "echoed":
            return "The question itself came back."
        case _:
            return f"{evidence['byteCount']} bytes came that are no packets."
