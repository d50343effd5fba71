"""Bluetooth modules as ports: characteristics, pieces, and sentences for a person; and bleak itself on
a stand-in for BlueZ, with the simulated board behind its module.
"""

import asyncio
import json
import subprocess
import sys
from collections.abc import AsyncIterator, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import pytest
from bleak.exc import BleakBluetoothNotAvailableError, BleakDBusError, BleakError
from bleak.exc import BleakBluetoothNotAvailableReason as Reason
from hypothesis import given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner
from websockets.asyncio.client import connect

from servodeck.cli.main import app
from servodeck.errors import OtherDeviceError, PortDeniedError, PortError, PortLostError, PortMissingError
from servodeck.port.bluetooth import (
    CHUNK_BYTES,
    GATHER_S,
    Bluetooth,
    BluetoothPort,
    choose,
    explain,
    this_computer,
    write_in_chunks,
)
from servodeck.port.link import BackgroundPorts
from servodeck.port.reader import Gathered
from servodeck.protocol.decoder import Decoder, DecoderEvent
from servodeck.protocol.families import UNKNOWN
from servodeck.protocol.timings import wire_s
from tests.amount import TIMES
from tests.bluetooth_board import BluetoothBoard, why_not
from tests.running import Running, server_on
from tests.samples import BATTERY, MOVE, STOP
from tests.test_clients import drive, hear_until, say
from tests.test_with_simulator import hear_port
from tests.vectors import load_vectors
from tests.virtual_time import in_virtual_time, now

ADDRESS = "48:87:2D:62:C6:00"


@dataclass(frozen=True)
class Offered:
    short: str
    properties: list[str]

    @property
    def uuid(self) -> str:
        return f"0000{self.short}-0000-1000-8000-00805f9b34fb"


@pytest.mark.parametrize(
    ("offered", "expected"),
    [
        ([Offered("ffe1", ["write-without-response", "notify"])], ("ffe1", "ffe1")),
        ([Offered("ffe1", ["write", "notify"])], ("ffe1", "ffe1")),
        ([Offered("ffe2", ["write"]), Offered("ffe1", ["read", "notify"])], ("ffe1", "ffe2")),
        ([Offered("ffe2", ["write"]), Offered("ffe1", ["notify", "write"])], ("ffe1", "ffe1")),
        ([Offered("ffe1", ["read", "notify"])], None),
        ([Offered("2a00", ["write", "notify"])], None),
    ],
)
def test_a_characteristic_is_chosen_by_what_it_can(
    offered: list[Offered], expected: tuple[str, str] | None
) -> None:
    chosen = choose(offered)
    assert (chosen and tuple(one.short for one in chosen)) == expected


@in_virtual_time
async def take(data: bytes, chunks: list[tuple[float, bytes]]) -> None:
    async def write(chunk: bytes) -> None:
        chunks.append((now(), chunk))

    await write_in_chunks(data, write)


@settings(max_examples=30 * TIMES)
@given(st.binary(min_size=1, max_size=255))
def test_a_packet_goes_in_pieces_as_fast_as_the_line_behind_the_module(data: bytes) -> None:
    chunks: list[tuple[float, bytes]] = []
    take(data, chunks)
    assert b"".join(chunk for _, chunk in chunks) == data
    assert all(len(chunk) <= CHUNK_BYTES for _, chunk in chunks)
    for (before_s, chunk), (next_s, _) in pairwise(chunks):
        assert next_s - before_s == pytest.approx(wire_s(len(chunk)), abs=0.0005)


@in_virtual_time
async def hear(pieces: list[tuple[int, bytes]], heard: list[tuple[float, bytes]]) -> None:
    """Each piece comes so many milliseconds behind the one before."""
    gathered = Gathered(lambda data: heard.append((round(now() * 1000), data)), CHUNK_BYTES, GATHER_S)
    for pause_ms, piece in pieces:
        await asyncio.sleep(pause_ms / 1000)
        gathered.add(piece)
    await asyncio.sleep(1)


