"""Downloads as jobs: who may begin one, what it forbids meanwhile, what ends it, what it leaves behind."""

import asyncio
import json
from typing import Any

import pytest

from servodeck.callers import THIS_COMPUTER, Caller
from servodeck.control import Control
from servodeck.errors import (
    ExpiredError,
    GatewayError,
    LatchedError,
    MovingError,
    NotDrivingError,
    NotFoundError,
    NotSupportedError,
    OutOfRangeError,
    SlotBrokenError,
)
from servodeck.packets import FAMILIES, encode
from servodeck.parts import Group, made_of, packets_of
from servodeck.values import Frame, Run, ServoTarget
from tests.client import Client, gateway_on
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to
from tests.samples import BATTERY, DOWNLOAD, ERASE, MOVE, RUN, STOP
from tests.test_download import STORED, AnsweringPort, begin, ended
from tests.virtual_time import at, in_virtual_time, now

SLOT = 8
WAVE = Group(SLOT, "Wave", [Frame(500, (ServoTarget(1, position),)) for position in (1500, 1600, 1700)])
RUN_WAVE = RUN  # slot 8, once
QUICK = [[180], [4], [46]]
PUPIL = Caller("pupil", "Anna", "driver")


def board_of(*, silent_after: int | None = None) -> AnsweringPort:
    return AnsweringPort(QUICK[:silent_after])


def broken(control: Control) -> list[int]:
    return control.board.jobs.broken(control.board.link.place)


@in_virtual_time
async def test_it_goes_on_when_everybody_has_left() -> None:
    async with gateway_on(board_of()) as control:
        anna = Client(control)
        control.driving.act(anna, "request")
        job = begin(control, WAVE)
        await asyncio.sleep(0.1)
        control.leave(anna)
        assert (await ended(control, job)).status == "done"
        assert (broken(control), control.latch) == ([], False)
        bert = Client(control)
        [welcome] = await bert.heard()
        assert (welcome["job"]["id"], welcome["job"]["status"]) == (job.id, "done")


@in_virtual_time
async def test_everybody_hears_how_far_it_is_and_whoever_joins_later_too() -> None:
    async with gateway_on(board_of()) as control:
        anna = Client(control, PUPIL)
        await anna.heard()
        job = begin(control, WAVE)
        await asyncio.sleep(0.19)
        bert = Client(control)
        [welcome] = await bert.heard()
        assert (welcome["job"]["status"], welcome["brokenSlots"]) == ("running", [SLOT])
        await ended(control, job)
        jobs = [message["job"] for message in await anna.heard() if message["type"] == "job"]
        assert jobs[0] == {
            "id": job.id,
            "by": "Anna",
            "status": "running",
            "slots": [SLOT],
            "groupsStored": 0,
            "slot": SLOT,
            "name": "Wave",
            "framesStored": 0,
            "frameCount": 3,
            "bytesSent": 0,
            "bytesTotal": 3 * len(DOWNLOAD),
            "remainingMs": 0,
            "code": None,
            "detail": None,
        }
        assert (jobs[-1]["status"], jobs[-1]["framesStored"]) == ("done", 3)
        states = [message for message in await bert.heard() if message["type"] == "state"]
        assert states[-1]["brokenSlots"] == []


@in_virtual_time
async def test_what_was_stored_last_is_told_also_when_the_next_frame_takes_long() -> None:
    frames = [Frame(500, (ServoTarget(1, 1500),))] * 20
    async with gateway_on(AnsweringPort([[180], *[[4]] * 18, [400]])) as control:
        anna = Client(control)
        begin(control, Group(SLOT, "Wave", frames))
        await asyncio.sleep(0.9)
        told = [message["job"]["framesStored"] for message in await anna.heard() if message["type"] == "job"]
        assert told[-1] == 19
        assert len(told) < 10


@in_virtual_time
async def test_while_it_lasts_nothing_else_goes_to_the_board_whoever_asks() -> None:
    port = board_of()
    async with gateway_on(port) as control:
        anna = Client(control)
        job = begin(control, WAVE)
        await asyncio.sleep(0.05)
        for packet in (MOVE, RUN_WAVE, ERASE, BATTERY):
            with pytest.raises((MovingError, SlotBrokenError)):
                anna.send(packet)
        with pytest.raises(MovingError):
            begin(control, WAVE)
        with pytest.raises(MovingError):
            control.take_for("openarm-new")
        assert (await ended(control, job)).status == "done"
        await anna.send(BATTERY)
        await anna.send(RUN_WAVE)
        assert [packet[3] for packet in port.packets()] == [7, 25, 25, 25, 15, 6]


