"""What blocks, done off the event loop: in threads that never keep the process from ending."""

import asyncio
import contextlib
import threading
from collections.abc import Callable
from functools import partial
from typing import TypeVar

T = TypeVar("T")
# As each of them is called.
NAME = "in the background"


async def in_thread(action: Callable[[], T], undo: Callable[[T], None] | None = None) -> T:
    """What `action`, which may block, gives or raises; `undo` gets the result where the caller has gone."""
    loop = asyncio.get_running_loop()
    outcome: asyncio.Future[T] = loop.create_future()

    def deliver(result: T) -> None:
        if not outcome.done():
            outcome.set_result(result)
        elif undo is not None:
            threading.Thread(target=undo, args=(result,), daemon=True).start()

    def refuse(error: Exception) -> None:
        if not outcome.done():
            outcome.set_exception(error)

    def run() -> None:
        try:
            deliver_outcome = partial(deliver, action())
        except Exception as error:  # noqa: BLE001 (whatever it is, somebody waits for it)
            deliver_outcome = partial(refuse, error)
        with contextlib.suppress(RuntimeError):  # the loop is closed: the process is ending
            loop.call_soon_threadsafe(deliver_outcome)

    threading.Thread(target=run, name=NAME, daemon=True).start()
    return await outcome
