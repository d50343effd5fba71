"""However a program ends, and at whichever step: behind the release nothing of it moves, and the lease is
free.
"""

import asyncio
import random
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from servodeck.client.errors import error_of
from servodeck.client.gateway import Call, Pause, Steps
from servodeck.client.vocabulary import Vocabulary
from servodeck.errors import GatewayError
from tests.amount import named, seeds
from tests.samples import STOP
from tests.scripted import RUN_TAKEN, Scripted, script
from tests.test_stop_scripts import HOLD_MS, MOVE, move_time_ms
from tests.virtual_time import at, in_virtual_time, now

# Stops, and a hold between them.
# Three stops, and those of a board that may have missed them.
END_S = 1.0
# A frame of a group that the gateway does not know may take as long.
UNKNOWN_GROUP_S = 31.0
FRAMES: list[tuple[float, dict[int, float]]] = [(1.5, {1: 1800}), (0.5, {1: 1200}), (0.5, {1: 1500})]


class EndError(Exception):
    """Anything that ends a program."""


async def answer_to(here: Scripted, call: Call, key: str) -> Any:
    headers = {"idempotency-key": key} if call.is_keyed else {}
    answer = await here.client.request(call.method, call.path, json=call.body, headers=headers)
    body = answer.json()
    if answer.status_code >= 400:
        raise error_of(body["code"], body["detail"], answer.status_code)
    return body


async def do(here: Scripted, steps: Steps[Any], ends_at: int = -1) -> None:
    """Carries them out; the program ends at that step, after its request was done."""
    answer: Any = None
    error: BaseException | None = None
    for number in range(10_000):
        try:
            step = steps.send(answer) if error is None else steps.throw(error)
        except StopIteration:
            return
        answer = error = None
        try:
            if isinstance(step, Pause):
                await asyncio.sleep(step.seconds)
            elif isinstance(step, Call):
                answer = await answer_to(here, step, f"{now():.6f}-{number}".replace(".", "_"))
        except GatewayError as refused:
            error = refused
        if number == ends_at:
            error = EndError()


def begun(said: Vocabulary, chance: random.Random) -> Steps[Any]:
    wait, timeout = chance.random() < 0.7, chance.choice([None, 0.3, 2.0])
    servos = {servo: chance.randint(900, 2100) for servo in chance.sample([1, 2, 3], 2)}
    seconds = chance.choice([1.5, 3.0, 8.0])
    choices: list[Callable[[], Steps[Any]]] = [
        lambda: said.move(servos, "board", seconds, wait=wait, timeout=timeout),
        lambda: said.play(FRAMES, "board", 3, 1, wait=wait, timeout=timeout, alone=None),
        lambda: said.run(8, 2, wait=wait, timeout=timeout, alone=None),
    ]
    return chance.choice(choices)()


async def program(chance: random.Random) -> None:
    async with script() as here:
        said = Vocabulary(now, take=False)
        at(now() + chance.choice([0.02, 0.1]), lambda: here.port.say(RUN_TAKEN))
        if chance.random() < 0.2:
            at(now() + chance.random() * 3, here.control.stop)
        for _ in range(chance.randint(1, 3)):
            with suppress(EndError, GatewayError):
                await do(here, begun(said, chance), chance.choice([-1, 0, 1, 2, 3, 5, 8]))
        await do(here, said.release())
        assert here.control.driving.driver is None
        await asyncio.sleep(END_S)
        count = len(here.port.written)
        await asyncio.sleep(UNKNOWN_GROUP_S)
        behind = here.port.packets()[count:]
        # A stop of a person, or the gateway's second one behind an unknown group, and its hold.
        assert behind[:1] in ([], [STOP])
        assert {packet[3] for packet in behind} <= {MOVE, STOP[3]}
        assert all(move_time_ms(packet) <= HOLD_MS for packet in behind if packet[3] == MOVE)
        assert here.control.board.is_idle()


@in_virtual_time
async def test_at_any_step_the_release_ends_all_motion() -> None:
    for seed in seeds(80):
        with named("test_client_ends.py", seed, "program"):
            await program(random.Random(seed))
