"""The run that may go on without whoever began it, of the board or played from here: which one, who said so,
and until when at most.

Knows time and one run; how it is stopped is for whoever is told that its time is over.
"""

import asyncio
from collections.abc import Callable

from servodeck.protocol.values import Run
from servodeck.robot.board.playing import Playing
from servodeck.robot.hub import Session
from servodeck.snapshots import UnattendedRun
from servodeck.value import value


@value
class AllowedRun:
    run: Run | Playing
    by: Session
    until_s: float


class Unattended:
    def __init__(
        self, now: Callable[[], float], over: Callable[[], None], changed: Callable[[], None]
    ) -> None:
        """`over`: its time is. `changed`: so is what people are told of it."""
        self._now = now
        self._over = over
        self._changed = changed
        self._present: AllowedRun | None = None
        self._timer: asyncio.TimerHandle | None = None

    @property
    def by(self) -> Session | None:
        return self._present.by if self._present else None

    def snapshot(self) -> UnattendedRun | None:
        if self._present is None:
            return None
        run, left_s = self._present.run, max(0.0, self._present.until_s - self._now())
        slot = run.slot if isinstance(run, Run) else None
        return UnattendedRun(
            slot=slot, times=run.times, by=self._present.by.caller.name, ends_in_ms=round(left_s * 1000)
        )

    def allow(self, run: Run | Playing, by: Session, for_s: float) -> None:
        self._show(AllowedRun(run, by, self._now() + for_s))

    def end(self) -> None:
        """It is nobody's any more, or watched again."""
        if self._present:
            self._show(None)

    def follow(self, run: Run | Playing | None) -> None:
        """That one runs now, so far as anybody knows: another one has not been allowed anything."""
        if self._present and self._present.run is not run:
            self._show(None)

    def _show(self, allowed: AllowedRun | None) -> None:
        if self._timer:
            self._timer.cancel()
        self._present, self._timer = allowed, None
        if allowed:
            delay_s = allowed.until_s - self._now()
            self._timer = asyncio.get_running_loop().call_later(delay_s, self._over)
        self._changed()
