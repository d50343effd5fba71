"""What people have of every version there has been (e2e/kept): a gateway has all of it, lets in the same
people as before, and moves nothing because of it.
"""

import asyncio
import json
import os
import shutil
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import ExitStack, asynccontextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from httpx2 import AsyncClient
from typer.testing import CliRunner

from servodeck.access import addresses
from servodeck.access.audit import Audit
from servodeck.access.audit_file import AuditFile
from servodeck.access.devices import DeviceFile, Devices
from servodeck.access.entrance import Entrance
from servodeck.api.app import create_app
from servodeck.api.library import robots_in
from servodeck.cli.main import app as command_line
from servodeck.files import Remembered
from servodeck.fleet.console import Console
from servodeck.fleet.home_assistant import HomeAssistant
from servodeck.fleet.identity import own_name
from servodeck.fleet.messages import About
from servodeck.library.library import Library
from servodeck.protocol.decoder import COMMAND_SHAPES, Decoder, DecoderEvent, PacketEvent
from servodeck.protocol.families import UNKNOWN
from servodeck.protocol.packets import parse_command
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.control import Control
from servodeck.robot.driving import GRANTS_PER_START, first_epoch
from tests.fake_port import FakePort, FakePorts
from tests.fleet import console_of, eventually
from tests.keep_fleet import HARDWARE, HOLD, NAMES, PREFIX, WORKSHOP, is_ready
from tests.mosquitto import LAB, Mosquitto, needs_mosquitto
from tests.raw_client import raw_client
from tests.real_fleet import RealGateway
from tests.running import PORT, client_of
from tests.test_cli import Served
from tests.test_ports import Pty
from tests.test_with_simulator import NODE, SIMULATOR, Board
from tests.virtual_time import in_virtual_time, now

KEPT = sorted(path for path in (Path(__file__).parents[2] / "e2e/kept").iterdir() if path.is_dir())
# Covers identification and every wait before a motion.
WATCHED_S = 30.0
READY_S = 20.0
HARMLESS = {"stop", "readBattery", "readVersion", "readPositions", "readAllPositions"}

each_version = pytest.mark.parametrize("kept", KEPT, ids=lambda path: path.name)
needs_simulator = pytest.mark.skipif(
    NODE is None or not SIMULATOR.exists() or os.name != "posix", reason="npm run build, Node and a pty"
)


def json_of(file: Path) -> Any:
    return json.loads(file.read_text("utf-8"))


def kept_at_ms(kept: Path) -> int:
    """The time of writing: a deleted document stays for 30 days."""
    documents = json_of(kept / "gateway.json")["answers"]["library"]["documents"]
    return max(int(one["facts"]["updatedAtMs"]) for one in documents)


def kinds_of(data: bytes) -> set[str]:
    """The kinds of all commands in it."""
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append, COMMAND_SHAPES)
    decoder.push(data)
    decoder.idle()
    commands = [parse_command(event.bytes) for event in events if isinstance(event, PacketEvent)]
    return {command.kind if command else "unknown" for command in commands}


def taken_by(board: Board) -> set[str]:
    return kinds_of(bytes(byte for _, byte in board.taken()))


def assert_still_said(kept: Any, said: Any, where: str) -> None:
    """A later version may say more of each thing, never less. Lists of things with ids may have grown."""
    if isinstance(kept, dict):
        assert isinstance(said, dict), where
        for key, value in kept.items():
            assert key in said, f"{where}: {key}"
            assert_still_said(value, said[key], f"{where}: {key}")
    elif isinstance(kept, list) and kept and isinstance(kept[0], dict) and "id" in kept[0]:
        by_id = {one["id"]: one for one in said}
        for one in kept:
            assert one["id"] in by_id, f"{where}: {one}"
            assert_still_said(one, by_id[one["id"]], f"{where}: {one['id']}")
    else:
        assert said == kept, where


async def assert_has_everything(client: AsyncClient, kept: Path, gone: Sequence[str] = ()) -> None:
    """`gone`: addresses of documents that may be gone, because they were deleted long ago."""
    expected = json_of(kept / "gateway.json")
    owner = {"authorization": f"Bearer {expected['people'][0]['credential']}"}
    answers = dict(expected["answers"])
    documents = answers["library"]["documents"]
    answers["library"] = {"documents": [one for one in documents if f"library/{one['id']}" not in gone]}
    for where, answer in answers.items():
        if not where.startswith(tuple(gone)):
            said = await client.get(f"/api/v1/{where}", headers=owner)
            assert said.status_code == 200, f"{where}: {said.text}"
            assert_still_said(answer, said.json(), where)


