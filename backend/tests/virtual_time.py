"""An event loop whose clock jumps to the next timer instead of waiting: exact times, no sleeps."""

import asyncio
import selectors
import threading
from collections.abc import Callable, Coroutine
from functools import wraps
from typing import Any, ParamSpec

from servodeck.threads import NAME

P = ParamSpec("P")
# How long to look whether a thread has finished before looking again.
LOOK_S = 0.01


class JumpingSelector(selectors.SelectSelector):
    """Where a real one would wait for a timer, it moves the clock there, but not while a thread works."""

    now_s = 0.0
    # What else has its time: how far the clock may run on its way to a timer.
    goes_to: Callable[[float], float] = staticmethod(lambda at_s: at_s)

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        ready = super().select(0)
        if ready:
            return ready
        if any(thread.name == NAME for thread in threading.enumerate()):
            return super().select(LOOK_S)
        if timeout is None:
            raise RuntimeError(
                "Nothing will ever happen again: the test waits for an event that cannot come."
            )
        self.now_s = self.goes_to(self.now_s + max(timeout, 0.0))
        return []


class VirtualTimeLoop(asyncio.SelectorEventLoop):
    def __init__(self) -> None:
        self.jumping = JumpingSelector()
        super().__init__(self.jumping)

    def time(self) -> float:
        return self.jumping.now_s


def in_virtual_time(test: Callable[P, Coroutine[Any, Any, None]]) -> Callable[P, None]:
    """Runs an async test from time 0 on such a loop."""

    @wraps(test)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
            runner.run(test(*args, **kwargs))

    return run


def now() -> float:
    """Seconds since the test began."""
    return asyncio.get_running_loop().time()


def at(seconds: float, call: Callable[[], object]) -> None:
    """Calls it at that time of the test."""
    asyncio.get_running_loop().call_at(seconds, call)


def hold_up(seconds: float) -> None:
    """Nothing runs for so long, as on a computer that is too busy; then everything is late."""
    loop = asyncio.get_running_loop()
    assert isinstance(loop, VirtualTimeLoop)
    loop.jumping.now_s += seconds
