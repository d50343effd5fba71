"""What ends a download, and what it leaves behind in its slot."""

import asyncio

import pytest

from servodeck.callers import THIS_COMPUTER
from servodeck.errors import LatchedError, PortLostError, SlotBrokenError
from servodeck.robot.board.download import packets_of
from tests.client import Client, gateway_on
from tests.downloading import STORED, AnsweringPort, begin, ended
from tests.fake_port import FakePort
from tests.samples import DOWNLOAD, ERASE, STOP
from tests.test_jobs import QUICK, RUN_WAVE, SLOT, WAVE, board_of, broken
from tests.virtual_time import at, in_virtual_time, now

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
                await control.stop()
                control.resume(THIS_COMPUTER)
            case "stop packet":
                await anna.send(STOP)
            case "unplugged":
                port.unplug()
            case "port closed":
                await control.close_port()
            case "port changed":
                await control.use_port("/dev/other", "doc")
            case "shut down":
                await control.shut_down()
        told_s = now()
        found = await ended(control, job)
        assert (found.status, found.code) == ENDS[end]
        assert end == "silence" or now() - told_s <= 0.01
        assert control.board.slot_memory.broken(place) == [SLOT]
        last = [message["job"] for message in await anna.heard() if message["type"] == "job"][-1]
        assert (last["status"], last["code"]) == ENDS[end]
        await asyncio.sleep(0.3)
        frames = [packet for packet in port.packets() if packet[3] == DOWNLOAD[3]]
        await asyncio.sleep(10)
        assert [packet for packet in port.packets() if packet[3] == DOWNLOAD[3]] == frames


class VanishingPort(AnsweringPort):
    """Takes so many bytes of the download and is gone."""

    def __init__(self, bytes_left: int) -> None:
        super().__init__(QUICK)
        self._bytes_left = bytes_left

    def write(self, data: bytes) -> None:
        if data[3] != DOWNLOAD[3]:
            super().write(data)
            return
        taken, self._bytes_left = data[: self._bytes_left], max(0, self._bytes_left - len(data))
        if taken == data:
            super().write(data)
            return
        self.written.append((now(), taken))
        self.unplug()
        raise PortLostError("The board is gone.")


@in_virtual_time
async def test_a_port_that_vanishes_at_any_byte_ends_it_and_what_comes_after_is_a_stop() -> None:
    size = sum(len(packet) for packet in packets_of(WAVE, "doc"))
    for taken_bytes in range(size):
        port, again = VanishingPort(taken_bytes), FakePort()
        async with gateway_on(port, again) as control:
            place = control.board.link.place
            job = begin(control, WAVE)
            await asyncio.sleep(1.5)
            found = control.board.jobs.find(job.id)
            assert (found.status, found.code) == ("failed", "lost"), taken_bytes
            frames = b"".join(packet for packet in port.packets() if packet[3:4] == DOWNLOAD[3:4])
            assert control.board.slot_memory.broken(place) == [SLOT], taken_bytes
            assert len(frames) <= taken_bytes
            await asyncio.sleep(10)
            assert again.packets()[:2] == [b"\xfd" * 253, STOP], taken_bytes
            assert not any(packet[3] == DOWNLOAD[3] for packet in again.packets()), taken_bytes
            assert control.latch


@in_virtual_time
async def test_a_broken_slot_is_not_run_until_a_download_or_an_erase_has_succeeded() -> None:
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
        port.say(bytes.fromhex("55550208"))  # without a question
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
        await control.stop()
        await asyncio.sleep(1)
        assert broken(control) == []
        assert DOWNLOAD[3] not in [packet[3] for packet in port.packets()]
