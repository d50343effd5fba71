"""The latch: whether motion is refused, for which cause and by whom; and what happens to a moving robot when
its driver falls silent, leaves or changes (docs/adr/0012).

Knows the events of the lease and how to stop; not who may drive or resume.
"""

import contextlib
import logging
import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from servodeck.errors import CancelledError, GatewayError, LatchedError, NotDrivingError
from servodeck.protocol.packets import HARMLESS
from servodeck.robot.hub import is_of
from servodeck.snapshots import LatchedBy
from servodeck.value import value

if TYPE_CHECKING:
    from servodeck.robot.control import Control


log = logging.getLogger("servodeck.robot")


@value
class Cause:
    """`name` is for people: who pressed STOP, or whose page did it for the battery."""

    by: LatchedBy
    name: str | None = None


SILENCE = Cause("silence")


class Latch:
    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.cause: Cause | None = None
        self.stopped_s = -math.inf
        """Time of the latest STOP."""

    @property
    def is_closed(self) -> bool:
        """Motion is refused until a person resumes."""
        return self.cause is not None

    @property
    def by(self) -> LatchedBy | None:
        return self.cause.by if self.cause else None

    @property
    def name(self) -> str | None:
        return self.cause.name if self.cause else None

    def close(self, cause: Cause, now: float) -> None:
        """While it is closed, the first cause stays."""
        self.stopped_s = now
        if self.cause is None:
            self.cause = cause
            log.info("stopped")
            self._changed()

    def open(self) -> bool:
        """Whether it was closed."""
        if self.cause is None:
            return False
        self.cause = None
        log.info("resumed")
        self._changed()
        return True


def judge_latch(number: int, latch: bool) -> None:
    """While stopped, only what moves nothing and stores nothing passes. Raises LatchedError."""
    if latch and number not in HARMLESS:
        raise LatchedError("Stopped: motion is refused until a person resumes.")


class Watch:
    def __init__(self, control: "Control") -> None:
        self._control = control

    def driver_quiet(self) -> None:
        control = self._control
        driver = control.driving.driver
        control.board.drop(driver, CancelledError("The driver sends no heartbeat."))
        play = control.board.plays.present
        if play and play.as_run:
            return
        if play or control.board.motion.is_moving(control.now()):
            self._stop_unwatched()

    def driver_silent(self) -> None:
        board = self._control.board
        if not board.unattended.by and board.activity.may_still_move():
            self._stop_unwatched()

    def driver_lost(self) -> None:
        self.driver_silent()

    def driver_changed(self) -> None:
        """The motion of one driver does not continue under the next; no resume is needed."""
        board = self._control.board
        is_unattended = board.unattended.by and self._control.driving.driver is None
        if board.activity.may_move() and not is_unattended:
            self.end_quietly(NotDrivingError("Another client drives now."))

    def lease_changed(self) -> None:
        driving = self._control.driving
        self._control.board.unattended.end_move(but=driving.driver)
        if driving.driver and self._control.board.unattended.by not in (None, driving.driver):
            self.end_quietly(NotDrivingError("Another client drives now."))
        self._control.acts.driver_is(driving.driver)
        driving.send_states()

    def disconnected(self, caller_id: str, by: str, *, run_continues: bool) -> None:
        """`by` has revoked that caller: STOP for its motion, and for its unattended group unless that may
        continue.
        """
        board, driver = self._control.board, self._control.driving.driver
        if is_of(board.unattended.by, caller_id):
            if run_continues:
                return
            board.unattended.end()
        elif not is_of(driver, caller_id):
            return
        if board.activity.may_still_move():
            with contextlib.suppress(GatewayError):
                self._control.stop(Cause("person", by))

    def end_quietly(self, reason: GatewayError) -> None:
        """Without the latch: a person is watching, or the end was announced. Not behind a STOP: a second hold
        would end later than the first one reported.
        """
        if self._control.latch:
            return
        with contextlib.suppress(GatewayError):
            self._control.board.halts.end_for_good(reason)

    def _stop_unwatched(self) -> None:
        """STOP because no driver watches over what moves: a person has to look before motion resumes. Not
        twice, as `end_quietly`.
        """
        if self._control.latch:
            return
        with contextlib.suppress(GatewayError):
            self._control.stop(SILENCE)
