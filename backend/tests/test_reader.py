"""Bytes from a real pty onto the event loop, on both ways."""

import asyncio
import os
from collections.abc import AsyncIterator

import pytest

from servodeck.errors import PortLostError
from servodeck.port.ports import OpenPort, open_port
from servodeck.port.reader import Stop, read_in_thread, start_reading
from tests.test_ports import Pty


class Listener:
    def __init__(self) -> None:
        self.data = bytearray()
        self.losses: list[PortLostError] = []
        self.something = asyncio.Event()

    def received(self, data: bytes) -> None:
        self.data += data
        self.something.set()

    def lost(self, error: PortLostError) -> None:
        self.losses.append(error)
        self.something.set()

    async def wait(self) -> None:
        await asyncio.wait_for(self.something.wait(), 2)
        self.something.clear()


@pytest.fixture(params=["descriptor", "thread"])
async def reading(request: pytest.FixtureRequest) -> AsyncIterator[tuple[Pty, Listener]]:
    pty, listener = Pty(), Listener()
    port: OpenPort = open_port(pty.device)
    start = start_reading if request.param == "descriptor" else read_in_thread
    stop: Stop = start(port, listener.received, listener.lost)
    yield pty, listener
    stop()
    port.close()
    if pty.board >= 0:
        pty.unplug()


async def test_what_the_board_says_arrives(reading: tuple[Pty, Listener]) -> None:
    pty, listener = reading
    for text in (b"\x55\x55\x02\x08", b"\x55"):
        os.write(pty.board, text)
        await listener.wait()
    assert listener.data == b"\x55\x55\x02\x08\x55"


async def test_a_pulled_cable_is_reported_once(reading: tuple[Pty, Listener]) -> None:
    pty, listener = reading
    pty.unplug()
    await listener.wait()
    await asyncio.sleep(0)
    assert len(listener.losses) == 1