@in_virtual_time
async def test_a_single_frame_by_hand_is_refused() -> None:
    async with gateway_on() as control:
        with pytest.raises(NotSupportedError):
            Client(control).send(DOWNLOAD)


@pytest.mark.parametrize("what", [MOVE, RUN])
@in_virtual_time
async def test_it_is_refused_while_something_moves_or_may(what: bytes) -> None:
    port = board_of()
    async with gateway_on(port) as control:
        anna = Client(control)
        left = anna.send(what)
        with pytest.raises(MovingError):
            begin(control, WAVE)
        await left
        with pytest.raises(MovingError):
            begin(control, WAVE)
        if what == RUN:
            port.say(bytes.fromhex("55550207"))  # too soon to be about this run
            await asyncio.sleep(0)
            with pytest.raises(MovingError):
                begin(control, WAVE)
        await asyncio.sleep(1.1)
        if what == RUN:
            port.say(bytes.fromhex("55550207"))  # finished
            await asyncio.sleep(0.01)
        begin(control, WAVE)


@in_virtual_time
async def test_it_is_refused_between_the_stops_of_a_change_of_driver_and_while_the_board_erases() -> None:
    port = board_of()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        await anna.send(RUN)
        control.driving.act(bert, "take")
        await asyncio.sleep(0.1)
        with pytest.raises(MovingError):
            begin(control, WAVE)
        await asyncio.sleep(0.2)
        await bert.send(ERASE)
        with pytest.raises(MovingError, match="erasing"):
            begin(control, WAVE)
        port.say(bytes.fromhex("55550208"))
        await asyncio.sleep(0.01)
        begin(control, WAVE)


@in_virtual_time
async def test_a_group_of_this_gateway_is_over_after_its_time_where_the_board_says_nothing() -> None:
    async with gateway_on(AnsweringPort(QUICK * 2)) as control:
        control.take_for("openarm-old")
        anna = Client(control)
        await ended(control, begin(control, WAVE))
        await anna.send(encode(Run(SLOT, 2), FAMILIES["openarm-old"]))
        await asyncio.sleep(3.0)
        with pytest.raises(MovingError):
            begin(control, WAVE)
        await asyncio.sleep(1.6)
        begin(control, WAVE)


@in_virtual_time
async def test_a_page_shows_by_its_nonce_that_it_drives() -> None:
    async with gateway_on() as control:
        anna = Client(control, PUPIL)
        judge = control.driving.judge_request
        with pytest.raises(NotDrivingError, match="Nobody"):
            judge(PUPIL, "1-1")
        control.driving.act(anna, "request")
        assert anna.nonce
        with pytest.raises(NotDrivingError, match="Anna"):
            judge(THIS_COMPUTER, anna.nonce)
        with pytest.raises(ExpiredError):
            judge(PUPIL, "1-99")
        old = anna.nonce
        await asyncio.sleep(9)
        judge(PUPIL, old)
        await asyncio.sleep(1.5)
        with pytest.raises(ExpiredError):
            judge(PUPIL, old)
        judge(PUPIL, anna.nonce)


@in_virtual_time
async def test_who_may_not_begins_none() -> None:
    port = FakePort()
    async with gateway_on(port) as control:

        def refuse() -> None:
            raise NotDrivingError("Anna drives.")

        with pytest.raises(NotDrivingError):
            control.download([made_of(WAVE, list(packets_of(WAVE, "doc")), "doc")], "Bert", refuse)
        await asyncio.sleep(1)
        assert (control.board.jobs.latest, port.packets()) == (None, [STOP])


@in_virtual_time
async def test_a_change_of_driver_does_not_end_it() -> None:
    port = board_of()
    async with gateway_on(port) as control:
        anna, bert = Client(control, PUPIL), Client(control)
        control.driving.act(anna, "request")
        job = begin(control, WAVE)
        control.driving.act(bert, "take")
        with pytest.raises(MovingError):
            bert.send(MOVE)
        assert (await ended(control, job)).status == "done"
        assert port.packets().count(STOP) == 1


