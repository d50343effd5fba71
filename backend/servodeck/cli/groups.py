"""Commands about whole groups: download them to the board's slots, or have the gateway play one."""

import json
import time
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from servodeck.cli.commands import BEAT_S, LONGEST_ALONE_S
from servodeck.cli.options import (
    FAILURE,
    INTERRUPTED,
    USAGE,
    Anyway,
    AsJson,
    Take,
    Times,
    asking,
    fail,
    once_identified,
    request,
    say_of_battery,
    show,
)
from servodeck.cli.remote import LONG_WAIT_S, Remote
from servodeck.protocol.timings import DOWNLOAD

LOOK_S = 0.2
FIELDS = ("slot", "name", "version", "replaces", "document", "frames")
SHAPE = '{"name": "Wave", "frames": [{"durationMs": 400, "positions": {"1": 1200}}]}'


@asking
def download(
    remote: Remote,
    groups: Annotated[
        list[str], typer.Argument(metavar="SLOT=FILE...", help="For example 5=wave.json 6=bow.json")
    ],
    wait: Annotated[
        bool,
        typer.Option(
            "--wait/--no-wait",
            help="Wait until all groups are stored, or return when the download has begun.",
        ),
    ] = True,
    take: Take = False,
    as_json: AsJson = False,
) -> None:
    """Store groups on the board, one after the other. Ctrl-C cancels the download."""
    job = delivered(remote, [group_of(text) for text in groups], take=take)
    if wait:
        job = followed(remote, job, shows_progress=not as_json)
    show(job, as_json, download_words)
    if job["status"] not in ("done", "running"):
        raise typer.Exit(FAILURE)


def delivered(remote: Remote, groups: list[dict[str, Any]], *, take: bool) -> dict[str, Any]:
    """As one job, in as many requests as the gateway needs to read them."""
    first, *rest = portions_of(groups)
    once_identified(remote)
    body: dict[str, Any] = {"groups": first, "take": take}
    job: dict[str, Any] = request(remote, "POST", "/api/download", body, wait_s=LONG_WAIT_S)
    for portion in rest:
        body = {"groups": portion, "take": take, "behind": job["id"]}
        job = request(remote, "POST", "/api/download", body)
    return job


def portions_of(groups: list[dict[str, Any]]) -> list[list[dict[str, Any]]]:
    portions: list[list[dict[str, Any]]] = []
    room_bytes = 0
    for group in groups:
        size_bytes = len(json.dumps(group)) + 2  # a comma and a blank
        if size_bytes > room_bytes:
            portions.append([])
            room_bytes = DOWNLOAD.portion_bytes
        portions[-1].append(group)
        room_bytes -= size_bytes
    return portions


def followed(remote: Remote, job: dict[str, Any], *, shows_progress: bool) -> dict[str, Any]:
    """Until it has ended."""
    stored = 0
    try:
        while job["status"] == "running":
            time.sleep(LOOK_S)
            job = request(remote, "GET", f"/api/jobs/{job['id']}")
            for slot in job["slots"][stored : job["groupsStored"]] if shows_progress else ():
                print(f"Slot {slot} is stored.", flush=True)
            stored = job["groupsStored"]
    except KeyboardInterrupt:
        request(remote, "DELETE", f"/api/jobs/{job['id']}")
        fail("Cancelled after the frame in progress.", INTERRUPTED)
    return job


def download_words(job: dict[str, Any]) -> str:
    stored, count = job["groupsStored"], len(job["slots"])
    if job["status"] == "running":
        return f"Begun: job {job['id']}, {counted(count, 'group')}, {counted(job['frameCount'], 'frame')}."
    end = f"{stored} of {counted(count, 'group')} {'is' if count == 1 else 'are'} stored."
    return end if job["status"] == "done" else f"{end} {job['detail']} ({job['code']})"


def counted(count: int, thing: str) -> str:
    return f"{count} {thing}{'' if count == 1 else 's'}"


def group_of(text: str) -> dict[str, Any]:
    """The group of one argument; ends the program with an explanation of an invalid one."""
    slot, separator, name = text.partition("=")
    if not separator or not slot.isascii() or not slot.isdigit():
        fail("A group is SLOT=FILE, for example 5=wave.json.", USAGE)
    file = Path(name)
    return {"name": file.stem} | group_in(file) | {"slot": int(slot)}


def group_in(file: Path) -> dict[str, Any]:
    """As a board stores it; ends the program with an explanation for anything else."""
    try:
        group = json.loads(file.read_text("utf-8"), object_pairs_hook=partial(object_in, file))
    except OSError as error:
        fail(f"{file} cannot be read: {error.strerror}.", USAGE)
    except ValueError:
        fail(f"{file} is not JSON. Expected one group: {SHAPE}", USAGE)
    if not isinstance(group, dict) or "frames" not in group or "format" in group:
        fail(f"{file} holds no valid frames. Expected: {SHAPE}", USAGE)
    for name in group:
        if name not in FIELDS:
            fail(f"{file} has {name}, which a group has not: {', '.join(FIELDS)}.", USAGE)
    return group


def object_in(file: Path, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Ends the program where one name is given twice, for example a servo."""
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            fail(f"{file} has {name} twice in one place.", USAGE)
    return dict(pairs)


@asking
def play(
    remote: Remote,
    file: Annotated[Path, typer.Argument(help="A file with one group, as for `servodeck download`.")],
    times: Times = 1,
    continue_for_s: Annotated[
        int | None,
        typer.Option(
            "--continue", metavar="SECONDS", help="Return at once and let it continue for at most this long."
        ),
    ] = None,
    take: Take = False,
    anyway: Anyway = False,
    as_json: AsJson = False,
) -> None:
    """Have the gateway play a group, frame by frame, and wait for its end; Ctrl-C stops it."""
    body: dict[str, Any] = {"frames": group_in(file)["frames"], "times": times, "take": take}
    body["anyway"] = anyway
    if continue_for_s is not None:
        body["continueForMs"] = min(continue_for_s, LONGEST_ALONE_S) * 1000
    state = request(remote, "POST", "/api/play", body)
    say_of_battery(state)
    if continue_for_s is None:
        state = watched(remote, state)
    show(state, as_json, play_words)
    if state["status"] == "ended":
        raise typer.Exit(FAILURE)


def watched(remote: Remote, state: dict[str, Any]) -> dict[str, Any]:
    """Until it has ended."""
    beaten_s = time.monotonic()
    try:
        while state["status"] == "playing":
            time.sleep(LOOK_S)
            latest = request(remote, "GET", "/api/status")["play"]
            if latest["id"] != state["id"]:  # it ended, and another play has begun
                return state | {"status": "ended", "code": "cancelled", "detail": "Another one is played."}
            state = latest
            if state["status"] == "playing" and time.monotonic() - beaten_s >= BEAT_S:
                request(remote, "POST", "/api/lease", {"action": "heartbeat"})
                beaten_s = time.monotonic()
    except KeyboardInterrupt:
        request(remote, "DELETE", "/api/play")
        fail("Stopped after the frame in progress.", INTERRUPTED)
    return state


def play_words(state: dict[str, Any]) -> str:
    count = counted(state["frameCount"], "frame")
    if state["status"] == "playing":
        return f"Begun: {count}, {state['times'] or 'endless'} times."
    left_out = f" {counted(state['skippedFrames'], 'frame')} left out." if state["skippedFrames"] else ""
    if state["status"] == "done":
        return f"Played: {count}.{left_out}"
    return f"Ended at frame {state['frameIndex'] + 1} of {state['frameCount']}.{left_out} {state['detail']}"