def test_a_report_of_two_notifications_is_not_cut_by_a_slow_radio() -> None:
    heard: list[tuple[float, bytes]] = []
    hear([(0, b"1" * CHUNK_BYTES), (120, b"234"), (10, b"5" * CHUNK_BYTES)], heard)
    assert heard == [(120, b"1" * CHUNK_BYTES + b"234"), (280, b"5" * CHUNK_BYTES)]


@settings(max_examples=30 * TIMES)
@given(st.lists(st.tuples(st.integers(0, 300), st.binary(min_size=1, max_size=CHUNK_BYTES)), max_size=8))
def test_however_a_board_is_heard_every_byte_comes_through_in_order(pieces: list[tuple[int, bytes]]) -> None:
    heard: list[tuple[float, bytes]] = []
    hear(pieces, heard)
    assert b"".join(data for _, data in heard) == b"".join(piece for _, piece in pieces)


REPORTS = [bytes.fromhex(vector["hex"]) for vector in load_vectors("reports")]
DELAYS_MS = st.lists(st.integers(0, 140), min_size=13, max_size=13)


@settings(max_examples=30 * TIMES)
@given(st.lists(st.tuples(st.sampled_from(REPORTS), DELAYS_MS), max_size=5))
def test_however_the_radio_cuts_and_delays_packets_they_are_those_of_a_serial_line(
    said: list[tuple[bytes, list[int]]],
) -> None:
    pieces = [
        (delays_ms[at // CHUNK_BYTES] + (0 if at else 300), packet[at : at + CHUNK_BYTES])
        for packet, delays_ms in said
        for at in range(0, len(packet), CHUNK_BYTES)
    ]
    heard: list[tuple[float, bytes]] = []
    hear(pieces, heard)
    assert decoded(heard) == decoded([(at * 300, packet) for at, (packet, _) in enumerate(said)])


def decoded(heard: list[tuple[float, bytes]]) -> list[DecoderEvent]:
    """A silence of 60 ms is the end of what was said."""
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append)
    for (at_ms, data), (next_ms, _) in pairwise([*heard, (float("inf"), b"")]):
        decoder.push(data)
        if next_ms - at_ms >= 60:
            decoder.idle()
    return events


@pytest.mark.parametrize(
    ("error", "expected", "words"),
    [
        (BleakBluetoothNotAvailableError("", Reason.POWERED_OFF), PortMissingError, "switched off"),
        (BleakBluetoothNotAvailableError("", Reason.NO_BLUETOOTH), PortMissingError, "no Bluetooth adapter"),
        (BleakBluetoothNotAvailableError("", Reason.DENIED_BY_USER), PortDeniedError, "may not use"),
        (BleakDBusError("org.freedesktop.DBus.Error.AccessDenied", []), PortDeniedError, "usermod"),
        (BleakDBusError("org.freedesktop.DBus.Error.ServiceUnknown", []), PortMissingError, "apt install"),
        (FileNotFoundError(2, "no bus"), PortMissingError, "not running"),
        (BleakDBusError("org.bluez.Error.NotReady", []), PortMissingError, "switched off"),
        (TimeoutError(), PortError, "TimeoutError"),
        (BleakError("odd"), PortError, "odd"),
    ],
)
def test_a_failure_is_reported_with_a_remedy(error: Exception, expected: type[PortError], words: str) -> None:
    explained = explain("ble:X", error)
    assert isinstance(explained, expected)
    assert words in explained.detail


def test_without_the_extra_the_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "bleak", None)
    with pytest.raises(PortMissingError, match=r"servodeck\[ble\]"):
        Bluetooth().open("ble:Hiwonder")


def test_bleak_is_not_loaded_before_a_module_is_requested() -> None:
    """It would take a fifth of the gateway's start."""
    code = "import sys, servodeck.port.link; sys.exit('bleak' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


needs_bluez = pytest.mark.skipif(why_not() is not None, reason=f"Bluetooth: {why_not()}")


