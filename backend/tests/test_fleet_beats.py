"""The beats of a console that drives a whole site: no message is larger than a gateway takes."""

import json
import time

import pytest

from servodeck.fleet.broker import Connection, Outgoing, parse_broker
from servodeck.fleet.console import Console
from servodeck.fleet.messages import BeatRequest, Done, encode
from servodeck.fleet.rules import SMALL_BYTES, Received
from tests.mosquitto import LAB

NAMES = [f"{number:04}-{'x' * 59}" for number in range(1000)]


def test_a_thousand_are_beaten_for(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[Outgoing] = []

    def publish(_: Connection, outgoing: Outgoing) -> bool:
        sent.append(outgoing)
        return True

    monkeypatch.setattr(Connection, "publish", publish)
    console = Console(parse_broker("mqtt://anna@127.0.0.1:1"), LAB, "driver")
    for name in NAMES:
        answered = console.request(name, "report")
        done = Done(gateway=name, n=1, nonce="5f0c21ab.8589934594-4712", epoch=1, drives=True)
        reply = sent.pop()
        assert reply.reply_to
        console.received(
            Received(reply.reply_to, encode(done), False, time.monotonic(), None, reply.correlation)
        )
        assert answered.result(0).drives
    console.beat()
    beaten: list[str] = []
    for outgoing in sent:
        assert len(outgoing.payload) <= SMALL_BYTES
        beaten += BeatRequest.model_validate_json(outgoing.payload).nonces
    assert sorted(beaten) == NAMES
    numbers = [json.loads(outgoing.payload)["n"] for outgoing in sent]
    assert numbers == sorted(set(numbers))
