"""Robots on a Mosquitto of their own that start a group together, each by another clock, and are stopped all
at once: real robot cores and connections, all in this process, on ports that note when a packet is written.

Prints the milliseconds as JSON: between the agreed start and the run of each, between the press and the first
stop of each, and until all were known to be stopped.
Usage: fleet.py ROBOTS ROUNDS
"""

import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from servodeck.fleet.console import Console
from servodeck.fleet.together import start_together
from tests.fleet import Gateway, console_of, eventually, fleet_on
from tests.mosquitto import Mosquitto

RUN, STOP = 6, 7
SLOT = 3
AHEAD_S = 100.0


def main() -> None:
    robots, rounds = map(int, sys.argv[1:])
    names = [f"arm-{number}" for number in range(robots)]
    figures: dict[str, list[float]] = {"startErrorMs": [], "stopByteMs": [], "stopKnownMs": []}
    with TemporaryDirectory() as folder:
        mosquitto = Mosquitto(Path(folder) / "broker", names)
        mosquitto.start()
        try:
            for _ in range(rounds):
                with fleet_on(mosquitto, []) as (fleet, _):
                    gateways = [
                        fleet.join(name, mosquitto.broker_for(name), number * AHEAD_S)
                        for number, name in enumerate(names)
                    ]
                    with console_of(mosquitto, "anna", *names) as console:
                        measure(console, names, gateways, figures)
        finally:
            mosquitto.kill()
    json.dump(figures, sys.stdout)


def measure(
    console: Console, names: Sequence[str], gateways: Sequence[Gateway], figures: dict[str, list[float]]
) -> None:
    for name in names:
        console.ask(name, "ask", action="request")
    start_s = start_together(console, names, SLOT)
    figures["startErrorMs"] += [abs(at_s - start_s) * 1000 for at_s in first_of(RUN, gateways, start_s - 1)]
    pressed_s = time.monotonic()
    report = console.stop_all()
    figures["stopKnownMs"].append((time.monotonic() - pressed_s) * 1000)
    assert len(report.stopped) == len(names)
    figures["stopByteMs"] += [(at_s - pressed_s) * 1000 for at_s in first_of(STOP, gateways, pressed_s)]
    console.withdraw_holds()
    assert console.until(lambda: not console.holds, 5)  # the next robots are not stopped by this one


def first_of(number: int, gateways: Sequence[Gateway], since_s: float) -> list[float]:
    """When each has written its first such packet since then, by this process's clock."""

    def times_of(gateway: Gateway) -> list[float]:
        return [at_s for at_s, packet in gateway.board.written if packet[3] == number and at_s >= since_s]

    assert eventually(lambda: all(map(times_of, gateways)))
    return [times_of(gateway)[0] for gateway in gateways]


if __name__ == "__main__":
    main()
