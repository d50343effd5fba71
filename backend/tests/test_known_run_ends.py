"""A counted run of a group that the gateway knows is over at its computed end, and never before the robot
stands: from then on no driver who leaves or falls silent stops and latches, a download begins, and pages show
"Idle". Where a board reports the end, that counts. Real simulated boards, virtual time.
"""

import asyncio
import json
import random
from math import ceil

import pytest

from servodeck.errors import MovingError
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.timings import ESTIMATE, LEASE, wire_ms, wire_s
from tests.amount import named, seeds
from tests.lockstep import ENTRY, NODE, History, Simulator, SteppedBoard
from tests.samples import RUN
from tests.stop_under_test import KNOWN_SLOT, Driven, frames_of
from tests.test_stop_says import own_seed
from tests.virtual_time import VirtualTimeLoop, now

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        NODE is None or not ENTRY.exists(), reason="Node is not installed, or the simulator is not built"
    ),
]

BOARDS = ["doc", "openarm-old", "openarm-new", "learm-esp32", "learm-esp32-bus"]
DOORS = ["silent before", "silent", "gone", "download"]
HISTORIES = 10
OTHER_SLOT = 6
LOOK_S = 0.005
LAST_TICKS_S = ESTIMATE.last_ticks_ms / 1000
# What a page is told later, so that quick moves are one motion.
LINGERS_S = LAST_TICKS_S
BEAT_S = LEASE.beat_ms / 1000 + LOOK_S
# A driver is taken for gone later than that.
LATER_S = 2 * LEASE.silent_ms / 1000


def computed_s(board: str, history: History, times: int) -> float:
    """The latest end of that run behind its packet, by boards.md (S42, S43, L7)."""
    frames_ms: list[int] = [frame["durationMs"] for frame in history["known"]]
    if FAMILIES[board].motion.groups == "deadlines":
        return (times * sum(frames_ms) + wire_ms(7)) / 1000
    polls = [ceil(ms / ESTIMATE.poll_step_ms) + ESTIMATE.spare_polls for ms in frames_ms]
    return (times * sum(polls) + ESTIMATE.spare_polls) * ESTIMATE.poll_ms / 1000


async def ends(simulator: Simulator, family: str, history: History, door: str, times: int) -> None:
    board = SteppedBoard(simulator, family, history)
    here = Driven(board, family)
    await here.prepare(history)
    control, activity = here.control, here.control.board.activity
    await asyncio.sleep(1)
    here.say({"type": "run", "slot": KNOWN_SLOT, "times": times})
    await asyncio.sleep(LOOK_S)
    begun_s, packet = board.ports[-1].written[-1]
    assert packet[COMMAND_AT] == RUN[COMMAND_AT]
    ends_s = begun_s + wire_s(len(packet)) + computed_s(family, history, times)
    if door == "silent before":
        await asyncio.sleep(max(0.0, ends_s + LAST_TICKS_S + BEAT_S - now() - LEASE.silent_ms / 1000))
        here.page.beats = False
    while not activity.is_at_rest():
        assert now() <= ends_s + LAST_TICKS_S, "the computed end counts"
        with pytest.raises(MovingError):
            control.requests.download([], here.page.caller, lambda: None)
        await asyncio.sleep(LOOK_S)
    rests_s = now()
    assert activity.running() is None
    sent = len(board.ports[-1].packets())
    if door == "silent":
        here.page.beats = False
    elif door == "gone":
        control.leave(here.page)
    elif door == "download":
        here.download(OTHER_SLOT, frames_of(history["known"]))
        assert control.board.jobs.is_busy()
        await here.stored()
    await asyncio.sleep(LAST_TICKS_S + LINGERS_S + LOOK_S)
    assert activity.state().may_move is False
    await asyncio.sleep(LATER_S)
    while board.run_on(now()) < now():
        pass
    assert max(board.moved_s) <= rests_s, "it stands"
    assert door == "download" or board.ports[-1].packets()[sent:] == [], "no stop"
    assert not control.latch
    await control.board.link.close()


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("board", BOARDS)
def test_a_known_run_is_over_at_its_computed_end_and_the_robot_stands(board: str, door: str) -> None:
    simulator = Simulator()
    for seed in seeds(1):
        drawn = own_seed(board, seed)
        dice = random.Random(drawn)
        for history in simulator.draw(board, drawn, HISTORIES, kind="plain"):
            times = dice.randint(1, 3)
            with (
                named("test_known_run_ends.py", seed, f"{board}, {times} times: {json.dumps(history)}"),
                asyncio.Runner(loop_factory=VirtualTimeLoop) as runner,
            ):
                runner.run(ends(simulator, board, history, door, times))
    simulator.end()
