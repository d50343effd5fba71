"""The commands that ask a running gateway, as a person and as a shell script use them."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest

from servodeck.cli.commands import usual_limit_s
from servodeck.cli.options import FAILURE, INTERRUPTED, TIMED_OUT, UNREACHABLE, USAGE
from servodeck.cli.remote import held_words
from tests.samples import BATTERY, RUN, STOP
from tests.test_cli import Served, run

pytestmark = pytest.mark.slow

SILENT = ("--log-level", "error")
RUN_9 = bytes.fromhex("55550506090100")
ENDLESS = bytes.fromhex("55550506080000")
MOVE_OF_TWO = bytes.fromhex("55550803 01dc05 01d007") + bytes.fromhex("55550803 01dc05 028403")


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served("--board", "doc", "--data", str(tmp_path), *SILENT)
    yield made
    made.end()


@pytest.mark.exhaustive
def test_status_is_printed_for_people_and_for_programs(served: Served) -> None:
    result = run("status", "--url", served.url)
    assert result.exit_code == 0
    assert f"port     open {served.pty.device}" in result.stdout
    assert "driver   none" in result.stdout
    assert json.loads(run("status", "--url", served.url, "--json").stdout)["board"] == "doc"


def test_a_stop_leaves_and_refuses_motion_until_resume(served: Served) -> None:
    assert run("stop", "--url", served.url).exit_code == 0
    assert served.read_until_stops(3).startswith(STOP * 3)
    refused = run("move", "1=1500", "--url", served.url)
    assert refused.exit_code == FAILURE
    assert "(latched)" in refused.stderr
    assert "servodeck resume" in refused.stderr
    assert run("resume", "--url", served.url).exit_code == 0
    assert run("move", "1=2000", "2=900", "--url", served.url).stdout == "Moving; ends in 1.5 s.\n"
    assert served.read_behind_stops(len(MOVE_OF_TWO)) == MOVE_OF_TWO


def test_what_happened_is_printed_for_people_and_for_spreadsheets(served: Served) -> None:
    assert run("stop", "--url", served.url).exit_code == 0
    latest, *others = run("audit", "--url", served.url).stdout.splitlines()
    assert latest.endswith("stopped  A script on this computer")
    assert "gatewayStarted" in others[-1]
    assert json.loads(run("audit", "--url", served.url, "--json").stdout)["problem"] is None
    head, row, *_ = run("audit", "--csv", "--url", served.url).stdout.splitlines()
    assert head == "at,until,act,who,whom,about,count"
    assert row.split(",")[2:] == ["stopped", "A script on this computer", "", "", "1"]


@pytest.mark.exhaustive
def test_a_bare_stop_does_not_wait_for_the_rest_of_the_command_line(served: Served) -> None:
    program = (
        "import sys; sys.argv = ['servodeck', 'stop']; from servodeck.__main__ import main; main(); "
        "print('typer' in sys.modules)"
    )
    said = subprocess.check_output(
        [sys.executable, "-c", program], text=True, env=variables(SERVODECK_URL=served.url)
    )
    assert said.startswith("Stopped, but a frame in progress cannot be held: servos may move for up to ")
    assert said.endswith(" servodeck resume allows motion again.\nFalse\n")
    assert served.read_until_stops(3) == STOP * 3


@pytest.mark.parametrize(
    ("unheld", "words"),
    [
        (None, "Stopped."),
        (
            {"servos": None, "forMs": 3759},
            "Stopped, but a frame in progress cannot be held: servos may move for up to 3.8 s.",
        ),
        (
            {"servos": [3], "forMs": 1200},
            "Stopped, but servo 3 cannot be held: it may move for up to 1.2 s.",
        ),
        (
            {"servos": [1, 3], "forMs": 900},
            "Stopped, but servos 1, 3 cannot be held: they may move for up to 0.9 s.",
        ),
        (
            {"servos": None, "forMs": None},
            "Stopped, but the board may not have heard it. Switch the robot off if it moves.",
        ),
    ],
)
def test_a_stop_says_what_it_cannot_hold_and_how_long_that_may_move(
    unheld: dict[str, Any] | None, words: str
) -> None:
    assert held_words(unheld) == words


def test_a_bare_stop_that_fails_is_explained() -> None:
    command = [sys.executable, "-m", "servodeck", "stop"]
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        env=variables(SERVODECK_URL="http://127.0.0.1:9"),
        check=False,
    )
    assert (done.returncode, "servodeck serve" in done.stderr) == (UNREACHABLE, True)


@pytest.mark.exhaustive
def test_an_out_of_range_value_is_refused_in_the_gateways_words(served: Served) -> None:
    refused = run("move", "1=2600", "--url", served.url)
    assert (refused.exit_code, refused.stdout) == (FAILURE, "")
    assert refused.stderr.startswith("position of servo 1 is 2600, allowed 500..2500")


@pytest.mark.exhaustive
def test_on_an_unnamed_board_motion_says_how_to_name_it(tmp_path: Path) -> None:
    """Nothing answers on this port, so that the gateway cannot know either."""
    unnamed = Served("--data", str(tmp_path), *SILENT, identifies_board=True)
    try:
        refused = run("move", "1=1500", "--url", unnamed.url)
        assert (refused.exit_code, refused.stdout) == (FAILURE, "")
        assert "Name it: servodeck board FAMILY" in refused.stderr
    finally:
        unnamed.end()


@pytest.mark.exhaustive
def test_a_silent_board_is_reported_with_a_remedy(served: Served) -> None:
    silent = run("battery", "--url", served.url)
    assert silent.exit_code == FAILURE
    assert "switched on" in silent.stderr
    assert os.read(served.pty.board, 100) == BATTERY


@pytest.mark.exhaustive
def test_a_run_is_watched_over_until_ctrl_c_ends_it(served: Served) -> None:
    with begin(served, "run", "8") as watching:
        assert watching.stdout
        assert watching.stdout.readline() == "Slot 8: silent.\n"
        with pytest.raises(subprocess.TimeoutExpired):
            watching.wait(2.5)  # longer than the gateway waits for a heartbeat
        watching.send_signal(signal.SIGINT)
        assert watching.wait(5) == INTERRUPTED
        assert served.read_until_stops(3) == RUN + STOP * 3
        assert "waits for resume" not in run("status", "--url", served.url).stdout


@pytest.mark.exhaustive
def test_a_run_without_a_reported_end_is_ended_in_time_with_a_code_of_its_own(served: Served) -> None:
    ended = run("run", "9", "--timeout", "1.2", "--url", served.url)
    assert (ended.exit_code, "within 1.2 s" in ended.stderr, "empty" in ended.stderr) == (
        TIMED_OUT,
        True,
        True,
    )
    assert served.read_until_stops(3) == RUN_9 + STOP * 3
    assert "waits for resume" not in run("status", "--url", served.url).stdout


def test_an_end_is_waited_for_as_long_as_the_group_takes_or_half_a_minute() -> None:
    assert usual_limit_s(4200) == 6.2
    assert usual_limit_s(None) == 30


@pytest.mark.exhaustive
def test_an_endless_run_says_who_ends_it_and_returns(served: Served) -> None:
    begun = run("run", "8", "--times", "0", "--url", served.url)
    assert (begun.exit_code, begun.stdout) == (0, "Slot 8: silent.\n")
    assert begun.stderr.startswith("Slot 8 repeats until it is stopped: by `servodeck stop`")
    assert "after 3600 s, by the gateway" in begun.stderr
    result = run("status", "--url", served.url).stdout
    assert "running  slot 8, endless times" in result
    assert "without A script on this computer for at most 3" in result
    assert run("stop", "--url", served.url).exit_code == 0
    assert served.read_until_stops(3) == ENDLESS + STOP * 3


@pytest.mark.exhaustive
def test_an_endless_run_ends_after_the_time_that_was_said(served: Served) -> None:
    begun = run("run", "8", "--times", "0", "--continue", "1", "--url", served.url)
    assert begun.exit_code == 0
    assert "after 1 s, by the gateway" in begun.stderr
    assert served.read_until_stops(3) == ENDLESS + STOP * 3
    assert "motion   allowed" in run("status", "--url", served.url).stdout


@pytest.mark.exhaustive
def test_a_watched_run_is_stopped_where_its_command_is_killed(served: Served) -> None:
    with begin(served, "run", "8", "--times", "0", "--timeout", "60") as watching:
        assert watching.stdout
        watching.stdout.readline()
        watching.kill()
        assert served.read_until_stops(3) == ENDLESS + STOP * 3


@pytest.mark.exhaustive
def test_an_endless_run_ends_after_its_timeout(served: Served) -> None:
    ended = run("run", "8", "--times", "0", "--timeout", "1", "--url", served.url)
    assert (ended.exit_code, ended.stdout.splitlines()[1:]) == (0, ["Ended after 1 s."])
    assert served.read_until_stops(3) == ENDLESS + STOP * 3
    both = run("run", "8", "--continue", "60", "--timeout", "1", "--url", served.url)
    assert both.exit_code == USAGE


@pytest.mark.exhaustive
def test_a_run_that_is_stopped_elsewhere_ends_its_watch(served: Served) -> None:
    with begin(served, "run", "8") as watching:
        assert watching.stdout
        watching.stdout.readline()
        assert run("stop", "--url", served.url).exit_code == 0
        assert watching.wait(5) == 0


@pytest.mark.exhaustive
def test_a_run_may_continue_without_the_command(served: Served) -> None:
    assert run("run", "8", "--continue", "60", "--url", served.url).exit_code == 0
    result = run("status", "--url", served.url).stdout
    assert "without A script on this computer for at most 60 s" in result
    assert "running  slot 8, 1 times" in result


@pytest.mark.exhaustive
def test_events_are_printed_line_by_line(served: Served) -> None:
    with begin(served, "events") as listening:
        assert listening.stdout
        assert json.loads(listening.stdout.readline())["type"] == "welcome"
        run("stop", "--url", served.url)
        assert json.loads(listening.stdout.readline())["latch"] is True
        listening.send_signal(signal.SIGINT)
        assert listening.wait(5) == INTERRUPTED


@pytest.mark.exhaustive
def test_ports_of_the_gateways_computer_are_listed(served: Served) -> None:
    assert served.pty.device in run("ports", "--url", served.url).stdout


@pytest.mark.exhaustive
def test_an_unauthenticated_command_says_where_to_get_a_token_and_works_with_one(tmp_path: Path) -> None:
    served = Served("--lan", "--data", str(tmp_path), *SILENT)
    refused = run("status", "--url", served.url)
    assert (refused.exit_code, "--token-file" in refused.stderr) == (FAILURE, True)
    token = tmp_path / "token"
    token.write_text(token_of(served) + "\n")
    assert run("stop", "--url", served.url, "--token-file", str(token)).exit_code == 0
    missing = run("stop", "--url", served.url, "--token-file", str(tmp_path / "missing"))
    assert missing.exit_code == USAGE
    served.end()


@pytest.mark.parametrize(
    ("arguments", "code", "why"),
    [
        (["status", "--url", "http://127.0.0.1:9"], UNREACHABLE, "servodeck serve"),
        (["events", "--url", "http://127.0.0.1:9"], UNREACHABLE, "servodeck serve"),
        (["status", "--url", "robot"], USAGE, "http://"),
        (["move", "1:1500"], USAGE, "SERVO=POSITION"),
        (["move", "1=1500", "2=900", "1=900"], USAGE, "Servo 1 is named twice."),
        (["move"], USAGE, "Missing argument"),
    ],
)
def test_each_failure_has_an_exit_code_of_its_own(arguments: list[str], code: int, why: str) -> None:
    result = run(*arguments)
    assert (result.exit_code, why in result.stderr) == (code, True)


def begin(served: Served, *arguments: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "servodeck", *arguments, "--url", served.url]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=variables()
    )


def variables(**more: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path), **more}


def token_of(served: Served) -> str:
    """By the way that the terminal shows: its code, then an owner's page."""
    assert served.process.stdout
    line = next(line for line in served.process.stdout if "type " in line)
    code = "".join(line.partition("type ")[2].split()[:2])
    with httpx2.Client(base_url=served.url, headers={"origin": served.url}) as owner:
        owner.post("/api/pair", json={"code": code, "name": "Anna"}).raise_for_status()
        made = owner.post("/api/tokens", json={"name": "Shell", "role": "driver"})
        return str(made.raise_for_status().json()["token"])
