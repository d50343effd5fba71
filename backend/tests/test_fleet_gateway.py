"""Gateways on a real Mosquitto, and consoles: what they say, requests, the lease, STOP."""

import json
from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.fleet.outcomes import RefusedError
from servodeck.fleet.rules import Received
from servodeck.fleet.topics import Verb
from servodeck.robot.document import robot_facts
from tests.fleet import Fleet, Gateway, console_of, eventually, fleet_on
from tests.mosquitto import Mosquitto, needs_mosquitto
from tests.raw_client import FOR_ARM, REPLY, raw_client
from tests.robots import care, robot_text

pytestmark = [pytest.mark.slow, needs_mosquitto]
MOVE, RUN, STOP = 3, 6, 7
# 6.5 V.
LOW_BATTERY = bytes.fromhex("5555040f6419")
NAMES = ("arm-1", "arm-2", "arm-3")
Robots = tuple[Fleet, list[Gateway]]
TARGETS = [{"servo": 1, "position": 1500}]


@pytest.fixture(scope="module")
def mosquitto(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path_factory.mktemp("broker"), (*NAMES, "late")) as made:
        yield made


@pytest.fixture
def fleet(mosquitto: Mosquitto) -> Iterator[Robots]:
    with fleet_on(mosquitto, NAMES) as made:
        yield made


def test_a_console_sees_who_is_there_and_how(mosquitto: Mosquitto, fleet: Robots) -> None:
    with console_of(mosquitto, "vera", *NAMES) as console:
        robot = console.robot("arm-1")
        assert robot
        assert robot.about
        assert (robot.about.name, robot.about.board) == ("arm-1", "doc")
        assert robot.state
        assert (robot.state.link.status, robot.state.latch, robot.state.driver) == ("ready", False, None)


def test_a_driver_moves_runs_and_stops(mosquitto: Mosquitto, fleet: Robots) -> None:
    _, (arm, other, _) = fleet
    with console_of(mosquitto, "anna", *NAMES) as console:
        assert console.ask("arm-1", "ask", action="request").drives
        console.ask("arm-1", "move", targets=TARGETS, duration_ms=1500)
        assert arm.count(MOVE) == 1
        assert console.ask("arm-1", "run", slot=3).outcome == "acknowledged"
        stops = arm.count(STOP)
        console.stop("arm-1").result(5)
        assert eventually(lambda: arm.count(STOP) >= stops + 3)
        with pytest.raises(RefusedError, match="Stopped") as refused:
            console.ask("arm-1", "run", slot=3)
        assert refused.value.code == "latched"
        console.ask("arm-1", "resume")
        assert console.ask("arm-1", "run", slot=3).outcome == "acknowledged"
        assert other.count(RUN) == other.count(MOVE) == 0


def test_a_battery_at_its_alarm_refuses_runs_until_a_person_says_anyway(
    mosquitto: Mosquitto, fleet: Robots
) -> None:
    maker, (arm, *_) = fleet
    arm.robot = robot_facts(robot_text(batteryCare=care("refuse", 7000, 6600)), 0)
    maker.do(arm.control.robot.put("arm", None))
    maker.call(lambda: arm.board.say(LOW_BATTERY))
    with console_of(mosquitto, "anna", *NAMES) as console:
        assert eventually(lambda: arm.control.board.battery.rested is not None)
        assert console.ask("arm-1", "ask", action="request").drives
        start = {"name": "dance", "start_ms": 0.0, "uncertainty_ms": 1.0}
        wishes: dict[Verb, dict[str, Any]] = {"run": {"slot": 3}, "prepare": {"slot": 3, **start}}
        for verb, wish in wishes.items():
            with pytest.raises(RefusedError) as refused:
                console.ask("arm-1", verb, **wish)
            assert refused.value.code == "batteryLow"
        assert arm.count(RUN) == 0
        assert console.ask("arm-1", "run", slot=3, anyway=True).outcome == "acknowledged"


def test_stop_for_all_reaches_all_and_those_that_come_later(mosquitto: Mosquitto, fleet: Robots) -> None:
    maker, gateways = fleet
    with console_of(mosquitto, "stan", *NAMES) as console:
        report = console.stop_all()
        assert report.stopped == NAMES
        assert (report.missing, report.refused) == ((), ())
        for gateway in gateways:
            assert gateway.control.latch
            assert eventually(partial(has_stopped, gateway))
        late = maker.add("late", mosquitto.broker_for("late"))
        assert eventually(lambda: late.control.latch)


def test_a_stop_that_is_repeated_is_done_again_and_answered_once(mosquitto: Mosquitto, fleet: Robots) -> None:
    maker, (arm, *_) = fleet
    with raw_client(mosquitto.broker_for("anna")) as raw:
        raw.say(FOR_ARM + "stop", b"", correlation=b"one")
        assert raw.answer()["kind"] == "done"
        maker.call(lambda: arm.control.resume(THIS_COMPUTER))
        raw.say(FOR_ARM + "stop", b"", correlation=b"one")
        raw.say(FOR_ARM + "report", {"v": 1, "n": 1}, correlation=b"two")
        done = raw.answer()
        assert (done["n"], done["state"]["latch"]) == (1, True)
        raw.say(FOR_ARM + "stop", b"", correlation=b"three")
        raw.say(FOR_ARM + "stop", b"")
        assert [raw.answer()["n"] for _ in range(2)] == [None, None]


def test_stops_that_come_together_are_answered_each(mosquitto: Mosquitto, fleet: Robots) -> None:
    maker, (arm, *_) = fleet

    def stop_twice() -> None:
        for correlation in (b"one", b"two"):
            arm.door.received(Received(FOR_ARM + "stop", b"", False, 0.0, REPLY, correlation))

    with raw_client(mosquitto.broker_for("anna")) as raw:
        raw.say(FOR_ARM + "report", {"v": 1, "n": 1})
        assert raw.answer()["kind"] == "done"
        maker.call(stop_twice)  # before the loop gets to either
        assert [raw.answer()["kind"] for _ in range(2)] == ["done", "done"]


@pytest.mark.parametrize(
    ("verbs", "stays_stopped"),
    [(("resume", "stop"), True), (("stop", "resume", "stop"), True), (("stop", "resume"), False)],
)
def test_a_resume_undoes_no_stop_that_came_later(
    mosquitto: Mosquitto, fleet: Robots, verbs: tuple[str, ...], *, stays_stopped: bool
) -> None:
    maker, (arm, *_) = fleet

    def receive(resume: bytes) -> None:
        """Before the loop gets to any of them."""
        for verb in verbs:
            payload = resume if verb == "resume" else b""
            at_s = arm.control.now()
            arm.door.received(Received(FOR_ARM + verb, payload, False, at_s, REPLY, verb.encode()))

    with raw_client(mosquitto.broker_for("anna")) as raw:
        maker.call(arm.control.stop)
        raw.say(FOR_ARM + "report", {"v": 1, "n": 1})
        resume = json.dumps({"v": 1, "n": 2, "nonce": raw.answer()["nonce"]}).encode()
        maker.call(partial(receive, resume))
        kinds = sorted(raw.answer()["kind"] for _ in range(2))
        assert kinds == ["done", "refused" if stays_stopped else "done"]
        assert arm.control.latch is stays_stopped


def has_stopped(gateway: Gateway) -> bool:
    return gateway.count(STOP) >= 3
