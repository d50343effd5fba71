"""`servodeck serve --mqtt` as people start it: on a broker with TLS, killed, and with wrong options."""

import json
import signal
import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path
from urllib.request import urlopen

import pytest

from servodeck.cli.options import USAGE
from servodeck.fleet.broker import parse_broker
from servodeck.fleet.broker_config import Encryption
from servodeck.fleet.console import Console
from servodeck.fleet.identity import own_name
from tests.fleet import WAIT_S, console_of, eventually, fleet_on
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto, needs_openssl
from tests.samples import STOP
from tests.test_cli import Served, run
from tests.test_ports import Pty
from tests.test_with_simulator import NODE, SIMULATOR, Board

pytestmark = pytest.mark.slow
needs_simulator = pytest.mark.skipif(
    NODE is None or not SIMULATOR.exists(), reason="the simulator is not built: npm run build"
)


@pytest.fixture(scope="module")
def encryption(tmp_path_factory: pytest.TempPathFactory) -> Encryption:
    """A certificate for this computer that vouches for itself."""
    folder = tmp_path_factory.mktemp("certificates")
    certificate, key = folder / "broker.pem", folder / "broker.key"
    subprocess.run(
        [
            *("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1"),
            *("-nodes", "-days", "2", "-subj", "/CN=127.0.0.1", "-addext", "subjectAltName=IP:127.0.0.1"),
            *("-keyout", str(key), "-out", str(certificate)),
        ],
        check=True,
        capture_output=True,
    )
    return Encryption(certificate, key)


@pytest.fixture
def mosquitto(tmp_path: Path, encryption: Encryption) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path / "broker", ["arm-1"], encryption) as made:
        yield made


def fleet_of(served: Served) -> dict[str, object]:
    with urlopen(f"{served.url}/api/status") as answer:
        found: dict[str, object] = json.load(answer)["fleet"]
        return found


@needs_mosquitto
@needs_openssl
def test_a_gateway_joins_by_tls_and_its_death_is_seen(
    mosquitto: Mosquitto, encryption: Encryption, tmp_path: Path
) -> None:
    secret = mosquitto.folder / "secrets" / "arm-1"
    options = ["--mqtt", f"mqtts://arm-1@127.0.0.1:{mosquitto.port}", "--mqtt-site", "lab"]
    files = ["--mqtt-password-file", str(secret), "--mqtt-ca", str(encryption.certificate)]
    served = Served(*options, *files, "--data", str(tmp_path / "data"))
    try:
        with console_of(mosquitto, "olga", "arm-1") as console:
            status = fleet_of(served)
            assert (status["name"], status["site"], status["isConnected"]) == ("arm-1", "lab", True)
            said = run("status", "--url", served.url).stdout
            assert f"broker   127.0.0.1:{mosquitto.port}, arm-1 at lab: connected\n" in said
            with urlopen(f"{served.url}/metrics") as answer:
                assert b"servodeck_broker_connected 1.0" in answer.read()
            console.stop("arm-1").result(WAIT_S)
            served.read_until_stops(3)
            served.process.send_signal(signal.SIGKILL)
            assert console.until(lambda: is_silent(console), WAIT_S)
    finally:
        served.end()


def is_silent(console: Console) -> bool:
    robot = console.robot("arm-1")
    return robot is not None and robot.presence == "silent"


@needs_mosquitto
def test_a_browser_s_way_leads_there_too(tmp_path: Path) -> None:
    with Mosquitto(tmp_path / "broker", ["arm-1"], websocket=True) as broker:
        secret = (broker.folder / "secrets" / "anna").read_text().strip()
        by_websocket = parse_broker(f"ws://anna@127.0.0.1:{broker.websocket_port}", secret)
        with fleet_on(broker, ["arm-1"]), Console(by_websocket, LAB, "driver") as console:
            assert console.until(lambda: console.is_present("arm-1"), WAIT_S), console.problem
            assert console.ask("arm-1", "ask", action="request").drives
        with socket.socket() as other, pytest.raises(ConnectionRefusedError):
            other.connect(("127.0.0.2", broker.websocket_port))  # on this one interface only


@needs_mosquitto
@needs_openssl
def test_a_broker_may_want_a_certificate_of_each(tmp_path: Path, encryption: Encryption) -> None:
    strict = Encryption(encryption.certificate, encryption.key, encryption.certificate)
    with Mosquitto(tmp_path / "broker", ["arm-1"], strict) as broker:
        secret = (broker.folder / "secrets" / "anna").read_text().strip()
        url, ca = f"mqtts://anna@127.0.0.1:{broker.port}", encryption.certificate
        with Console(parse_broker(url, secret, ca), LAB, "driver") as console:
            assert console.until(lambda: "not been" not in (console.problem or "not been"), WAIT_S)
            assert console.problem
        with Console(parse_broker(url, secret, ca, ca, encryption.key), LAB, "driver") as console:
            assert console.until(lambda: console.problem is None, WAIT_S), console.problem


