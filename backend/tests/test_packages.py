"""What is given to others: the libraries by hash, their bill, and a container with few rights."""

import json
import re
import runpy
import shutil
import subprocess
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.request import urlopen

import pytest
from typer.testing import CliRunner

from servodeck.cli.main import app
from tests.fleet import eventually
from tests.test_openapi import SCHEMA

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = runpy.run_path(str(ROOT / "scripts/package.py"))
LOCK = (ROOT / "backend/requirements.lock").read_text()
CONTAINER = (ROOT / "packaging/Containerfile").read_text()
COMPOSE = import_module("yaml").safe_load((ROOT / "packaging/compose.yaml").read_text())


def locked(*wanted: str) -> dict[str, str]:
    found: dict[str, str] = PACKAGE["locked_requirements"](LOCK, wanted or PACKAGE["PROJECT"]["dependencies"])
    return found


def test_the_wheel_comes_with_all_that_it_needs_by_hash_and_nothing_else() -> None:
    entries = locked()
    named = {re.split(r"[=\[]", one)[0] for one in PACKAGE["PROJECT"]["dependencies"]}
    assert named <= entries.keys()
    assert {"starlette", "pydantic-core", "websockets", "colorama"} <= entries.keys()
    assert not {"pytest", "mypy", "hatchling", "uv", "bleak"} & entries.keys()
    for name, entry in entries.items():
        assert re.match(rf"{re.escape(name)}==", entry.replace("_", "-").lower()), entry
        assert "--hash=sha256:" in entry
        assert "#" not in entry


def test_extras_are_followed_and_what_is_not_locked_is_an_error() -> None:
    assert "websockets" not in locked("uvicorn==0.54.0")
    assert "websockets" in locked("uvicorn[standard]==0.54.0")
    with pytest.raises(KeyError, match="left-pad is not in the lock file"):
        locked("left-pad==1.0")


def test_the_bill_names_each_library_of_page_and_gateway_with_its_licence() -> None:
    page = {"bomFormat": "CycloneDX", "components": [{"name": "react", "purl": "pkg:npm/react@1"}]}
    bill: dict[str, Any] = PACKAGE["bill_of"](page, locked())
    assert bill["bomFormat"] == "CycloneDX"
    by_name = {one["name"]: one for one in bill["components"]}
    assert "react" in by_name
    assert by_name["fastapi"]["purl"] == "pkg:pypi/fastapi@0.165.0"
    assert by_name["fastapi"]["licenses"] == [{"expression": "MIT"}]
    assert all(re.fullmatch("[0-9a-f]{64}", one["content"]) for one in by_name["fastapi"]["hashes"])
    silent = [
        name for name, one in by_name.items() if not one.get("licenses") and name not in {"react", "colorama"}
    ]
    assert silent == []
    json.dumps(bill)


def test_the_licences_have_the_text_of_each_library_of_the_gateway() -> None:
    texts: str = PACKAGE["library_texts"](locked())
    for said in (
        "zeroconf 0.154.0 (LGPL-2.1-or-later)",
        "GNU LESSER GENERAL PUBLIC LICENSE",
        "pyserial 3.5 (",
    ):
        assert said in texts
    assert "Redistribution and use" in PACKAGE["library_text"]("pyserial")


def test_a_library_without_its_licence_is_an_error_that_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    library_text = PACKAGE["library_text"]
    monkeypatch.setitem(library_text.__globals__, "distribution", lambda _: SimpleNamespace(files=()))
    with pytest.raises(ValueError, match="nameless is installed without its licence"):
        library_text("nameless")


def test_the_container_runs_as_nobody_in_particular_with_options_that_exist() -> None:
    steps = dict(re.findall(r"^([A-Z]+) (.+)$", CONTAINER, re.MULTILINE))
    assert re.fullmatch(r"python:3\.\d+-slim", steps["FROM"])
    assert int(steps["USER"]) > 0
    assert "--require-hashes" in CONTAINER
    assert "--no-deps" in CONTAINER
    options = CliRunner().invoke(app, ["serve", "--help"]).stdout
    variables = re.findall(r"SERVODECK_[A-Z_]+", steps["ENV"])
    assert variables == [one for one in variables if one in options]
    probe = re.search(r"http://127\.0\.0\.1:(\d+)(/api/\w+)", CONTAINER)
    assert probe
    assert probe[1] == steps["EXPOSE"]
    assert probe[2] in SCHEMA["paths"]


def test_the_service_may_write_its_data_and_nothing_else() -> None:
    service = COMPOSE["services"]["servodeck"]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert "privileged" not in service
    assert service["security_opt"] == ["no-new-privileges:true"]
    assert service["volumes"] == ["servodeck:/data"]
    assert "VOLUME /data" in CONTAINER
    context = (ROOT / "packaging" / service["build"]["context"]).resolve()
    assert (context / service["build"]["dockerfile"]).read_text() == CONTAINER
    assert COMPOSE["volumes"] == {"servodeck": None}


@pytest.fixture
def engine() -> str:
    """A container engine that works here."""
    for name in ("docker", "podman"):
        if (
            shutil.which(name)
            and subprocess.run([name, "info"], capture_output=True, check=False).returncode == 0
        ):
            return name
    pytest.skip("no container engine runs here")


def asked(*command: str) -> str:
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.exhaustive
def test_the_image_is_built_and_serves_without_a_right_to_write(engine: str) -> None:
    assert PACKAGE["main"]() == 0
    asked(engine, "build", "--file", "packaging/Containerfile", "--tag", "servodeck-under-test", ".")
    rights = ["--read-only", "--tmpfs", "/tmp", "--cap-drop", "ALL", "--security-opt", "no-new-privileges"]
    began = [engine, "run", "--detach", *rights, "--publish", "127.0.0.1::8300", "servodeck-under-test"]
    container = asked(*began)
    try:
        place = asked(engine, "port", container, "8300").splitlines()[0]
        assert eventually(lambda: health_at(place) == "ready"), asked(engine, "logs", container)
        assert asked(engine, "exec", container, "id", "-u") == "10001"
        refused = [engine, "exec", container, "touch", "/usr/here"]
        assert subprocess.run(refused, capture_output=True, check=False).returncode != 0
    finally:
        asked(engine, "rm", "--force", container)


def health_at(place: str) -> str | None:
    """None while nothing answers."""
    try:
        with urlopen(f"http://{place}/api/health", timeout=2) as answer:
            status: str = json.load(answer)["status"]
            return status
    except OSError:
        return None
