"""HTTPS by the Caddyfile that is shipped: a real Caddy with its own CA before a real gateway, on loopback."""

import json
import os
import re
import shutil
import socket
import ssl
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import pytest
from httpx2 import Client
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from servodeck.events import PROTOCOL
from servodeck.notify.conditions import Due
from servodeck.notify.notifications import notice_of
from servodeck.notify.receivers import parse_receiver
from servodeck.notify.sender import Sender
from tests.test_cli import Served
from tests.test_client import has

ROOT = Path(__file__).resolve().parents[2]
# `npm test` fetches one into build/.
CADDY = shutil.which("caddy", path=f"{os.environ['PATH']}{os.pathsep}{ROOT / 'build/caddy/usr/bin'}")
READY_S = 30.0
CADDYFILE = ROOT / "packaging/caddy/Caddyfile"
# Nothing of it leaves the folder or this computer, and it takes no usual port.
AROUND = """\
{{
	admin off
	skip_install_trust
	http_port {http}
	default_bind 127.0.0.1
	storage file_system {folder}
}}
import {caddyfile}
"""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        CADDY is None, reason="Caddy is not installed (on Debian or Ubuntu: apt install caddy)"
    ),
]


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port: int = free.getsockname()[1]
        return port


@dataclass
class Site:
    url: str
    gateway: str
    trust: ssl.SSLContext
    code: str


@pytest.fixture
def site(tmp_path: Path) -> Iterator[Site]:
    url = f"https://localhost:{free_port()}"
    served = Served("--public-url", url, "--data", str(tmp_path / "data"), "--log-level", "warning")
    try:
        code = code_in(served)
        with caddy(tmp_path, url, served.url) as trust:
            yield Site(url, served.url, trust, code)
    finally:
        served.end()


def code_in(served: Served) -> str:
    """The eight digits for the first owner."""
    assert served.process.stdout
    for line in served.process.stdout:
        if found := re.search(r"type (\d{4}) (\d{4}) there", line):
            return found[1] + found[2]
    raise AssertionError("the gateway prints no code")


@contextmanager
def caddy(folder: Path, url: str, gateway: str) -> Iterator[ssl.SSLContext]:
    """What trusts its CA, once it serves that address."""
    config = folder / "Caddyfile"
    config.write_text(AROUND.format(http=free_port(), folder=folder / "caddy", caddyfile=CADDYFILE))
    named = {"SERVODECK_PUBLIC_URL": url, "SERVODECK_LISTEN": gateway.removeprefix("http://")}
    here = {"HOME": str(folder), "XDG_CONFIG_HOME": str(folder), "XDG_DATA_HOME": str(folder)}
    command = [CADDY or "", "run", "--config", str(config), "--adapter", "caddyfile"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env={**here, **named}) as process:
        try:
            assert process.stderr
            said: list[str] = []
            is_ready = threading.Event()
            threading.Thread(target=read, args=(process.stderr, said, is_ready), daemon=True).start()
            assert is_ready.wait(READY_S), "".join(said)
            root = folder / "caddy/pki/authorities/local/root.crt"
            trust = ssl.create_default_context(cafile=str(root))
            has(lambda: shakes_hands(url, trust))  # it says so before it uses it
            yield trust
        finally:
            process.kill()


def read(stream: IO[str], said: list[str], is_ready: threading.Event) -> None:
    """To the end: once a pipe is full, who writes to it waits."""
    for line in stream:
        said.append(line)
        if "certificate obtained successfully" in line:
            is_ready.set()


def shakes_hands(url: str, trust: ssl.SSLContext) -> bool:
    host, _, port = url.removeprefix("https://").rpartition(":")
    with (
        socket.create_connection(("127.0.0.1", int(port)), 5) as plain,
        suppress(ssl.SSLError),
        trust.wrap_socket(plain, server_hostname=host),
    ):
        return True
    return False


def test_page_pairing_socket_and_stop_work_over_https_and_no_other_name_does(site: Site) -> None:
    headers = {"origin": site.url}
    with Client(base_url=site.url, verify=site.trust, headers=headers) as client:
        assert "<title>Servodeck" in client.get("/").text
        assert client.get("/api/status").status_code == 401
        paired = client.post("/api/pair", json={"code": site.code, "name": "Anna"})
        assert paired.json()["role"] == "owner"
        cookie = paired.headers["set-cookie"]
        assert cookie.startswith("__Host-servodeck=")
        assert {"Secure", "HttpOnly"} <= set(cookie.split("; "))
        token = cookie.partition(";")[0]
        address = f"wss{site.url.removeprefix('https')}/ws?protocol={PROTOCOL}"
        with connect(
            address,
            ssl=site.trust,
            origin=Origin(site.url),
            additional_headers={"cookie": token},
            close_timeout=0,
        ) as socket_:
            assert json.loads(socket_.recv(5))["type"] == "welcome"
            assert client.post("/api/stop").json()["halted"] is True
            states = (json.loads(socket_.recv(5)) for _ in range(20))
            stopped = next(state for state in states if state.get("latch"))
            assert stopped["stoppedBy"] == "Anna"
        with pytest.raises(InvalidStatus, match="403"):
            connect(
                address,
                ssl=site.trust,
                origin=Origin("https://evil.example"),
                additional_headers={"cookie": token},
            )
        # Neither Caddy nor the gateway itself answers to another name.
        elsewhere = client.get("/", headers={"host": "evil.example"})
        assert "Servodeck" not in elsewhere.text
    with Client(base_url=site.gateway) as inside:
        assert inside.get("/").status_code >= 400
    # A certificate of an authority that is not trusted gets no notification.
    outcome = Sender(parse_receiver(site.url), ()).deliver(notice_of(Due("test", "")))
    assert outcome.status == "dropped"
    assert "CERTIFICATE" in str(outcome.detail).upper()
