"""A Mosquitto of its own for a test, on free ports of this computer, configured by `fleet.broker_config`;
never the system's service.
"""

import os
import shutil
import signal
import socket
import subprocess
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Self

import pytest

from servodeck.callers import Role
from servodeck.fleet.broker import Broker, parse_broker
from servodeck.fleet.broker_config import Encryption, Listener, Plan, write_config
from servodeck.fleet.topics import Site

PROGRAM = shutil.which("mosquitto", path=f"{os.environ.get('PATH', '')}:/usr/sbin:/usr/local/sbin")
needs_mosquitto = pytest.mark.skipif(PROGRAM is None, reason="Mosquitto is not installed")
needs_openssl = pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl is not installed")
LAB = Site("lab")
USERS: dict[str, Role] = {
    "anna": "driver",
    "ben": "driver",
    "olga": "owner",
    "vera": "viewer",
    "stan": "stopper",
}
READY_S = 10.0


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port: int = listener.getsockname()[1]
        return port


class Mosquitto:
    def __init__(
        self,
        folder: Path,
        gateways: Sequence[str],
        encryption: Encryption | None = None,
        *,
        websocket: bool = False,
    ) -> None:
        self.folder = folder
        self.port = free_port()
        self.websocket_port = free_port()
        self._encryption = encryption
        second = Listener(self.websocket_port, "127.0.0.1") if websocket else None
        self.plan = Plan("lab", gateways, USERS, Listener(self.port, "127.0.0.1"), second, encryption)
        self.configure()
        self._process: subprocess.Popen[str] | None = None

    def configure(self) -> None:
        write_config(self.plan, self.folder)
        if os.geteuid() == 0:  # it would become a user that may not read a test's folder
            with (self.folder / "mosquitto.conf").open("a") as file:
                file.write("user root\n")

    def start(self) -> None:
        assert PROGRAM
        self._process = subprocess.Popen(
            [PROGRAM, "-c", str(self.folder / "mosquitto.conf")], stderr=subprocess.PIPE, text=True
        )
        assert self._process.stderr
        is_ready = threading.Event()
        threading.Thread(target=drain, args=(self._process.stderr, is_ready), daemon=True).start()
        assert is_ready.wait(READY_S)

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.kill()

    def kill(self) -> None:
        if self._process:
            self._process.kill()
            self._process.wait()
            self._process = None

    def revoke(self, user: str) -> None:
        """As an administrator does it: takes the user out and has the running broker read its files again."""
        for file, line in (("passwords", f"{user}:"), ("acl", f"user {user}\n")):
            text = (self.folder / file).read_text()
            (self.folder / file).write_text(text.replace(line, line.replace(user, "nobody")))
        self.signal(signal.SIGHUP)

    def signal(self, number: signal.Signals) -> None:
        assert self._process
        self._process.send_signal(number)

    @property
    def pid(self) -> int:
        assert self._process
        return self._process.pid

    def broker_for(self, user: str, password: str | None = None) -> Broker:
        secret = password or (self.folder / "secrets" / user).read_text().strip()
        scheme, ca = ("mqtts", self._encryption.certificate) if self._encryption else ("mqtt", None)
        return parse_broker(f"{scheme}://{user}@127.0.0.1:{self.port}", secret, ca)


def drain(stream: IO[str], is_ready: threading.Event) -> None:
    with stream:
        for line in stream:
            if line.rstrip().endswith(" running"):
                is_ready.set()
