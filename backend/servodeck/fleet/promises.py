"""Promises to start a group at a given time of this gateway's clock, so that several robots start together
(docs/adr/0049). A promise is kept only if it was committed, its driver is heard, and nothing has happened
since that would have ended a run.

Knows the robot core and the request; no broker. One promise at a time.
"""

import asyncio
import logging
from collections.abc import Callable

from servodeck.errors import (
    CancelledError,
    GatewayError,
    MovingError,
    NotDrivingError,
    OutOfRangeError,
    SlotChangedError,
)
from servodeck.fleet.messages import PrepareRequest, Started
from servodeck.port.wire import Left
from servodeck.protocol.families import check
from servodeck.protocol.packets import RUN, encoded
from servodeck.protocol.timings import wire_ms
from servodeck.protocol.values import Run
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from servodeck.robot.latch import judge_latch
from servodeck.robot.lease import Permit

SOONEST_MS, LATEST_MS = 50.0, 10_000.0
UNCERTAIN_MS = 20.0
log = logging.getLogger("servodeck.fleet")


class Promise:
    """As a claim of the run: no nonce is young enough then, so the driver's latest sign of life counts."""

    def __init__(
        self,
        control: Control,
        session: Session,
        request: PrepareRequest,
        command: Run,
        started: Callable[[Started], None],
    ) -> None:
        self.session = session
        self.name = request.name
        self._start_ms = request.start_ms
        self._started = started
        self.command = command
        self.is_committed = False
        self._control = control
        self._epoch = control.driving.lease.epoch
        self._stopped_s = control.stopped_s

    def claim(self) -> None:
        self.permit()

    def permit(self) -> Permit:
        """Raises NotDrivingError, ExpiredError or CancelledError."""
        control = self._control
        if control.stopped_s != self._stopped_s:
            raise CancelledError("STOP was pressed after this was prepared.")
        permit = control.driving.lease.renewed_permit(self.session, control.now())
        if permit.epoch != self._epoch:
            raise NotDrivingError("The lease has passed on since this was prepared.")
        return permit

    def renew(self) -> None:
        """The permit is made anew for each packet."""

    def lasts(self, left: Left, for_s: float) -> None:  # noqa: ARG002 (as a claim has it)
        """As long as its driver is heard. Says when the first bit has left."""
        left.add_done_callback(self._has_left)

    def _has_left(self, left: Left) -> None:
        if left.cancelled() or left.exception():
            return
        packet_ms = wire_ms(len(encoded(self.command, self._control.board.family).data))
        late_ms = self._control.now() * 1000 - packet_ms - self._start_ms
        self._started(Started(name=self.name, late_ms=round(late_ms, 1)))


class Promises:
    def __init__(
        self, control: Control, run: Callable[[Promise], None], started: Callable[[Started], None]
    ) -> None:
        """`run` begins it; `started` hears when it has left."""
        self._control = control
        self._started = started
        self._run = run
        self._promise: Promise | None = None
        self._timer: asyncio.TimerHandle | None = None

    def prepare(self, session: Session, request: PrepareRequest) -> None:
        """Goes the way of the run up to its last step, which is quick then. An earlier promise is given up.
        Raises what would keep the run from leaving now, and where the time is not sure enough.
        """
        control, board, command = self._control, self._control.board, Run(request.slot, request.times)
        board.identification.judge_known()
        check(command, board.family)
        encoded(command, board.family)
        board.link.wire()
        judge_latch(RUN, control.latch)
        board.jobs.judge_run(command, board.link.place)
        if not board.is_idle():
            raise MovingError("The robot is moving: a start at a given time needs one that rests.")
        stored = board.slot_versions.get(str(command.slot))
        if request.version is not None and (stored is None or stored.version != request.version):
            raise SlotChangedError(f"Slot {command.slot} does not hold that group.")
        judge_between("uncertaintyMs", request.uncertainty_ms, 0.0, UNCERTAIN_MS)
        left_ms = request.start_ms - control.now() * 1000
        judge_between("startMs from now", left_ms, SOONEST_MS, LATEST_MS)
        promise = Promise(control, session, request, command, self._started)
        promise.permit()
        self.give_up()
        self._promise = promise
        self._timer = asyncio.get_running_loop().call_later(left_ms / 1000, self._due, promise)

    def commit(self, session: Session, name: str) -> bool:
        """False where there is no such promise of that session; raises what has voided it since."""
        promise = self._promise
        if promise is None or promise.name != name or promise.session is not session:
            return False
        promise.permit()
        promise.is_committed = True
        return True

    def cancel(self, session: Session, name: str) -> bool:
        """Whether there was such a promise of that session."""
        promise = self._promise
        if promise is None or promise.name != name or promise.session is not session:
            return False
        self.give_up()
        return True

    def give_up(self) -> None:
        self._promise = None
        if self._timer:
            self._timer.cancel()

    def _due(self, promise: Promise) -> None:
        self._promise = None
        try:
            if not promise.is_committed:
                raise CancelledError("It was not committed in time.")
            if not self._control.board.is_idle():
                raise MovingError("Something else moves the robot.")
            promise.claim()
        except GatewayError as error:
            log.info("not started", extra={"facts": {"slot": promise.command.slot, "why": error.detail}})
            return
        self._run(promise)


def judge_between(name: str, number: float, least: float, most: float) -> None:
    if not least <= number <= most:
        raise OutOfRangeError(f"{name} is {number:.1f}, allowed {least:.0f}..{most:.0f}")
