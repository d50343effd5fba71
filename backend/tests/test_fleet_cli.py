"""`servodeck fleet` on a real Mosquitto, and the configuration that it writes for one."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.testing import Result

from servodeck.cli.options import FAILURE, TIMED_OUT, UNREACHABLE, USAGE
from tests.fleet import WAIT_S, Fleet, Gateway, console_of, eventually, fleet_on
from tests.mosquitto import Mosquitto, free_port, needs_mosquitto
from tests.test_cli import run

pytestmark = pytest.mark.slow
RUN, STOP, DOWNLOAD = 6, 7, 25
NAMES = ("arm-1", "arm-2")
FRAMES = [{"durationMs": 400, "positions": {"1": 1200}}]
Robots = tuple[Fleet, list[Gateway]]


@pytest.fixture(scope="module")
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path_factory.mktemp("broker"), NAMES) as made:
        yield made


@pytest.fixture
def robots(mosquitto: Mosquitto) -> Iterator[Robots]:
    with fleet_on(mosquitto, NAMES) as made:
        yield made


def fleet(mosquitto: Mosquitto, *arguments: str, user: str = "anna") -> Result:
    secret = mosquitto.folder / "secrets" / user
    broker = ["--mqtt", f"mqtt://{user}@127.0.0.1:{mosquitto.port}", "--mqtt-site", "lab"]
    given = mosquitto.plan.users.get(user)
    role = [] if "--role" in arguments or given is None else ["--role", given]
    return run("fleet", *arguments, *broker, "--mqtt-password-file", str(secret), *role)


@needs_mosquitto
def test_list_shows_who_is_there(mosquitto: Mosquitto, robots: Robots) -> None:
    result = fleet(mosquitto, "list", user="vera")
    assert result.exit_code == 0, result.output
    assert [line.split() for line in result.stdout.splitlines()] == [
        [name, "present", "doc", "ready"] for name in NAMES
    ]
    listed = json.loads(fleet(mosquitto, "list", "--json", user="vera").stdout)
    assert [(robot["name"], robot["state"]["latch"]) for robot in listed] == [
        ("arm-1", False),
        ("arm-2", False),
    ]


@needs_mosquitto
def test_a_robot_that_will_not_come_back_is_taken_off_the_lists_by_its_own_user(tmp_path: Path) -> None:
    with Mosquitto(tmp_path / "broker", NAMES) as own:
        with fleet_on(own, ["arm-1"]):
            pass
        with console_of(own, "olga") as console:
            assert console.until(lambda: console.robot("arm-1") is not None, WAIT_S)
            refused = fleet(own, "forget", "arm-1", user="arm-2")
            assert (refused.exit_code, refused.stderr) == (
                FAILURE,
                "The broker does not let arm-2 do that.\n",
            )
            assert fleet(own, "forget", "arm-1", user="arm-1").stdout == "arm-1 is off the lists.\n"
            assert console.until(lambda: console.robot("arm-1") is None, WAIT_S)
        assert fleet(own, "list", user="vera").stdout == "No robot is there.\n"


@needs_mosquitto
def test_what_the_broker_has_not_confirmed_is_not_said_to_be_off_the_lists(
    mosquitto: Mosquitto, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.fleet.broker.END_S", 0.0)
    result = fleet(mosquitto, "forget", "arm-1", user="arm-2")
    assert (result.exit_code, result.stdout) == (FAILURE, "")


@needs_mosquitto
def test_stop_and_resume_one_or_all(mosquitto: Mosquitto, robots: Robots) -> None:
    _, (one, other) = robots
    result = fleet(mosquitto, "stop", "arm-2")
    assert (result.exit_code, result.stdout) == (0, "1 of 1 stopped.\n")
    assert (one.control.latch, other.control.latch) == (False, True)
    assert fleet(mosquitto, "stop", user="stan").stdout == "2 of 2 stopped.\n"
    assert one.control.latch
    result = fleet(mosquitto, "resume")
    assert result.stdout == "arm-1: motion is allowed.\narm-2: motion is allowed.\n"
    assert not one.control.latch
    assert not other.control.latch


@needs_mosquitto
def test_stop_names_what_it_did_not_stop(mosquitto: Mosquitto, robots: Robots) -> None:
    maker, (one, _) = robots
    maker.do(one.control.close_port())
    result = fleet(mosquitto, "stop", "--json")
    assert result.exit_code == FAILURE
    report = json.loads(result.stdout)
    assert (report["stopped"], list(report["refused"]), report["missing"]) == (["arm-2"], ["arm-1"], [])
    assert fleet(mosquitto, "resume", "arm-2").exit_code == 0


@needs_mosquitto
def test_those_that_are_there_are_stopped_where_another_is_not(mosquitto: Mosquitto, robots: Robots) -> None:
    _, (one, other) = robots
    result = fleet(mosquitto, "stop", "arm-1", "arm-9", "--json")
    assert result.exit_code == FAILURE
    report = json.loads(result.stdout)
    assert (report["stopped"], report["missing"]) == (["arm-1"], ["arm-9"])
    assert (one.control.latch, other.control.latch) == (True, False)


@needs_mosquitto
def test_a_stop_of_all_does_not_wait_until_it_is_known_who_is_there(
    mosquitto: Mosquitto, robots: Robots, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, gateways = robots
    had_stopped: list[bool] = []

    def heard(*_: Any) -> None:
        had_stopped.append(eventually(lambda: all(one.control.latch for one in gateways), 2.0))

    monkeypatch.setattr("servodeck.cli.fleet.heard", heard)
    fleet(mosquitto, "stop")
    assert had_stopped == [True]
    monkeypatch.undo()
    assert fleet(mosquitto, "resume").exit_code == 0


@needs_mosquitto
def test_a_group_is_stored_and_run_on_several(mosquitto: Mosquitto, robots: Robots, tmp_path: Path) -> None:
    _, gateways = robots
    wave = tmp_path / "wave.json"
    wave.write_text(json.dumps({"frames": FRAMES}))
    result = fleet(mosquitto, "download", f"5={wave}", f"6={wave}", "--to", "arm-1", "--to", "arm-2")
    assert (result.exit_code, result.stdout) == (0, "arm-1: done\narm-2: done\n")
    assert [gateway.count(DOWNLOAD) for gateway in gateways] == [2, 2]
    result = fleet(mosquitto, "run", "5", *NAMES)
    assert result.exit_code == 0, result.output
    assert [gateway.count(RUN) for gateway in gateways] == [1, 1]
    assert [gateway.control.driving.driver for gateway in gateways] == [None, None]


@needs_mosquitto
def test_a_download_that_is_refused_leaves_no_driver(
    mosquitto: Mosquitto, robots: Robots, tmp_path: Path
) -> None:
    maker, gateways = robots
    maker.do(gateways[1].control.close_port())
    wave = tmp_path / "wave.json"
    wave.write_text(json.dumps({"frames": FRAMES}))
    result = fleet(mosquitto, "download", f"5={wave}", "--to", "arm-1", "--to", "arm-2")
    assert result.exit_code == FAILURE
    assert result.stderr.startswith("arm-2: ")
    assert [gateway.control.driving.driver for gateway in gateways] == [None, None]


@needs_mosquitto
@pytest.mark.parametrize("is_download", [False, True])
def test_where_another_drives_one_of_them_none_is_kept(
    mosquitto: Mosquitto, robots: Robots, tmp_path: Path, *, is_download: bool
) -> None:
    _, (one, _) = robots
    file = tmp_path / "wave.json"
    file.write_text(json.dumps({"name": "Wave", "frames": FRAMES}))
    download = ["download", f"3={file}", "--to", "arm-1", "--to", "arm-2"]
    with console_of(mosquitto, "olga", *NAMES) as console:
        assert console.ask("arm-2", "ask", action="request").drives
        result = fleet(mosquitto, *(download if is_download else ["run", "3", "arm-1", "arm-2"]))
        assert (result.exit_code, result.stderr) == (FAILURE, "olga drives arm-2. Wait, or ask there.\n")
        assert one.control.driving.driver is None


@needs_mosquitto
def test_several_start_together_or_none(mosquitto: Mosquitto, robots: Robots) -> None:
    _, gateways = robots
    assert fleet(mosquitto, "stop", "arm-2").exit_code == 0
    result = fleet(mosquitto, "run", "5", *NAMES, "--together")
    assert result.exit_code == FAILURE
    assert "arm-2: Stopped" in result.stderr
    assert [gateway.count(RUN) for gateway in gateways] == [0, 0]
    assert [gateway.control.driving.driver for gateway in gateways] == [None, None]
    assert fleet(mosquitto, "resume", "arm-2").exit_code == 0
    result = fleet(mosquitto, "run", "5", *NAMES, "--together", "--timeout", "0.1")
    assert result.exit_code == TIMED_OUT, result.output
    assert result.stdout == "arm-1: slot 5, started.\narm-2: slot 5, started.\n"


@needs_mosquitto
def test_a_run_that_does_not_end_is_stopped(mosquitto: Mosquitto, robots: Robots) -> None:
    _, (one, _) = robots
    result = fleet(mosquitto, "run", "9", "arm-1", "--times", "0", "--timeout", "0.2")
    assert result.exit_code == TIMED_OUT, result.output
    assert eventually(lambda: one.count(STOP) >= 3)
    assert not one.control.latch


@needs_mosquitto
def test_a_run_may_continue_alone(mosquitto: Mosquitto, robots: Robots) -> None:
    _, (one, _) = robots
    result = fleet(mosquitto, "run", "9", "arm-1", "--times", "0", "--continue", "60")
    assert (result.exit_code, result.stdout) == (0, "arm-1: slot 9, acknowledged.\n")
    assert one.control.board.unattended.by


@needs_mosquitto
def test_who_is_not_there_is_named(
    mosquitto: Mosquitto, robots: Robots, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.cli.fleet.NAMED_S", 0.3)
    result = fleet(mosquitto, "run", "1", "arm-1", "arm-9")
    assert result.exit_code == FAILURE
    assert "arm-9: not there" in result.stderr


@needs_mosquitto
def test_a_role_that_the_broker_does_not_give_is_named(
    mosquitto: Mosquitto, robots: Robots, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.cli.fleet.NAMED_S", 5.0)  # no answer to its first question either
    result = fleet(mosquitto, "run", "1", "arm-1", "--role", "owner")
    assert result.exit_code == FAILURE
    assert "Has anna the role owner?" in result.stderr


def test_a_broker_that_does_not_answer_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.cli.fleet.CONNECT_S", 0.3)
    result = run("fleet", "list", "--mqtt", f"mqtt://anna@127.0.0.1:{free_port()}")
    assert result.exit_code == UNREACHABLE
    assert "cannot be reached: " in result.stderr  # and why


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["list"], "Name the broker"),
        (["list", "--mqtt", "mqtt://127.0.0.1"], "needs a user"),
        (["list", "--mqtt", "mqtt://anna@127.0.0.1", "--role", "king"], "--role is one of"),
        (["broker-config", "x", "--gateway", "all", "--user", "anna=driver"], "cannot be called all"),
        (["broker-config", "x", "--gateway", "a", "--user", "a=driver"], "different names"),
        (["broker-config", "x", "--gateway", "a", "--user", "anna"], "NAME=ROLE"),
        (["broker-config", "x", "--gateway", "a", "--user", "b=viewer", "--listen", "8883"], "HOST:PORT"),
        (
            ["broker-config", "x", "--gateway", "a", "--user", "b=viewer", "--cert", "c.pem"],
            "belong together",
        ),
    ],
)
def test_options_that_cannot_be_are_explained(arguments: list[str], sentence: str) -> None:
    result = run("fleet", *arguments)
    assert result.exit_code == USAGE
    assert sentence in result.stderr


@needs_mosquitto
def test_a_configuration_is_written_and_keeps_its_passwords(tmp_path: Path) -> None:
    folder = tmp_path / "broker"
    options = ["--gateway", "arm-1", "--user", "anna=driver", "--listen", "127.0.0.1:18830"]
    assert run("fleet", "broker-config", str(folder), *options).exit_code == 0
    secret = (folder / "secrets" / "anna").read_text()
    assert (folder / "secrets" / "anna").stat().st_mode & 0o077 == 0
    assert secret.strip() not in (folder / "passwords").read_text()
    more = [*options, "--gateway", "arm-2", "--websocket", "127.0.0.1:18831"]
    assert run("fleet", "broker-config", str(folder), *more).exit_code == 0
    assert (folder / "secrets" / "anna").read_text() == secret
    assert (folder / "secrets" / "arm-2").exists()
    assert "protocol websockets" in (folder / "mosquitto.conf").read_text()
