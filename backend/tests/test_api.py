"""What a script can do over HTTP."""

import asyncio
import time

from servodeck import __version__
from servodeck.errors import PortBusyError, PortMissingError
from servodeck.port.diagnosis import Heard
from tests.client import ANNA, Client
from tests.fake_port import FakePort, FakePorts
from tests.running import DEVICE, http_to
from tests.samples import BATTERY, BATTERY_REPORT, MOVE, STOP
from tests.virtual_time import at, in_virtual_time, now

QUIET = {"simulated": False, "withheld": [], "code": None, "detail": None, "heldBy": [], "retryInMs": None}
OPEN = {"device": DEVICE, "status": "open", **QUIET}
CLOSED = {"device": None, "status": "closed", **QUIET}


@in_virtual_time
async def test_status_tells_how_everything_stands() -> None:
    async with http_to(FakePorts(FakePort()), now) as (client, _):
        assert (await client.get("/api/status")).json() == {
            "version": __version__,
            "board": "doc",
            "port": OPEN,
            "link": {"status": "ready", "code": None, "detail": None},
            "identity": {"evidence": [], "candidates": []},
            "latch": False,
            "clients": 0,
            "battery": None,
            "driver": None,
            "running": None,
            "play": None,
            "unattended": None,
            "notifications": [],
            "fleet": None,
        }


@in_virtual_time
async def test_the_battery_is_asked_and_remembered_with_its_age() -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, _):
        at(0.1, lambda: port.say(BATTERY_REPORT))
        assert (await client.get("/api/battery")).json() == {"batteryMv": 7500}
        await asyncio.sleep(2)
        assert (await client.get("/api/status")).json()["battery"] == {"batteryMv": 7500, "ageMs": 2000}
        assert port.packets() == [STOP, BATTERY]


@in_virtual_time
async def test_a_silent_board_is_a_time_out() -> None:
    async with http_to(FakePorts(FakePort()), now) as (client, _):
        answer = await client.get("/api/battery")
        assert answer.status_code == 504
        assert answer.json()["code"] == "noAnswer"


@in_virtual_time
async def test_stop_answers_when_the_stops_have_left_and_resume_moves_nothing() -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, control):
        await asyncio.sleep(1)
        assert (await client.post("/api/stop")).json() == {
            "latch": True,
            "halted": True,
            # Motion from before the port was opened.
            "unheld": {"servos": None, "forMs": 29_080},
        }
        assert port.packets() == [STOP] * 4
        assert control.latch is True
        assert (await client.post("/api/resume")).json()["latch"] is False
        await asyncio.sleep(1)
        assert port.packets() == [STOP] * 4


@in_virtual_time
async def test_a_page_gets_the_name_of_a_script_that_stopped_and_resumed() -> None:
    async with http_to(FakePorts(FakePort()), now) as (client, control):
        anna = Client(control)
        page = {"origin": str(client.base_url).rstrip("/")}
        for headers, name in (({}, "A script on this computer"), (page, "This computer")):
            await client.post("/api/stop", headers=headers)
            await client.post("/api/resume", headers=headers)
            names = [(one.get("stoppedBy"), one.get("by")) for one in await anna.heard()]
            assert [stopped for stopped, _ in names if stopped] == [name]
            assert [by for _, by in names if by] == [name]


async def test_a_port_is_chosen_and_closed() -> None:
    ports = FakePorts(FakePort(), FakePort())
    async with http_to(ports, time.monotonic) as (client, control):
        chosen = await client.put("/api/port", json={"device": "/dev/other", "board": "lsc-16"})
        assert chosen.json() == {**OPEN, "device": "/dev/other"}
        assert control.board.family_id == "lsc-16"
        assert control.remembered.port == "/dev/other"
        assert (await client.delete("/api/port")).json() == CLOSED
        assert control.remembered.port is None
        assert (await client.delete("/api/port")).json() == CLOSED
        refused = await client.get("/api/battery")
        assert (refused.status_code, refused.json()["code"]) == (409, "closed")


@in_virtual_time
async def test_a_port_that_cannot_be_had_is_refused_with_its_reason_and_tried_again() -> None:
    ports = FakePorts(PortBusyError("minicom (7) has it.", ["minicom (7)"]), FakePort())
    async with http_to(ports, now, device=None) as (client, control):
        refused = await client.put("/api/port", json={"device": DEVICE})
        assert refused.status_code == 503
        assert refused.json() == {
            "code": "portBusy",
            "detail": "minicom (7) has it.",
            "heldBy": ["minicom (7)"],
        }
        assert control.remembered.port is None
        assert (await client.get("/api/status")).json()["port"]["retryInMs"] == 250
        await asyncio.sleep(1)
        assert (await client.get("/api/status")).json()["port"] == OPEN


@in_virtual_time
async def test_a_board_at_another_speed_is_heard_where_it_is_at_rest_and_no_other_client_drives() -> None:
    ports = FakePorts(*(FakePort() for _ in range(5)))
    async with http_to(ports, now) as (client, control):
        assert (await client.post("/api/port/listen")).json() == {"baud": None, "kind": None}
        for heard, kind in ((Heard(packets=1), "packets"), (Heard(noise=bytearray(b"rst:0x1")), "text")):
            ports.at_other_rates = (115200, heard)
            assert (await client.post("/api/port/listen")).json() == {"baud": 115200, "kind": kind}
        await asyncio.sleep(1)
        anna = Client(control, ANNA)
        await anna.send(MOVE)
        refused = await client.post("/api/port/listen")
        assert (refused.status_code, refused.json()["code"]) == (409, "notDriving")
        control.driving.act(anna, "release")
        refused = await client.post("/api/port/listen")
        assert (refused.status_code, refused.json()["code"]) == (409, "busy")
        assert ports.listened == [DEVICE] * 3
        await asyncio.sleep(60)
        assert (await client.post("/api/port/listen")).status_code == 200


@in_virtual_time
async def test_while_stopped_the_battery_can_still_be_asked() -> None:
    port = FakePort()
    async with http_to(FakePorts(port), now) as (client, control):
        Client(control).send(MOVE)
        await client.post("/api/stop")
        at(now() + 0.1, lambda: port.say(BATTERY_REPORT))
        assert (await client.get("/api/battery")).status_code == 200


async def test_the_ports_list_holds_the_one_named_at_the_start() -> None:
    ports = FakePorts(PortMissingError("There is no such port."))
    async with http_to(ports, time.monotonic, device=None) as (client, control):
        control.named_device = DEVICE
        listed = (await client.get("/api/ports")).json()
        assert listed[0] == {
            "device": DEVICE,
            "description": "Port",
            "likely": True,
            "lasting": None,
            "inUse": False,
        }
