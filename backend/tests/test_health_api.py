"""What the gateway says of itself, to people and to Prometheus."""

import asyncio
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from httpx2 import AsyncClient
from prometheus_client.parser import text_string_to_metric_families

from servodeck import __version__, threads
from servodeck.errors import PortMissingError
from servodeck.library.library import Library
from servodeck.port.link import BackgroundPorts
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.timings import wire_s
from servodeck.robot.control import Control
from tests.client import Client
from tests.fake_port import FakePort, FakePorts
from tests.running import http_to, server_on
from tests.samples import BATTERY, BATTERY_REPORT, MOVE, STOP

READY = {"status": "ready", "version": __version__, "troubles": []}


async def troubles_of(client: AsyncClient) -> dict[str, str]:
    """By part; the status agrees with them."""
    answer = await client.get("/api/health")
    assert answer.status_code == 200
    said = answer.json()
    assert said["status"] == ("degraded" if said["troubles"] else "ready")
    return {trouble["part"]: trouble["detail"] for trouble in said["troubles"]}


async def numbers_of(client: AsyncClient) -> dict[str, float]:
    """By name and labels, as `name{label=value}`."""
    text = (await client.get("/metrics")).text
    samples = [sample for family in text_string_to_metric_families(text) for sample in family.samples]
    return {
        sample.name + "".join(f"{{{k}={v}}}" for k, v in sample.labels.items()): sample.value
        for sample in samples
    }


async def test_a_gateway_with_an_open_port_is_ready_and_its_board_untouched(tmp_path: Path) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), time.monotonic, library=Library(tmp_path)) as (client, _):
        await port.until_written(1)
        assert (await client.get("/api/health")).json() == READY
        await numbers_of(client)
        assert port.packets() == [STOP]  # of the opening


async def test_a_gateway_without_a_port_is_ready(tmp_path: Path) -> None:
    nowhere = FakePorts(PortMissingError("There is none."))
    async with http_to(nowhere, time.monotonic, device=None, library=Library(tmp_path)) as (client, _):
        assert await troubles_of(client) == {}


async def test_a_lost_port_degrades_it_without_naming_the_device(tmp_path: Path) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), time.monotonic, library=Library(tmp_path)) as (client, control):
        port.unplug()
        await until_lost(control)
        assert await troubles_of(client) == {"port": "The serial port is lost (lost) and tried again."}


async def until_lost(control: Control) -> None:
    while control.board.port.status != "lost":  # noqa: ASYNC110 (the state has no event)
        await asyncio.sleep(0)


async def test_a_folder_that_takes_no_files_degrades_it_until_it_does(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("in the way")
    now = 0.0
    # No port: where the clock stands still, nothing would leave.
    async with http_to(FakePorts(), lambda: now, None, library=Library(tmp_path / "data")) as (client, _):
        assert "takes no files" in (await troubles_of(client))["disk"]
        (tmp_path / "data").unlink()
        now = 10.0
        assert await troubles_of(client) == {}


async def test_a_disk_that_hangs_does_not_make_health_hang(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answers = threading.Event()

    def hang(**_: Any) -> None:
        answers.wait()
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(tempfile, "TemporaryFile", hang)
    async with http_to(FakePorts(FakePort()), time.monotonic, library=Library(tmp_path)) as (client, _):
        assert await troubles_of(client) == {"disk": "The disk does not answer."}
        assert await troubles_of(client) == {"disk": "The disk does not answer."}
        assert sum(thread.name == threads.NAME for thread in threading.enumerate()) == 1
        answers.set()
        assert "Input/output" in (await troubles_of(client))["disk"]


async def test_a_held_up_loop_is_reported() -> None:
    async with (
        server_on(BackgroundPorts(), None) as running,
        AsyncClient(base_url=f"http://{running.host}") as client,
    ):
        asyncio.get_running_loop().call_soon(time.sleep, 0.8)  # three beats
        await asyncio.sleep(0.3)
        assert "loop" in await troubles_of(client)
        assert (await numbers_of(client))["servodeck_loop_delay_seconds"] > 0.25


async def answer_to_the_third(port: FakePort) -> None:
    """Behind the first stop and a move."""
    await port.until_written(3)
    # No board answers what has not reached it yet.
    await asyncio.sleep(wire_s(len(BATTERY)))
    port.say(BATTERY_REPORT)


async def test_what_happens_is_counted(tmp_path: Path) -> None:
    port = FakePort()
    async with http_to(FakePorts(port), time.monotonic, library=Library(tmp_path)) as (client, control):
        before, written = await numbers_of(client), len(port.everything())
        await Client(control).send(MOVE)
        answering = asyncio.create_task(answer_to_the_third(port))
        await client.get("/api/battery")
        await answering
        port.say(b"\x01\x02")
        await client.get("/api/nothing")
        await client.post("/api/stop")
        port.unplug()
        await until_lost(control)
        after = await numbers_of(client)
    grown = {name: after[name] - before.get(name, 0) for name in after if not name.endswith("_created")}
    assert grown["servodeck_packets_sent_total{command=move}"] == 1
    assert grown["servodeck_packets_sent_total{command=readBattery}"] == 1
    # Three, and a row where one begins to leave before the port is lost.
    stops = sum(packet[COMMAND_AT] == STOP[COMMAND_AT] for _, packet in port.everything()[written:])
    assert grown["servodeck_packets_sent_total{command=stop}"] == stops
    assert 3 <= stops <= 4
    assert grown["servodeck_packets_received_total{command=readBattery}"] == 1
    assert grown["servodeck_noise_bytes_total"] == 2
    assert grown["servodeck_refused_total{code=notFound}"] == 1
    assert grown["servodeck_queue_wait_seconds_count"] == 2
    assert grown["servodeck_stops_total"] == 1
    assert grown["servodeck_port_losses_total"] == 1
    assert after["servodeck_port_state{status=lost}"] == 1
    assert after["servodeck_port_state{status=open}"] == 0
    assert after["servodeck_battery_millivolts"] == 7500
    assert after["servodeck_latched"] == 1
    assert after["process_resident_memory_bytes"] > 0
    assert port.packets().count(BATTERY) == 1
