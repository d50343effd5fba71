"""Eight gateways as people run them, each with a simulated board on a pty, on a Mosquitto of their own. STOP
for all is pressed at a console; then STOP at one gateway's own door, while nothing else happens, and while
somebody floods the broker with moves for it.

Prints as JSON, in milliseconds, from the press to the first byte of a stop on each wire, and how many moves
were sent in a second of the flood.
Usage: fleet_wires.py PRESSES LOCAL_PRESSES
"""

import json
import logging
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.request import Request, urlopen

from servodeck.fleet.console import Console
from tests.fleet import console_of, eventually
from tests.mosquitto import Mosquitto
from tests.real_fleet import RealGateway, real_fleet

STOP = 7
NAMES = [f"arm-{number}" for number in range(8)]
PATIENCE_S = 60.0
# The repetitions of a STOP and its hold are over.
PAUSE_S = 0.5


def main() -> None:
    logging.disable(logging.WARNING)  # of brokers that come and go
    presses, local_presses = map(int, sys.argv[1:])
    with TemporaryDirectory() as name:
        folder = Path(name)
        with (
            Mosquitto(folder / "broker", NAMES) as mosquitto,
            real_fleet(mosquitto, NAMES, folder) as gateways,
            console_of(mosquitto, "anna") as console,
        ):
            must(eventually(lambda: all(map(console.is_present, NAMES)), PATIENCE_S))
            all_ms = [ms for _ in range(presses) for ms in stop_all(console, gateways)]
            quiet_ms = [stop_locally(gateways[0]) for _ in range(local_presses)]
            flood = subprocess.Popen(
                [sys.executable, "bench/fleet_flood.py", str(mosquitto.port), str(mosquitto.folder)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
            )
            assert flood.stdout
            flood.stdout.readline()
            begun_s = time.monotonic()
            flooded_ms = [stop_locally(gateways[0]) for _ in range(local_presses)]
            sent = int(flood.communicate("")[0])
            per_s = sent / (time.monotonic() - begun_s)
    json.dump({"allMs": all_ms, "quietMs": quiet_ms, "floodedMs": flooded_ms, "floodPerS": per_s}, sys.stdout)


def must(is_so: bool) -> None:
    if not is_so:
        raise SystemExit("It never came to that: the computer is too busy.")


def stop_all(console: Console, gateways: Sequence[RealGateway]) -> list[float]:
    for gateway in gateways:
        console.ask(gateway.name, "resume")
    console.withdraw_holds()
    time.sleep(PAUSE_S)
    pressed_s = time.monotonic()
    must(len(console.stop_all(PATIENCE_S).stopped) == len(gateways))
    return [stopped_ms(gateway, pressed_s) for gateway in gateways]


def stop_locally(gateway: RealGateway) -> float:
    post(gateway, "resume")
    time.sleep(PAUSE_S)
    pressed_s = time.monotonic()
    post(gateway, "stop")
    return stopped_ms(gateway, pressed_s)


def post(gateway: RealGateway, what: str) -> None:
    headers = {"content-type": "application/json"}
    with urlopen(Request(f"{gateway.served.url}/api/{what}", b"{}", headers, method="POST")):
        pass


def stopped_ms(gateway: RealGateway, pressed_s: float) -> float:
    def stops_s() -> list[float]:
        return [at_s for at_s, command in gateway.packets() if command == STOP and at_s >= pressed_s]

    must(eventually(lambda: bool(stops_s()), PATIENCE_S))
    return (stops_s()[0] - pressed_s) * 1000


if __name__ == "__main__":
    main()
