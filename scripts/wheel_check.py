"""Builds the wheel and uses it as a person who installed it would: in its own environment, without Node.

Needs the built page, without which the wheel would build all the same. The libraries are those of the
environment that runs this, so that nothing is fetched.
"""

import os
import re
import signal
import socket
import subprocess
import sys
import sysconfig
import tempfile
import time
import venv
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from zipfile import ZipFile

import httpx2
from websockets.sync.client import connect

NEEDED = (
    "servodeck/py.typed",
    "servodeck/static/third-party-licences.txt",
    *("servodeck/static/index.html", "servodeck/static/index.html.br", "servodeck/__main__.py"),
    *(f"servodeck/protocol/{name}.json" for name in ("families", "robots", "timings")),
    "servodeck/protocol/bluetooth.json",
    "servodeck/protocol/usb.json",
)
STOP = bytes.fromhex("55550207")
# In KiB of gzipped JavaScript; see ADR 20. What makes it grow comes later, or pays for it.
FIRST_LOAD_KIB = 180
READY = re.compile(r"Servodeck is at (\S+)")
END_S = 3.0
BIN = "Scripts" if os.name == "nt" else "bin"


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        wheel = build(Path(folder))
        names = ZipFile(wheel).namelist()
        missing = set(NEEDED) - set(names)
        if missing:
            print(f"{wheel.name} lacks {', '.join(sorted(missing))}")
            return 1
        first_kib = first_load_kib(ZipFile(wheel))
        if first_kib > FIRST_LOAD_KIB:
            print(f"The page's first load is {first_kib:.0f} KiB, wanted at most {FIRST_LOAD_KIB}")
            return 1
        if any("gallery" in name for name in names):
            print(f"{wheel.name} has the gallery, which is for those who build the page")
            return 1
        if os.name == "posix":  # the end below is a signal
            use(install(wheel, Path(folder) / "installed"), Path(folder))
    return 0


def first_load_kib(wheel: ZipFile) -> float:
    """The scripts that a browser fetches before the dashboard is there: those that index.html names."""
    index = wheel.read("servodeck/static/index.html").decode()
    scripts = set(re.findall(r'(?:src|href)="\./(assets/[^"]+[.]js)"', index))
    sizes = [wheel.getinfo(f"servodeck/static/{script}.gz").file_size for script in scripts]
    assert sizes, "index.html names no script"
    return sum(sizes) / 1024


def build(folder: Path) -> Path:
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    (wheel,) = folder.glob("*.whl")
    return wheel


def install(wheel: Path, environment: Path) -> Path:
    """The folder of the installed commands."""
    venv.create(environment, symlinks=True)
    commands = environment / BIN
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", str(commands / "python")]
    subprocess.run([*pip, "install", "--quiet", "--no-deps", "--no-index", str(wheel)], check=True)
    where = {"base": str(environment), "platbase": str(environment)}
    packages = Path(sysconfig.get_path("purelib", "venv", where))
    # A path inside such a file is taken as it stands: our own source beside those libraries is not seen.
    (packages / "libraries.pth").write_text(sysconfig.get_path("purelib"))
    return commands


def use(commands: Path, folder: Path) -> None:
    """Raises where anything is not as it should be."""
    with socket.create_server(("127.0.0.1", 0)) as board, served(commands, folder, board) as process:
        connection, _ = board.accept()
        assert process.stdout
        ready = READY.match(process.stdout.readline())
        assert ready, "it does not say where it is"
        opening = connection.recv(100)
        assert opening == STOP * (len(opening) // len(STOP)), (
            "the board hears something else than stops at first"
        )
        ask(ready[1])
        leave(process, connection)


@contextmanager
def served(commands: Path, folder: Path, board: socket.socket) -> Iterator["subprocess.Popen[str]"]:
    serve = [str(commands / "servodeck"), "serve", "--listen", "127.0.0.1:0", "--no-open"]
    more = ["--serial", f"socket://127.0.0.1:{board.getsockname()[1]}", "--data", str(folder / "data")]
    # No Node, no source and no settings of the present account.
    variables = {"PATH": str(commands), "HOME": str(folder)}
    process = subprocess.Popen([*serve, *more], stdout=subprocess.PIPE, text=True, env=variables, cwd=folder)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def ask(url: str) -> None:
    page = httpx2.get(url).raise_for_status().text
    scripts = re.findall(r'src="\./(assets/[^"]+\.js)"', page)
    assert scripts, "the page names no script"
    for script in scripts:
        httpx2.get(f"{url}/{script}").raise_for_status()
    licences = httpx2.get(f"{url}/third-party-licences.txt").raise_for_status()
    assert "react-dom" in licences.text
    health = httpx2.get(f"{url}/api/health").json()
    assert health["status"] == "ready", health
    with connect(f"ws{url.removeprefix('http')}/ws", close_timeout=0) as client:
        welcome = client.recv(5)
        assert '"type":"welcome"' in str(welcome), welcome


def leave(process: "subprocess.Popen[str]", board: socket.socket) -> None:
    begun_s = time.monotonic()
    process.send_signal(signal.SIGTERM)
    assert process.wait(END_S) == 0
    assert time.monotonic() - begun_s <= END_S
    heard = b"".join(iter(lambda: board.recv(100), b""))  # the questions about which board it is, too
    assert heard.endswith(STOP), "it ends without a stop"


if __name__ == "__main__":
    sys.exit(main())
