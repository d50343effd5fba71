"""`servodeck mcp` as an assistant has it: the official client of the protocol, a real gateway, and a port of
which the test sees each packet.
"""

import asyncio
import base64
import json
import os
import subprocess
import sys
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import jsonschema_rs
import pytest
from mcp import Client, StdioServerParameters, stdio_client
from PIL import Image
from typer.testing import CliRunner

from servodeck.access import addresses
from servodeck.assistant.gateway import Requests
from servodeck.assistant.server import make_server
from servodeck.callers import Role
from servodeck.cli.main import app
from servodeck.client.asynchronous import AsyncRobot
from servodeck.client.gateway import Call
from servodeck.client.opening import gateway_at
from servodeck.errors import MalformedError
from servodeck.robot.latch import Cause
from tests.fake_port import FakePorts
from tests.samples import STOP
from tests.scripted import move
from tests.served_robot import Served, served
from tests.test_client import BoardPort, drives, has, sent
from tests.test_with_simulator import ROOT

pytestmark = pytest.mark.slow

LOOKING = {"get_snapshot", "get_robot", "get_pose_picture", "list_groups", "get_group"}
FOR_ALL = LOOKING | {"propose_group", "stop"}
MOVING = {"move_servos", "go_to_pose", "run_slot"}
WAVE = [
    {"seconds": 0.5, "degrees": {"Base": 30, "Gripper": 10}},
    {"seconds": 0.5, "degrees": {"base": -30}, "easing": "inOut", "note": "and back"},
]


@pytest.fixture
def port() -> BoardPort:
    return BoardPort()


@pytest.fixture
def here(tmp_path: Path, port: BoardPort) -> Iterator[Served]:
    with served(tmp_path, FakePorts(port)) as made:
        yield made


@asynccontextmanager
async def assistant(here: Served, token: str = "", *, may_drive: bool = True) -> AsyncIterator[Client]:
    """As `servodeck mcp --drive`, without a process."""
    requests = Requests(gateway_at(here.url, token, None, None, 5.0))
    async with (
        AsyncRobot(here.url, token=token) as robot,
        Client(make_server(robot, requests, drives=may_drive)) as client,
    ):
        yield client


async def told(client: Client, tool: str, **arguments: Any) -> Any:
    """What the tool answers."""
    answer = await client.call_tool(tool, arguments)
    assert not answer.is_error, answer.content
    return answer.structured_content


async def refusal(client: Client, tool: str, **arguments: Any) -> str:
    answer = await client.call_tool(tool, arguments)
    assert answer.is_error
    text = answer.content[0]
    assert text.type == "text"
    return text.text.removeprefix(f"Error executing tool {tool}: ")


def token_of(here: Served, role: Role, name: str = "Claude") -> str:
    async def make() -> str:
        return here.running.entrance.devices.admit("token", name, role)[1]

    return here.at_gateway(make())


async def proposed(client: Client, name: str, frames: Any) -> tuple[dict[str, Any], Image.Image]:
    answer = await client.call_tool("propose_group", {"name": name, "frames": frames})
    assert not answer.is_error, answer.content
    said, picture = answer.content
    assert said.type == "text"
    assert picture.type == "image"
    return json.loads(said.text), Image.open(BytesIO(base64.b64decode(picture.data)))


async def test_it_knows_the_robot_in_degrees(here: Served) -> None:
    async with assistant(here) as client:
        robot = await told(client, "get_robot")
        assert [one["name"] for one in robot["joints"]] == ["Base", "Elbow", "Gripper"]
        assert robot["joints"][1] == {
            "servo": 2,
            "name": "Elbow",
            "leastDegrees": -90.0,
            "mostDegrees": 60.0,
        }
        assert robot["poses"] == ["home", "Greeting"]
        now = await told(client, "get_snapshot")
        assert now["degrees"] == {}
        assert not now["is_stopped"]


async def test_it_moves_by_name_and_sees_where_servos_are(here: Served, port: BoardPort) -> None:
    async with assistant(here) as client:
        await told(client, "move_servos", degrees={"Elbow": 10}, seconds=1.5)
        assert (await told(client, "get_snapshot"))["degrees"] == {"Elbow": 10.0}
        answer = await client.call_tool("get_pose_picture", {})
        assert answer.content[0].type == "image"
        assert move(1500, s2=1420) in sent(port)
    assert here.running.control.driving.driver is None