def deleted_in(kept: Path) -> list[str]:
    documents = json_of(kept / "gateway.json")["answers"]["library"]["documents"]
    found = [f"library/{one['id']}" for one in documents if one["isRemoved"]]
    assert found
    return found


async def assert_lets_in_the_same_people(client: AsyncClient, kept: Path) -> None:
    expected = json_of(kept / "gateway.json")

    async def who_is(credential: str) -> Any:
        said = await client.get("/api/v1/me", headers={"authorization": f"Bearer {credential}"})
        return said.json()["you"]

    for one in expected["people"]:
        you = await who_is(one["credential"])
        assert (you["name"], you["role"]) == (one["name"], one["role"])
    for credential in expected["revoked"]:
        assert await who_is(credential) is None
        headers = {"authorization": f"Bearer {credential}"}
        assert (await client.get("/api/v1/library", headers=headers)).status_code == 401


async def until_ready(client: AsyncClient, kept: Path) -> None:
    """Waits for the answer of the board, a process of its own, in real time."""
    owner = json_of(kept / "gateway.json")["people"][0]["credential"]
    async with asyncio.timeout(READY_S):
        while True:
            said = await client.get("/api/v1/status", headers={"authorization": f"Bearer {owner}"})
            if said.json()["link"]["status"] == "ready":
                return
            await asyncio.sleep(0.05)


