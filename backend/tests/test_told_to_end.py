"""However the real process is told to end, what it has in motion is stopped first: the bytes at its board."""

import json
import os
import pty as terminals
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from urllib.error import URLError
from urllib.request import Request, urlopen

import pytest

from servodeck.api.server import CONSOLE_CLOSED, console_handler
from servodeck.files import FILE
from servodeck.protocol.families import FAMILIES
from tests.bus import bus_of_pty
from tests.samples import RUN, STOP
from tests.test_cli import END_S, Served
from tests.test_ports import Pty
from tests.test_with_simulator import NODE, ROOT, SIMULATOR

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(os.name != "posix", reason="signals and ptys need POSIX"),
]
needs_simulator = pytest.mark.skipif(
    not (NODE and SIMULATOR.exists()), reason="needs Node and the simulator: npm run build"
)
OPENING_S = 10.0
# Of the board behind its gateway.
BOARD_END_S = 8.0
# The stops of an end: more may come behind a run whose frames are unknown.
STOPS = STOP * 3


# The first terminal that the leader of a session opens is the one of its session.
IN_TERMINAL = """
import os
os.close(os.open(os.ttyname(0), os.O_RDWR))
from servodeck.cli.main import main
main()
"""


def run_a_group(url: str) -> None:
    body = json.dumps({"times": 1}).encode()
    headers = {"Content-Type": "application/json"}
    urlopen(Request(f"{url}/api/slots/8/run", body, headers, method="POST")).close()


def stopped_behind_its_run(served: Served) -> None:
    received = served.read_until_stops(3)
    assert RUN in received
    only_stops(received.partition(RUN)[2])


def only_stops(behind: bytes) -> None:
    """Three, and more for a board that takes these for the rest of a packet; the last may be read in part."""
    assert behind.startswith(STOPS)
    assert (STOP * len(behind)).startswith(behind)


@pytest.mark.parametrize("name", ["SIGHUP", "SIGQUIT", "SIGTERM", "SIGINT"])
def test_each_signal_stops_the_group_that_runs(tmp_path: Path, name: str) -> None:
    served = Served("--data", str(tmp_path), "--log-level", "warning")
    run_a_group(served.url)
    begun_s = time.monotonic()
    served.process.send_signal(signal.Signals[name])
    stopped_behind_its_run(served)
    _, errors = served.process.communicate(timeout=END_S)
    assert time.monotonic() - begun_s <= END_S
    assert (served.process.returncode, errors) == (0, "")
    served.end()