async def test_a_proposal_is_a_draft_of_the_library_and_moves_nothing(here: Served, port: BoardPort) -> None:
    async with assistant(here) as client:
        answer, picture = await proposed(client, "Wave", WAVE)
        assert answer["problems"] == []
        assert answer["seconds"] == 1.0
        assert answer["ranges"] == {"Base": [-30.0, 30.0], "Gripper": [10.0, 10.0]}
        assert picture.size == (640, 300)
        (listed,) = (await told(client, "list_groups"))["result"]
        assert listed == {
            "id": answer["id"],
            "name": "Wave",
            "tags": ["draft", "by A script on this computer"],
            "seconds": 1.0,
            "frames": 2,
        }
        read = await told(client, "get_group", id=answer["id"])
        assert read["frames"][1] == {"seconds": 0.5, "degrees": {"Base": -30.0}, "note": "and back"}
        assert not {tool.name for tool in (await client.list_tools()).tools} & {
            "play",
            "play_group",
            "resume",
        }
    assert sent(port) == []


async def test_its_draft_follows_the_published_schema(here: Served) -> None:
    schema = json.loads((ROOT / "docs" / "group.schema.json").read_text("utf-8"))
    async with assistant(here) as client:
        answer, _ = await proposed(client, "Wave", WAVE)
    requests = Requests(gateway_at(here.url, "", None, None, 5.0))
    content = await requests.group(answer["id"])
    document = {"format": "servodeck-group", "version": 1, "content": content}
    jsonschema_rs.validate(schema, document)
    assert content["frames"][0]["targets"] == [
        {"servo": 1, "position": 1800},
        {"servo": 3, "position": 1600},
    ]


async def test_a_proposal_that_does_not_fit_is_explained_and_not_stored(here: Served) -> None:
    frames = [
        {"seconds": 0.5, "degrees": {"Base": 95}},
        {"seconds": 0.5, "degrees": {"Wrist": 0, "Gripper": 0}},
        {"seconds": 40, "degrees": {"Gripper": 10}},
        {"seconds": 1, "degrees": {"Base": 10, "1": -10}},
    ]
    async with assistant(here) as client:
        answer, _ = await proposed(client, "Too far", frames)
        assert answer["id"] is None
        assert answer["problems"] == [
            "Frame 1: Base (servo 1) cannot go to 95 degrees: -90 to 90.",
            "Frame 2: no servo is called Wrist. There are: Base, Elbow, Gripper.",
            "Frame 3: 40000 ms; the board takes 20 to 30000.",
            "Frame 4: Base (servo 1) is named twice.",
        ]
        assert (await told(client, "list_groups"))["result"] == []


async def test_what_a_tool_does_not_take_is_refused_by_name(here: Served, port: BoardPort) -> None:
    async with assistant(here) as client:
        degrees = {"Base": 0.3}
        said = await refusal(client, "move_servos", degrees=degrees, units="rad")
        assert said == "malformed: units is no argument of move_servos, allowed: degrees, seconds"
        frames = [{"seconds": 1, "degrees": degrees, "units": "rad"}]
        assert "units" in await refusal(client, "propose_group", name="Rad", frames=frames)
        frames = [{"seconds": 1, "degrees": degrees, "easing": "bounce"}]
        assert "'linear', 'in', 'out' or 'inOut'" in await refusal(
            client, "propose_group", name="Bounce", frames=frames
        )
        twice = await refusal(client, "move_servos", degrees={"Base": 10, "1": -10})
        assert twice == "outOfRange: Servo 1 is named twice, the second time as 1."
        assert sent(port) == []
        await told(client, "stop", units="rad")
        assert here.running.control.latch


async def test_a_fast_turn_is_remarked_upon(here: Served) -> None:
    frames = [{"seconds": 1, "degrees": {"Base": -80}}, {"seconds": 0.2, "degrees": {"Base": 80}}]
    async with assistant(here) as client:
        answer, _ = await proposed(client, "Fast", frames)
    assert answer["id"] is not None
    assert answer["remarks"] == [
        "Frame 2: Base would turn at 800 degrees a second; common servos reach about 300, so it comes late."
    ]


