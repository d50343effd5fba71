"""Two consoles of one user: whether one drives is a matter of its own session, not of the user's name."""

import time

import pytest

from servodeck.fleet.broker import Connection, Outgoing, parse_broker
from servodeck.fleet.console import Console
from servodeck.fleet.messages import Done, State, encode
from servodeck.fleet.rules import Received
from servodeck.snapshots import BatteryUnread, LinkState
from tests.mosquitto import LAB

ARM = "arm-1"


class Stage:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._sent: list[Outgoing] = []
        monkeypatch.setattr(Connection, "publish", self._publish)
        self.console = Console(parse_broker("mqtt://anna@127.0.0.1:1"), LAB, "driver")

    def _publish(self, outgoing: Outgoing) -> bool:
        self._sent.append(outgoing)
        return True

    def says(self, driver: str | None, epoch: int) -> None:
        state = State(
            instance="i",
            count=1,
            epoch=epoch,
            nonce="i.1",
            is_cloned=False,
            board="doc",
            link=LinkState(status="ready"),
            latch=False,
            latched_by=None,
            stopped_by=None,
            unheld=None,
            driver=driver,
            requested_by=None,
            running=None,
            play=None,
            job=None,
            unattended=None,
            battery=BatteryUnread(),
        )
        self._receive(LAB.published(ARM, "state"), encode(state))

    def asks(self, *, drives: bool, epoch: int) -> None:
        self.console.request(ARM, "ask", action="request")
        sent = self._sent[-1]
        assert sent.reply_to
        done = Done(gateway=ARM, n=1, nonce="i.2", epoch=epoch, drives=drives)
        self._receive(sent.reply_to, encode(done), sent.correlation)

    def _receive(self, topic: str, payload: bytes, correlation: bytes | None = None) -> None:
        self.console.received(Received(topic, payload, False, time.monotonic(), None, correlation))


def test_who_waits_has_the_lease_once_it_has_passed(monkeypatch: pytest.MonkeyPatch) -> None:
    stage = Stage(monkeypatch)
    stage.says("anna", epoch=5)
    stage.asks(drives=False, epoch=5)
    stage.says("anna", epoch=5)  # the other one
    assert not stage.console.drives(ARM)
    stage.says("anna", epoch=6)
    assert stage.console.drives(ARM)


def test_a_lease_that_has_passed_to_another_session_of_the_same_user_is_gone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stage = Stage(monkeypatch)
    stage.says(None, epoch=5)
    stage.asks(drives=True, epoch=6)
    stage.says("anna", epoch=6)
    assert stage.console.drives(ARM)
    stage.says("anna", epoch=7)
    assert not stage.console.drives(ARM)
