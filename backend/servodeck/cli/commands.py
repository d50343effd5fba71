"""The commands that ask a running gateway: status, STOP and resume, moves, runs, erase, battery, events,
poses and the library.

They parse and print; the gateway decides what is allowed and which pose a name means.
"""

import sys
import time
from collections.abc import Callable
from typing import Annotated, Any
from urllib.parse import quote

import typer

from servodeck.cli.options import (
    INTERRUPTED,
    TIMED_OUT,
    USAGE,
    Anyway,
    AsJson,
    MoveTime,
    Take,
    Times,
    asking,
    board,
    board_words,
    explain,
    explain_silence,
    fail,
    once_identified,
    request,
    say_of_battery,
    show,
)
from servodeck.cli.remote import LONG_WAIT_S, RefusedError, Remote, UnreachableError, stopped_words

BEAT_S = 1.0
# The longest time that the gateway allows without a driver.
LONGEST_ALONE_S = 3600
# How long the end of a group is waited for where it was not reported: until its computed end and a little
# more, or where only the board could report it.
AFTER_END_S = 2.0
UNKNOWN_END_S = 30.0


@asking
def status(remote: Remote, as_json: AsJson = False) -> None:
    """Show the port, the board, the driver and what is running."""
    show(request(remote, "GET", "/api/status"), as_json, status_words)


def status_words(state: dict[str, Any]) -> str:
    port, run, alone = state["port"], state["running"], state["unattended"]
    lines = [
        f"port     {port['status']} {port['device'] or ''} {port['detail'] or ''}".rstrip(),
        board_words(state),
        f"motion   {'stopped, waits for resume' if state['latch'] else 'allowed'}",
        f"driver   {state['driver'] or 'none'}",
    ]
    if state["fleet"]:
        lines.append(broker_words(state["fleet"]))
    if run:
        lines.append(f"running  slot {run['slot']}, {run['times'] or 'endless'} times, as far as is known")
    if alone:
        lines.append(f"         without {alone['by']} for at most {alone['endsInMs'] / 1000:.0f} s")
    return "\n".join(lines)


def broker_words(there: dict[str, Any]) -> str:
    how = there["problem"] or ("another gateway has this name" if there["isCloned"] else "connected")
    return f"broker   {there['broker']}, {there['name']} at {there['site']}: {how}"


@asking
def stop(remote: Remote, as_json: AsJson = False) -> None:
    """Stop the robot and refuse motion until `servodeck resume`. Prints which servos cannot be held, and for
    how long they may still move.
    """
    answer = request(remote, "POST", "/api/stop")
    show(answer, as_json, stopped_words)


@asking
def resume(remote: Remote, as_json: AsJson = False) -> None:
    """Allow motion again. Moves nothing."""
    answer = request(remote, "POST", "/api/resume")
    show(answer, as_json, lambda _: "Motion is allowed.")


