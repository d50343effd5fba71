"""The simulated board itself behind the gateway's port, both in virtual time: bytes in at a time, bytes out
at theirs, when each servo's pulse changed last, and how far a STOP threw it.
Board: shared/src/robot/lockstepUnderTest.ts.

Bytes go to the board's process when it may answer, and not before: most histories need few round trips.
"""

import asyncio
import json
import shutil
import subprocess
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import Any

from servodeck.errors import PortMissingError
from servodeck.port.ports import OpenPort
from servodeck.port.whereabouts import UsbDevice
from servodeck.protocol.decoder import COMMAND_AT
from tests.fake_port import FakePort
from tests.virtual_time import VirtualTimeLoop, at, now

ENTRY = Path(__file__).parents[2] / "build" / "lockstep.mjs"
NODE = shutil.which("node")
SERVOS = (1, 2, 6)
# Longer than any answer takes (S33, S34).
ANSWERS_WITHIN_S = 4.0
STOP, MOVE, RUN = 7, 3, 6

History = dict[str, Any]


class Simulator:
    """The process: one board at a time."""

    def __init__(self) -> None:
        assert NODE
        self._process = subprocess.Popen(
            [NODE, str(ENTRY)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )

    def ask(self, **request: Any) -> Any:
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.write(json.dumps(request) + "\n")
        return json.loads(self._process.stdout.readline())

    def draw(self, board: str, seed: int, count: int, kind: str = "any") -> list[History]:
        """Of the kind `plain` the gateway knows all that moves the robot; of the kind `situation` each ends
        in what a STOP must not make worse.
        """
        drawn: list[History] = self.ask(draw=board, seed=seed, count=count, kind=kind)
        return drawn

    def end(self) -> None:
        self._process.kill()
        self._process.communicate()


class SteppedBoard:
    """It follows the clock of the running loop."""

    def __init__(
        self,
        simulator: Simulator,
        board: str,
        history: History,
        faults: Sequence[dict[str, Any]] = (),
        sampled: dict[str, Any] | None = None,
    ) -> None:
        """With `faults` it may say something at any time. `sampled`: `servos`, whose pulses are noted every
        `everyMs`.
        """
        self._simulator = simulator
        watched = {"sampled": sampled} if sampled else {}
        simulator.ask(start=board, history=history, faults=list(faults), **watched)
        self.samples: list[list[int]] = []
        self._happened: list[tuple[float, str]] = []
        self._talks_until_s = inf if faults else 0.0
        self.is_running = False
        self.ports: list[BoardPort] = []
        self.is_plugged = True
        self.last_byte_s = 0.0
        self.runs = 0
        """So many have begun to leave."""
        self.moved_s: Sequence[float] = [0.0 for _ in SERVOS]
        self.thrown_by: Sequence[float] = [0.0 for _ in SERVOS]
        """Of each servo, the farthest that a STOP moved it off its way."""
        self.met: Sequence[str] = ()
        """What the last STOP met."""
        loop = asyncio.get_running_loop()
        assert isinstance(loop, VirtualTimeLoop)
        loop.jumping.goes_to = self._follow

    # As ports of the gateway

    async def open(self, device: str) -> FakePort:
        if not self.is_plugged:
            raise PortMissingError(f"There is no {device}.")
        self.ports.append(BoardPort(self))
        return self.ports[-1]

    async def close(self, port: OpenPort) -> None:
        port.close()

    async def list_usb(self) -> list[UsbDevice]:
        return []

    async def find_rate(self, device: str) -> None:
        """Nothing that can be read arrives there."""

    # What happens to it

    def take(self, data: bytes) -> None:
        self.note(data.hex())
        self.runs += data[COMMAND_AT] == RUN
        if data[COMMAND_AT] not in (STOP, MOVE):
            # A run may be reported at any time from then on.
            lasts_s = inf if data[COMMAND_AT] == RUN else ANSWERS_WITHIN_S
            self._talks_until_s = max(self._talks_until_s, now() + lasts_s)

    def note_press(self) -> None:
        """A STOP begins now."""
        self.note("press")

    def note_resume(self) -> None:
        self.note("resume")

    def restart(self) -> None:
        """It loses its power for a moment."""
        self._talks_until_s = inf  # some say so
        self.note("restart")

    def disturb(self, noise: str) -> None:
        """These bytes reach it, though nobody sent them (hexadecimal)."""
        self._talks_until_s = inf  # what it takes apart may be a run
        self.note(f"noise {noise}")

    def lose(self, for_s: float) -> None:
        if not (self.ports and self.is_plugged):
            return
        self.is_plugged = False
        self.note("unplug")
        if self.ports[-1].is_open:
            self.ports[-1].unplug()
        at(now() + for_s, self._plug_in)

    def run_on(self, until_s: float) -> float:
        """Until then, or until it says something; returns when."""
        until_ms = until_s * 1000
        answer = self._simulator.ask(untilMs=until_ms, happened=self._happened)
        assert "early" not in answer, answer
        self._happened = []
        self.is_running = answer["isRunning"]
        self.samples += answer["samples"]
        self.moved_s = [moved_ms / 1000 for moved_ms in answer["movedMs"]]
        self.thrown_by, self.met = answer["thrownBy"], answer["met"]
        if answer["said"]:
            # That was one byte, and what is behind it may belong to the same report.
            self._talks_until_s = max(self._talks_until_s, answer["atMs"] / 1000 + ANSWERS_WITHIN_S)
        if answer["said"] and self.ports and self.ports[-1].is_open:
            self.ports[-1].say(bytes.fromhex(answer["said"]))
        return until_s if answer["atMs"] == until_ms else float(answer["atMs"]) / 1000

    def _plug_in(self) -> None:
        self.is_plugged = True
        self.note("plugIn")

    def note(self, what: str) -> None:
        """Bytes in hex that reach it now, or what happens to its cable."""
        self._happened.append((now() * 1000, what))

    def _follow(self, at_s: float) -> float:
        may_talk = self.is_running or now() < self._talks_until_s
        return self.run_on(at_s) if may_talk else at_s


class BoardPort(FakePort):
    def __init__(self, board: SteppedBoard) -> None:
        super().__init__()
        self._board = board

    def write(self, data: bytes) -> None:
        super().write(data)
        self._board.take(data)
