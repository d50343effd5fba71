"""Clients without a credential that take what they can get: each opens a connection, says what its kind says,
waits until it is closed and begins again. Until it is ended.
Usage: unauthenticated.py HOST PORT KIND CLIENTS
"""

import asyncio
import os
import resource
import sys
from contextlib import suppress

BODY_BYTES = 3 * 1024 * 1024
CHUNK_BYTES = 64 * 1024
GET = b"GET / HTTP/1.1\r\nHost: %s\r\n"
PUT = (
    b"PUT /api/library/x HTTP/1.1\r\nHost: %s\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n"
)
UPGRADE = (
    b"GET /ws HTTP/1.1\r\nHost: %s\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
)
BODY = (b"[" + b"[]," * (BODY_BYTES // 3))[: BODY_BYTES - 2] + b"0]"


def said(kind: str, host: bytes) -> tuple[bytes, bytes]:
    """A head and what follows it."""
    return {
        "idle": (b"", b""),
        "half-head": (b"GET /", b""),
        "half-body": (PUT % (host, BODY_BYTES), BODY[:-1]),
        "whole-body": (PUT % (host, BODY_BYTES), BODY),
        "long-head": (GET % host + b"X-Long: ", b"x" * 64 * 1024 + b"\r\n\r\n"),
        "many-headers": (GET % host, b"X: 1\r\n" * 5000 + b"\r\n"),
        "upgrade": (UPGRADE % host, b""),
        "page": (GET % host + b"\r\n", b""),
    }[kind]


async def main() -> None:
    host, port, kind, clients = sys.argv[1:]
    allow_descriptors()
    os.nice(10)  # they are on other computers: their processor is not the gateway's
    head, rest = said(kind, f"{host}:{port}".encode())
    await asyncio.gather(*(flood(host, int(port), head, rest) for _ in range(int(clients))))


def allow_descriptors() -> None:
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))


async def flood(host: str, port: int, head: bytes, rest: bytes) -> None:
    while True:
        with suppress(OSError):
            reader, writer = await asyncio.open_connection(host, port)
            try:
                await say(writer, head, rest)
                while await reader.read(CHUNK_BYTES):
                    pass
            finally:
                writer.transport.abort()


async def say(writer: asyncio.StreamWriter, head: bytes, rest: bytes) -> None:
    writer.write(head)
    for start in range(0, len(rest), CHUNK_BYTES):
        writer.write(rest[start : start + CHUNK_BYTES])
        await writer.drain()


if __name__ == "__main__":
    asyncio.run(main())
