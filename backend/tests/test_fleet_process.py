"""`servodeck serve --mqtt` as people start it: on a broker with TLS, killed, and with wrong options."""

import json
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from urllib.request import urlopen

import pytest

from servodeck.cli.options import USAGE
from servodeck.fleet.broker_config import Encryption
from servodeck.fleet.console import Console
from servodeck.fleet.identity import own_name
from tests.fleet import WAIT_S, console_of
from tests.mosquitto import Mosquitto, needs_mosquitto, needs_openssl
from tests.test_cli import Served, run

pytestmark = pytest.mark.slow


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
    made = Mosquitto(tmp_path / "broker", ["arm-1"], encryption)
    made.start()
    yield made
    made.kill()


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


def test_a_password_is_not_shown() -> None:
    assert "secret" not in run("config", "--mqtt", "mqtt://b", "--mqtt-password", "secret").stdout


def test_a_name_of_its_own_stays_on_its_hardware(tmp_path: Path) -> None:
    name = own_name(tmp_path, "one")
    assert own_name(tmp_path, "one") == name
    assert own_name(tmp_path, "another") != name
    (tmp_path / "fleet.json").write_text("{")
    assert own_name(tmp_path, "one") != name
