"""Robots in the library, and the one on the board, over HTTP: who may change what, and what holds."""

import json
import time
from pathlib import Path
from typing import Any

import pytest

from servodeck.access import addresses
from servodeck.api.library import robots_in
from servodeck.library.library import Library
from tests.fake_port import FakePort, FakePorts
from tests.robots import care, robot_text, servo, written
from tests.running import PORT, entrance_to, http_to
from tests.scripted import refusal


def robot(top: int = 1800, expected: int = 0, name: str = "Arm") -> dict[str, Any]:
    return written(robot_text(servo(2, "Elbow", 900, top), name=name), expected)


FACTS = {
    "kind": "robot",
    "name": "Arm",
    "board": "doc",
    "limits": [{"servo": 2, "name": "Elbow", "min": 900, "max": 1800, "trim": 0}],
    "poses": [{"id": 0, "name": "home", "unit": "us", "targets": [{"servo": 2, "position": 1500}]}],
    "lowBatteryMv": 7000,
    "batteryPolicy": "tell",
    "alarmMv": 6600,
}
MOVE = {"timeMs": 1500, "positions": {"2": 1900}}


async def test_a_robot_is_stored_put_on_the_board_and_its_limits_hold(tmp_path: Path) -> None:
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        assert refusal(await client.put("/api/robot", json={"id": "arm"})) == (404, "notFound")
        assert (await client.put("/api/library/arm", json=robot())).json() == {"revision": 1}
        [listed] = (await client.get("/api/library")).json()["documents"]
        assert listed["facts"].items() >= FACTS.items()
        assert (await client.put("/api/robot", json={"id": "arm"})).status_code == 204
        assert refusal(await client.post("/api/move", json=MOVE)) == (422, "outOfRange")
        # Two screens may put the same one there at once.
        assert (await client.put("/api/robot", json={"id": "arm"})).status_code == 204
        assert refusal(await client.put("/api/robot", json={"id": "hand"})) == (412, "conflict")
        await client.put("/api/library/arm", json=robot(2000, 1))
        assert (await client.post("/api/move", json=MOVE)).status_code == 200
        await client.put("/api/library/arm", json=robot(1800, 2))
        await client.post("/api/library/remove", json={"ids": ["arm"]})
        assert (await client.post("/api/move", json=MOVE)).status_code == 200


async def test_while_a_client_drives_others_change_no_limits_and_no_robot(tmp_path: Path) -> None:
    lan = entrance_to(addresses.lan(PORT))
    headers = {
        name: {"Authorization": f"Bearer {lan.devices.admit('token', name, 'driver')[1]}"}
        for name in ("Anna", "Bert")
    }
    anna, bert = headers["Anna"], headers["Bert"]
    ports, library = FakePorts(FakePort()), Library(tmp_path)
    async with http_to(ports, time.monotonic, library=library, entrance=lan) as (client, control):
        await client.put("/api/library/arm", json=robot(), headers=bert)
        await client.put("/api/robot", json={"id": "arm"}, headers=bert)
        moved = await client.post("/api/move", json={"timeMs": 1500, "positions": {"2": 1000}}, headers=anna)
        assert moved.status_code == 200
        wider = await client.put("/api/library/arm", json=robot(2000, 1), headers=bert)
        assert refusal(wider) == (409, "notDriving")
        other = {"id": "arm", "insteadOf": "arm"}
        assert refusal(await client.put("/api/robot", json=other, headers=bert)) == (409, "notDriving")
        renamed = robot(1800, 1, name="Crane")
        assert (await client.put("/api/library/arm", json=renamed, headers=bert)).json() == {"revision": 2}
        assert (await client.put("/api/library/arm", json=robot(2000, 2), headers=anna)).status_code == 200
        assert control.robot.facts is not None
        assert control.robot.facts.limits[0].max == 2000


async def test_facts_beside_a_text_are_not_believed(tmp_path: Path) -> None:
    told = FACTS | {"name": "Crane", "updatedAtMs": 7, "limits": [], "poses": [], "batteryPolicy": "refuse"}
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        assert (await client.put("/api/library/arm", json=robot() | {"facts": told})).status_code == 200
        [listed] = (await client.get("/api/library")).json()["documents"]
        assert listed["facts"] == FACTS | {"updatedAtMs": 7}
        await client.put("/api/robot", json={"id": "arm"})
        assert refusal(await client.post("/api/move", json=MOVE)) == (422, "outOfRange")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "servodeck-robot-kit"),
        (robot_text(batteryCare=care("tell", 6600, 7000)), "its battery alarm 7000 mV is not below"),
        (robot_text(servo(1, "Gripper", 900, 800)), "Gripper (servo 1): its lowest position 900"),
        (robot_text(colour="red"), "robot.colour"),
    ],
)
async def test_a_robot_that_cannot_be_is_refused_with_words(tmp_path: Path, text: str, said: str) -> None:
    facts = FACTS | {"updatedAtMs": 7}
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        answer = await client.put("/api/library/arm", json=written(text, facts=facts))
        assert refusal(answer) == (422, "malformed")
        assert said in answer.json()["detail"]
        assert (await client.get("/api/library")).json()["documents"] == []


async def test_a_robot_that_calls_itself_a_group_is_refused(tmp_path: Path) -> None:
    group = {"kind": "group", "name": "Wave", "robot": "Arm", "tags": [], "updatedAtMs": 7}
    facts = group | {"frames": 1, "durationMs": 1000, "unit": "us", "pose": []}
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        answer = await client.put("/api/library/arm", json=robot() | {"facts": facts})
        assert refusal(answer) == (422, "malformed")
        answer = await client.put("/api/library/wave", json=written("{}"))
        assert refusal(answer) == (422, "malformed")


async def test_a_robot_of_a_version_before_is_read_from_its_text(tmp_path: Path) -> None:
    """Its stored facts know no policy, and may be those that any caller claimed."""
    library = Library(tmp_path)
    old = {"kind": "robot", "name": "Arm", "board": "doc", "updatedAtMs": 7, "limits": [], "poses": []}
    text = robot_text(servo(2, "Elbow", 900, 1800), batteryCare=care("refuse", 7000, 6600))
    library.write("arm", text, json.dumps(old), 0, kind="robot")
    library.write("odd", "{}", json.dumps(old | {"limits": FACTS["limits"]}), 0, kind="robot")
    facts, revision = robots_in(library)("arm")
    assert (revision, facts.battery_policy, facts.alarm_mv, facts.updated_at_ms) == (1, "refuse", 6600, 7)
    assert facts.limits[0].max == 1800
    assert robots_in(library)("odd")[0].limits[0].max == 1800