@pytest.fixture
def board(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> Iterator[BluetoothBoard]:
    made = BluetoothBoard(tmp_path, getattr(request, "param", ("Hiwonder",)))
    made.start()
    monkeypatch.setenv("DBUS_SYSTEM_BUS_ADDRESS", made.bus_address)
    this_computer.cache_clear()
    yield made
    made.end()


@pytest.fixture
async def gateway(board: BluetoothBoard) -> AsyncIterator[Running]:
    async with server_on(BackgroundPorts(), f"ble:{ADDRESS}") as running:
        yield running


def read_on(port: BluetoothPort) -> None:
    """Until it is lost."""
    while True:
        port.read()


@needs_bluez
@pytest.mark.parametrize(
    "board", [("Hiwonder",), pytest.param(("BT24/fff0",), marks=pytest.mark.exhaustive)], indirect=True
)
async def test_moves_and_stop_reach_the_board_and_its_answers_come_back(
    board: BluetoothBoard, gateway: Running
) -> None:
    async with connect(gateway.ws) as client:
        await hear_port(client, "open")
        nonce = await drive(client)
        await say(client, type="packet", id=1, bytes=MOVE.hex(), nonce=nonce)
        await say(client, type="packet", id=2, bytes=BATTERY.hex())
        await hear_until(client, "received")
        await say(client, type="stop")
        await hear_until(client, "halted")
        await asyncio.sleep(0.05)  # the board takes its last byte one byte time after we counted it
    got = board.taken()
    opening, _, behind = got.partition(MOVE + BATTERY)
    assert opening == STOP * (UNKNOWN.left_over_bytes // len(STOP) + 3)
    assert behind.count(STOP) >= 3


@needs_bluez
@pytest.mark.exhaustive
@pytest.mark.parametrize("events", [("drop",), ("off", "on"), ("adapter off", "adapter on")])
async def test_a_broken_link_is_reported_and_comes_back(
    board: BluetoothBoard, gateway: Running, events: tuple[str, ...]
) -> None:
    async with connect(gateway.ws) as client:
        await hear_port(client, "open")
        board.say(events[0])
        assert (await hear_port(client, "lost"))["latch"] is True
        for event in events[1:]:
            board.say(event)
        await hear_port(client, "open")


@needs_bluez
@pytest.mark.exhaustive
@pytest.mark.parametrize("board", [("Hiwonder", "Hiwonder")], indirect=True)
def test_a_name_that_two_modules_bear_is_not_guessed(board: BluetoothBoard) -> None:
    with pytest.raises(OtherDeviceError, match=f"ble:{ADDRESS} or ble:"):
        Bluetooth().open("ble:Hiwonder")


@needs_bluez
@pytest.mark.exhaustive
def test_a_name_stands_for_the_module_that_was_found_by_it(board: BluetoothBoard) -> None:
    bluetooth = Bluetooth()
    bluetooth.open("ble:hiwonder").close()
    board.say("off")
    with pytest.raises(PortMissingError, match=ADDRESS):
        bluetooth.open("ble:hiwonder")


@needs_bluez
@pytest.mark.exhaustive
def test_a_module_that_was_left_connected_is_opened_again(board: BluetoothBoard) -> None:
    left = Bluetooth().open(f"ble:{ADDRESS}")
    Bluetooth().open(f"ble:{ADDRESS}").close()
    with pytest.raises(PortLostError):
        read_on(left)


@needs_bluez
@pytest.mark.exhaustive
def test_a_switched_off_adapter_is_reported(board: BluetoothBoard) -> None:
    port = Bluetooth().open("ble:Hiwonder")
    board.say("adapter off")
    with pytest.raises(PortLostError):
        read_on(port)
    with pytest.raises(PortMissingError, match="switched off"):
        Bluetooth().open("ble:Hiwonder")


@needs_bluez
@pytest.mark.exhaustive
@pytest.mark.parametrize("board", [("Hiwonder", "BT24/fff0")], indirect=True)
def test_the_command_lists_modules(board: BluetoothBoard) -> None:
    ports = json.loads(CliRunner().invoke(app, ["ports", "--bluetooth", "--json"]).stdout)
    listed = {(port["device"], port["description"]) for port in ports if port["device"].startswith("ble:")}
    assert listed == {
        (f"ble:{ADDRESS}", "Hiwonder, Bluetooth"),
        ("ble:48:87:2D:62:C6:01", "BT24, Bluetooth"),
    }
