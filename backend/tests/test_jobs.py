"""Downloads as jobs: who may begin one, its messages, and requests that it refuses meanwhile."""

import asyncio

import pytest

from servodeck.callers import THIS_COMPUTER, Caller
from servodeck.errors import (
    ExpiredError,
    GatewayError,
    LatchedError,
    MovingError,
    NotDrivingError,
    NotSupportedError,
    OutOfRangeError,
    SlotBrokenError,
)
from servodeck.protocol import timings
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, Run, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.control import Control
from tests.client import Client, gateway_on
from tests.downloading import AnsweringPort, begin, ended
from tests.fake_port import FakePort, FakePorts
from tests.samples import BATTERY, DOWNLOAD, ERASE, MOVE, RUN, STOP
from tests.virtual_time import in_virtual_time

SLOT = 8
WAVE = Group(SLOT, "Wave", [Frame(500, (ServoTarget(1, position),)) for position in (1500, 1600, 1700)])
RUN_WAVE = RUN  # slot 8, once
QUICK = [[180], [4], [46]]
PUPIL = Caller("pupil", "Anna", "driver")


def board_of(*, silent_after: int | None = None) -> AnsweringPort:
    return AnsweringPort(QUICK[:silent_after])


def broken(control: Control) -> list[int]:
    return control.board.broken_slots


@in_virtual_time
async def test_it_continues_when_all_clients_have_left() -> None:
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
async def test_every_client_gets_its_progress_and_later_ones_too() -> None:
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
async def test_the_last_stored_frame_is_published_also_when_the_next_takes_long() -> None:
    frames = [Frame(500, (ServoTarget(1, 1500),))] * 20
    async with gateway_on(AnsweringPort([[180], *[[4]] * 18, [400]])) as control:
        anna = Client(control)
        begin(control, Group(SLOT, "Wave", frames))
        await asyncio.sleep(0.9)
        messages = await anna.heard()
        stored = [message["job"]["framesStored"] for message in messages if message["type"] == "job"]
        assert stored[-1] == 19
        assert len(stored) < 10


@in_virtual_time
async def test_while_it_lasts_nothing_else_goes_to_the_board_from_any_client() -> None:
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
            control.choose_family("openarm-new")
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
        with pytest.raises(MovingError, match=r"up to 29\.\d s more"):  # the last frame of that group
            begin(control, WAVE)
        await asyncio.sleep(30)
        begin(control, WAVE)


@in_virtual_time
async def test_a_group_of_this_gateway_is_over_after_its_time_where_the_board_says_nothing() -> None:
    async with gateway_on(AnsweringPort(QUICK * 2)) as control:
        control.choose_family("openarm-old")
        anna = Client(control)
        await ended(control, begin(control, WAVE))
        await anna.send(encode(Run(SLOT, 2), FAMILIES["openarm-old"]))
        await asyncio.sleep(2.99)
        with pytest.raises(MovingError):
            begin(control, WAVE)
        await asyncio.sleep(timings.ESTIMATE.last_ticks_ms / 1000)
        begin(control, WAVE)


@in_virtual_time
async def test_a_page_shows_by_its_nonce_that_it_drives() -> None:
    async with gateway_on() as control:
        anna = Client(control, PUPIL)
        judge = control.driving.judge_request
        with pytest.raises(NotDrivingError, match="No client"):
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
            control.requests.download([made_of(WAVE, list(packets_of(WAVE, "doc")), "doc")], PUPIL, refuse)
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


async def test_without_a_port_or_while_stopped_there_is_none() -> None:
    control = Control(FakePorts(FakePort()), asyncio.get_running_loop().time, "doc")
    with pytest.raises(GatewayError):
        begin(control, WAVE)
    await control.use_port("/dev/board")
    await control.stop()
    with pytest.raises(LatchedError):
        begin(control, WAVE)
    with pytest.raises(OutOfRangeError):
        begin(control, Group(SLOT, "", []))
    await control.shut_down()
