"""Generated histories at the gateway's doors: a known group is held where its frames have it, for a STOP of
any client at any time; no download ends by itself; and every wait for a run is bounded.
"""

import asyncio
from collections.abc import Awaitable, Callable, Sequence

from hypothesis import given, settings
from hypothesis import strategies as st

from servodeck.protocol.families import FAMILIES, Family
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.values import (
    Command,
    Download,
    Erase,
    Erased,
    Frame,
    FrameStored,
    Move,
    ReadBattery,
    Report,
    Run,
    RunAccepted,
    RunFinished,
    ServoTarget,
    Stop,
)
from servodeck.robot.board.estimate import Estimate
from tests.amount import TIMES
from tests.boards import WorkingBoard, new_board, old_board
from tests.samples import STOP
from tests.scripted import Scripted, script
from tests.test_stop_known_groups import DOORS
from tests.virtual_time import in_virtual_time

BOARDS: dict[str, Callable[[], WorkingBoard]] = {"openarm-old": old_board, "openarm-new": new_board}
RUN_NUMBER = 6
START, SLOT, OTHER_SLOT, NEVER_STORED = 1000, 5, 6, 77
BYTE_S = 10 / 9600
# Of every slot from 100 on, each of 255 frames of 30 s (S49).
LONGEST_CHAIN_S = 2 * 160 * 255 * 30.0

# A run that may continue without its driver continues when that one lets go.
STOPPING = sorted(set(DOORS) - {"letting go of the lease"})

boards = st.sampled_from(sorted(BOARDS))
groups = st.lists(st.tuples(st.integers(300, 4000), st.integers(500, 2500)), min_size=1, max_size=4)


def fastest_of(group: Sequence[tuple[int, int]]) -> float:
    """In units a millisecond."""
    places = [START, *(position for _, position in group)]
    return max(
        abs(position - before) / duration_ms
        for before, (duration_ms, position) in zip(places, group, strict=False)
    )


def place_in(group: Sequence[tuple[int, int]], since_ms: float) -> tuple[float, float]:
    """Where servo 1 is so long after the group began, and where it goes."""
    at: float = START
    for duration_ms, position in group:
        # Whole ticks (S27).
        way_ms = duration_ms // 20 * 20
        if since_ms < duration_ms:
            went = min(1.0, since_ms / way_ms)
            return at + (position - at) * went, position
        at, since_ms = position, since_ms - duration_ms
    return at, at


@given(boards, groups, st.sampled_from(STOPPING), st.floats(0.05, 0.95))
@settings(max_examples=5 * TIMES, deadline=None)
@in_virtual_time
async def test_a_known_group_is_held_where_its_frames_have_it(
    board: str, group: list[tuple[int, int]], door: str, share: float
) -> None:
    async with script(board=board, behind=BOARDS[board]()) as here:
        await here.move(1500, s1=START)
        await asyncio.sleep(2)
        await here.download_frames(SLOT, frames=group)
        await here.post(f"slots/{SLOT}/run", continueForMs=60_000)
        [begun_s] = [at_s for at_s, packet in here.port.written if packet[3] == RUN_NUMBER]
        begun_s += (7 + (4 if board == "openarm-new" else 0)) * BYTE_S
        await asyncio.sleep(share * sum(duration_ms for duration_ms, _ in group) / 1000)
        before = len(here.port.written)
        await DOORS[door](here)
        [(stopped_s, _), (left_s, packet), *_] = here.port.written[before:]
        hold = parse_command(packet)
        assert isinstance(hold, Move)
        [target] = hold.targets
        at, to = place_in(group, (left_s - begun_s) * 1000)
        # What a fast frame left open the next one does not close.
        speed = fastest_of(group)
        # Not behind it; and no further than where it may be when the hold has arrived, a tick and a talk
        # later.
        ahead = (target.position - at) * (1 if to >= at else -1)
        late_ms = 11 + 2 * (20 + FAMILIES[board].motion.talk_ms)
        # About the end of a frame a tick decides which one it is in; a stop keeps the next from beginning.
        around_ms = ((stopped_s - begun_s) * 1000, (left_s - begun_s) * 1000 + late_ms)
        is_turning = {place_in(group, at_ms)[1] for at_ms in around_ms} != {to}
        assert is_turning or -2 <= ahead <= late_ms * speed + 3
        assert is_turning or (target.position - to) * (1 if to >= at else -1) <= 0
        [first, _, *repeats, again] = [sent for _, sent in here.port.written[before : before + 5]]
        assert [first, *repeats] == [STOP] * 3
        assert isinstance(parse_command(again), Move)
        # Who drove may fall silent while it holds: it is stopped once more, and nothing else leaves.
        behind = [parse_command(sent) for _, sent in here.port.written[before + 5 :]]
        assert all(isinstance(command, Stop | Move) for command in behind)
        assert behind.count(Stop()) <= 3


