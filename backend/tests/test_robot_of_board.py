"""One robot of the library is on the board, with its limits: for all clients, also after a restart."""

import asyncio
import json
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from servodeck.callers import Caller
from servodeck.errors import ConflictError, MovingError, NotFoundError, OutOfRangeError
from servodeck.files import FILE, Remembered, write_whole
from servodeck.robot.control import Control
from servodeck.snapshots import RobotFacts, ServoLimits
from tests.client import Client
from tests.fake_port import FakePort, FakePorts
from tests.samples import MOVE, MOVE_ELSEWHERE

# MOVE takes servo 1 to 2000, MOVE_ELSEWHERE to 1500.
ELBOW = ServoLimits(servo=1, name="Elbow", min=600, max=1800)
WIDE = ServoLimits(servo=1, name="Elbow", min=500, max=2500)
PUPIL = Caller("anna", "Anna", "driver")
PLACE = "/dev/board"


def arm(*limits: ServoLimits, board: str = "doc") -> RobotFacts:
    return RobotFacts(kind="robot", name="Arm", board=board, updated_at_ms=0, limits=list(limits), poses=[])


class DeviceStore:
    """What the library holds; `slow` holds every answer back."""

    def __init__(self, **robots: tuple[RobotFacts, int]) -> None:
        self.robots = robots
        self.slow = threading.Event()
        self.slow.set()

    def read(self, document: str) -> tuple[RobotFacts, int]:
        self.slow.wait(5)
        try:
            return self.robots[document]
        except KeyError:
            raise NotFoundError("The library has no such document.") from None


def gateway_at(store: DeviceStore, remembered: Remembered | None = None, *ports: FakePort) -> Control:
    return Control(
        FakePorts(*(ports or (FakePort(),))),
        time.monotonic,
        "doc",
        remembered=remembered,
        read_robot=store.read,
    )


async def robots_sent(client: Client) -> list[Any]:
    return [message["robot"] for message in await client.heard() if message["type"] == "robot"]


async def test_a_new_client_gets_the_robot_and_its_limits_hold_for_all() -> None:
    control = gateway_at(DeviceStore(arm=(arm(ELBOW), 3)))
    await control.use_port(PLACE)
    anna = Client(control)
    await anna.heard()
    await control.robot.put("arm", None)
    assert await robots_sent(anna) == [{"id": "arm", "revision": 3}]
    welcome, *_ = await Client(control).heard()
    assert welcome["robot"] == {"id": "arm", "revision": 3}
    with pytest.raises(OutOfRangeError, match="Elbow"):
        anna.send(MOVE)
    await control.board.link.close()


async def test_an_edit_counts_at_once_and_an_older_answer_does_not() -> None:
    control = gateway_at(DeviceStore(arm=(arm(ELBOW), 3)))
    await control.use_port(PLACE)
    await control.robot.put("arm", None)
    anna = Client(control)
    await anna.heard()
    assert control.robot.changes_limits("arm", arm(WIDE))
    assert not control.robot.changes_limits("arm", arm(ELBOW))
    assert not control.robot.changes_limits("hand", arm(WIDE))
    control.robot.written("arm", 5, arm(WIDE))
    control.robot.written("arm", 4, arm(ELBOW))
    control.robot.written("hand", 9, arm(ELBOW))
    assert await robots_sent(anna) == [{"id": "arm", "revision": 5}] * 3
    await anna.send(MOVE)
    control.robot.removed(["arm"])
    assert await robots_sent(anna) == [None]
    await control.board.link.close()


async def test_only_the_robot_that_is_known_to_stand_there_is_replaced_and_by_one_that_fits() -> None:
    store = DeviceStore(arm=(arm(), 1), hand=(arm(), 1), bus=(arm(board="lsc-6"), 1))
    control = gateway_at(store, None, FakePort(), FakePort())
    with pytest.raises(ConflictError):
        await control.robot.put("arm", None)  # no board
    await control.use_port(PLACE)
    for document, refusal in (("none", NotFoundError), ("bus", OutOfRangeError)):
        with pytest.raises(refusal):
            await control.robot.put(document, None)
    await control.robot.put("arm", None)
    with pytest.raises(ConflictError):
        await control.robot.put("hand", None)
    await control.robot.put("hand", "arm")
    assert control.robot.snapshot() is not None
    control.choose_family("lsc-6")
    assert control.robot.snapshot() is None
    control.choose_family("doc")
    snapshot = control.robot.snapshot()
    assert snapshot is not None
    assert snapshot.id == "hand"
    await control.use_port("/dev/other")
    assert control.robot.snapshot() is None
    await control.close_port()


async def test_after_a_restart_it_stands_there_again_and_until_its_limits_are_read_nothing_moves(
    tmp_path: Path,
) -> None:
    store = DeviceStore(arm=(arm(ELBOW), 2))
    control = gateway_at(store, Remembered(tmp_path))
    await control.use_port(PLACE)
    await control.robot.put("arm", None)
    await control.board.link.close()

    store.slow.clear()
    control = gateway_at(store, Remembered(tmp_path))
    await control.use_port(PLACE)
    snapshot = control.robot.snapshot()
    assert snapshot is not None
    assert (snapshot.id, snapshot.revision) == ("arm", 0)
    anna = Client(control)
    for packet in (MOVE, MOVE_ELSEWHERE):
        with pytest.raises(MovingError):
            anna.send(packet)
    store.slow.set()
    assert await next_robot(anna) == {"id": "arm", "revision": 2}
    with pytest.raises(OutOfRangeError):
        anna.send(MOVE)
    await control.board.link.close()


async def next_robot(client: Client) -> Any:
    """Set by a thread that reads the library."""
    async with asyncio.timeout(10):
        while (message := json.loads(await client.next()))["type"] != "robot":
            pass
    return message["robot"]


async def test_a_robot_that_cannot_be_read_holds_nothing_up() -> None:
    remembered = Remembered()
    remembered.remember_robot(f"doc {PLACE}", "gone")
    store = DeviceStore()
    store.slow.clear()
    control = gateway_at(store, remembered)
    await control.use_port(PLACE)
    anna = Client(control)
    store.slow.set()
    assert await next_robot(anna) is None
    await anna.send(MOVE)
    await control.board.link.close()


def test_what_is_remembered_is_there_again_and_damage_is_nothing(tmp_path: Path) -> None:
    assert (Remembered(tmp_path).port, Remembered(tmp_path).robot_on("doc a")) == (None, None)
    write_whole(tmp_path / FILE, '{"port": "/dev/serial/by-id/x", "robots": {"doc a": "arm"}}')
    there = Remembered(tmp_path)
    assert (there.port, there.robot_on("doc a"), there.robot_on("doc b")) == (
        "/dev/serial/by-id/x",
        "arm",
        None,
    )
    for damage in ("{", '{"port": 7}', "[]"):
        write_whole(tmp_path / FILE, damage)
        assert Remembered(tmp_path).port is None


async def test_while_a_client_drives_only_it_and_owners_change_the_robot() -> None:
    control = gateway_at(DeviceStore())
    await control.use_port(PLACE)
    anna = Client(control, PUPIL)
    bert = Caller("bert", "Bert", "driver")
    assert control.driving.may_rule(bert)
    control.driving.act(anna, "request")
    rules = [control.driving.may_rule(who) for who in (PUPIL, bert, Caller("cora", "Cora", "owner"))]
    assert rules == [True, False, True]
    await control.board.link.close()