ENDS: dict[str, tuple[str, str]] = {
    "stop": ("failed", "latched"),
    "stop packet": ("cancelled", "cancelled"),
    "unplugged": ("failed", "lost"),
    "port closed": ("failed", "closed"),
    "port changed": ("failed", "closed"),
    "shut down": ("cancelled", "cancelled"),
    "silence": ("failed", "noAnswer"),
}


@pytest.mark.parametrize("end", ENDS)
@in_virtual_time
async def test_what_ends_it_is_said_and_leaves_the_slot_broken(end: str) -> None:
    port, other = board_of(silent_after=1), FakePort()
    async with gateway_on(port, other) as control:
        anna = Client(control)
        job = begin(control, WAVE)
        place = control.board.link.place
        await asyncio.sleep(0.3)
        match end:
            case "stop":
                await control.stop(None)
                control.resume(THIS_COMPUTER)
            case "stop packet":
                await anna.send(STOP)
            case "unplugged":
                port.unplug()
            case "port closed":
                await control.close_port()
            case "port changed":
                await control.use_port("/dev/other")
            case "shut down":
                await control.shut_down()
        told_s = now()
        found = await ended(control, job)
        assert (found.status, found.code) == ENDS[end]
        assert end == "silence" or now() - told_s <= 0.01
        assert control.board.jobs.broken(place) == [SLOT]
        last = [message["job"] for message in await anna.heard() if message["type"] == "job"][-1]
        assert (last["status"], last["code"]) == ENDS[end]
        await asyncio.sleep(0.3)
        frames = [packet for packet in port.packets() if packet[3] == DOWNLOAD[3]]
        await asyncio.sleep(10)
        assert [packet for packet in port.packets() if packet[3] == DOWNLOAD[3]] == frames


@in_virtual_time
async def test_a_broken_slot_is_run_by_nobody_until_a_download_or_an_erase_has_ended_well() -> None:
    port = AnsweringPort([[180], [], [], *QUICK])
    async with gateway_on(port) as control:
        anna = Client(control)
        job = begin(control, WAVE)
        await asyncio.sleep(0.3)
        control.board.jobs.cancel(job.id)
        assert (await ended(control, job)).status in ("cancelled", "failed")
        control.board.jobs.end(LatchedError("Nothing is under way: this ends nothing."))
        with pytest.raises(SlotBrokenError):
            anna.send(RUN_WAVE)
        await asyncio.sleep(3)
        assert (await ended(control, begin(control, WAVE))).status == "done"
        await anna.send(RUN_WAVE)


@in_virtual_time
async def test_an_erase_that_the_board_confirms_mends_every_slot() -> None:
    port = board_of(silent_after=1)
    async with gateway_on(port) as control:
        anna = Client(control)
        begin(control, WAVE)
        await asyncio.sleep(0.3)
        await anna.send(STOP)
        port.say(bytes.fromhex("55550208"))  # nobody has asked for it
        await asyncio.sleep(0.01)
        assert broken(control) == [SLOT]
        await anna.send(ERASE)
        port.say(bytes.fromhex("55550208"))
        await asyncio.sleep(0.01)
        assert broken(control) == []


@in_virtual_time
async def test_words_that_an_ended_one_is_still_owed_speak_for_no_other() -> None:
    port = AnsweringPort([[], [180], [4], [46]])
    async with gateway_on(port) as control:
        anna = Client(control)
        begin(control, WAVE)
        await asyncio.sleep(0.1)
        await anna.send(STOP)
        begun_s = now()
        at(begun_s + 1.5, lambda: port.say(STORED))
        job = begin(control, WAVE)
        assert (await ended(control, job)).status == "done"
        first_s = next(at_s for at_s, packet in port.written if at_s > begun_s and packet[3] == DOWNLOAD[3])
        assert first_s - begun_s >= 1.5 + 2.3


@in_virtual_time
async def test_what_is_stopped_before_its_first_byte_leaves_the_slot_whole() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        begin(control, WAVE)
        await control.stop(None)
        await asyncio.sleep(1)
        assert broken(control) == []
        assert DOWNLOAD[3] not in [packet[3] for packet in port.packets()]


FRAMES = [{"durationMs": 500, "positions": {"1": 1500}}]


def wish(frames: Any, slot: Any = SLOT) -> dict[str, Any]:
    return {"groups": [{"slot": slot, "frames": frames}]}


