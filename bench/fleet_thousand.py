"""Very many gateways on one Mosquitto: real robot cores and connections in a few processes on the same
computer, some of them driven 20 times a second. Then all are stopped, again and again, and last the broker is
killed.

Prints as JSON, in milliseconds: from a state's publication to its arrival at the console, from the driver's
word to the wire, the library alone on the same broker meanwhile; from the press to each first stop, and until
all were known; until all were back. And what the broker spent.
Usage: fleet_thousand.py ROBOTS DRIVEN SECONDS PRESSES
"""

import json
import logging
import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from servodeck.fleet.console import Console
from servodeck.fleet.messages import State
from servodeck.fleet.rules import Received
from tests.fleet import console_of, eventually
from tests.light_fleet import STOP, LightFleet
from tests.mosquitto import Mosquitto

PERIOD_S, BEAT_EVERY = 0.05, 5
STATE_BYTES = 600
FIRST_POSITION, POSITIONS = 600, 1800
PATIENCE_S = 120.0
LOOK_S = 0.05
KNOWN_S = 20.0


def main() -> None:
    logging.disable(logging.WARNING)  # of brokers that come and go
    robots, driven, seconds, presses = map(int, sys.argv[1:])
    names = [f"arm-{number}" for number in range(robots)]
    with TemporaryDirectory() as folder:
        mosquitto = Mosquitto(Path(folder) / "broker", [*names, "probe"])
        mosquitto.start()
        fleet = LightFleet(mosquitto, dict.fromkeys(names, 0.0), apart=driven)
        try:
            with console_of(mosquitto, "anna") as console:
                must(lambda: are_present(console, robots))
                figures = {
                    **traffic(mosquitto, fleet, console, names[:driven], seconds),
                    **stops(fleet, console, robots, presses),
                    **storm(mosquitto, fleet, console, robots),
                }
        finally:
            fleet.end()
            mosquitto.kill()
    json.dump(figures, sys.stdout)


def must(is_so: Callable[[], bool]) -> None:
    if not eventually(is_so, PATIENCE_S, LOOK_S):
        raise SystemExit("It never came to that: the computer is too busy.")


def are_present(console: Console, robots: int) -> bool:
    return [robot.presence for robot in console.robots()] == ["present"] * robots


def traffic(
    mosquitto: Mosquitto, fleet: LightFleet, console: Console, driven: Sequence[str], seconds: int
) -> dict[str, object]:
    arrived: list[Received] = []
    take = console.received

    def taking(received: Received) -> None:
        arrived.append(received)
        take(received)

    for name in driven:
        console.ask(name, "ask", action="request", timeout_s=PATIENCE_S)
    fleet.ask("note")
    console.received = taking  # type: ignore[method-assign]
    bare = subprocess.Popen(
        [
            *(sys.executable, "bench/bare_mqtt.py", str(mosquitto.port)),
            *(str(mosquitto.folder / "secrets"), str(seconds), str(STATE_BYTES)),
        ],
        stdout=subprocess.PIPE,
        text=True,
    )
    cpu_s, begun_s = cpu_of(mosquitto.pid), time.monotonic()
    said_s = drive(console, driven, seconds)
    spent_s = time.monotonic() - begun_s
    cpu_percent = (cpu_of(mosquitto.pid) - cpu_s) / spent_s * 100
    console.received = take  # type: ignore[method-assign]
    bare_ms = json.loads(bare.communicate()[0])
    said = {name: times for part in fleet.ask("said") for name, times in part.items()}
    moves = {name: times for part in fleet.ask("moves") for name, times in part.items()}
    return {
        "stateMs": [
            (state.at_s - said[name][count]) * 1000
            for state in arrived
            if state.topic.endswith("/state")
            and (name := state.topic.split("/")[3])
            and (count := count_of(state.payload)) in said[name]
        ],
        "moveMs": [
            (at_s - said_s[name][position]) * 1000
            for name in driven
            for at_s, position in moves[name]
            if position in said_s[name]
        ],
        "movesSaid": sum(map(len, said_s.values())),
        "bareMs": bare_ms,
        "arrivedPerS": len(arrived) / spent_s,
        "brokerCpuPercent": cpu_percent,
        "brokerRssMiB": rss_of(mosquitto.pid),
        "gatewayRssMiB": sum(map(rss_of, fleet.pids)) / len(fleet.names),
    }


def count_of(payload: bytes) -> str:
    return str(State.model_validate_json(payload).count)


def drive(console: Console, driven: Sequence[str], seconds: int) -> dict[str, dict[int, float]]:
    """When each position was said."""
    said_s: dict[str, dict[int, float]] = {name: {} for name in driven}
    begun_s = time.monotonic()
    for number in range(int(seconds / PERIOD_S)):
        time.sleep(max(0.0, begun_s + number * PERIOD_S - time.monotonic()))
        if number % BEAT_EVERY == 0:
            console.beat()
        position = FIRST_POSITION + number % POSITIONS
        for name in driven:
            said_s[name][position] = time.monotonic()
            console.request(name, "move", targets=[{"servo": 1, "position": position}], duration_ms=50)
    return said_s


def stops(fleet: LightFleet, console: Console, robots: int, presses: int) -> dict[str, object]:
    first_ms: list[float] = []
    known_ms: list[float] = []
    missing = 0
    for _ in range(presses):
        must(lambda: are_present(console, robots))
        pressed_s = time.monotonic()
        report = console.stop_all(KNOWN_S)
        known_ms.append((time.monotonic() - pressed_s) * 1000)
        missing += robots - len(report.stopped)
        first_ms += [(at_s - pressed_s) * 1000 for at_s in all_stopped_s(fleet, pressed_s)]
        console.withdraw_holds()
        fleet.ask("resume")
        time.sleep(1)  # what it has set off is over
    return {"stopByteMs": first_ms, "stopKnownMs": known_ms, "missing": missing}


def all_stopped_s(fleet: LightFleet, since_s: float) -> list[float]:
    must(lambda: len(fleet.first_s(STOP, since_s)) == len(fleet.names))
    return list(fleet.first_s(STOP, since_s).values())


def storm(mosquitto: Mosquitto, fleet: LightFleet, console: Console, robots: int) -> dict[str, object]:
    must(lambda: are_present(console, robots))
    console.stop_all(PATIENCE_S)
    must(lambda: fleet.count("latched") == robots)
    mosquitto.kill()
    must(lambda: all(robot.presence == "silent" for robot in console.robots()))
    mosquitto.start()
    begun_s = time.monotonic()
    must(lambda: are_present(console, robots) and all(r.state and r.state.latch for r in console.robots()))
    return {"backMs": (time.monotonic() - begun_s) * 1000}


def cpu_of(pid: int) -> float:
    """Seconds of a core."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def rss_of(pid: int) -> float:
    """MiB."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024


if __name__ == "__main__":
    main()
