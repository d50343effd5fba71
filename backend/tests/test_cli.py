"""The command line as a person and as the start script use it."""

import asyncio
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest
from typer.testing import CliRunner, Result

from servodeck import __version__
from servodeck.api.server import Server
from servodeck.cli.main import app
from servodeck.files import FILE
from servodeck.protocol.families import UNKNOWN
from tests.fake_port import FakePort, FakePorts
from tests.running import server_on
from tests.samples import STOP
from tests.test_ports import Pty

pytestmark = pytest.mark.slow

READY = re.compile(r"Servodeck is at (http://127\.0\.0\.1:\d+)\n")
END_S = 3.0


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def test_the_version_is_printed() -> None:
    result = run("--version")
    assert (result.exit_code, result.stdout) == (0, f"servodeck {__version__}\n")


# As many as a board can miss behind what others left on the line, then three.
STOPS_AT_OPENING = UNKNOWN.left_over_bytes // len(STOP) + 3


class Served:
    """`servodeck serve` as a process of its own on a pty."""

    def __init__(
        self,
        *more: str,
        before: Sequence[str] = (),
        program: Sequence[str] = ("-m", "servodeck"),
        variables: Mapping[str, str] | None = None,
        pty: Pty | None = None,
        is_named: bool = True,
        identifies_board: bool = False,
    ) -> None:
        """On a pty of its own; a test that passes one reads it. Not `is_named`: without `--serial`. Unless it
        `identifies_board`, nothing but what a test says reaches the board.
        """
        self.pty = pty or Pty()
        command = [*before, sys.executable, *program, "serve", "--listen", "127.0.0.1:0"]
        self.process = subprocess.Popen(
            [
                *command,
                *(["--serial", self.pty.device] if is_named else []),
                *([] if identifies_board else ["--simulated"]),
                *more,
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={
                **os.environ,
                "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
                **(variables or {}),
            },
        )
        assert self.process.stdout
        ready = READY.fullmatch(self.process.stdout.readline())
        assert ready
        self.url = ready[1]
        if pty is None:
            self.read_until_stops(STOPS_AT_OPENING)

    def read_until_stops(self, count: int) -> bytes:
        """What the board got, until it holds that many stops. More of them may have left at once, for a board
        that takes these for the rest of a packet.
        """
        received = b""
        until = time.monotonic() + 20
        while received.count(STOP) < count:
            assert time.monotonic() < until, received
            # Between two openings of the port its other end is closed.
            with suppress(OSError):
                received += os.read(self.pty.board, 100)
        last = -1
        for _ in range(count):
            last = received.index(STOP, last + 1)
        end = last + len(STOP)
        return received[:end] if (STOP * len(received)).startswith(received[end:]) else received

    def read_behind_stops(self, count: int) -> bytes:
        """As `read`, behind the stops that go on while motion is latched."""
        received = self.read(count)
        while received.startswith(STOP):
            received = received.removeprefix(STOP) + self.read(len(STOP))
        return received

    def read(self, count: int) -> bytes:
        """So many bytes of what the board gets next: the pty may hand them over in pieces."""
        received = b""
        while len(received) < count:
            received += os.read(self.pty.board, count - len(received))
        return received

    def end(self) -> None:
        self.process.kill()
        self.process.communicate()
        self.pty.unplug()


@pytest.fixture
def served() -> Iterator[Served]:
    made = Served("--exit-with-stdin", "--log-level", "warning")
    yield made
    made.end()


def test_serve_tells_its_real_address_and_opens_the_port(served: Served) -> None:
    with urlopen(f"{served.url}/api/status") as answer:
        assert json.load(answer)["port"]["status"] == "open"


def port_of(served: Served) -> str | None:
    with urlopen(f"{served.url}/api/status") as answer:
        return str(json.load(answer)["port"]["device"])


def board_of(served: Served) -> str:
    with urlopen(f"{served.url}/api/status") as answer:
        return str(json.load(answer)["board"])


@pytest.mark.exhaustive
def test_the_board_is_what_it_was_last_unless_an_option_says(tmp_path: Path) -> None:
    pty, data = Pty(), ("--data", str(tmp_path))
    memory = {"boards": {pty.device: "lsc-6"}}
    for options, board in (((), "lsc-6"), (("--board", "unknown"), "unknown")):
        (tmp_path / FILE).write_text(json.dumps(memory))
        served = Served(
            *data, "--serial", pty.device, *options, pty=pty, is_named=False, identifies_board=True
        )
        served.read_until_stops(1)
        assert board_of(served) == board
        served.process.kill()
        served.process.communicate()
    pty.unplug()


@pytest.mark.exhaustive
def test_the_port_that_was_chosen_is_opened_again_with_a_stop_and_an_option_goes_before_it(
    tmp_path: Path,
) -> None:
    chosen, data = Pty(), ("--data", str(tmp_path))
    first = Served(*data)
    body = json.dumps({"device": chosen.device}).encode()
    headers = {"Content-Type": "application/json"}
    urlopen(Request(f"{first.url}/api/port", body, headers, method="PUT")).close()
    assert os.read(chosen.board, 100) == STOP
    first.end()
    again = Served(*data, pty=chosen, is_named=False)
    assert again.read_until_stops(1).startswith(STOP)
    assert port_of(again) == chosen.device
    again.process.kill()
    again.process.communicate()
    named = Served(*data)
    assert port_of(named) == named.pty.device
    named.end()
    chosen.unplug()


@pytest.mark.parametrize("ending", ["SIGTERM", "SIGINT", "end of stdin"])
def test_at_the_end_the_robot_is_stopped_first_and_the_process_leaves_in_time(
    served: Served, ending: str
) -> None:
    begun_s = time.monotonic()
    if ending == "end of stdin":
        assert served.process.stdin
        served.process.stdin.close()
        served.process.stdin = None
    else:
        served.process.send_signal(signal.Signals[ending])
    assert served.read_until_stops(3) == STOP * 3
    _, errors = served.process.communicate(timeout=END_S)
    assert time.monotonic() - begun_s <= END_S
    assert served.process.returncode == 0
    assert errors == ""


def test_its_end_may_be_requested_again_when_its_event_loop_has_ended() -> None:
    """As where the parent process closes our stdin just then."""

    async def one_life() -> Server:
        async with server_on(FakePorts(FakePort())) as running:
            return running.server

    asyncio.run(one_life()).leave()


@pytest.mark.parametrize(
    ("listen", "why"),
    [
        ("0.0.0.0:8300", "--lan"),
        ("192.168.1.5:8300", "--lan"),
        ("[::]:8300", "--lan"),
        ("robot.local:8300", "--lan"),
        ("127.0.0.2:8300", "--lan"),
        (":8300", "--lan"),
        ("8300", "HOST:PORT"),
        ("127.0.0.1:port", "HOST:PORT"),
        ("127.0.0.1:70000", "HOST:PORT"),
    ],
)
def test_an_address_that_others_can_reach_is_refused_with_an_explanation(listen: str, why: str) -> None:
    result = run("serve", "--listen", listen)
    assert result.exit_code == 2
    assert why in result.stderr


@pytest.mark.parametrize("url", ["robot.example", "https://robot.example/path"])
def test_a_public_address_that_cannot_be_is_refused(url: str) -> None:
    result = run("serve", "--listen", "127.0.0.1:0", "--public-url", url)
    assert result.exit_code == 2
    assert "--public-url" in result.stderr


@pytest.mark.exhaustive
def test_a_lan_start_tells_addresses_invites_its_first_owner_and_warns(tmp_path: Path) -> None:
    served = Served("--lan", "--data", str(tmp_path))
    assert served.process.stdout
    said = "".join(iter(served.process.stdout.readline, "and start with --public-url.\n"))
    secret = re.search(r"#pair=([\w-]+)", said)
    code = re.search(r"type (\d{4}) (\d{4}) there", said)
    assert secret
    assert code
    assert "█" in said
    assert "read plain http" in said
    assert "Tailscale" in said
    with pytest.raises(HTTPError, match="401") as refused:
        urlopen(f"{served.url}/api/status")
    refused.value.close()
    body = json.dumps({"code": code[1] + code[2], "name": "Anna"}).encode()
    headers = {"content-type": "application/json", "origin": served.url}
    with urlopen(Request(f"{served.url}/api/pair", body, headers)) as answer:
        assert json.load(answer)["role"] == "owner"
    served.end()
    again = Served("--lan", "--data", str(tmp_path))
    assert again.process.stdout
    said = "".join(iter(again.process.stdout.readline, "and start with --public-url.\n"))
    assert "#pair=" not in said
    again.end()


@pytest.mark.exhaustive
def test_a_lan_start_on_loopback_names_only_an_address_that_answers(tmp_path: Path) -> None:
    served = Served("--lan", "--data", str(tmp_path))
    assert served.process.stdout
    said = "".join(iter(served.process.stdout.readline, "and start with --public-url.\n"))
    assert "Only this computer can reach it" in said
    assert "Other devices reach it" not in said
    assert set(re.findall(r"http://([\d.]+):", said)) == {"127.0.0.1"}
    assert "--listen 0.0.0.0:8300" in said
    served.end()


def test_a_taken_address_is_reported() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        result = run("serve", "--listen", f"127.0.0.1:{taken.getsockname()[1]}")
    assert result.exit_code == 1
    assert "Another Servodeck" in result.stderr or "another Servodeck" in result.stderr


def test_an_unknown_board_is_reported() -> None:
    result = run("serve", "--board", "toaster")
    assert result.exit_code == 2
    assert "doc" in result.stderr


@pytest.mark.skipif(os.name != "posix", reason="a shell script")
def test_the_command_stands_beside_its_python_as_the_readme_says() -> None:
    command = Path(sys.executable).with_name("servodeck")
    said = subprocess.check_output([command, "decode", "55550207"], text=True)
    assert said.startswith("stop the running group")


def test_ports_are_listed_for_people_and_for_programs() -> None:
    assert run("ports").exit_code == 0
    for port in json.loads(run("ports", "--json").stdout):
        assert set(port) == {"device", "description", "likely", "lasting"}


def test_decode_says_what_a_packet_means() -> None:
    assert run("decode", "55", "55", "08", "03", "01", "E8", "03", "01", "D0", "07").stdout == (
        "move servo 1 to 2000 in 1000 ms\n"
    )
    assert run("decode", "5555040f4c1d").stdout == "battery 7500 mV\n"
    lines = run("decode", "--json", "01", "5555080301E80301D007", "5555040F3831").stdout.splitlines()
    assert [json.loads(line) for line in lines] == [
        {"noise": "01"},
        {
            "packet": "5555080301e80301d007",
            "command": {
                "kind": "move",
                "durationMs": 1000,
                "targets": [{"servo": 1, "position": 2000}],
            },
            "reports": [],
            "text": "move servo 1 to 2000 in 1000 ms",
        },
        {
            "packet": "5555040f3831",
            "command": None,
            "reports": [{"kind": "battery", "batteryMv": 12600}],
            "text": "battery 12600 mV",
        },
    ]


def test_decode_reads_a_file(tmp_path: Path) -> None:
    file = tmp_path / "export.csv"
    file.write_text("Time,Value\n0.1,0x55\n0.2,0x55\n0.3,0x02\n0.4,0x0F\n")
    assert run("decode", "--file", str(file)).stdout == "ask for the battery voltage\n"
    assert run("decode").exit_code == 2


@pytest.mark.parametrize(("text", "code"), [("zz", 2), ("555", 2), ("555502", 1), ("01", 1)])
def test_decode_tells_what_is_no_packet(text: str, code: int) -> None:
    result = run("decode", text)
    assert result.exit_code == code
    assert result.stderr
    assert not result.stdout
