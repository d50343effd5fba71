"""Several gateways as people run them, for tests and benchmarks: `servodeck serve` in a process each, with a
simulated board on a pty of its own.
"""

import json
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from servodeck.protocol.decoder import COMMAND_AT
from tests.mosquitto import LAB, Mosquitto
from tests.test_cli import Served
from tests.test_ports import Pty
from tests.test_with_simulator import Board

LENGTH_AT = 2


class RealGateway:
    def __init__(self, name: str, mosquitto: Mosquitto, folder: Path, *more: str) -> None:
        """On the broker by and by; `more`: options of `servodeck serve`."""
        self.name = name
        self.board = Board(folder / f"{name}.port", folder / f"{name}.jsonl")
        self.board.plug()
        where = ["--mqtt", f"mqtt://{name}@127.0.0.1:{mosquitto.port}", "--mqtt-site", LAB.name]
        files = ["--mqtt-password-file", str(mosquitto.folder / "secrets" / name)]
        data = ["--data", str(folder / f"{name}.data"), "--serial", str(self.board.link)]
        self.served = Served(*where, *files, *data, *more, pty=Pty(), is_named=False)

    def end(self) -> None:
        self.served.end()
        self.board.pull()

    def packets(self) -> list[tuple[float, int]]:
        """Of each that has reached the board: when its first byte did (`time.monotonic`), and the command."""
        taken, packets, at = self.board.taken(), [], 0
        head = json.loads(self.board.log.read_text().partition("\n")[0])
        begun_s = head["startedAtMonotonicMs"] / 1000
        while at + COMMAND_AT < len(taken):
            packets.append((begun_s + taken[at][0] / 1000, taken[at + COMMAND_AT][1]))
            at += LENGTH_AT + taken[at + LENGTH_AT][1]
        return packets

    def count(self, *commands: int, since_s: float = 0.0) -> int:
        return sum(at_s >= since_s and command in commands for at_s, command in self.packets())


@contextmanager
def real_fleet(
    mosquitto: Mosquitto, names: Sequence[str], folder: Path, *more: str
) -> Iterator[list[RealGateway]]:
    """They take seconds to start, so all at once."""
    with ThreadPoolExecutor(len(names)) as pool:
        starting = [pool.submit(RealGateway, name, mosquitto, folder, *more) for name in names]
    try:
        yield [one.result() for one in starting]
    finally:
        for one in starting:
            if not one.exception():
                one.result().end()
