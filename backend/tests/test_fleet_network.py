"""What a network before the broker, an attacker on it, clocks and withdrawn passwords may do: docs/adr/0048
has the table.
"""

import socket
import time
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from servodeck.fleet.broker import Broker
from servodeck.fleet.console import Console
from servodeck.fleet.messages import Done
from servodeck.fleet.outcomes import NoAnswerError, RefusedError
from tests.fleet import WAIT_S, console_of, eventually, fleet_on
from tests.mosquitto import LAB, USERS, Mosquitto, needs_mosquitto
from tests.raw_client import FOR_ARM, TARGETS, driving, move, raw_client
from tests.tcp_proxy import Proxy

pytestmark = [pytest.mark.slow, pytest.mark.exhaustive, needs_mosquitto]
MOVE, RUN, STOP = 3, 6, 7
NAMES = ("arm-1", "arm-2")
YOUNG_S = 0.5


@pytest.fixture
def mosquitto(tmp_path: Path) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path / "broker", NAMES) as made:
        yield made


@contextmanager
def proxy_before(mosquitto: Mosquitto) -> Iterator[Proxy]:
    proxy = Proxy(mosquitto.port)
    try:
        yield proxy
    finally:
        proxy.end()


def through(proxy: Proxy, broker: Broker) -> Broker:
    return replace(broker, port=proxy.port)


def running(console: Console) -> None:
    """A run that needs its driver."""
    console.ask("arm-1", "ask", action="request")
    console.ask("arm-1", "run", slot=3, times=0)


def test_a_gateway_without_its_network_stops_and_moves_held_back_are_refused(mosquitto: Mosquitto) -> None:
    with proxy_before(mosquitto) as proxy, fleet_on(mosquitto, []) as (fleet, _):
        arm = fleet.join("arm-1", through(proxy, mosquitto.broker_for("arm-1")))
        with raw_client(mosquitto.broker_for("anna")) as anna:
            nonce = driving(anna)
            anna.say(FOR_ARM + "run", {"v": 1, "n": 3, "nonce": nonce, "slot": 3, "times": 0})
            assert anna.answer()["kind"] == "done"
            proxy.hold()
            for n in range(60):
                anna.say(FOR_ARM + "move", move(10 + n, nonce))
            assert eventually(lambda: arm.control.latch)
            assert eventually(lambda: arm.count(STOP) >= 3)
            proxy.let_go()
            assert {anna.answer()["code"] for _ in range(60)} <= {"expired", "notDriving"}
        assert (arm.control.latch, arm.count(RUN), arm.count(MOVE)) == (True, 1, 0)


def test_moves_that_the_network_delayed_are_refused(mosquitto: Mosquitto) -> None:
    with (
        proxy_before(mosquitto) as proxy,
        fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)),
        Console(through(proxy, mosquitto.broker_for("anna")), LAB, USERS["anna"]) as anna,
    ):
        assert anna.until(lambda: anna.is_present("arm-1"), WAIT_S)
        assert anna.ask("arm-1", "ask", action="request").drives
        proxy.hold(answers_too=False)
        sent = [paced(anna) for _ in range(60)]
        let_pass(YOUNG_S + 0.1)  # so that the last one, too, is too old
        proxy.let_go()
        codes = set()
        for answered in sent:
            with pytest.raises(RefusedError) as refused:
                anna.result_of("arm-1", answered, WAIT_S)
            codes.add(refused.value.code)
        assert codes <= {"expired", "notDriving"}
        assert arm.count(MOVE) == 0


def paced(console: Console) -> "Future[Done]":
    """A move with the newest nonce, a moment after the one before: all of them take 2.4 s."""
    let_pass(0.04)
    return console.request("arm-1", "move", targets=TARGETS, duration_ms=1500)


def let_pass(seconds: float) -> None:
    begun_s = time.monotonic()
    assert eventually(lambda: time.monotonic() - begun_s >= seconds)


