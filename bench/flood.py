"""Clients that say far too much: each a thousand things a second until it is sent away, and then it is there
again. Until it is ended.
Usage: flood.py HOST PORT FLOODERS
"""

import asyncio
import sys
from collections.abc import Awaitable, Callable
from contextlib import suppress

from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, WebSocketException

MESSAGES_PER_S = 1_000
BURSTS_PER_S = 50
SAID = '{"type":"calibrate","servo":null}'


async def main() -> None:
    address = f"ws://{sys.argv[1]}:{sys.argv[2]}/ws"
    await asyncio.gather(*(flood(address) for _ in range(int(sys.argv[3]))))


async def flood(address: str) -> None:
    while True:
        with suppress(WebSocketException, OSError, TimeoutError):
            async with connect(address, max_queue=None) as client:
                with suppress(ConnectionClosed):
                    await shout(client.send)


async def shout(send: Callable[[str], Awaitable[None]]) -> None:
    while True:
        for _ in range(MESSAGES_PER_S // BURSTS_PER_S):
            await send(SAID)
        await asyncio.sleep(1 / BURSTS_PER_S)


if __name__ == "__main__":
    asyncio.run(main())
