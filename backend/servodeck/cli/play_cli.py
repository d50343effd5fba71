"""The command that has the gateway play a group: reads its file, asks, watches over it, tells how it ended.

Parses and prints; what a board can take the gateway decides.
"""

import time
from pathlib import Path
from typing import Annotated, Any

import typer

from servodeck.cli.download_cli import counted, group_in
from servodeck.cli.exits import FAILURE, INTERRUPTED, fail
from servodeck.cli.options_cli import AsJson, Take, asked, asking, show
from servodeck.cli.remote import Remote
from servodeck.cli.remote_cli import BEAT_S, LONGEST_ALONE_S

LOOK_S = 0.2


@asking
def play(
    remote: Remote,
    file: Annotated[Path, typer.Argument(help="Of one group, as `servodeck download` takes it.")],
    times: Annotated[int, typer.Option(help="0: until stopped.")] = 1,
    go_on: Annotated[
        int | None,
        typer.Option("--continue", metavar="SECONDS", help="Return at once; it goes on for so long at most."),
    ] = None,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Have the gateway play a group, frame by frame, and watch over it: Ctrl-C ends it."""
    body: dict[str, Any] = {"frames": group_in(file)["frames"], "times": times, "take": take}
    if go_on is not None:
        body["continueForMs"] = min(go_on, LONGEST_ALONE_S) * 1000
    state = asked(remote, "POST", "/api/play", body)
    if go_on is None:
        state = watched(remote, state)
    show(state, as_json, words_of)
    if state["status"] == "ended":
        raise typer.Exit(FAILURE)


def watched(remote: Remote, state: dict[str, Any]) -> dict[str, Any]:
    """Until it has ended."""
    beaten_s = time.monotonic()
    try:
        while state["status"] == "playing":
            time.sleep(LOOK_S)
            latest = asked(remote, "GET", "/api/status")["play"]
            if latest["id"] != state["id"]:  # it ended, and somebody plays something else
                return state | {"status": "ended", "code": "cancelled", "detail": "Another one is played."}
            state = latest
            if state["status"] == "playing" and time.monotonic() - beaten_s >= BEAT_S:
                asked(remote, "POST", "/api/lease", {"action": "beat"})
                beaten_s = time.monotonic()
    except KeyboardInterrupt:
        asked(remote, "DELETE", "/api/play")
        fail("Ended with its frame in progress.", INTERRUPTED)
    return state


def words_of(state: dict[str, Any]) -> str:
    count = counted(state["frameCount"], "frame")
    if state["status"] == "playing":
        return f"Begun: {count}, {state['times'] or 'endless'} times."
    left_out = f" {counted(state['skippedFrames'], 'frame')} left out." if state["skippedFrames"] else ""
    if state["status"] == "done":
        return f"Played: {count}.{left_out}"
    return f"Ended at frame {state['frameIndex'] + 1} of {state['frameCount']}.{left_out} {state['detail']}"
