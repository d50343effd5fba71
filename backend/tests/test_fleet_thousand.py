"""A thousand gateways on one broker: seen, stopped, and back after the broker was killed. Order and safety
alone: `npm run bench -- --only fleet` measures how long it takes.
"""

import time
from collections.abc import Callable
from pathlib import Path

import pytest

from servodeck.fleet.console import Console
from tests.fleet import console_of, eventually
from tests.light_fleet import STOP, light_fleet
from tests.mosquitto import Mosquitto, needs_mosquitto

pytestmark = [pytest.mark.slow, pytest.mark.exhaustive, needs_mosquitto]
NAMES = [f"arm-{number}" for number in range(1000)]
# They all work on the cores of this computer, beside other tests.
PATIENCE_S, LOOK_S = 300.0, 0.5


def test_a_thousand_are_stopped_and_come_back_stopped(tmp_path: Path) -> None:
    with (
        Mosquitto(tmp_path / "broker", NAMES) as mosquitto,
        light_fleet(mosquitto, NAMES) as fleet,
        console_of(mosquitto, "anna") as console,
    ):
        assert becomes(console, "present")
        pressed_s = time.monotonic()
        console.stop_all(PATIENCE_S)
        assert patiently(lambda: fleet.count("latched") == len(NAMES))
        assert patiently(lambda: fleet.first_s(STOP, pressed_s).keys() == set(NAMES))
        mosquitto.kill()
        assert becomes(console, "silent")
        assert fleet.count("connected") == 0
        mosquitto.start()
        assert becomes(console, "present")
        assert patiently(lambda: are_shown_stopped(console))
        assert patiently(lambda: fleet.count("connected") == len(NAMES))
        assert fleet.count("latched") == len(NAMES)
        assert fleet.count("motion") == 0


def patiently(is_so: Callable[[], bool]) -> bool:
    return eventually(is_so, PATIENCE_S, LOOK_S)


def becomes(console: Console, presence: str) -> bool:
    """All of them, at one moment."""
    return patiently(lambda: [robot.presence for robot in console.robots()] == [presence] * len(NAMES))


def are_shown_stopped(console: Console) -> bool:
    return all(robot.state and robot.state.latch and not robot.state.running for robot in console.robots())
