"""Eight gateways as people run them, each with a simulated board, through what a lesson may bring."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from servodeck.fleet.console import Console
from servodeck.fleet.heard import Robot
from servodeck.fleet.together import start_together
from tests.fleet import console_of, eventually
from tests.mosquitto import Mosquitto, needs_mosquitto
from tests.real_fleet import RealGateway, real_fleet
from tests.test_fleet_process import needs_simulator

pytestmark = [pytest.mark.slow, pytest.mark.exhaustive, needs_mosquitto, needs_simulator]
NAMES = tuple(f"arm-{number}" for number in range(1, 9))
PULLED = "arm-3"
MOVE, RUN, STOP = 3, 6, 7
SLOT = 4
# As a clock has to be, before it is relied on.
SURE_S = 0.02
FRAMES = [{"durationMs": 500, "positions": {"1": position}} for position in (1200, 1800)]
# Sixteen processes beside other tests.
PATIENCE_S = 60.0


def test_eight_gateways_run_together_and_stop_whatever_breaks(tmp_path: Path) -> None:
    with (
        Mosquitto(tmp_path / "broker", NAMES) as mosquitto,
        real_fleet(mosquitto, NAMES, tmp_path) as gateways,
        console_of(mosquitto, "anna") as anna,
        console_of(mosquitto, "stan") as stan,
    ):
        assert all_are(anna, is_ready)
        assert all_are(stan, is_ready)
        store(anna)
        run_together_until_stopped(anna, stan, gateways)
        lose_a_cable(anna, gateways)
        lose_the_broker(anna, gateways, mosquitto)


def store(anna: Console) -> None:
    for name in NAMES:
        assert anna.ask(name, "ask", action="request").drives
        anna.ask(name, "download", groups=[{"slot": SLOT, "frames": FRAMES}])
    assert all_are(anna, has_stored)


def run_together_until_stopped(anna: Console, stan: Console, gateways: Sequence[RealGateway]) -> None:
    start_s = start_together(anna, NAMES, SLOT, times=0)
    assert eventually(lambda: all(one.count(RUN) == 1 for one in gateways))
    assert all(one.count(RUN, since_s=start_s - SURE_S) == 1 for one in gateways)
    pressed_s = time.monotonic()
    report = stan.stop_all(PATIENCE_S)
    assert report.stopped == NAMES
    assert eventually(lambda: all(one.count(STOP, since_s=pressed_s) >= 3 for one in gateways))
    assert all_are(anna, is_latched)
    assert all(one.count(RUN) == 1 for one in gateways)


def lose_a_cable(anna: Console, gateways: Sequence[RealGateway]) -> None:
    (pulled,) = (one for one in gateways if one.name == PULLED)
    others = tuple(name for name in NAMES if name != PULLED)
    pulled.board.pull()
    assert anna.until(lambda: not is_ready(robot_of(anna, PULLED)), PATIENCE_S)
    pressed_s = time.monotonic()
    report = anna.stop_all(PATIENCE_S)
    assert (report.stopped, report.missing) == (others, ())
    assert [name for name, _ in report.refused] == [PULLED]
    reached = [one for one in gateways if one is not pulled]
    assert eventually(lambda: all(one.count(STOP, since_s=pressed_s) >= 3 for one in reached))
    pulled.board.plug()
    assert all_are(anna, is_ready)
    assert all_are(anna, is_latched)


def lose_the_broker(anna: Console, gateways: Sequence[RealGateway], mosquitto: Mosquitto) -> None:
    driven = [one for one in gateways if one.name != PULLED]  # what that board holds is not known any more
    for one in driven:
        anna.ask(one.name, "resume")
        assert anna.ask(one.name, "ask", action="request").drives
        anna.ask(one.name, "run", slot=SLOT, times=0)
    killed_s = time.monotonic()
    mosquitto.kill()
    assert eventually(lambda: all(one.count(STOP, since_s=killed_s) >= 3 for one in driven))
    assert anna.until(lambda: all(robot.presence == "silent" for robot in anna.robots()), PATIENCE_S)
    back_s = time.monotonic()
    mosquitto.start()
    assert all_are(anna, is_ready)
    assert all_are(anna, is_latched)
    for name in NAMES:
        assert anna.ask(name, "report").state
    assert [one.count(MOVE, RUN, since_s=back_s) for one in gateways] == [0] * len(NAMES)


def robot_of(console: Console, name: str) -> Robot:
    robot = console.robot(name)
    assert robot
    return robot


def all_are(console: Console, is_so: Callable[[Robot], bool]) -> bool:
    """All eight; meanwhile the console stays the driver of those that it drives."""

    def look() -> bool:
        console.beat()
        robots = console.robots()
        return len(robots) == len(NAMES) and all(map(is_so, robots))

    return eventually(look, PATIENCE_S, 0.1)


def is_ready(robot: Robot) -> bool:
    return robot.presence == "present" and robot.state is not None and robot.state.link.status == "ready"


def is_latched(robot: Robot) -> bool:
    return robot.state is not None and robot.state.latch and robot.state.running is None


def has_stored(robot: Robot) -> bool:
    job = robot.state.job if robot.state else None
    return job is not None and job.status == "done"
