"""STOP while scripts send any request at any time: nothing moves behind it (I2), and unattended motion ends
by itself.
"""

import asyncio
import random

from tests.amount import named, seeds
from tests.samples import STOP
from tests.scripted import Scripted, script
from tests.virtual_time import in_virtual_time

MOVE = 3
# The longest that a servo in its first move still takes.
HOLD_MS = 1500 + 1500
PAUSES_S = (0.0, 0.02, 0.1, 0.3, 0.8)


async def ask(here: Scripted, chance: random.Random) -> None:
    """One wish, of the script or its owner, who may take the lease."""
    owner = chance.random() < 0.3
    wishes = [
        lambda: here.move(1500, owner=owner, take=owner, s1=chance.randint(500, 2500), s2=1500, s3=1500),
        lambda: here.move(chance.choice([20, 300, 3000]), owner=owner, s1=chance.randint(500, 2500)),
        lambda: here.post("slots/8/run", owner=owner, times=chance.randint(0, 2), take=owner),
        lambda: here.post("slots/8/run", owner=owner, times=1, continueForMs=5000),
        lambda: here.post("lease", owner=owner, action=chance.choice(["heartbeat", "release", "request"])),
        lambda: here.post("erase", owner=True),
    ]
    answer = await chance.choice(wishes)()
    assert answer.status_code in (200, 409, 422, 429, 504), answer.text


async def busy_scripts(chance: random.Random) -> None:
    async with script() as here:
        asked = []
        for _ in range(chance.randint(1, 8)):
            asked.append(asyncio.create_task(ask(here, chance)))
            await asyncio.sleep(chance.choice(PAUSES_S))
        before = len(here.port.written)
        here.control.stop()
        await asyncio.gather(*asked)
        await asyncio.sleep(3)
        # Stops and their hold, and nothing else.
        behind = here.port.packets()[before:]
        assert STOP in behind
        assert {packet[3] for packet in behind} <= {MOVE, STOP[3]}
        assert all(move_time_ms(packet) <= HOLD_MS for packet in behind if packet[3] == MOVE)
        assert here.control.latch is True


def move_time_ms(packet: bytes) -> int:
    return int.from_bytes(packet[5:7], "little")


@in_virtual_time
async def test_for_any_requests_of_scripts_nothing_moves_after_a_stop() -> None:
    for seed in seeds(60):
        with named("test_stop_scripts.py", seed, "scripts"):
            await busy_scripts(random.Random(seed))


@in_virtual_time
async def test_any_requests_of_scripts_end_by_themselves_and_free_the_lease() -> None:
    for seed in seeds(30):
        with named("test_stop_scripts.py", seed, "scripts left alone"):
            chance = random.Random(seed)
            async with script() as here:
                for _ in range(chance.randint(1, 8)):
                    await ask(here, chance)
                    await asyncio.sleep(chance.choice(PAUSES_S))
                # The longest that a run may continue; the five seconds of a client that requests to drive,
                # and the two of one that then sends nothing.
                await asyncio.sleep(5 + 5 + 2 + 0.5)
                assert here.control.driving.driver is None
                assert not here.control.board.activity.may_move()
                assert here.control.board.unattended.snapshot() is None
