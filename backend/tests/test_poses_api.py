"""The poses of the robot on the board, as a script finds them and goes there."""

import time
from pathlib import Path
from typing import Any

from httpx2 import AsyncClient

from servodeck.library.library import Library
from tests.fake_port import FakePort, FakePorts
from tests.robots import robot_text, written
from tests.running import http_to
from tests.samples import STOP
from tests.scripted import move, refusal


def pose(number: int, name: str, unit: str = "us", **positions: int) -> dict[str, Any]:
    targets = [{"servo": int(servo[1:]), "position": at} for servo, at in positions.items()]
    return {"id": number, "name": name, "unit": unit, "targets": targets}


POSES = [
    pose(1, "Greeting", s1=1800, s2=900),
    pose(2, "Rest", s1=1500),
    pose(3, "Rest", s1=1400),
    pose(4, "2", s1=1300),
    pose(5, "Steps", "steps", s1=500),
    pose(6, "Far", s1=2600),
]
HOME = pose(0, "home", s1=1500)


async def describe(client: AsyncClient) -> None:
    document = written(robot_text(poses=POSES))
    assert (await client.put("/api/library/arm", json=document)).status_code == 200
    assert (await client.put("/api/robot", json={"id": "arm"})).status_code == 204


async def test_the_poses_are_those_of_the_robot_on_the_board(tmp_path: Path) -> None:
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        assert (await client.get("/api/poses")).json() == {"robot": "", "poses": []}
        await describe(client)
        assert (await client.get("/api/poses")).json() == {"robot": "Arm", "poses": [HOME, *POSES]}
        await client.put("/api/library/arm", json=written(robot_text(), 1))
        assert (await client.get("/api/poses")).json()["poses"] == [HOME]


async def test_a_script_goes_to_a_pose_by_number_or_name(tmp_path: Path) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), time.monotonic, library=Library(tmp_path)) as (client, _):
        await describe(client)
        begun = await client.post("/api/poses/Greeting/apply")
        assert begun.json() == {"packets": 2, "overInMs": 1500, "firstMoves": [1, 2]}
        assert (await client.post("/api/poses/1/apply", json={"timeMs": 1600})).status_code == 200
        assert (await client.post("/api/poses/2/apply")).status_code == 200
        *sent, last = port.packets()[1:]
        assert sent == [move(1500, s1=1800), move(1500, s2=900), move(1600, s1=1800, s2=900)]
        # Servo 2 is under way from an unknown place, and is not made faster.
        assert last in [move(duration_ms, s1=1500) for duration_ms in range(1500, 1601)]


async def test_an_unreachable_pose_is_refused_and_moves_nothing(tmp_path: Path) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), time.monotonic, library=Library(tmp_path)) as (client, _):
        await describe(client)
        for name, expected in {
            "Nowhere": (404, "notFound"),
            "Rest": (422, "outOfRange"),
            "Steps": (422, "outOfRange"),
            "Far": (422, "outOfRange"),
        }.items():
            assert refusal(await client.post(f"/api/poses/{name}/apply")) == expected
        detail = (await client.post("/api/poses/Rest/apply")).json()["detail"]
        assert "2, 3" in detail
        assert (await client.get("/api/status")).json()["driver"] is None
        await port.until_written(1)
        assert set(port.packets()) == {STOP}  # the opening's own
