"""What the broker and one console take of a thousand gateways, where each of these has a computer of its own:
here one client speaks for all of them.

Prints as JSON, in milliseconds: from each state's publication until the console had it, and from the press of
STOP for all until all were known to have stopped. And how many were not.
Usage: fleet_console.py ROBOTS SECONDS PRESSES
"""

import json
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from servodeck.fleet.console import Console
from servodeck.fleet.messages import State
from servodeck.fleet.rules import Received
from tests.fleet import console_of, eventually, fleet_on
from tests.mosquitto import Mosquitto

STAND_IN = "stand-in"
PATIENCE_S = 60.0
KNOWN_S = 10.0


def main() -> None:
    robots, seconds, presses = map(int, sys.argv[1:])
    with TemporaryDirectory() as folder:
        mosquitto = Mosquitto(Path(folder) / "broker", ["arm-0", STAND_IN])
        with (mosquitto.folder / "acl").open("a") as acl:
            acl.write(f"user {STAND_IN}\ntopic readwrite #\n")
        mosquitto.start()
        try:
            state = Path(folder) / "state.json"
            state.write_text(state_of_one(mosquitto))
            command = [sys.executable, "bench/fleet_stand_in.py", str(mosquitto.port)]
            files = [str(mosquitto.folder / "secrets"), str(robots), str(state)]
            with console_of(mosquitto, "anna") as console, subprocess.Popen([*command, *files]) as stand_in:
                try:
                    figures = measured(console, robots, seconds, presses)
                finally:
                    stand_in.kill()
        finally:
            mosquitto.kill()
    json.dump(figures, sys.stdout)


def state_of_one(mosquitto: Mosquitto) -> str:
    """As a real gateway says it."""
    with fleet_on(mosquitto, ["arm-0"]), console_of(mosquitto, "anna", "arm-0") as console:
        robot = console.robot("arm-0")
        assert robot
        assert robot.state
        return robot.state.model_dump_json()


def measured(console: Console, robots: int, seconds: int, presses: int) -> dict[str, object]:
    assert eventually(lambda: present(console) == robots, PATIENCE_S)
    state_ms: list[float] = []
    take = console.received

    def taking(received: Received) -> None:
        take(received)
        if received.topic.endswith("/state"):
            said_s = float(State.model_validate_json(received.payload).nonce)
            state_ms.append((time.monotonic() - said_s) * 1000)

    console.received = taking  # type: ignore[method-assign]
    time.sleep(seconds)
    console.received = take  # type: ignore[method-assign]
    known_ms, missing = [], 0
    for _ in range(presses):
        pressed_s = time.monotonic()
        missing += len(console.stop_all(KNOWN_S).missing)
        known_ms.append((time.monotonic() - pressed_s) * 1000)
        time.sleep(1.0)  # the states that follow are over
    return {"stateMs": state_ms, "stopKnownMs": known_ms, "missing": missing}


def present(console: Console) -> int:
    return sum(robot.presence == "present" for robot in console.robots())


if __name__ == "__main__":
    main()