GROUP = {"slot": OTHER_SLOT, "frames": [{"durationMs": 700, "positions": {"1": 1500}}]}


LONG_ALONE_MS = 5000


async def idle(here: Scripted) -> None:
    await asyncio.sleep(7)


STEPS: dict[str, Callable[[Scripted], Awaitable[object]]] = {
    "run": lambda here: here.post(f"slots/{SLOT}/run"),
    "run another": lambda here: here.post(f"slots/{OTHER_SLOT}/run", times=2),
    "run an unknown one": lambda here: here.post(f"slots/{NEVER_STORED}/run"),
    "move": lambda here: here.move(1500, s1=2000),
    "play": lambda here: here.post("play", frames=GROUP["frames"]),
    "play on and on": lambda here: here.post(
        "play", frames=GROUP["frames"], times=0, continueForMs=LONG_ALONE_MS
    ),
    "stop playing": lambda here: here.client.delete("/api/play"),
    "download": lambda here: here.post("download", groups=[GROUP]),
    "erase": lambda here: here.post("erase"),
    "end": lambda here: here.post("lease", action="release"),
    "wait": idle,
}


@given(boards, st.lists(st.sampled_from(sorted(STEPS)), max_size=6))
@settings(max_examples=5 * TIMES, deadline=None)
@in_virtual_time
async def test_a_download_that_may_begin_is_not_ended(board: str, steps: list[str]) -> None:
    async with script(role="owner", board=board, behind=BOARDS[board]()) as here:
        for step in steps:
            await STEPS[step](here)
        await asyncio.sleep(4)
        # An unattended run has been stopped by now, unless it ended or was let go.
        await here.post("resume")
        await here.post("stop")
        await here.post("resume")
        # The last frame of an unknown group may take so long.
        await asyncio.sleep(30.5)
        job = await here.download(SLOT, OTHER_SLOT, frames=30)
        assert (job.status, job.detail, here.control.latch) == ("done", None, False)


def commands(family: Family) -> st.SearchStrategy[Command]:
    frames = st.builds(
        lambda ms, at: Frame(ms, (ServoTarget(1, at),)), st.integers(0, 30_000), st.integers(500, 1500)
    )
    slots = st.sampled_from([SLOT, NEVER_STORED, 100, 101])
    every: list[st.SearchStrategy[Command]] = [
        st.builds(Run, slots, st.integers(1, 3)),
        st.builds(lambda frame: Move(frame.duration_ms, frame.targets), frames),
        st.builds(Stop),
        st.builds(Erase),
        st.builds(lambda frame: Download(SLOT, 1, 0, frame), frames),
    ]
    if "readBattery" in family.commands:
        every.append(st.builds(ReadBattery))
    return st.one_of(every)


reports = st.sampled_from([FrameStored(), Erased(), RunAccepted(), RunFinished(None)])


@given(st.data(), st.sampled_from(["doc", "openarm-old", "openarm-new", "learm-esp32"]))
@settings(max_examples=30 * TIMES, deadline=None)
def test_a_counted_run_is_waited_for_with_a_bound(data: st.DataObject, name: str) -> None:
    family, at_s = FAMILIES[name], 0.0
    estimate = Estimate(family)
    event_of = st.one_of(commands(family), reports)
    events: list[tuple[float, Command | Report]] = data.draw(
        st.lists(st.tuples(st.floats(0, 5), event_of), max_size=12)
    )
    for pause_s, event in events:
        at_s += pause_s
        if isinstance(event, Report):
            estimate.heard(event, at_s)
        else:
            estimate.left(event, at_s)
            if isinstance(event, Download):
                estimate.stored(SLOT, [encode(event, family)], at_s)
    assert not estimate.group_may_run(at_s + LONGEST_CHAIN_S)