@pytest.mark.slow
@needs_simulator
@each_version
async def test_a_gateway_starts_on_a_data_folder_with_everything_in_it_and_moves_nothing(
    kept: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    status = json_of(kept / "gateway.json")["answers"]["status"]
    monkeypatch.chdir(tmp_path)  # the name of the port is relative
    link = Path(status["port"]["device"])
    link.parent.mkdir(parents=True)
    board = Board(tmp_path / link, tmp_path / "bus.jsonl", status["board"])
    board.plug()
    data = str(copied(kept, tmp_path))
    served = Served(*("--lan", "--data", data), pty=Pty(), is_named=False, identifies_board=True)
    try:
        async with AsyncClient(base_url=served.url) as client:
            await until_ready(client, kept)
            await assert_lets_in_the_same_people(client, kept)
            await assert_has_everything(client, kept, deleted_in(kept))
        # Its end sends stops, too.
        served.process.terminate()
        served.process.communicate(timeout=10)
        assert {"stop", "readBattery"} <= taken_by(board) <= HARMLESS
    finally:
        served.end()
        board.pull()


def restored(kept: Path, tmp_path: Path) -> Path:
    """A folder into which the backup was put."""
    folder = tmp_path / "restored"
    result = CliRunner().invoke(command_line, ["restore", str(kept / "backup.zip"), "--data", str(folder)])
    assert result.exit_code == 0, result.output
    return folder


def copied(kept: Path, tmp_path: Path) -> Path:
    """A copy, because a gateway writes into its data folder."""
    return Path(shutil.copytree(kept / "data", tmp_path / "data"))


@asynccontextmanager
async def gateway_on(data: Path, port: FakePort, at_ms: int) -> AsyncIterator[AsyncClient]:
    """The gateway of that data folder, at that time of the world."""
    library, remembered = Library(data, now_ms=lambda: at_ms), Remembered(data)
    control = Control(
        FakePorts(port),
        now,
        UNKNOWN.id,
        None,
        epoch=first_epoch(data),
        slot_memory=SlotMemory(data),
        remembered=remembered,
        recalls_board=True,
        identifies_board=True,
        read_robot=robots_in(library),
    )
    entrance = Entrance(addresses.lan(PORT), Devices(DeviceFile(data), lambda: at_ms), now)
    app = create_app(control, library, entrance, audit=Audit(AuditFile(data), lambda: at_ms))
    assert remembered.port
    await control.use_port(remembered.port)
    try:
        async with client_of(app) as client:
            yield client
    finally:
        await control.shut_down()
        library.close()
        port.close()


@each_version
@pytest.mark.parametrize("source", [copied, restored])
@in_virtual_time
async def test_nothing_of_a_data_folder_is_lost_nor_of_a_backup(
    kept: Path, source: Callable[[Path, Path], Path], tmp_path: Path
) -> None:
    port, data = FakePort(), source(kept, tmp_path)
    async with gateway_on(data, port, kept_at_ms(kept)) as client:
        await assert_lets_in_the_same_people(client, kept)
        # The list of acts stays with its folder.
        await assert_has_everything(client, kept, ["audit"] if source is restored else [])
        await asyncio.sleep(WATCHED_S)
    assert {"stop", "readBattery"} <= kinds_of(b"".join(port.packets())) <= HARMLESS


@each_version
def test_the_memory_of_a_gateway_is_read(kept: Path, tmp_path: Path) -> None:
    data = copied(kept, tmp_path)
    slots, remembered = json_of(data / "slots.json"), json_of(data / "remembered.json")
    for board, expected in slots.items():
        memory = SlotMemory(data)
        assert memory.broken(board) == expected["broken"]
        stored = {str(slot): group.model_dump(by_alias=True) for slot, group in memory.stored(board).items()}
        assert_still_said(expected["versions"], stored, board)
    found = Remembered(data)
    assert found.port == remembered["port"]
    assert {place: found.board_at(place) for place in remembered["boards"]} == remembered["boards"]
    assert {board: found.robot_on(board) for board in remembered["robots"]} == remembered["robots"]
    # Leases of earlier starts are never valid again.
    assert first_epoch(data) > int((kept / "data" / "epoch").read_text()) * GRANTS_PER_START


@each_version
@in_virtual_time
async def test_a_gateway_keeps_its_name_in_the_fleet_and_takes_back_what_it_announced(
    kept: Path, tmp_path: Path
) -> None:
    data = Path(shutil.copytree(kept / "fleet-data", tmp_path / "data"))
    assert own_name(data, HARDWARE) == json_of(kept / "fleet-data" / "fleet.json")["name"]
    announced = json_of(kept / "fleet-data" / "home-assistant.json")["topic"]
    about = About.model_validate(message_of(kept, LAB.published(NAMES[0], "about")))
    messages = HomeAssistant(LAB, NAMES[0], "", data).messages(about)
    assert [(one.topic, one.payload) for one in messages] == [(announced, b"")]


def feed(mosquitto: Mosquitto, kept: Path) -> None:
    """The broker gets what an earlier one had retained, from those who may write it."""
    messages = json_of(kept / "fleet.json")
    with ExitStack() as clients:
        for user in {one["by"] for one in messages}:
            client = clients.enter_context(raw_client(mosquitto.broker_for(user)))
            for one in messages:
                if one["by"] == user:
                    client.say(one["topic"], one["payload"].encode(), is_retained=True)
        with console_of(mosquitto, "vera") as vera:
            assert vera.until(lambda: has_read_all(vera), 10)


def has_read_all(console: Console) -> bool:
    told = [robot.name for robot in console.robots() if robot.about and robot.state]
    return HOLD in console.holds and told == [*NAMES]


@pytest.mark.slow
@needs_mosquitto
@needs_simulator
@each_version
def test_a_fleet_reads_what_a_broker_kept_and_moves_nothing_because_of_it(
    kept: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # the name of the port is relative
    shutil.copytree(kept / "fleet-data", WORKSHOP / f"{NAMES[0]}.data")
    mosquitto = Mosquitto(tmp_path / "broker", NAMES)
    mosquitto.plan = replace(mosquitto.plan, home_assistant=PREFIX)
    mosquitto.configure()
    with mosquitto:
        feed(mosquitto, kept)
        with console_of(mosquitto, "olga") as olga:
            assert olga.until(lambda: has_read_all(olga), 10)
            for name in NAMES:
                assert_says_what_it_said(kept, olga, "silent", name)
            # The retained hold stops a gateway that connects later.
            arm = RealGateway(NAMES[0], mosquitto, WORKSHOP)
            try:
                assert olga.until(lambda: is_stopped_at_its_board(NAMES[0], olga), 10)
                assert_says_what_it_said(kept, olga, "present", NAMES[0])
                assert eventually(lambda: "stop" in taken_by(arm.board))
                assert taken_by(arm.board) <= HARMLESS
            finally:
                arm.end()


def assert_says_what_it_said(kept: Path, console: Console, presence: str, name: str) -> None:
    robot, topic = console.robot(name), LAB.published(name, "about")
    assert robot
    assert robot.about
    assert robot.presence == presence
    assert_still_said(message_of(kept, topic), json.loads(robot.about.model_dump_json(by_alias=True)), topic)


def is_stopped_at_its_board(name: str, console: Console) -> bool:
    robot = console.robot(name)
    is_stopped = bool(robot and robot.state and robot.state.latch)
    return console.is_present(name) and is_ready(name, console) and is_stopped


def message_of(kept: Path, topic: str) -> Any:
    return next(json.loads(one["payload"]) for one in json_of(kept / "fleet.json") if one["topic"] == topic)