@asking
def move(
    remote: Remote,
    targets: Annotated[
        list[str], typer.Argument(metavar="SERVO=POSITION...", help="For example 1=1500 2=900")
    ],
    time_ms: MoveTime = 1500,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Move servos together, in the board's unit."""
    body = {"timeMs": time_ms, "positions": positions_in(targets), "take": take}
    once_identified(remote)
    answer = request(remote, "POST", "/api/move", body, wait_s=LONG_WAIT_S)
    show(answer, as_json, begun_words)


def begun_words(begun: dict[str, Any]) -> str:
    return f"Moving; ends in {begun['overInMs'] / 1000:.1f} s."


def positions_in(targets: list[str]) -> dict[str, int]:
    try:
        pairs = [(int(servo), int(position)) for servo, position in (each.split("=") for each in targets)]
    except ValueError:
        fail("A target is SERVO=POSITION, for example 1=1500.", USAGE)
    servos = [servo for servo, _ in pairs]
    for servo in servos:
        if servos.count(servo) > 1:
            fail(f"Servo {servo} is named twice.", USAGE)
    return {str(servo): position for servo, position in pairs}


@asking
def run(
    remote: Remote,
    slot: Annotated[int, typer.Argument(help="Slot of the board, from 0.")],
    times: Times = 1,
    continue_for_s: Annotated[
        int | None,
        typer.Option(
            "--continue",
            metavar="SECONDS",
            help="Return at once and let it continue for at most this long. "
            f"Default with --times 0: {LONGEST_ALONE_S}.",
        ),
    ] = None,
    timeout_s: Annotated[
        float | None,
        typer.Option(
            "--timeout",
            metavar="SECONDS",
            min=0,
            help="Stop it after this time. Default: the length of the group, or "
            f"{UNKNOWN_END_S:.0f} if that is unknown.",
        ),
    ] = None,
    take: Take = False,
    anyway: Anyway = False,
    as_json: AsJson = False,
) -> None:
    """Run a group of the board and wait for its end; Ctrl-C stops it. An endless run returns at once."""
    if continue_for_s is not None and timeout_s is not None:
        fail("--timeout has no effect with --continue, which returns at once: leave out one of them.", USAGE)
    if times == 0 and timeout_s is None and continue_for_s is None:
        continue_for_s = LONGEST_ALONE_S
    once_identified(remote)
    body = {
        "times": times,
        "take": take,
        "anyway": anyway,
        "continueForMs": None if continue_for_s is None else continue_for_s * 1000,
    }
    answer = request(remote, "POST", f"/api/slots/{slot}/run", body)
    show(answer, as_json, lambda begun: f"Slot {slot}: {begun['outcome']}.")
    say_of_battery(answer)
    if continue_for_s is not None:
        if times == 0:
            print(endless(slot, continue_for_s), file=sys.stderr)
        return
    limit_s = watch(remote, timeout_s)
    if limit_s is not None and times == 0:
        print(f"Ended after {limit_s:g} s.")
    elif limit_s is not None:
        fail(unheard_end(slot, limit_s), TIMED_OUT)


def endless(slot: int, alone_s: int) -> str:
    return (
        f"Slot {slot} repeats until it is stopped: by `servodeck stop`, by a page, by the next driver, or "
        f"after {alone_s} s, by the gateway. --continue SECONDS sets that; --timeout SECONDS waits instead."
    )


def watch(remote: Remote, limit_s: float | None) -> float | None:
    """Sends heartbeats until the group is over. The seconds after which it was ended; None where it ended
    before.
    """
    begun_s = time.monotonic()
    try:
        while running := request(remote, "GET", "/api/status")["running"]:
            limit_s = usual_limit_s(running["endsInMs"]) if limit_s is None else limit_s
            left_s = limit_s - (time.monotonic() - begun_s)
            if left_s <= 0:
                let_go(remote)
                return limit_s
            request(remote, "POST", "/api/lease", {"action": "heartbeat"})
            time.sleep(min(BEAT_S, left_s))
    except KeyboardInterrupt:
        let_go(remote)
        fail("Ended.", INTERRUPTED)
    return None


def usual_limit_s(ends_in_ms: int | None) -> float:
    return UNKNOWN_END_S if ends_in_ms is None else ends_in_ms / 1000 + AFTER_END_S


def let_go(remote: Remote) -> None:
    """Releases the lease, which ends the run and needs no resume."""
    request(remote, "POST", "/api/lease", {"action": "release"})


def unheard_end(slot: int, limit_s: float) -> str:
    return (
        f"The board did not report within {limit_s:g} s that slot {slot} has ended, so it was stopped. "
        "Did nothing move? Then the slot is empty. Does it take longer? Then set --timeout SECONDS."
    )


@asking
def erase(
    remote: Remote,
    sure: Annotated[bool, typer.Option("--yes", help="Do not ask for confirmation.")] = False,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Erase every slot of the board for good. Owners only."""
    if not sure:
        typer.confirm("Every group on the board goes for good. Erase them?", abort=True)
    once_identified(remote)
    erased = request(remote, "POST", "/api/erase", {"take": take}, wait_s=LONG_WAIT_S)
    show(erased, as_json, lambda _: "Every slot is empty.")


@asking
def battery(remote: Remote, as_json: AsJson = False) -> None:
    """Read the battery voltage."""
    answer = request(remote, "GET", "/api/battery")
    show(answer, as_json, lambda read: f"{read['batteryMv'] / 1000:.2f} V")


@asking
def events(remote: Remote) -> None:
    """Print events, one JSON object per line, until Ctrl-C."""
    try:
        for line in remote.events():
            print(line, flush=True)
    except RefusedError as error:
        explain(error)
    except UnreachableError as error:
        explain_silence(remote, error)
    except KeyboardInterrupt:
        raise typer.Exit(INTERRUPTED) from None


@asking
def audit(
    remote: Remote,
    limit: Annotated[int, typer.Option(min=1, max=200, help="So many entries, the newest first.")] = 50,
    as_csv: Annotated[bool, typer.Option("--csv", help="Print the whole list as CSV.")] = False,
    as_json: AsJson = False,
) -> None:
    """Show who did what at this gateway, and when. Owners only."""
    if not as_csv:
        show(request(remote, "GET", f"/api/audit?limit={limit}"), as_json, audit_words)
        return
    try:
        print(remote.text("/api/audit/file?format=csv"), end="")
    except RefusedError as error:
        explain(error)
    except UnreachableError as error:
        explain_silence(remote, error)


def audit_words(page: dict[str, Any]) -> str:
    lines = [entry_words(entry) for entry in page["entries"]] or ["Nothing has happened yet."]
    return "\n".join([*lines, *([f"Not stored: {page['problem']}"] if page["problem"] else [])])


def entry_words(entry: dict[str, Any]) -> str:
    at = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(entry["atMs"] / 1000))
    times = f"{entry['count']} times" if entry["count"] > 1 else ""
    words = (at, entry["act"], entry["who"] or "-", entry["whom"], entry["about"], times)
    return "  ".join(word for word in words if word)


COMMANDS: tuple[Callable[..., None], ...] = (
    status,
    board,
    stop,
    resume,
    move,
    run,
    erase,
    battery,
    events,
    audit,
)


@asking
def poses(remote: Remote, as_json: AsJson = False) -> None:
    """List the poses of the robot on the board, by number and name."""
    show(request(remote, "GET", "/api/poses"), as_json, poses_words)


def poses_words(book: dict[str, Any]) -> str:
    if not book["poses"]:
        return f"{book['robot'] or 'The robot on the board'} has no poses yet: capture one on a page."
    return "\n".join(f"{one['id']:>3}  {one['name']}" for one in book["poses"])


@asking
def pose(
    remote: Remote,
    wanted: Annotated[str, typer.Argument(metavar="POSE", help="Its name or its number; 0 is home.")],
    time_ms: MoveTime = 1500,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Go to a pose of the robot on the board."""
    once_identified(remote)
    path = f"/api/poses/{quote(wanted, safe='')}/apply"
    begun = request(remote, "POST", path, {"timeMs": time_ms, "take": take}, wait_s=LONG_WAIT_S)
    show(begun, as_json, begun_words)


@asking
def library(remote: Remote, as_json: AsJson = False) -> None:
    """List the groups and robots of the library."""
    show(request(remote, "GET", "/api/library"), as_json, library_words)


def library_words(listing: dict[str, Any]) -> str:
    present = [one for one in listing["documents"] if not one["isRemoved"]]
    return "\n".join(map(document_words, present)) or "The library is empty."


def document_words(document: dict[str, Any]) -> str:
    facts = document["facts"]
    about = f"{facts['frames']} frames, {facts['durationMs'] / 1000:.1f} s" if "frames" in facts else "robot"
    return f"{document['id']}  {facts['name']}  ({about})"
