"""What happens to robots that are still open when their program ends: at its ordinary end, and by a signal.

Knows no robot and no transport.
"""

import atexit
import signal
import threading
import weakref
from collections.abc import Callable
from contextlib import suppress
from types import FrameType

from servodeck.errors import GatewayError

# SIGINT is an exception in Python, behind which a program ends in the ordinary way.
ENDING = ("SIGTERM", "SIGHUP", "SIGQUIT", "SIGBREAK")
End = Callable[[], object]
_ends: list[End] = []


def at_exit(end: End) -> None:
    """Calls that bound method at the ordinary end of the program, while its object lives."""
    method = weakref.WeakMethod(end, lambda _: atexit.unregister(call))

    def call() -> None:
        if found := method():
            with suppress(GatewayError):
                found()

    atexit.register(call)


def before_signals(end: End) -> None:
    """Calls it before a signal ends the program, where the program has no handler of its own. Python takes
    signals in the main thread alone: called in another one, it does nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    _ends.append(end)
    for number in map(signal.Signals.__members__.get, ENDING):
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _end)


def no_signals(end: End) -> None:
    """It is closed."""
    with suppress(ValueError):
        _ends.remove(end)


def _end(number: int, _frame: FrameType | None) -> None:
    """The signal then has its usual effect."""
    for end in reversed(_ends[:]):
        end()
    signal.signal(number, signal.SIG_DFL)
    signal.raise_signal(number)