def test_recorded_bytes_move_nothing_later_nor_elsewhere(mosquitto: Mosquitto) -> None:
    with proxy_before(mosquitto) as proxy, fleet_on(mosquitto, NAMES) as (fleet, (arm, other)):
        with raw_client(through(proxy, mosquitto.broker_for("anna"))) as anna:
            stolen = move(5, driving(anna))
            anna.say(FOR_ARM + "move", stolen)
            done = anna.answer()
            anna.say(FOR_ARM + "ask", {"v": 1, "n": 6, "nonce": done["nonce"], "action": "release"})
            assert not anna.answer()["drives"]
        replay(proxy.sent, mosquitto)
        assert eventually(lambda: arm.door.status().refused.get("superseded", 0) >= 2)
        assert arm.count(MOVE) == 1
        with raw_client(mosquitto.broker_for("anna")) as anna:
            for topic in (FOR_ARM, "sd/1/lab/arm-2/do/driver/anna/"):
                anna.say(topic + "ask", {"v": 1, "n": 100, "nonce": stolen["nonce"], "action": "request"})
                anna.say(topic + "move", {**stolen, "n": 101})
                assert [anna.answer()["code"] for _ in range(2)] == ["expired", "expired"]
        fleet.do(arm.end())
        again = fleet.join("arm-1", mosquitto.broker_for("arm-1"))
        replay(proxy.sent, mosquitto)
        assert eventually(lambda: again.door.status().refused.get("expired", 0) >= 2)
        assert (arm.count(MOVE), other.count(MOVE), again.count(MOVE)) == (1, 0, 0)


def replay(sent: bytes, mosquitto: Mosquitto) -> None:
    """All that a client has sent, its password included, on a connection of its own."""
    with socket.create_connection(("127.0.0.1", mosquitto.port)) as connection:
        connection.sendall(sent)
        connection.shutdown(socket.SHUT_WR)
        while connection.recv(4096):  # until the broker has read all of it
            pass


def test_the_time_of_day_has_no_say(mosquitto: Mosquitto, monkeypatch: pytest.MonkeyPatch) -> None:
    with fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)), console_of(mosquitto, "anna", "arm-1") as anna:
        anna.ask("arm-1", "ask", action="request")
        time_of_day = time.time
        for step_s in (86_400.0, -86_400.0):
            monkeypatch.setattr("time.time", lambda step_s=step_s: time_of_day() + step_s)
            anna.beat()
            anna.ask("arm-1", "move", targets=TARGETS, duration_ms=1500)
            assert anna.is_present("arm-1")
            with raw_client(mosquitto.broker_for("anna")) as raw:
                raw.say(FOR_ARM + "move", move(1, "x.1-1"))
                assert raw.answer()["code"] == "expired"
        assert arm.count(MOVE) == 2


def test_a_run_ends_where_its_driver_is_revoked(mosquitto: Mosquitto) -> None:
    with fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)), console_of(mosquitto, "anna", "arm-1") as anna:
        running(anna)
        mosquitto.revoke("anna")
        assert eventually(lambda: arm.control.latch)
        assert eventually(lambda: arm.count(STOP) >= 3)
        with pytest.raises(NoAnswerError):
            anna.ask("arm-1", "resume")
        assert arm.control.latch


def test_a_gateway_that_is_revoked_stops_and_is_out(mosquitto: Mosquitto) -> None:
    with (
        fleet_on(mosquitto, ["arm-1"]) as (_, (arm,)),
        console_of(mosquitto, "anna", "arm-1") as anna,
    ):
        running(anna)
        mosquitto.revoke("arm-1")
        assert eventually(lambda: arm.control.latch)
        assert arm.control.driving.driver is None
        assert anna.until(lambda: not anna.is_present("arm-1"), WAIT_S)
        assert eventually(lambda: "refuses" in (arm.door.status().problem or ""))
        with pytest.raises(NoAnswerError):
            anna.ask("arm-1", "resume", timeout_s=0.5)


def test_what_a_broker_kept_of_a_gateway_that_died_with_it_is_not_believed(mosquitto: Mosquitto) -> None:
    keep_on_disk(mosquitto)
    with fleet_on(mosquitto, ["arm-2"]), fleet_on(mosquitto, ["arm-1"]):
        kept = mosquitto.folder / "mosquitto.db"
        assert eventually(lambda: kept.exists() and b"arm-1/online" in kept.read_bytes())
        mosquitto.kill()
    mosquitto.start()
    with fleet_on(mosquitto, ["arm-2"]), console_of(mosquitto, "vera", "arm-2") as vera:
        assert vera.until(lambda: vera.robot("arm-1") is not None, WAIT_S)
        found = vera.robot("arm-1")
        assert found
        assert (found.presence, found.about is not None) == ("silent", True)


def keep_on_disk(mosquitto: Mosquitto) -> None:
    """Other than our configuration: retained messages outlive the broker."""
    mosquitto.kill()
    file = mosquitto.folder / "mosquitto.conf"
    kept = f"persistence true\npersistence_location {mosquitto.folder}/\n"
    kept += "autosave_on_changes true\nautosave_interval 1\n"
    file.write_text(file.read_text().replace("persistence false\n", kept))
    mosquitto.start()
