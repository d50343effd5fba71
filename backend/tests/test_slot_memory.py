"""What the gateway remembers of slots: which hold half a group, which version the others got."""

import asyncio
from pathlib import Path

import pytest

from servodeck.errors import SlotChangedError
from servodeck.protocol.values import Frame, ServoTarget
from servodeck.robot.board.download import Group
from servodeck.robot.board.slots import FILE, OLD_FILE, SlotMemory
from servodeck.robot.control import Control
from servodeck.snapshots import StoredGroup
from tests.client import Client, gateway_on
from tests.downloading import AnsweringPort, begin, ended
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to
from tests.samples import ERASE
from tests.virtual_time import in_virtual_time, now

SLOT = 8
FRAMES = [Frame(500, (ServoTarget(1, 1500),))]
QUICK = [[180]]


def versions(control: Control) -> dict[str, str]:
    return {slot: stored.version for slot, stored in control.board.slot_versions.items()}


def group(version: str, replaces: str | None = None, slot: int = SLOT) -> Group:
    return Group(slot, "Wave", FRAMES, version, replaces)


def test_what_is_known_outlives_the_gateway_for_its_own_board(tmp_path: Path) -> None:
    async def work() -> None:
        memory = SlotMemory(tmp_path, lambda: 1700.5)
        memory.breaks("/dev/a", 5)
        memory.breaks("/dev/a", 9)
        memory.breaks("/dev/b", 7)
        memory.store("/dev/a", 9, "v1", "Wave", "w", "Anna")
        await memory.saved()

    asyncio.run(work())
    again = SlotMemory(tmp_path)
    assert (again.broken("/dev/a"), again.broken("/dev/b"), again.broken("/dev/c")) == ([5], [7], [])
    wave = StoredGroup(version="v1", name="Wave", document="w", by="Anna", at_ms=1_700_500)
    assert (again.stored("/dev/a"), again.stored("/dev/b")) == ({9: wave}, {})


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        '{"a": 5}',
        '{"a": {"broken": ["x"], "versions": {}}}',
        '{"a": {}}',
        '{"a": {"broken": [], "versions": {"9": {"version": 5}}}}',
    ],
)
def test_a_damaged_memory_is_no_memory(tmp_path: Path, text: str) -> None:
    (tmp_path / FILE).write_text(text)
    assert SlotMemory(tmp_path).broken("a") == []


async def test_it_is_on_disk_before_the_first_byte_leaves_and_a_disk_that_takes_nothing_hinders_nothing(
    tmp_path: Path,
) -> None:
    (tmp_path / "file").touch()
    for folder, saved in ((tmp_path / "new", [SLOT]), (tmp_path / "file", [])):
        port = FakePort()
        loop = asyncio.get_running_loop()
        control = Control(FakePorts(port), loop.time, "doc", slot_memory=SlotMemory(folder))
        await control.use_port("/dev/board")
        await control.until_identified()
        begin(control, group("v1"))
        await port.until_written(2)
        assert SlotMemory(folder).broken("/dev/board") == saved
        assert control.board.broken_slots == [SLOT]
        await control.shut_down()


def test_of_what_an_earlier_version_stored_its_version_is_known(tmp_path: Path) -> None:
    (tmp_path / FILE).write_text('{"/dev/a": {"broken": [], "versions": {"9": "v1"}}}')
    memory = SlotMemory(tmp_path)
    assert (memory.version("/dev/a", 9), memory.stored("/dev/a")[9].at_ms) == ("v1", None)


def test_what_an_earlier_version_knew_to_be_broken_is_broken(tmp_path: Path) -> None:
    (tmp_path / OLD_FILE).write_text('{"/dev/a": [5]}')
    assert SlotMemory(tmp_path).broken("/dev/a") == [5]


@in_virtual_time
async def test_every_client_gets_the_version_of_a_slot_also_when_it_returns_later() -> None:
    async with gateway_on(AnsweringPort(QUICK * 3)) as control:
        anna = Client(control)
        await ended(control, begin(control, group("v1")))
        states = [message for message in await anna.heard() if message["type"] == "state"]
        [stored] = states[-1]["slotVersions"].values()
        assert stored.pop("atMs") > 0
        assert stored == {"version": "v1", "name": "Wave", "document": None, "by": "Anna"}
        control.leave(anna)
        await ended(control, begin(control, group("v2")))
        [welcome] = await Client(control).heard()
        assert welcome["slotVersions"]["8"]["version"] == "v2"
        await ended(control, begin(control, Group(SLOT, "Unnamed", FRAMES)))
        assert versions(control)["8"] not in ("v1", "v2", "")


@in_virtual_time
async def test_one_that_ends_half_way_changes_no_version_and_an_erase_forgets_all() -> None:
    async with gateway_on(AnsweringPort([*QUICK, []])) as control:
        anna = Client(control)
        await ended(control, begin(control, group("v1")))
        job = begin(control, group("v2"))
        await asyncio.sleep(0.1)
        control.stop()
        assert (await ended(control, job)).status == "failed"
        assert (control.board.broken_slots, versions(control)) == ([SLOT], {"8": "v1"})
        await asyncio.sleep(3)
        control.resume(anna.caller)
        await anna.send(ERASE)
        assert (control.board.broken_slots, versions(control)) == ([SLOT], {})


@in_virtual_time
async def test_a_slot_that_changed_since_it_was_seen_is_not_overwritten() -> None:
    port = AnsweringPort(QUICK * 4)
    async with gateway_on(port) as control:
        await ended(control, begin(control, group("annas", "")))
        await ended(control, begin(control, group("berts", "annas")))
        before = port.packets()
        for seen in ("annas", ""):
            with pytest.raises(SlotChangedError):
                begin(control, group("again", seen))
            with pytest.raises(SlotChangedError):
                begin(control, group("first", "", slot=3), group("again", seen))
        assert (port.packets(), versions(control)) == (before, {"8": "berts"})
        await ended(control, begin(control, group("again", "berts")))
        assert versions(control) == {"8": "again"}


@in_virtual_time
async def test_a_program_says_what_it_has_seen_or_does_not_care() -> None:
    frames = [{"durationMs": 500, "positions": {"1": 1500}}]
    async with http_to(FakePorts(AnsweringPort(QUICK * 2)), now) as (client, _):
        asks = {"slot": SLOT, "frames": frames, "version": "mine"}
        assert (await client.post("/api/download", json={"groups": [asks]})).status_code == 202
        await asyncio.sleep(1)
        refused = await client.post("/api/download", json={"groups": [asks | {"replaces": "theirs"}]})
        assert (refused.status_code, refused.json()["code"]) == (409, "slotChanged")
        seen = await client.post("/api/download", json={"groups": [asks | {"replaces": "mine"}]})
        assert seen.status_code == 202
