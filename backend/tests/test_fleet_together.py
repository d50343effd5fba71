"""Several robots start a group together, over a real Mosquitto, each by its own clock."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from servodeck.fleet.console import Console
from servodeck.fleet.outcomes import FleetError, RefusedError
from servodeck.fleet.together import UncertainError, start_together
from tests.fleet import Gateway, console_of, eventually, fleet_on
from tests.mosquitto import Mosquitto, needs_mosquitto

pytestmark = [pytest.mark.slow, needs_mosquitto]
NAMES = ("arm-1", "arm-2", "arm-3")
AHEAD_S = (0.0, 500.0, -3.0)
RUN, STOP = 6, 7


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[tuple[Console, list[Gateway]]]:
    with Mosquitto(tmp_path / "broker", NAMES) as mosquitto, fleet_on(mosquitto, []) as (fleet, _):
        gateways = [
            fleet.join(name, mosquitto.broker_for(name), ahead_s)
            for name, ahead_s in zip(NAMES, AHEAD_S, strict=True)
        ]
        with console_of(mosquitto, "anna", *NAMES) as console:
            yield console, gateways


def drive_all(console: Console) -> None:
    for name in NAMES:
        assert console.ask(name, "ask", action="request").drives


def test_all_start_once_and_not_before_the_time(stage: tuple[Console, list[Gateway]]) -> None:
    console, gateways = stage
    drive_all(console)
    start_s = start_together(console, NAMES, slot=3)
    assert eventually(lambda: all(gateway.count(RUN) == 1 for gateway in gateways))
    for gateway in gateways:
        (run_s,) = [at_s for at_s, packet in gateway.board.written if packet[3] == RUN]
        assert run_s >= start_s - 0.02  # as sure as a clock has to be


def test_none_starts_where_one_is_not_ready(stage: tuple[Console, list[Gateway]]) -> None:
    console, gateways = stage
    drive_all(console)
    console.stop("arm-2").result(5)
    with pytest.raises(RefusedError, match="arm-2: Stopped"):
        start_together(console, NAMES, slot=3)
    assert_none_starts(console, gateways)


def test_none_starts_where_one_is_not_driven(stage: tuple[Console, list[Gateway]]) -> None:
    console, gateways = stage
    for name in NAMES[:2]:
        console.ask(name, "ask", action="request")
    with pytest.raises(FleetError, match="arm-3"):
        start_together(console, NAMES, slot=3)
    assert_none_starts(console, gateways)


def test_none_starts_where_a_clock_is_not_sure(
    stage: tuple[Console, list[Gateway]], monkeypatch: pytest.MonkeyPatch
) -> None:
    console, gateways = stage
    drive_all(console)
    monkeypatch.setattr("servodeck.fleet.together.UNCERTAIN_MS", 0.0)
    with pytest.raises(UncertainError):
        start_together(console, NAMES, slot=3)
    assert_none_starts(console, gateways)


@pytest.mark.exhaustive
def test_clocks_are_measured_before_each_start(stage: tuple[Console, list[Gateway]]) -> None:
    console, gateways = stage
    for name in ("arm-1", "arm-3"):
        console.ask(name, "ask", action="request")
    with pytest.raises(FleetError, match="arm-2"):
        start_together(console, NAMES, slot=3)
    said = states_of(console, "arm-2")
    gateways[1].ahead_s += 100.0
    assert console.until(lambda: states_of(console, "arm-2") >= said + 3, 10)  # it has seen that it was away
    drive_all(console)
    start_s = start_together(console, NAMES, slot=3)
    assert eventually(lambda: all(gateway.count(RUN) == 1 for gateway in gateways))
    for gateway in gateways:
        run_s = gateway.first_s(RUN, 0.0)
        assert run_s
        assert run_s >= start_s - 0.02


def states_of(console: Console, name: str) -> int:
    robot = console.robot(name)
    return robot.state.count if robot and robot.state else 0


def assert_none_starts(console: Console, gateways: list[Gateway]) -> None:
    """Also not behind the time that was agreed on: no promise is left to commit to."""
    assert all(gateway.count(RUN) == 0 for gateway in gateways)
    for name in NAMES:
        assert console.ask(name, "report").state
    assert all(not gateway.door.status().refused.get("internal") for gateway in gateways)