@pytest.mark.exhaustive
@needs_mosquitto
def test_a_frozen_gateway_is_silent_and_comes_back(tmp_path: Path) -> None:
    with Mosquitto(tmp_path / "broker", ["arm-1"]) as broker:
        secret = broker.folder / "secrets" / "arm-1"
        options = ["--mqtt", f"mqtt://arm-1@127.0.0.1:{broker.port}", "--mqtt-site", "lab"]
        served = Served(*options, "--mqtt-password-file", str(secret), "--data", str(tmp_path / "data"))
        try:
            with console_of(broker, "olga", "arm-1") as console:
                served.process.send_signal(signal.SIGSTOP)
                assert console.until(lambda: is_silent(console), WAIT_S)
                served.process.send_signal(signal.SIGCONT)
                assert console.until(lambda: console.is_present("arm-1"), WAIT_S)
        finally:
            served.end()


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--mqtt", "http://broker"], "begins with mqtt://"),
        (["--mqtt", "mqtt://a:secret@broker"], "give it in a file"),
        (["--mqtt", "mqtt://broker", "--mqtt-ca", "some.pem"], "certificates need mqtts://"),
        (["--mqtt", "mqtt://broker", "--mqtt-site", "a/b"], "no name of a site"),
        (["--mqtt", "mqtt://broker", "--mqtt-name", "all"], "cannot be called all"),
        (["--mqtt", "mqtts://broker", "--mqtt-ca", "/nowhere.pem"], "certificate of --mqtt cannot be used"),
        (["--mqtt", "mqtt://broker", "--mqtt-password-file", "/nowhere"], "cannot be read"),
    ],
)
def test_options_that_cannot_be_are_explained(options: list[str], sentence: str, tmp_path: Path) -> None:
    result = run("serve", "--listen", "127.0.0.1:0", "--data", str(tmp_path), "--no-open", *options)
    assert result.exit_code == USAGE
    assert sentence in result.stderr


@pytest.mark.parametrize(
    ("url", "can_be"),
    [("mqtt://broker", True), ("ws://broker", True), ("mqtts://broker", False), ("mqtt://localhost", False)],
)
def test_it_is_known_what_others_can_read(url: str, can_be: bool) -> None:
    assert parse_broker(url).can_be_overheard is can_be


def test_a_password_is_not_shown() -> None:
    assert "secret" not in run("config", "--mqtt", "mqtt://b", "--mqtt-password", "secret").stdout


def test_a_name_of_its_own_stays_on_its_hardware(tmp_path: Path) -> None:
    name = own_name(tmp_path, "one")
    assert own_name(tmp_path, "one") == name
    assert own_name(tmp_path, "another") != name
    (tmp_path / "fleet.json").write_text("{")
    assert own_name(tmp_path, "one") != name


@pytest.mark.exhaustive
@needs_mosquitto
@needs_simulator
def test_a_simulated_board_runs_and_is_stopped_over_the_broker(tmp_path: Path) -> None:
    board = Board(tmp_path / "board", tmp_path / "bus.jsonl")
    broker = Mosquitto(tmp_path / "broker", ["arm-1"])
    board.plug()
    broker.start()
    secret = broker.folder / "secrets" / "arm-1"
    where = ["--mqtt", f"mqtt://arm-1@127.0.0.1:{broker.port}", "--mqtt-site", "lab"]
    files = ["--mqtt-password-file", str(secret), "--data", str(tmp_path / "data")]
    served = Served(*where, *files, "--serial", str(board.link), pty=Pty(), is_named=False)
    try:
        with console_of(broker, "anna", "arm-1") as console:
            assert console.until(lambda: has_port(console), WAIT_S)
            frames = [{"durationMs": 500, "positions": {"1": position}} for position in (1200, 1800)]
            console.ask("arm-1", "ask", action="request")
            console.ask("arm-1", "download", groups=[{"slot": 4, "frames": frames}])
            assert console.until(lambda: has_stored(console), WAIT_S)
            console.ask("arm-1", "run", slot=4, times=0)
            begun = len(board.taken())
            console.stop("arm-1").result(WAIT_S)
            assert eventually(lambda: stops_since(board, begun) >= 3)
    finally:
        served.end()
        broker.kill()
        board.pull()


def has_port(console: Console) -> bool:
    robot = console.robot("arm-1")
    return robot is not None and robot.state is not None and robot.state.link.status == "ready"


def has_stored(console: Console) -> bool:
    console.beat()
    robot = console.robot("arm-1")
    return bool(robot and robot.state and robot.state.job and robot.state.job.status == "done")


def stops_since(board: Board, begun: int) -> int:
    return bytes(byte for _, byte in board.taken()[begun:]).count(STOP)
