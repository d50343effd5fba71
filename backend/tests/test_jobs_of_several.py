"""Several groups as one job: one progress, one end, and what each slot holds afterwards."""

import asyncio
import itertools
import tracemalloc
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.errors import CancelledError, NotDrivingError, NotFoundError, OutOfRangeError
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import wire_s
from servodeck.protocol.values import Frame, Run, ServoTarget
from servodeck.robot.board.download import Group, Progress, Tally, made_of, packets_of, part_of
from servodeck.robot.control import Control
from tests.client import ANNA, Client, gateway_on
from tests.downloading import AnsweringPort, begin, ended
from tests.fake_port import FakePorts
from tests.running import http_to
from tests.samples import DOWNLOAD, STOP
from tests.virtual_time import in_virtual_time, now

WAVE, BOW, NOD = (
    Group(slot, name, [Frame(500, (ServoTarget(1, position),)) for position in (1500, 1600, 1700)])
    for slot, name in ((8, "Wave"), (3, "Bow"), (200, "Nod"))
)
QUICK = [[180], [4], [46]]
SLOTS = [WAVE.slot, BOW.slot, NOD.slot]


def stored_by(port: AnsweringPort) -> list[tuple[int, int]]:
    """Slot and frame of each frame that left."""
    return [(packet[4], packet[6]) for packet in port.packets() if packet[3] == DOWNLOAD[3]]


def broken(control: Control) -> list[int]:
    return control.board.broken_slots


@in_virtual_time
async def test_they_are_stored_one_after_the_other_with_one_progress_though_everybody_has_left() -> None:
    port = AnsweringPort(QUICK * 3)
    async with gateway_on(port) as control:
        anna = Client(control)
        job = begin(control, WAVE, BOW, NOD)
        assert (job.slots, job.frame_count, job.bytes_total) == (SLOTS, 9, 9 * len(DOWNLOAD))
        control.leave(anna)
        await asyncio.sleep(0.3)
        bert = Client(control)
        [welcome] = await bert.heard()
        assert (welcome["job"]["slot"], welcome["job"]["name"]) == (3, "Bow")
        assert (welcome["job"]["groupsStored"], welcome["brokenSlots"]) == (1, [3])
        end = await ended(control, job)
        assert (end.status, end.groups_stored, end.frames_stored) == ("done", 3, 9)
        assert stored_by(port) == [(slot, frame) for slot in SLOTS for frame in range(3)]
        jobs = [message["job"] for message in await bert.heard() if message["type"] == "job"]
        assert [job["framesStored"] for job in jobs] == sorted(job["framesStored"] for job in jobs)
        assert broken(control) == []
        await bert.send(encode(Run(BOW.slot, 1), FAMILIES["doc"]))
        assert control.board.motion.group_ends_in_s(now()) is not None


ENDS: dict[str, Callable[[Control, str], Any]] = {
    "STOP": lambda control, _: control.stop(),
    "cancel": lambda control, job: control.board.jobs.cancel(job),
}


@pytest.mark.parametrize("end", ENDS)
@in_virtual_time
async def test_what_ends_it_leaves_whole_groups_before_it_and_old_ones_behind_it(end: str) -> None:
    port = AnsweringPort(QUICK * 3)
    async with gateway_on(port) as control:
        job = begin(control, WAVE, BOW, NOD)
        await asyncio.sleep(0.4)
        ENDS[end](control, job.id)
        state = await ended(control, job)
        assert (state.groups_stored, state.slot, state.name) == (1, 3, "Bow")
        assert state.status == {"STOP": "failed", "cancel": "cancelled"}[end]
        assert broken(control) == [3]
        before = stored_by(port)
        assert {slot for slot, _ in before} == {8, 3}
        await asyncio.sleep(10)
        assert stored_by(port) == before


@in_virtual_time
async def test_called_off_in_the_last_frame_of_a_group_none_is_broken_and_the_next_is_not_begun() -> None:
    port = AnsweringPort(QUICK * 2)
    async with gateway_on(port) as control:
        job = begin(control, WAVE, BOW)
        await asyncio.sleep(0.25)
        control.board.jobs.cancel(job.id)
        state = await ended(control, job)
        assert (state.status, state.groups_stored, broken(control)) == ("cancelled", 1, [])
        assert {slot for slot, _ in stored_by(port)} == {8}


@in_virtual_time
async def test_one_that_the_board_does_not_answer_ends_the_others_too() -> None:
    port = AnsweringPort(QUICK)
    async with gateway_on(port) as control:
        state = await ended(control, begin(control, WAVE, BOW, NOD))
        assert (state.status, state.code, state.groups_stored) == ("failed", "noAnswer", 1)
        assert broken(control) == [3]
        assert {slot for slot, _ in stored_by(port)} == {8, 3}


@in_virtual_time
async def test_a_stop_packet_ends_it_behind_a_whole_group_too() -> None:
    port = AnsweringPort(QUICK * 2)
    async with gateway_on(port) as control:
        anna = Client(control)
        job = begin(control, WAVE, BOW)
        await asyncio.sleep(0.272)
        assert control.board.jobs.find(job.id).groups_stored == 1
        await anna.send(STOP)
        state = await ended(control, job)
        assert (state.code, state.groups_stored) == ("cancelled", 1)


