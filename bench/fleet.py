"""Robots on a Mosquitto of their own that start a group together, each by another clock, and are stopped all
at once: real robot cores and connections, some in a process, on ports that note when a packet is written.
With MOST_MS a proxy between them and the broker delays what passes, in each direction, by 0 to so many
milliseconds.

Prints the milliseconds as JSON: between the agreed start and the run of each, between the press and the first
stop of each, and until all were known to be stopped; and 1 for each attempt that started, 0 for the others.
Usage: fleet.py ROBOTS ROUNDS MOST_MS
"""

import json
import logging
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from servodeck.fleet.console import Console
from servodeck.fleet.together import UncertainError, start_together
from tests.fleet import console_of, eventually
from tests.light_fleet import RUN, STOP, LightFleet
from tests.mosquitto import Mosquitto

SLOT = 3
AHEAD_S = 100.0
KEYS = ("startErrorMs", "stopByteMs", "stopKnownMs", "startedOf")
IN_EACH = 15
PATIENCE_S = 60.0
# A start is refused where a clock is not sure; people press again.
ATTEMPTS = 5


def main() -> None:
    logging.disable(logging.WARNING)  # of brokers that come and go
    robots, rounds, most_ms = map(int, sys.argv[1:])
    names = [f"arm-{number}" for number in range(robots)]
    figures: dict[str, list[float]] = {key: [] for key in KEYS}
    with (
        TemporaryDirectory() as folder,
        Mosquitto(Path(folder) / "broker", names) as mosquitto,
        proxy_before(mosquitto.port, most_ms) as port,
    ):
        for _ in range(rounds):
            ahead_s = {name: number * AHEAD_S for number, name in enumerate(names)}
            fleet = LightFleet(mosquitto, ahead_s, port, in_each=IN_EACH)
            try:
                with console_of(mosquitto, "anna") as console:
                    must(eventually(lambda: all(map(console.is_present, names)), PATIENCE_S))
                    measure(console, names, fleet, figures)
            finally:
                fleet.end()
    json.dump(figures, sys.stdout)


@contextmanager
def proxy_before(port: int, most_ms: int) -> Iterator[int]:
    """The port to use. It is a process of its own, so that it holds up nobody but for what it should."""
    if not most_ms:
        yield port
        return
    command = [sys.executable, "-m", "tests.tcp_proxy", str(port), "0", str(most_ms)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as proxy:
        assert proxy.stdout
        assert proxy.stdin
        try:
            yield int(proxy.stdout.readline())
        finally:
            proxy.stdin.close()


def must(is_so: bool) -> None:
    if not is_so:
        raise SystemExit("It never came to that: the computer is too busy.")


def measure(
    console: Console, names: Sequence[str], fleet: LightFleet, figures: dict[str, list[float]]
) -> None:
    for name in names:
        console.ask(name, "ask", action="request")
        console.beat()
    start_s = started(console, names, figures)
    started_s = first_of(RUN, fleet, start_s - 1)
    figures["startErrorMs"] += [abs(at_s - start_s) * 1000 for at_s in started_s]
    pressed_s = time.monotonic()
    report = console.stop_all()
    figures["stopKnownMs"].append((time.monotonic() - pressed_s) * 1000)
    must(len(report.stopped) == len(names))
    figures["stopByteMs"] += [(at_s - pressed_s) * 1000 for at_s in first_of(STOP, fleet, pressed_s)]
    console.withdraw_holds()
    must(console.until(lambda: not console.holds, 5))  # the next robots are not stopped by this one


def started(console: Console, names: Sequence[str], figures: dict[str, list[float]]) -> float:
    for _ in range(ATTEMPTS):
        with suppress(UncertainError):
            start_s = start_together(console, names, SLOT)
            figures["startedOf"].append(1.0)
            return start_s
        figures["startedOf"].append(0.0)
    raise SystemExit("No clock is known well enough: the computer is too busy.")


def first_of(number: int, fleet: LightFleet, since_s: float) -> list[float]:
    """When each has written its first such packet since then, by this computer's clock."""
    must(eventually(lambda: len(fleet.first_s(number, since_s)) == len(fleet.names), PATIENCE_S))
    return list(fleet.first_s(number, since_s).values())


if __name__ == "__main__":
    main()
