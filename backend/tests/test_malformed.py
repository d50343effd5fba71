"""What no client may say, said 20,000 times by one that drives: nothing breaks, nothing moves (F12)."""

import asyncio
import json
import random
from collections.abc import Callable, Iterator
from typing import Any

from pydantic import ValidationError

from servodeck.api.websocket import intake_of, take_text
from servodeck.callers import THIS_COMPUTER
from servodeck.errors import GatewayError
from servodeck.intents import PacketMessage, client_message
from servodeck.robot.requests import judge_packet
from tests.amount import TIMES
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import BATTERY, DOWNLOAD, ERASE, MOVE, RUN, STOP
from tests.virtual_time import in_virtual_time

MESSAGES = 20_000 * TIMES
WELL_FORMED: list[dict[str, Any]] = [
    *({"type": "packet", "id": 7, "bytes": packet.hex()} for packet in (MOVE, RUN, ERASE, DOWNLOAD)),
    {"type": "move", "id": 7, "targets": [{"servo": 1, "position": 1500}], "durationMs": 0},
    {"type": "run", "id": 7, "slot": 1, "times": 1},
    {"type": "stop", "why": "person"},
    {"type": "resume"},
    {"type": "board", "id": 2, "board": "doc"},
    {"type": "calibrate", "servo": 1},
    {"type": "lease", "action": "request"},
    {"type": "heartbeat", "nonce": "1-1"},
]
ODD: list[Any] = [
    None,
    True,
    -1,
    2**70,
    1.5,
    "",
    "\0",
    "é" * 50,
    [],
    {},
    [[[[]]]],
    {"type": "run"},
    "5555",
]


def spoilt_text(chance: random.Random, text: str) -> str:
    """A letter is lost, doubled, swapped or cut off behind."""
    at = chance.randrange(len(text))
    return chance.choice(
        [
            text[:at] + text[at + 1 :],
            text[:at] + text[at] + text[at:],
            text[:at] + chr(chance.randrange(0x20, 0x2FF)) + text[at + 1 :],
            text[:at],
            text + text,
            text * 40,
            "[" * chance.randrange(1, 4000) + text,
        ]
    )


def spoilt_fields(chance: random.Random, message: dict[str, Any]) -> str:
    """A field is missing, of another kind, or one too many."""
    key = chance.choice(list(message))
    changed = dict(message)
    if chance.random() < 0.2:
        del changed[key]
    else:
        changed[chance.choice([key, "more"])] = chance.choice(ODD)
    return json.dumps(changed)


def spoilt_packet(chance: random.Random, message: dict[str, Any]) -> str:
    packet = bytearray(bytes.fromhex(message.get("bytes", MOVE.hex())))
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(packet))
        packet[at : at + chance.randrange(2)] = chance.randbytes(chance.randrange(3))
    return json.dumps({"type": "packet", "id": 7, "nonce": message.get("nonce"), "bytes": packet.hex()})


SPOILERS: list[Callable[[random.Random, dict[str, Any]], str]] = [
    lambda chance, message: spoilt_text(chance, json.dumps(message)),
    spoilt_fields,
    spoilt_packet,
]


def is_sound(text: str) -> bool:
    """A message that is almost valid; it has no effect here."""
    try:
        message = client_message.validate_json(text)
        if isinstance(message, PacketMessage):
            judge_packet(message.bytes, "doc")
    except (ValidationError, GatewayError):
        return False
    return True


def malformed(chance: random.Random, nonce: str | None) -> Iterator[str]:
    while True:
        message = dict(chance.choice(WELL_FORMED))
        if message["type"] in ("move", "packet", "run"):
            message["nonce"] = nonce
        text = chance.choice(SPOILERS)(chance, message)
        if not is_sound(text):
            yield text


@in_virtual_time
async def test_nothing_of_it_moves_or_breaks_anything() -> None:
    port = FakePort()
    chance = random.Random(MESSAGES)
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        control.driving.act(anna, "request")
        await anna.heard()
        refused = 0
        for _ in range(MESSAGES // 100):
            intake = intake_of(anna, control)
            texts = malformed(chance, anna.nonce)
            for _ in range(100):
                take_text(next(texts), anna, intake)
            intake.close()
            await asyncio.sleep(0.3)  # accepted packets leave
            answers = await anna.heard()
            refused += sum(answer["type"] == "refused" for answer in answers)
            assert {answer["type"] for answer in answers} <= {"refused", "state", "halted", "resumed"}
            await bert.heard()
            if control.latch:
                control.resume(THIS_COMPUTER)
        assert refused >= MESSAGES
        assert set(port.packets()) <= {STOP, BATTERY}
        await anna.send(MOVE)
        assert port.packets()[-1] == MOVE