def test_a_terminal_that_is_closed_stops_it_though_nothing_can_be_written_there(tmp_path: Path) -> None:
    with bus_of_pty() as (board, bus):
        ours, theirs = terminals.openpty()
        command = ["serve", "--listen", "127.0.0.1:0", "--serial", board.device, "--simulated"]
        # The log comes through the same terminal, and begins with no digit.
        command += ["--no-open", "--log-format", "json", "--data", str(tmp_path)]
        process = subprocess.Popen(
            [sys.executable, "-c", IN_TERMINAL, *command],
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
            start_new_session=True,
        )
        os.close(theirs)
        said = b""
        while b"\n" not in said.partition(b"Servodeck is at ")[2]:
            said += os.read(ours, 1000)
        [url] = re.findall(rb"Servodeck is at (http://[0-9.]+:[0-9]+)", said)
        run_a_group(url.decode())
        os.close(ours)
        process.wait(END_S)
        bus.rest()
        # Three, and as many as a stray byte can make the board miss.
        assert bus.since(0).partition(RUN)[2] == STOPS + STOP * (FAMILIES["doc"].left_over_bytes // len(STOP))


def test_a_process_of_nohup_outlives_its_terminal_and_no_polite_kill(tmp_path: Path) -> None:
    ignoring = ["sh", "-c", 'trap "" HUP; exec "$@"', "sh"]
    served = Served("--data", str(tmp_path), before=ignoring)
    run_a_group(served.url)
    assert served.read(len(RUN)) == RUN
    served.process.send_signal(signal.SIGHUP)
    with urlopen(f"{served.url}/api/status") as answer:
        assert json.load(answer)["running"]["slot"] == 8
    served.process.send_signal(signal.SIGTERM)
    assert served.read_until_stops(3) == STOPS
    served.process.wait(END_S)
    served.end()


@contextmanager
def fleet_page(board: Pty, folder: Path) -> Iterator["subprocess.Popen[str]"]:
    """On a computer that has used that port before; its broker is not there."""
    memory = {"port": board.device, "boards": {board.device: "openarm-new"}}
    (folder / FILE).write_text(json.dumps(memory))
    command: Sequence[str] = [
        "fleet",
        "serve",
        "--mqtt",
        "mqtt://desk@127.0.0.1:1",
        "--listen",
        "127.0.0.1:0",
    ]
    process = subprocess.Popen(
        [sys.executable, "-m", "servodeck", *command, "--data", str(folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.mark.parametrize("name", ["SIGHUP", "SIGTERM"])
def test_the_server_of_a_fleets_page_stops_the_robot_on_its_port_too(tmp_path: Path, name: str) -> None:
    with bus_of_pty() as (board, bus), fleet_page(board, tmp_path) as process:
        assert process.stdout
        assert process.stdout.readline().startswith("Servodeck is at ")
        until_s = time.monotonic() + OPENING_S
        while not bus.since(0):
            assert time.monotonic() < until_s
            time.sleep(0.02)
        bus.rest()
        told_s = time.monotonic()
        process.send_signal(signal.Signals[name])
        assert process.wait(END_S) == 0
        bus.rest()
        # A question may have been under way.
        assert bus.since(told_s).endswith(STOPS)


def answers(url: str) -> bool:
    try:
        urlopen(f"{url}/api/status").close()
    except (URLError, ConnectionError):
        return False
    return True


def heard_in(log: Path) -> bytes:
    *lines, _half_written = log.read_text().split("\n")
    entries = [json.loads(line) for line in lines[1:]]
    return bytes(entry["byte"] for entry in entries if entry["direction"] == "in")


STARTER = """
import { simulatedBoard } from './scripts/cable.mjs';
import { endChildren, onEnd, startChild } from './scripts/children.mjs';
import { python } from './scripts/python.mjs';
const [link, log, data] = process.argv.slice(1);
onEnd(() => void endChildren().then(() => process.exit(0)));
const cable = await simulatedBoard({
  ...{ link, simulatorArgs: ['--bus-log', log] }, onLine: () => undefined, onLost: () => undefined,
});
await cable.plug();
const port = ['--serial', cable.device, '--simulated', '--data', data];
const serve = ['-m', 'servodeck', 'serve', '--listen', '127.0.0.1:0', '--exit-with-stdin', ...port];
startChild(python, serve, (line) => line.startsWith('Servodeck is at') && console.log(line));
"""


@needs_simulator
@pytest.mark.parametrize("name", ["SIGKILL", "SIGHUP"])
def test_a_starter_that_is_gone_takes_gateway_and_board_along_and_the_stop_comes_first(
    tmp_path: Path, name: str
) -> None:
    """As `npm start` starts both."""
    log, link = tmp_path / "bus.jsonl", tmp_path / "board"
    starter = subprocess.Popen(
        [str(NODE), "--input-type=module", "-e", STARTER, str(link), str(log), str(tmp_path)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert starter.stdout
    url = starter.stdout.readline().split()[-1]
    run_a_group(url)
    starter.send_signal(signal.Signals[name])
    starter.communicate(timeout=3 * END_S)
    until_s = time.monotonic() + BOARD_END_S
    # The gateway's requests end behind the robot, the board's log behind its port.
    while answers(url) or link.is_symlink() or not heard_in(log).endswith(STOP):
        assert time.monotonic() < until_s, heard_in(log)
        time.sleep(0.05)
    assert heard_in(log).partition(RUN)[2].startswith(STOP)


def test_a_console_of_windows_that_closes_waits_until_the_robot_is_stopped() -> None:
    """The registration alone needs Windows."""
    has_ended, left = threading.Event(), threading.Event()

    def leave() -> None:
        left.set()
        threading.Timer(0.05, has_ended.set).start()

    handle = console_handler(leave, has_ended)
    assert not handle(0)
    assert not left.is_set()
    for event in CONSOLE_CLOSED:
        has_ended.clear()
        assert handle(event)
        assert has_ended.is_set()
