"""What becomes of what moves when its driver is silent, gone or another one (docs/adr/0012).

Knows what the lease tells and how to stop; not who may drive.
"""

import contextlib
from typing import TYPE_CHECKING

from servodeck.access.hub import is_of
from servodeck.driving.latch import Cause
from servodeck.errors import CancelledError, GatewayError, NotDrivingError

if TYPE_CHECKING:
    from servodeck.driving.control import Control


class Watch:
    def __init__(self, control: "Control") -> None:
        self._control = control

    def driver_quiet(self) -> None:
        control = self._control
        driver = control.driving.driver
        control.board.drop(driver, CancelledError("Its driver was not heard any more."))
        play = control.board.plays.present
        if play and play.as_run:
            return
        if play or control.board.motion.is_moving(control.now()):
            self._stop_for_nobody()

    def driver_silent(self) -> None:
        if self._control.board.may_move_on() and not self._control.board.unattended.by:
            self._stop_for_nobody()

    def driver_lost(self) -> None:
        self.driver_silent()

    def driver_changed(self) -> None:
        """What one driver began does not go on under the next; nobody has to resume for it."""
        board = self._control.board
        goes_on_alone = board.unattended.by and self._control.driving.driver is None
        if board.may_move() and not goes_on_alone:
            self.end_quietly(NotDrivingError("Somebody else drives now."))

    def lease_changed(self) -> None:
        driving = self._control.driving
        if driving.driver and self._control.board.unattended.by not in (None, driving.driver):
            self.end_quietly(NotDrivingError("Somebody else drives now."))
        driving.tell_all()

    def sent_away(self, caller_id: str, by: str, *, group_goes_on: bool) -> None:
        """`by` has revoked them: STOP for what they move, and for the group that they let go on unless it
        may. Nobody who is out answers for what moves.
        """
        board, driver = self._control.board, self._control.driving.driver
        if is_of(board.unattended.by, caller_id):
            if group_goes_on:
                return
            board.unattended.end()
        elif not is_of(driver, caller_id):
            return
        if board.may_move_on():
            with contextlib.suppress(GatewayError):
                self._control.stop(Cause("person", by))

    def end_quietly(self, reason: GatewayError) -> None:
        """Without the latch: somebody is there, or it was said beforehand."""
        with contextlib.suppress(GatewayError):
            self._control.board.halt(reason)

    def _stop_for_nobody(self) -> None:
        """STOP because nobody watches over what moves: whoever goes on has to look first. Not twice: a second
        hold would end later than was said of the first.
        """
        if self._control.latch:
            return
        with contextlib.suppress(GatewayError):
            self._control.stop(Cause("silence"))
