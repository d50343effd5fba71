"""Robots in the library, and the one on the board, over HTTP: who may change what, and what holds."""

import time
from pathlib import Path
from typing import Any

from servodeck.access import addresses
from servodeck.library.library import Library
from tests.fake_port import FakePort, FakePorts
from tests.running import PORT, entrance_to, http_to
from tests.scripted import refusal


def limits(top: int) -> list[dict[str, Any]]:
    return [{"servo": 2, "name": "Elbow", "min": 900, "max": top, "trim": 0}]


def robot(top: int = 1800, expected: int = 0, **facts: object) -> dict[str, Any]:
    described = {
        "kind": "robot",
        "name": "Arm",
        "board": "doc",
        "updatedAtMs": 1_790_000_000_000,
        "limits": limits(top),
        "poses": [],
        **facts,
    }
    return {"text": f'{{"top": {top}}}', "facts": described, "expected": expected, "isRemoved": False}


MOVE = {"timeMs": 1500, "positions": {"2": 1900}}


async def test_a_robot_is_stored_put_on_the_board_and_its_limits_hold(tmp_path: Path) -> None:
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        assert refusal(await client.put("/api/robot", json={"id": "arm"})) == (404, "notFound")
        assert (await client.put("/api/library/arm", json=robot())).json() == {"revision": 1}
        [listed] = (await client.get("/api/library")).json()["documents"]
        assert listed["facts"] == robot()["facts"] | {"lowBatteryMv": None}
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
        renamed = robot(1800, 1, name="Crane") | {"text": '{"name": "Crane"}'}
        assert (await client.put("/api/library/arm", json=renamed, headers=bert)).json() == {"revision": 2}
        assert (await client.put("/api/library/arm", json=robot(2000, 2), headers=anna)).status_code == 200
        assert control.robot.facts is not None
        assert control.robot.facts.limits[0].max == 2000
