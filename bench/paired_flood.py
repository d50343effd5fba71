"""Clients with a credential that take what they can get, until the flood is ended.
Usage: paired_flood.py HOST PORT KIND CLIENTS TOKEN
"""

import asyncio
import base64
import os
import socket
import sys
from contextlib import suppress

from websockets.frames import Frame, Opcode

UPGRADE = (
    "GET {path} HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\nConnection: Upgrade\r\n"
    "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n"
)
GET = "GET {path} HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\n\r\n"
AT_ONCE = 400
LEAVES_S = 2.0
SMALL_WINDOW = 4096
PATHS = {"unread": "/api/events", "camera": "/api/cameras/0/stream"}


def frames(kind: str) -> tuple[bytes, bytes]:
    """Once, and then again and again."""

    def frame(opcode: Opcode, data: bytes = b"", *, is_last: bool = True) -> bytes:
        return Frame(opcode, data, is_last).serialize(mask=True)

    return {
        "pings": (b"", frame(Opcode.PING, b"p" * 125)),
        "fragments": (frame(Opcode.TEXT, b"{", is_last=False), frame(Opcode.CONT, is_last=False)),
        "messages": (b"", frame(Opcode.TEXT, b'{"type":"x"}')),
        "unread": (b"", b""),
        "camera": (b"", b""),
    }[kind]


async def main() -> None:
    host, port, kind, clients, token = sys.argv[1:]
    os.nice(10)  # they are on other computers: their processor is not the gateway's
    await asyncio.gather(*(flood(host, int(port), kind, token) for _ in range(int(clients))))


async def flood(host: str, port: int, kind: str, token: str) -> None:
    key = base64.b64encode(os.urandom(16)).decode()
    shape = GET if kind in PATHS else UPGRADE
    head = shape.format(path=PATHS.get(kind, "/ws"), host=f"{host}:{port}", token=token, key=key)
    once, again = frames(kind)
    while True:
        with suppress(OSError):
            opened = socket.socket()
            opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALL_WINDOW)
            opened.setblocking(False)
            await asyncio.get_running_loop().sock_connect(opened, (host, port))
            _, writer = await asyncio.open_connection(sock=opened, limit=1)
            try:
                writer.write(head.encode() + once)
                await shout(writer, again)
            finally:
                writer.transport.abort()


async def shout(writer: asyncio.StreamWriter, again: bytes) -> None:
    """Until the client is sent away; without anything to say it leaves by itself."""
    while again:
        writer.write(again * AT_ONCE)
        await writer.drain()
    await asyncio.sleep(LEAVES_S)


if __name__ == "__main__":
    asyncio.run(main())
