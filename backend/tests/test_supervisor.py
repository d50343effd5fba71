"""What systemd hears of the real process, and the unit that starts it."""

import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from servodeck.api.health import SAMPLE_EVERY_S
from servodeck.api.server import END_S
from servodeck.cli.main import app
from tests.test_cli import Served

pytestmark = pytest.mark.skipif(os.name != "posix", reason="systemd needs POSIX")


class Supervisor:
    def __init__(self, address: str) -> None:
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(address)
        self.socket.settimeout(5)

    def hear(self) -> str:
        return self.socket.recv(100).decode()

    def hear_until(self, state: str) -> list[str]:
        heard = [self.hear()]
        while heard[-1] != state:
            heard.append(self.hear())
        return heard

    def drain(self) -> int:
        """How many waited."""
        self.socket.settimeout(0)
        count = 0
        try:
            while self.hear():
                count += 1
        except BlockingIOError:
            self.socket.settimeout(5)
        return count


@pytest.fixture
def supervisor(tmp_path: Path) -> Iterator[Supervisor]:
    made = Supervisor(str(tmp_path / "notify"))
    yield made
    made.socket.close()


def served_for(supervisor: Supervisor, **variables: str) -> Served:
    return Served(variables={"NOTIFY_SOCKET": supervisor.socket.getsockname(), **variables})


@pytest.mark.exhaustive
def test_systemd_hears_of_readiness_life_and_end(supervisor: Supervisor) -> None:
    served = served_for(supervisor, WATCHDOG_USEC="2000000")
    assert "READY=1" in supervisor.hear_until("READY=1")
    supervisor.hear_until("WATCHDOG=1")
    served.process.send_signal(signal.SIGSTOP)
    supervisor.drain()
    time.sleep(1)
    assert supervisor.drain() == 0
    served.process.send_signal(signal.SIGCONT)
    supervisor.hear_until("WATCHDOG=1")
    served.process.send_signal(signal.SIGTERM)
    supervisor.hear_until("STOPPING=1")
    served.end()


@pytest.mark.exhaustive
def test_a_supervisor_that_watches_another_process_hears_no_life(supervisor: Supervisor) -> None:
    served = served_for(supervisor, WATCHDOG_USEC="2000000", WATCHDOG_PID="1")
    supervisor.hear_until("READY=1")
    time.sleep(0.6)  # two beats
    served.process.send_signal(signal.SIGTERM)
    assert supervisor.hear_until("STOPPING=1") == ["STOPPING=1"]
    served.end()


@pytest.mark.exhaustive
def test_a_name_without_a_file_will_do() -> None:
    supervisor = Supervisor(f"\0servodeck-test-{os.getpid()}")
    served = Served(variables={"NOTIFY_SOCKET": f"@servodeck-test-{os.getpid()}"})
    supervisor.hear_until("READY=1")
    served.end()
    supervisor.socket.close()


@pytest.mark.exhaustive
def test_a_supervisor_that_is_gone_is_no_reason_to_fail() -> None:
    served = Served(variables={"NOTIFY_SOCKET": "/nowhere/at/all"})
    served.end()


UNIT = Path(__file__).parents[2] / "packaging" / "servodeck.service"
HAS_SYSTEMD = shutil.which("systemd-analyze") is not None


def settings_of_unit() -> dict[str, list[str]]:
    """By name; a name may stand there several times."""
    settings: dict[str, list[str]] = {}
    for line in UNIT.read_text().splitlines():
        if line and line[0] not in "[#":
            name, _, value = line.partition("=")
            settings.setdefault(name, []).append(value)
    return settings


def test_the_unit_starts_what_this_version_understands() -> None:
    settings = settings_of_unit()
    _, *arguments = shlex.split(settings["ExecStart"][0])
    assert arguments[0] == "serve"
    variables = dict(pair.split("=", 1) for line in settings["Environment"] for pair in shlex.split(line))
    shown = CliRunner().invoke(app, ["config", *arguments[1:]], env=variables)
    assert shown.exit_code == 0, shown.stderr
    assert all(f"# {name}" in shown.stdout for name in variables)


def test_the_unit_waits_long_enough_and_gives_only_what_is_needed() -> None:
    settings = settings_of_unit()
    assert settings["Type"] == ["notify"]
    assert float(settings["WatchdogSec"][0]) > 4 * SAMPLE_EVERY_S
    assert float(settings["TimeoutStopSec"][0]) > END_S
    assert int(settings["Nice"][0]) < 0
    assert settings["DynamicUser"] == ["yes"]
    assert settings["CapabilityBoundingSet"] == [""]
    assert all(device.endswith(" rw") and "tty" in device for device in settings["DeviceAllow"])


@pytest.mark.exhaustive
@pytest.mark.skipif(not HAS_SYSTEMD, reason="systemd is not installed")
@pytest.mark.parametrize("check", [["verify"], ["security", "--offline=true", "--threshold=20"]])
def test_systemd_finds_nothing_wrong_with_the_unit(check: list[str], tmp_path: Path) -> None:
    # What it starts is installed on the robot, not here.
    unit = tmp_path / UNIT.name
    unit.write_text(re.sub(r"(?m)^ExecStart=\S+", "ExecStart=/bin/true", UNIT.read_text()))
    result = subprocess.run(
        ["systemd-analyze", *check, str(unit)], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stderr == ""