async def test_nobody_can_propose_in_the_name_of_another(tmp_path: Path, port: BoardPort) -> None:
    with served(tmp_path, FakePorts(port), make_access=addresses.lan) as lan:
        gateway = gateway_at(lan.url, token_of(lan, "viewer", "Mallory"), None, None, 5.0)
        requests = Requests(gateway)
        content = {"name": "Wave", "tags": ["by Anna"], "frames": []}
        text = json.dumps({"format": "servodeck-group", "version": 1, "content": content})
        facts = {"kind": "group", "name": "Wave", "robot": "", "tags": ["by Anna"], "updatedAtMs": 1}
        facts |= {"frames": 0, "durationMs": 0, "unit": "us", "pose": []}
        stored = await requests.propose(text, facts)
        assert (await requests.group(stored))["tags"] == ["draft", "by Mallory"]
        (listed,) = await requests.groups()
        assert listed.tags == ["draft", "by Mallory"]
        for other in ("{}", "[]", '{"format": "servodeck-robot", "content": {}}'):
            with pytest.raises(MalformedError):
                await requests.propose(other, facts)


async def test_a_draft_that_a_person_stored_on_the_board_is_not_run_before_they_took_it(
    here: Served, port: BoardPort
) -> None:
    port.ends_in_s = 0.1
    async with assistant(here) as client:
        answer, _ = await proposed(client, "Wave", WAVE)
        board = here.running.control.board
        board.slot_memory.store(board.link.place, 3, "1", "Wave", answer["id"], "Anna")
        for group in (3, "Wave"):
            assert (
                await refusal(client, "run_slot", group=group) == "Slot 3 holds a draft: a person plays it."
            )
        assert sent(port) == []


def test_without_its_parts_the_command_says_how_to_get_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.cli.assistant.find_spec", lambda _: None)
    said = CliRunner().invoke(app, ["mcp"])
    assert said.exit_code == 1
    assert "pip install 'servodeck[mcp]'" in said.stderr


async def test_a_tool_that_is_not_listed_cannot_be_called(here: Served, port: BoardPort) -> None:
    async with assistant(here, may_drive=False) as client:
        answer = await client.call_tool("move_servos", {"degrees": {"Base": 0}})
    assert answer.is_error
    assert sent(port) == []


async def test_there_are_so_many_drafts_and_not_more(here: Served) -> None:
    async with assistant(here) as client:
        for number in range(20):
            await proposed(client, f"Draft {number}", WAVE)
        said = await refusal(client, "propose_group", name="One more", frames=WAVE)
    assert said == "outOfRange: There are 20 drafts, which is the limit. Delete some first."


@pytest.mark.parametrize(
    ("name", "arguments", "code"),
    [
        ("move_servos", {"degrees": {"Base": 95}}, "outOfRange: Base (servo 1): position is 2450"),
        ("move_servos", {"degrees": {"Wrist": 0}}, "notFound: No servo is called Wrist"),
        ("go_to_pose", {"pose": "Bow"}, "notFound: No pose is called Bow"),
        ("run_slot", {"group": "Wave"}, "notFound: No slot is known to hold Wave"),
        ("move_servos", {"degrees": {"Base": 0}, "seconds": 0.1}, "seconds"),
        ("run_slot", {"group": 3, "times": 0}, "times"),
    ],
)
async def test_what_must_not_be_is_refused(
    here: Served, port: BoardPort, name: str, arguments: dict[str, Any], code: str
) -> None:
    async with assistant(here) as client:
        assert code in await refusal(client, name, **arguments)
    assert [packet for packet in sent(port) if packet != STOP] == []


async def test_stop_ends_its_motion_and_only_a_person_resumes(here: Served, port: BoardPort) -> None:
    async with assistant(here) as client:
        moving = asyncio.create_task(refusal(client, "move_servos", degrees={"Base": 30}, seconds=5))
        await asyncio.to_thread(has, lambda: bool(sent(port)))
        await asyncio.to_thread(here.at_gateway, stopped_by_anna(here))
        assert (await moving).startswith("latched: ")
        count = len(port.packets())
        assert (await refusal(client, "go_to_pose", pose="home")).startswith("latched: ")
        now = await told(client, "get_snapshot")
        assert (now["is_stopped"], now["stopped_by"]) == (True, "Anna")
        assert len(port.packets()) == count


