"""Runs blocking calls in threads, off the event loop, that never keep the process from ending."""

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
    """Runs `action`, which may block, and returns its result or raises its error. `undo` gets the result of a
    caller that has gone.
    """
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
        except Exception as error:  # noqa: BLE001 (every error goes to the caller)
            deliver_outcome = partial(refuse, error)
        with contextlib.suppress(RuntimeError):  # the loop is closed: the process is ending
            loop.call_soon_threadsafe(deliver_outcome)

    threading.Thread(target=run, name=NAME, daemon=True).start()
    return await outcome
