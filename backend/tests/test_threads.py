"""Blocking calls run in a thread, and the caller gets their result or error."""

import asyncio
import threading

import pytest

from servodeck.threads import in_thread


async def test_what_it_gives_is_heard() -> None:
    assert await in_thread(lambda: 5) == 5


@pytest.mark.parametrize("error", [RuntimeError("a bug"), OSError("a disk"), KeyError("a key")])
async def test_any_error_reaches_the_caller(error: Exception) -> None:
    def fail() -> None:
        raise error

    async with asyncio.timeout(5):
        with pytest.raises(type(error)):
            await in_thread(fail)


async def test_a_result_without_a_caller_is_undone() -> None:
    may_end, undone = threading.Event(), asyncio.Event()
    loop = asyncio.get_running_loop()

    def undo(_: bool) -> None:
        loop.call_soon_threadsafe(undone.set)

    with pytest.raises(TimeoutError):
        async with asyncio.timeout(0.01):
            await in_thread(may_end.wait, undo=undo)
    may_end.set()
    async with asyncio.timeout(5):
        await undone.wait()