async def stopped_by_anna(here: Served) -> None:
    await here.running.control.stop(Cause("person", "Anna"))


async def test_its_own_stop_needs_no_right_to_drive(here: Served, port: BoardPort) -> None:
    async with assistant(here, may_drive=False) as client:
        answer = await client.call_tool("stop", {})
    assert not answer.is_error
    assert STOP in sent(port)
    assert here.running.control.latch


async def test_it_waits_its_turn_while_a_person_drives(here: Served, port: BoardPort) -> None:
    await asyncio.to_thread(here.at_gateway, drives(here))
    async with assistant(here) as client:
        assert (await refusal(client, "go_to_pose", pose="home")).startswith("notDriving: Anna drives")


ROLES: list[tuple[Role, set[str]]] = [("viewer", FOR_ALL), ("driver", FOR_ALL | MOVING)]


@asynccontextmanager
async def started(url: str, *options: str, **env: str) -> AsyncIterator[Client]:
    """The command itself, as an assistant's program starts it."""
    command = StdioServerParameters(
        command=sys.executable,
        args=["-m", "servodeck", "mcp", "--url", url, *options],
        env={"PYTHONPATH": os.pathsep.join(path for path in sys.path if path), **env},
    )
    async with Client(stdio_client(command)) as client:
        yield client


async def names(client: Client) -> set[str]:
    return {tool.name for tool in (await client.list_tools()).tools}


@pytest.mark.parametrize(("role", "tools"), ROLES)
async def test_the_tools_are_those_of_the_tokens_role(
    tmp_path: Path, port: BoardPort, role: Role, tools: set[str]
) -> None:
    with served(tmp_path, FakePorts(port), make_access=addresses.lan) as lan:
        token = token_of(lan, role)
        async with started(lan.url, SERVODECK_TOKEN=token) as client:
            assert await names(client) == tools
            answer, _ = await proposed(client, "Wave", WAVE)
            (listed,) = (await told(client, "list_groups"))["result"]
            assert listed["tags"] == ["draft", "by Claude"]
            assert answer["id"] == listed["id"]


async def test_on_the_gateways_computer_it_drives_only_when_told_so(here: Served) -> None:
    async with started(here.url) as client:
        assert await names(client) == FOR_ALL
    async with started(here.url, "--drive") as client:
        assert await names(client) == FOR_ALL | MOVING


async def test_a_revoked_token_ends_its_motion_and_everything_else(tmp_path: Path, port: BoardPort) -> None:
    with served(tmp_path, FakePorts(port), make_access=addresses.lan) as lan:
        token = token_of(lan, "driver")
        async with assistant(lan, token) as client:
            moving = asyncio.create_task(refusal(client, "move_servos", degrees={"Base": 30}, seconds=5))
            await asyncio.to_thread(has, lambda: bool(sent(port)))
            assert (await told(client, "get_snapshot"))["driver"] == "Claude"
            owner = gateway_at(lan.url, token_of(lan, "owner", "Anna"), None, None, 5.0)
            device = token.partition(".")[0]
            await asyncio.to_thread(owner.call, Call("DELETE", f"/api/people/{device}"))
            assert "notPaired" in await moving
            assert "notPaired" in await refusal(client, "get_snapshot")
        assert STOP in sent(port)


def test_without_a_gateway_it_says_so(run_command: Callable[..., tuple[int, str]]) -> None:
    code, said = run_command("mcp", "--url", "http://127.0.0.1:1")
    assert code == 1
    assert said.startswith("No tools at http://127.0.0.1:1: No gateway answers at 127.0.0.1")


@pytest.fixture
def run_command() -> Callable[..., tuple[int, str]]:
    def run(*arguments: str) -> tuple[int, str]:
        done = subprocess.run(
            [sys.executable, "-m", "servodeck", *arguments],
            capture_output=True,
            text=True,
            timeout=30,
            check=False,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        )
        return done.returncode, done.stderr

    return run
