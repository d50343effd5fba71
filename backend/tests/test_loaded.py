"""What a start does not load, because nothing that is served at first needs it."""

import subprocess
import sys

import pytest

# Pictures of links, names on the network, a browser, colours, other clients, and what would report elsewhere.
NOT_TO_SERVE = (
    *("segno", "ifaddr", "zeroconf", "webbrowser", "rich", "pygments", "jinja2", "yaml", "email_validator"),
    *("httpx", "httpx2", "requests", "multipart", "fastapi.testclient"),
    *("opentelemetry.sdk", "opentelemetry.exporter", "google.protobuf", "grpc"),
)
# What a start does not wait for.
NOT_AT_FIRST = (
    *("servodeck.api.robot", "servodeck.api.motion", "servodeck.api.library", "servodeck.api.people"),
    *("servodeck.api.openapi", "servodeck.cli.commands", "prometheus_client"),
)
NOT_FOR_A_COMMAND = ("fastapi", "starlette", "uvicorn", "prometheus_client", "asyncio")
# Where the gateway would begin to serve, it says what is loaded and leaves.
SERVE = """
from servodeck.api.server import Server
def run(self, sockets):
    print(*sys.modules, flush=True)
Server.run = run
"""
# A port that is closed, what was remembered.
HELD_FROM_THE_START = {"PortState", "Memory"}
# There, too: the messages whose validators are built by then.
BUILT = """
from servodeck.api.server import Server
def run(self, sockets):
    from servodeck.schema import Message
    def kinds(kind):
        return [kind, *(each for below in kind.__subclasses__() for each in kinds(below))]
    print(*(kind.__name__ for kind in kinds(Message) if kind.__pydantic_complete__), flush=True)
    import os
    os._exit(0)
Server.run = run
"""


def words_of(*arguments: str, before: str = "") -> set[str]:
    """Of its last line, each word once."""
    program = f"import sys\n{before}\nsys.argv[1:] = {list(arguments)}\nfrom servodeck.__main__ import main\n"
    ending = "try:\n    main()\nfinally:\n    print(*sys.modules)\n"
    said = subprocess.check_output([sys.executable, "-c", program + ending], text=True)
    return set(said.splitlines()[-1].split())


def test_a_start_loads_what_it_serves_with_and_no_more(tmp_path: object) -> None:
    loaded = words_of("serve", "--listen", "127.0.0.1:0", "--data", str(tmp_path), "--no-open", before=SERVE)
    assert "servodeck.api.app" in loaded
    assert sorted(loaded & {*NOT_TO_SERVE, *NOT_AT_FIRST}) == []


def test_a_start_builds_no_message_before_it_is_used(tmp_path: object) -> None:
    built = words_of("serve", "--listen", "127.0.0.1:0", "--data", str(tmp_path), "--no-open", before=BUILT)
    assert built <= HELD_FROM_THE_START


@pytest.mark.parametrize("arguments", [("--version",), ("decode", "55", "55", "02", "07")])
def test_a_small_command_loads_no_gateway(arguments: tuple[str, ...]) -> None:
    loaded = words_of(*arguments)
    assert "servodeck.cli.main" in loaded
    assert sorted(loaded & set(NOT_FOR_A_COMMAND)) == []
