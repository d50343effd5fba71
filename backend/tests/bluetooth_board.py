"""The simulated board behind a Bluetooth module, on the stand-in for BlueZ of scripts/bluetooth_board.py."""

import json
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
SIMULATOR = ROOT / "build" / "simulator.mjs"
NODE = shutil.which("node")


def why_not() -> str | None:
    """Why there can be none here, or None."""
    if sys.platform != "linux":
        return "BlueZ exists on Linux only"
    if shutil.which("dbus-daemon") is None:
        return "dbus-daemon is not installed (on Debian or Ubuntu: apt install dbus-daemon)"
    if NODE is None:
        return "Node is not installed"
    return None if SIMULATOR.exists() else "the simulator is not built: npm run build"


@dataclass
class BluetoothBoard:
    """`modules` as the script takes them; the board is behind the first."""

    folder: Path
    modules: tuple[str, ...] = ("Hiwonder",)
    bus_address: str = ""
    _process: subprocess.Popen[str] | None = field(default=None, repr=False)

    def start(self) -> None:
        modules = [f"--module={one}" for one in self.modules]
        board = [str(NODE), str(SIMULATOR), "--stdio", "--board", "doc", "--bus-log", str(self._log)]
        script = str(ROOT / "scripts" / "bluetooth_board.py")
        self._process = subprocess.Popen(
            [sys.executable, script, "--folder", str(self.folder / "bus"), *modules, "--", *board],
            stdin=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self._process.stderr
        self.bus_address = self._process.stderr.readline().removeprefix("bluetooth ").strip()
        assert self.bus_address.startswith("unix:"), self.bus_address

    def say(self, event: str) -> None:
        """An event of the script: drop, off, on, adapter off, adapter on."""
        assert self._process
        assert self._process.stdin
        self._process.stdin.write(f"{event}\n")
        self._process.stdin.flush()

    def end(self) -> None:
        if self._process:
            self._process.communicate(timeout=5)
            self._process = None

    @property
    def _log(self) -> Path:
        return self.folder / "bus.jsonl"

    def taken(self) -> bytes:
        """The bytes that reached the board since it was switched on."""
        *lines, _half_written = self._log.read_text().split("\n")
        entries = [json.loads(line) for line in lines[1:]]
        return bytes(entry["byte"] for entry in entries if entry["direction"] == "in")
