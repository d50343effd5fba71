"""A network that is slow or goes away: stands before a broker, delays what passes in each direction, holds it
back, and remembers what clients have sent.

As a program (`python -m tests.tcp_proxy PORT LEAST_MS MOST_MS`) it says its own port and delays until its
input ends.
"""

import asyncio
import random
import sys
import threading
from collections.abc import Coroutine
from typing import Any

CHUNK_BYTES = 65536
START_S = 5.0
Delay = tuple[float, float]


class Proxy:
    """In a thread of its own. `delay_s`: each piece is held so long, at least and at most, in its order."""

    def __init__(self, port: int, delay_s: Delay = (0.0, 0.0)) -> None:
        """To that port of this computer."""
        self._to_port = port
        self._delay_s = delay_s
        self._sent: list[bytes] = []
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self.port = self._do(self._start())

    def hold(self, *, answers_too: bool = True) -> None:
        """Nothing passes any more; `answers_too`: not from the broker either."""
        self._loop.call_soon_threadsafe(self._up.clear)
        if answers_too:
            self._loop.call_soon_threadsafe(self._down.clear)

    def let_go(self) -> None:
        """What was held back passes now."""
        self._loop.call_soon_threadsafe(self._up.set)
        self._loop.call_soon_threadsafe(self._down.set)

    @property
    def sent(self) -> bytes:
        """By all clients."""
        return b"".join(self._sent)

    def end(self) -> None:
        self._do(self._stop())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(START_S)
        self._loop.close()

    def _do(self, work: Coroutine[Any, Any, Any]) -> Any:
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(START_S)

    async def _start(self) -> int:
        self._up, self._down = asyncio.Event(), asyncio.Event()
        self._up.set()
        self._down.set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._server = await asyncio.start_server(self._connected, "127.0.0.1", 0)
        port: int = self._server.sockets[0].getsockname()[1]
        return port

    async def _stop(self) -> None:
        self._server.close()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _connected(self, client: asyncio.StreamReader, to_client: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task
        self._tasks.add(task)
        try:
            broker, to_broker = await asyncio.open_connection("127.0.0.1", self._to_port)
        except OSError:
            to_client.close()
            return
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self._pass(client, to_broker, self._up, keeps=True))
                group.create_task(self._pass(broker, to_client, self._down, keeps=False))
        except* OSError:
            pass
        finally:
            to_broker.close()
            to_client.close()
            await asyncio.gather(to_broker.wait_closed(), to_client.wait_closed(), return_exceptions=True)
            self._tasks.discard(task)

    async def _pass(
        self, source: asyncio.StreamReader, target: asyncio.StreamWriter, gate: asyncio.Event, *, keeps: bool
    ) -> None:
        pieces: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()

        async def write() -> None:
            while True:
                due_s, piece = await pieces.get()
                await asyncio.sleep(max(0.0, due_s - self._loop.time()))
                await gate.wait()
                if not piece:
                    raise ConnectionResetError
                target.write(piece)

        async with asyncio.TaskGroup() as group:
            group.create_task(write())
            piece = b"-"
            while piece:
                try:
                    piece = await source.read(CHUNK_BYTES)
                except ConnectionError:
                    piece = b""
                if keeps:
                    self._sent.append(piece)
                pieces.put_nowait((self._loop.time() + random.uniform(*self._delay_s), piece))


def main() -> None:
    port, least_ms, most_ms = map(int, sys.argv[1:])
    proxy = Proxy(port, (least_ms / 1000, most_ms / 1000))
    sys.stdout.write(f"{proxy.port}\n")
    sys.stdout.flush()
    sys.stdin.read()


if __name__ == "__main__":
    main()
