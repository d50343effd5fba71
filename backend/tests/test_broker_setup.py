"""The broker as the guides set it up: certificates by the commands of docs/fleet.md, the list of rights for
two brokers, and the compose files.
"""

import json
import re
import ssl
import subprocess
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from servodeck.fleet.broker import parse_broker
from servodeck.fleet.broker_config import Encryption, Listener, Plan, acl
from servodeck.fleet.console import Console
from servodeck.fleet.emqx_config import acl_of
from tests.fleet import eventually
from tests.mosquitto import LAB, USERS, Mosquitto, needs_mosquitto, needs_openssl
from tests.test_cli import run

ROOT = Path(__file__).resolve().parents[2]
BROKER = ROOT / "packaging" / "broker"
YAML = import_module("yaml")
PLAN = Plan("lab", ["arm-1", "arm-2"], USERS, Listener(1883), home_assistant="homeassistant")


def commands_of(document: str) -> list[str]:
    """The blocks of a guide that are for a shell."""
    text = (ROOT / "docs" / document).read_text("utf-8")
    blocks: list[str] = re.findall(r"^ *```sh\n(.+?)^ *```$", text, re.MULTILINE | re.DOTALL)
    return blocks


@pytest.fixture
def certificates(tmp_path: Path) -> Path:
    """By the guide, for this computer."""
    block = next(one for one in commands_of("fleet.md") if "openssl" in one)
    here = block.replace("broker.local", "localhost")
    subprocess.run(["sh", "-ec", here], cwd=tmp_path, check=True, capture_output=True)
    return tmp_path


@pytest.fixture
def mosquitto(certificates: Path) -> Iterator[Mosquitto]:
    folder = certificates / "broker"
    encryption = Encryption(folder / "broker.pem", folder / "broker.key")
    with Mosquitto(folder, ["arm-1"], encryption) as made:
        yield made


@pytest.mark.slow
@needs_openssl
@needs_mosquitto
def test_the_certificates_of_the_guide_are_trusted(mosquitto: Mosquitto, certificates: Path) -> None:
    secret = (mosquitto.folder / "secrets" / "anna").read_text().strip()
    broker = parse_broker(f"mqtts://anna@localhost:{mosquitto.port}", secret, certificates / "ca.pem")
    assert broker.encryption
    broker.encryption.verify_flags |= ssl.VERIFY_X509_STRICT  # as later versions of Python do
    with Console(broker, LAB, "driver") as console:
        assert eventually(lambda: console.problem is None), console.problem


def allowed_by_mosquitto(text: str) -> dict[tuple[str, str], set[str]]:
    found: dict[tuple[str, str], set[str]] = {}
    user = ""
    for line in filter(None, text.splitlines()):
        match line.split():
            case ["user", name]:
                user = name
            case ["topic", access, topic]:
                found.setdefault((user, {"write": "publish", "read": "subscribe"}[access]), set()).add(topic)
    return found


def test_both_brokers_have_the_same_rights() -> None:
    *allowing, last = acl_of(PLAN).splitlines()
    rules = [re.fullmatch(r'\{allow, \{user, "(.+)"\}, (\w+), (\[.+\])\}\.', line) for line in allowing]
    assert all(rules)
    found = {(one[1], one[2]): set(json.loads(one[3])) for one in rules if one}
    assert found == allowed_by_mosquitto(acl(PLAN))
    assert last == "{deny, all}."


def test_owners_alone_see_how_the_broker_is() -> None:
    readers = {user for (user, _), topics in allowed_by_mosquitto(acl(PLAN)).items() if "$SYS/#" in topics}
    assert readers == {name for name, role in USERS.items() if role == "owner"}


def test_files_for_emqx_have_all_users_and_stay(tmp_path: Path) -> None:
    command = ["fleet", "broker-config", str(tmp_path / "b"), "--emqx", "--site", "lab", "--gateway", "arm-1"]
    assert run(*command, "--user", "anna=driver").exit_code == 0
    before = (tmp_path / "b" / "users.csv").read_text()
    assert run(*command, "--user", "anna=driver", "--user", "ben=viewer").exit_code == 0
    after = (tmp_path / "b" / "users.csv").read_text()
    assert after.startswith(before)
    rows = [line.split(",") for line in after.splitlines()]
    assert rows[0] == ["user_id", "password", "is_superuser"]
    secrets = tmp_path / "b" / "secrets"
    assert rows[1:] == [
        [name, (secrets / name).read_text().strip(), "false"] for name in ("arm-1", "anna", "ben")
    ]
    base = (tmp_path / "b" / "base.hocon").read_text()
    for line in ("no_match = deny", 'bootstrap_file = "${EMQX_ETC_DIR}/users.csv"', "max_mqueue_len = 1000"):
        assert line in base


@pytest.mark.parametrize("file", ["compose.yaml", "emqx.compose.yaml"])
def test_containers_have_few_rights_and_files_that_are_written(file: str) -> None:
    compose: dict[str, Any] = YAML.safe_load((BROKER / file).read_text())
    for service in compose["services"].values():
        assert service["cap_drop"] == ["ALL"]
        assert service["security_opt"] == ["no-new-privileges:true"]
        assert "privileged" not in service
        assert re.fullmatch(r"[a-z/-]+:\d[\d.]*", service["image"])
        assert all(volume.endswith(":ro") for volume in service["volumes"])
        assert not any(port.startswith(("1883", "8083")) for port in service["ports"])  # nothing unencrypted
    guide = (ROOT / "docs" / "broker.md").read_text("utf-8")
    names = set(re.findall(r"\$\{(\w+)", (BROKER / file).read_text()))
    assert all(f"{name}=" in guide for name in names)


def test_a_cluster_knows_each_of_its_nodes() -> None:
    compose = YAML.safe_load((BROKER / "emqx.compose.yaml").read_text())
    nodes = [one["environment"] for one in compose["services"].values()]
    names = [node["EMQX_NODE__NAME"] for node in nodes]
    aliases = [one["networks"]["nodes"]["aliases"][0] for one in compose["services"].values()]
    assert names == [f"emqx@{alias}" for alias in aliases]
    assert {node["EMQX_CLUSTER__STATIC__SEEDS"] for node in nodes} == {f"[{','.join(names)}]"}


def test_figures_that_the_guide_names_are_there() -> None:
    guide = (ROOT / "docs" / "broker.md").read_text("utf-8")
    named = set(re.findall(r"servodeck_\w+", guide))
    shown = set(re.findall(r'"(servodeck_\w+)"', (ROOT / "backend/servodeck/api/prometheus.py").read_text()))
    assert named
    assert named <= shown
