"""A client of the gateway: records its messages and, as a page does, answers each tick."""

import asyncio
import json
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

from websockets.sync.client import ClientConnection

from servodeck.api.websocket import take
from servodeck.callers import THIS_COMPUTER, Caller
from servodeck.intents import PacketMessage
from servodeck.port.wire import Left
from servodeck.protocol.families import UNKNOWN
from servodeck.protocol.packets import encode
from servodeck.protocol.values import (
    Command,
    Download,
    Erase,
    Frame,
    Move,
    ReadAllPositions,
    ReadBattery,
    ReadPositions,
    ReadVersion,
    Release,
    Run,
    ServoTarget,
    SetSpeed,
    Stop,
)
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from tests.fake_port import FakePort, FakePorts
from tests.virtual_time import now

ANNA = Caller("anna", "Anna", "driver")


class Client(Session):
    """`lease` and `activity` are the latest ones that it got; `beats` False is a tab that froze."""

    def __init__(self, control: Control, caller: Caller = THIS_COMPUTER) -> None:
        super().__init__(caller)
        self.control = control
        self.beats = True
        self.nonce: str | None = None
        self.lease: dict[str, Any] = {}
        self.activity: dict[str, Any] = {}
        self.followed: list[bytes] = []
        control.join(self)

    def put(self, text: str) -> None:
        message = json.loads(text)
        if message["type"] == "welcome":
            self.activity = message["activity"]
        if message["type"] == "tick":
            self._answer(message["nonce"])
        elif message["type"] == "lease":
            self.lease = message["lease"]
        elif message["type"] == "activity":
            self.activity = message["activity"]
        else:
            super().put(text)

    def send(self, packet: bytes) -> Left:
        """As a page: a free lease is requested first."""
        if self.control.driving.driver is None:
            self.control.driving.act(self, "request")
        return self.control.requests.send(self, packet.hex(), self.nonce)

    def run(self, packet: bytes) -> None:
        """As a page: what moves is ended before that run leaves."""
        message = PacketMessage(type="packet", id=1, bytes=packet.hex(), nonce=self.nonce)
        take(message, self, self.control)

    async def next(self) -> str:
        """What left the wire is in `followed` instead."""
        while (message := json.loads(text := await super().next()))["type"] == "left":
            self.followed += [packet_of(left, self.control) for left in message["commands"]]
            if not self.waiting:
                return ""
        return text

    async def heard(self) -> list[dict[str, Any]]:
        """All messages that wait, those of the lease apart."""
        await asyncio.sleep(0)
        messages = []
        while self.waiting:
            if text := await self.next():
                messages.append(json.loads(text))
        return messages

    def _answer(self, nonce: str) -> None:
        if self.beats:
            self.nonce = nonce
            self.control.driving.lease.heartbeat(self, nonce)


def packet_of(left: dict[str, Any], control: Control) -> bytes:
    """What has left, as the board got it; while it is asked who it is, that is of no family."""
    command, family = command_of(left), control.board.family
    return encode(command, family if command.kind in family.commands else UNKNOWN)


def command_of(left: dict[str, Any]) -> Command:
    match left:
        case {"kind": "move"}:
            return Move(left["durationMs"], targets_of(left))
        case {"kind": "run"}:
            return Run(left["slot"], left["times"])
        case {"kind": "download", "frame": frame}:
            stored = Frame(frame["durationMs"], targets_of(frame))
            return Download(left["slot"], left["frameCount"], left["frameIndex"], stored)
        case {"kind": "release"}:
            return Release(tuple(left["servos"]))
        case {"kind": "readPositions"}:
            return ReadPositions(tuple(left["servos"]))
        case {"kind": "setSpeed"}:
            return SetSpeed(left["slot"], left["percent"])
    plain = {each.kind: each() for each in (Stop, Erase, ReadBattery, ReadVersion, ReadAllPositions)}
    return plain[left["kind"]]


def targets_of(left: dict[str, Any]) -> tuple[ServoTarget, ...]:
    return tuple(ServoTarget(one["servo"], one["position"]) for one in left["targets"])


@asynccontextmanager
async def gateway_on(*ports: FakePort, board: str = "doc") -> AsyncIterator[Control]:
    """A gateway whose port is open and whose first stop has left."""
    control = Control(FakePorts(*(ports or (FakePort(),))), now, board)
    await control.use_port("/dev/board")
    await asyncio.sleep(0.1)
    try:
        yield control
    finally:
        await control.board.link.close()
        for port in ports:
            port.close()


@asynccontextmanager
async def driven(*sent: bytes) -> AsyncIterator[tuple[Control, FakePort, Client]]:
    """A gateway, its port, and who drives there: has sent these, one after the other."""
    port = FakePort()
    async with gateway_on(port) as control:
        driver = Client(control)
        for packet in sent:
            await driver.send(packet)
        yield control, port, driver


def lease_of(connection: ClientConnection) -> str:
    """Over a real socket: gets a free lease; the nonce holds for half a second."""
    connection.send('{"type": "lease", "action": "request"}')
    while (message := json.loads(connection.recv(5)))["type"] != "tick":
        pass
    return str(message["nonce"])


def upgrade_at(host: str) -> bytes:
    """The first words of a client that is written by hand, to do what no library does."""
    return (
        f"GET /ws HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    ).encode()


async def deaf_at(address: tuple[str, int]) -> socket.socket:
    """A client on the WebSocket that never reads."""
    made = socket.socket()
    made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    made.setblocking(False)
    await asyncio.get_running_loop().sock_connect(made, address)
    await asyncio.get_running_loop().sock_sendall(made, upgrade_at(f"{address[0]}:{address[1]}"))
    return made