@in_virtual_time
async def test_a_slot_that_is_wanted_twice_or_another_board_is_refused_before_anything_is_sent() -> None:
    port = AnsweringPort()
    async with gateway_on(port) as control:
        with pytest.raises(OutOfRangeError, match="Slot 8 is given twice"):
            begin(control, WAVE, BOW, WAVE)
        made = [made_of(WAVE, list(packets_of(WAVE, "doc")), "doc")]
        control.choose_family("openarm-new")
        with pytest.raises(CancelledError):
            control.requests.download(made, ANNA, lambda: None)
        assert (port.packets(), broken(control)) == ([STOP], [])


async def test_others_continue_while_a_large_group_is_made_into_packets() -> None:
    turns = 0

    async def go_on() -> None:
        nonlocal turns
        while True:
            turns += 1
            await asyncio.sleep(0)

    beside = asyncio.create_task(go_on())
    frame = Frame(500, tuple(ServoTarget(servo, 1500) for servo in range(1, 33)))
    part = await part_of(Group(8, "Long", [frame] * 255), "doc")
    beside.cancel()
    with suppress(asyncio.CancelledError):
        await beside
    assert len(part.packets) == 255
    assert turns >= 255


def follow(control: Control, job_id: str, *groups: Group, claim: Callable[[], object] = lambda: None) -> Any:
    parts = [made_of(group, list(packets_of(group, "doc")), "doc") for group in groups]
    return control.requests.download(parts, ANNA, claim, job_id)


@in_virtual_time
async def test_what_comes_behind_it_belongs_to_it_until_its_end() -> None:
    port = AnsweringPort(QUICK * 3)
    async with gateway_on(port) as control:
        job = begin(control, WAVE)
        await asyncio.sleep(0.1)
        followed = follow(control, job.id, BOW, NOD)
        assert (followed.id, followed.slots, followed.frame_count, followed.bytes_total) == (
            job.id,
            SLOTS,
            9,
            9 * len(DOWNLOAD),
        )
        end = await ended(control, job)
        assert (end.status, end.groups_stored, end.frames_stored) == ("done", 3, 9)
        assert stored_by(port) == [(slot, frame) for slot in SLOTS for frame in range(3)]
        with pytest.raises(CancelledError):
            follow(control, job.id, BOW)


@in_virtual_time
async def test_nothing_comes_behind_what_has_its_slot_was_called_off_or_is_anothers() -> None:
    async with gateway_on(AnsweringPort(QUICK * 3)) as control:
        job = begin(control, WAVE)

        def refuse() -> None:
            raise NotDrivingError("Bert drives.")

        with pytest.raises(OutOfRangeError, match="Slot 8 is given twice"):
            follow(control, job.id, BOW, WAVE)
        with pytest.raises(NotDrivingError):
            follow(control, job.id, BOW, claim=refuse)
        with pytest.raises(NotFoundError):
            follow(control, "other", BOW)
        control.board.jobs.cancel(job.id)
        with pytest.raises(CancelledError):
            follow(control, job.id, BOW)
        assert (await ended(control, job)).slots == [WAVE.slot]


async def test_a_full_board_waits_in_little_memory() -> None:
    await part_of(WAVE, "doc")  # what is built at its first use is not a group's
    tracemalloc.start()
    part = await part_of(Group(8, "Long", [frame_of(index) for index in range(255)]), "doc")
    bytes_each, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(part.packets) == 255
    assert bytes_each < 60 * 1024


def frame_of(index: int) -> Frame:
    return Frame(500, tuple(ServoTarget(servo, 500 + servo + index) for servo in range(1, 33)))


@in_virtual_time
async def test_over_http_they_are_one_job() -> None:
    frames = [{"durationMs": 500, "positions": {"1": 1500}}]
    port = AnsweringPort([[225]] * 3)
    async with http_to(FakePorts(port), now) as (client, _):
        wish = {"groups": [{"slot": 8, "name": "Wave", "frames": frames}, {"slot": 3, "frames": frames}]}
        begun = await client.post("/api/download", json=wish)
        assert (begun.status_code, begun.json()["slots"]) == (202, [8, 3])
        more = {"groups": [{"slot": 4, "frames": frames}], "behind": begun.json()["id"]}
        assert (await client.post("/api/download", json=more)).json()["slots"] == [8, 3, 4]
        await asyncio.sleep(1)
        found = (await client.get(f"/api/jobs/{begun.json()['id']}")).json()
        assert (found["status"], found["groupsStored"], found["name"]) == ("done", 3, "")
        twice = await client.post("/api/download", json={"groups": wish["groups"][:1] * 2})
        assert (twice.status_code, twice.json()["code"]) == (422, "outOfRange")
        assert (await client.post("/api/download", json={"groups": []})).json()["code"] == "malformed"


GROUPS = st.lists(st.lists(st.integers(12, 107), min_size=1, max_size=6), min_size=1, max_size=6)


@given(sizes=GROUPS, ms=st.lists(st.floats(0, 2), min_size=36, max_size=36))
def test_the_time_left_is_at_least_the_wires_and_nothing_at_the_end(
    sizes: list[list[int]], ms: list[float]
) -> None:
    clock = itertools.accumulate(ms)
    at_s = 0.0
    tally = Tally(lambda: at_s)
    tally.add(sizes)
    last = tally.after(0, 0)
    total = sum(map(sum, sizes))
    for group, of_group in enumerate(sizes):
        for frame in range(1, len(of_group) + 1):
            at_s = next(clock)
            progress = tally.after(group, frame)
            assert progress.frames_stored == last.frames_stored + 1
            assert progress.remaining_s >= wire_s(total - progress.bytes_sent)
            last = progress
        tally.after(group + 1, 0)
    assert last == Progress(len(sizes) - 1, sum(map(len, sizes)), sum(map(len, sizes)), total, total, 0.0)