@in_virtual_time
async def test_a_script_begins_one_looks_at_it_and_calls_it_off() -> None:
    async with http_to(FakePorts(AnsweringPort([[180]])), now) as (client, control):
        begun = await client.post("/api/download", json=wish(FRAMES * 4))
        assert begun.status_code == 202
        job = begun.json()
        assert (job["slot"], job["status"], job["frameCount"]) == (SLOT, "running", 4)
        await asyncio.sleep(0.3)
        assert (await client.get(f"/api/jobs/{job['id']}")).json()["framesStored"] == 1
        await client.delete(f"/api/jobs/{job['id']}")
        await asyncio.sleep(1)
        found = (await client.get(f"/api/jobs/{job['id']}")).json()
        assert (found["status"], found["code"]) == ("cancelled", "cancelled")
        assert (await client.get("/api/jobs/other")).status_code == 404
        with pytest.raises(NotFoundError):
            control.board.jobs.cancel("other")


@in_virtual_time
async def test_over_http_only_who_drives_begins_one_and_the_job_needs_nobody_from_then_on() -> None:
    async with http_to(FakePorts(AnsweringPort([[1500], [1500]] * 2)), now) as (client, control):
        path, body = "/api/download", wish(FRAMES * 2)
        anna = Client(control, PUPIL)
        control.driving.act(anna, "request")
        for each in (body, {**body, "nonce": anna.nonce}):
            refused = await client.post(path, json=each)
            assert (refused.status_code, refused.json()["code"]) == (409, "notDriving")
            assert "Anna drives" in refused.json()["detail"]
        taken = (await client.post(path, json={**body, "take": True})).json()
        assert taken["by"] == anna.lease["driver"] == "A script on this computer"
        await asyncio.sleep(2.1)
        assert anna.lease["driver"] is None
        assert (await client.get(f"/api/jobs/{taken['id']}")).json()["status"] == "running"
        await asyncio.sleep(2)
        page = Client(control)
        control.driving.act(page, "request")
        begun = await client.post(path, json={**body, "nonce": page.nonce})
        assert (begun.status_code, begun.json()["by"]) == (202, "This computer")
        assert page.lease["drives"] is True


@pytest.mark.parametrize(
    ("slot", "frames", "code"),
    [
        (300, FRAMES, "malformed"),
        ("8", FRAMES, "malformed"),
        (8, [], "malformed"),
        (8, [{"durationMs": 500, "positions": {"0": 1500}}], "malformed"),
        (8, [{"durationMs": 500, "positions": {"33": 1500}}], "outOfRange"),
        (8, [{"durationMs": 500, "positions": {"1": 2600}}], "outOfRange"),
        (8, [{"durationMs": 40_000, "positions": {}}], "outOfRange"),
        (8, [{"durationMs": 500, "positions": {}, "more": 1}], "malformed"),
    ],
)
@in_virtual_time
async def test_what_the_board_cannot_store_is_refused_before_anything_is_sent(
    slot: str, frames: Any, code: str
) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, control):
        answer = await client.post("/api/download", json=wish(frames, slot))
        assert (answer.status_code, answer.json()["code"]) == (422, code)
        assert (broken(control), set(port.packets()) - {STOP}) == ([], set())


@in_virtual_time
async def test_the_largest_group_there_is_fits_into_one_request() -> None:
    frame = {"durationMs": 30_000, "positions": {str(servo): 2500 for servo in range(1, 33)}}
    async with http_to(FakePorts(FakePort()), now) as (client, _):
        text = json.dumps(wish([frame] * 255), indent=1)
        headers = {"content-type": "application/json"}
        assert (await client.post("/api/download", content=text, headers=headers)).status_code == 202
        too_large = await client.post("/api/download", content=text * 5, headers=headers)
        assert too_large.status_code == 413


async def test_without_a_port_or_while_stopped_there_is_none() -> None:
    control = Control(FakePorts(FakePort()), asyncio.get_running_loop().time, "doc")
    with pytest.raises(GatewayError):
        begin(control, WAVE)
    await control.use_port("/dev/board")
    await control.stop(None)
    with pytest.raises(LatchedError):
        begin(control, WAVE)
    with pytest.raises(OutOfRangeError):
        begin(control, Group(SLOT, "", []))
    await control.shut_down()
