"""Operations of a driver besides moves: run, end and erase groups, set their speed, release servos. The same
for pages and scripts; each is sent once, and its outcome is reported (docs/adr/0014, class C).

Knows the operations and the order of their packets. A `Claim` proves that the caller drives; requests.py
judges each packet.
"""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from typing import TYPE_CHECKING, Protocol

from servodeck.errors import CancelledError, GatewayError, MovingError, NoAnswerError
from servodeck.port.wire import Left
from servodeck.protocol.families import Family, check
from servodeck.protocol.packets import MOVE, portions_of
from servodeck.protocol.timings import RUN
from servodeck.protocol.values import (
    Command,
    Erase,
    Erased,
    Move,
    Release,
    Run,
    RunAccepted,
    RunStarted,
    SetSpeed,
)
from servodeck.robot.board.halt import repeat_stop
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.board.storing import ERASE_TIMEOUT_S
from servodeck.robot.hub import Session
from servodeck.robot.latch import judge_latch
from servodeck.robot.lease import Permit
from servodeck.snapshots import Outcome, PlayState
from servodeck.value import value

if TYPE_CHECKING:
    from servodeck.robot.control import Control


RUN_WAIT_S = RUN.timeout_ms / 1000


@value
class Ran:
    """`is_battery_unknown`: it would have been judged by the battery, whose voltage is not known."""

    outcome: Outcome
    is_battery_unknown: bool


class Claim(Protocol):
    """Proves that its session drives."""

    @property
    def session(self) -> Session: ...

    def claim(self) -> None:
        """Raises what prevents it from driving."""

    def permit(self) -> Permit:
        """For one packet that leaves now."""

    def renew(self) -> None:
        """The motion before has ended. Raises where the session does not drive any more."""

    def lasts(self, left: Left, for_s: float) -> None:
        """The motion of that packet lasts for so long."""


class PageClaim:
    """Of a page, by the nonce of its message; its heartbeat continues independently."""

    def __init__(self, control: "Control", session: Session, nonce: str | None) -> None:
        self.session = session
        self._lease = control.driving.lease
        self._now = control.now
        self._nonce = nonce
        self._permit: Permit | None = None

    def claim(self) -> None:
        self.session.caller.require("driver")
        self._permit = self._lease.permit(self.session, self._nonce, self._now())

    def permit(self) -> Permit:
        return self._permit or self._lease.permit(self.session, self._nonce, self._now())

    def renew(self) -> None:
        self._permit = self._lease.renewed_permit(self.session, self._now())

    def lasts(self, left: Left, for_s: float) -> None:
        """As long as it is heard."""


class Grant:
    """The permission of one request to move the robot. It ends with the next stop, and with another
    driver.
    """

    def __init__(self, control: "Control", claim: Claim) -> None:
        """Raises what keeps its first packet from leaving."""
        control.board.link.wire()
        judge_latch(MOVE, control.latch)
        self._control = control
        self._claim = claim
        claim.claim()
        self._mark = self._present()

    async def after_the_stop(self) -> None:
        """Waits where the motion of another driver is being stopped."""
        self._judge()
        if self._control.board.link.wire().is_halting:
            await self.end_what_moves()

    async def end_what_moves(self) -> None:
        self._judge()
        ended = self._control.board.halts.end_motion()
        self._mark = self._present()  # now: any other stop meanwhile ends this grant, too
        if ended:
            await asyncio.shield(ended)  # others may wait for it
            self._judge()
            self._claim.renew()

    async def waits_for(self, work: Awaitable[None]) -> None:
        """Before its first packet."""
        self._judge()
        await work
        self._judge()
        self._claim.renew()

    def send(self, command: Command, lasts_s: float = 0.0) -> Left:
        """`lasts_s`: what it sets in motion."""
        self._judge()
        requests, session, permit = self._control.requests, self._claim.session, self._claim.permit()
        if isinstance(command, Move):
            left = requests.move_by(session, command, permit)
        else:
            left = requests.put(session, command, permit)
        self._claim.lasts(left, lasts_s)
        return left

    def _present(self) -> tuple[int, int]:
        return self._control.driving.lease.epoch, self._control.board.halts.count

    def _judge(self) -> None:
        if self._mark != self._present():
            raise CancelledError("The robot was stopped or taken over before all packets were sent.")


class Operations:
    def __init__(self, control: "Control") -> None:
        self._control = control
        self._has_request = False
        self._ending: asyncio.Task[None] | None = None

    async def run(self, claim: Claim, slot: int, times: int, *, anyway: bool = False) -> Ran:
        """Ends the present motion first. `anyway`: also where the battery is at its alarm."""
        command, family = Run(slot, times), self._family()
        check(command, family)
        async with self._one_request():
            grant = Grant(self._control, claim)
            self._control.board.plays.judge_idle()
            # One that left between the repeats of a stop would be ended by the last one.
            for stops in (self._ending, self._control.board.halts.at_opening):
                if stops:
                    await asyncio.shield(stops)
                    claim.renew()
            is_battery_unknown = not anyway and await self._judge_battery(grant)
            await grant.end_what_moves()
            left = grant.send(command)
            if "run" not in family.answers:
                await left
                return Ran("sent", is_battery_unknown)
            replies = self._control.board.replies
            taken = await replies.to(left, RUN_WAIT_S, RunAccepted, RunStarted)
            return Ran("silent" if taken is None else "acknowledged", is_battery_unknown)

    async def _judge_battery(self, grant: Grant) -> bool:
        """Whether it is not known. What moves is ended first only where it keeps the board from being asked.
        Raises BatteryLowError.
        """
        guard = self._control.battery_guard
        if guard.must_ask:
            if not guard.may_ask:
                await grant.end_what_moves()
            before = self._stops()
            await grant.waits_for(guard.ask())
            self._judge_unstopped(before)
        return guard.judge()

    async def play(
        self,
        claim: Claim,
        group: FrameGroup,
        ended: Callable[[PlayState], None],
        *,
        as_run: bool = False,
        anyway: bool = False,
    ) -> PlayState:
        """Begins to play it. `ended` is called with its final state. `anyway` as with `run`; `as_run`: a
        silent driver ends it as late as a run of the board, not as soon as moves by hand.
        """
        control, guard = self._control, self._control.battery_guard
        if not anyway and guard.must_ask:
            claim.claim()
            before = self._stops()
            await guard.ask()
            self._judge_unstopped(before)
            claim.renew()
        is_unknown = not anyway and guard.judge()
        return control.requests.play(
            claim.session, group, claim.permit, ended, as_run=as_run, is_battery_unknown=is_unknown
        )

    def _stops(self) -> tuple[int, float]:
        return self._control.requests.stop_count, self._control.stopped_s

    def _judge_unstopped(self, before: tuple[int, float]) -> None:
        if self._stops() != before:
            raise CancelledError("The group was stopped before it began.")

    async def end_group(self, session: Session) -> Outcome:
        """Behind its frame in progress; everything else is free to move. Sent three times (S54), also where
        the caller has gone meanwhile.
        """
        left = self._control.requests.stop_once(session)
        if self._ending is None:
            self._ending = asyncio.create_task(self._end_again(session, left))
        ending = self._ending
        await left
        await asyncio.shield(ending)
        return "sent"

    async def _end_again(self, session: Session, first: Left) -> None:
        waiting = [first]

        def stop() -> Left:
            return waiting.pop() if waiting else self._control.requests.stop_once(session)

        async def stops() -> None:
            with contextlib.suppress(GatewayError):  # a port that is lost takes no more of them
                await repeat_stop(stop, self._control.now)

        try:
            await self._control.board.halts.end_group(stops)
        finally:
            self._ending = None

    async def erase(self, claim: Claim) -> Outcome:
        """Until the board reports that it is done."""
        command = Erase()
        self._control.board.link.judge_carried("erase")
        check(command, self._family())
        self._judge_rest()
        async with self._one_request():
            left = Grant(self._control, claim).send(command, ERASE_TIMEOUT_S)
            if await self._control.board.replies.to(left, ERASE_TIMEOUT_S, Erased) is None:
                raise NoAnswerError("The board did not confirm that its groups are erased.")
        return "acknowledged"

    async def set_speed(self, claim: Claim, slot: int | None, percent: int) -> Outcome:
        """`slot` None: of every group."""
        command = SetSpeed(slot, percent)
        check(command, self._family())
        await Grant(self._control, claim).send(command)
        return "sent"

    async def release(self, claim: Claim, servos: Sequence[int]) -> Outcome:
        """At rest only: a move that continues or still waits for the wire would power them again (X7)."""
        family = self._family()
        commands = [Release(tuple(portion)) for portion in portions_of(servos, family.servos_per_move)]
        for command in commands:
            check(command, family)
        self._judge_rest()
        grant = Grant(self._control, claim)
        for command in commands:
            await grant.send(command)
        return "sent"

    def _family(self) -> Family:
        self._control.board.identification.judge_known()
        return self._control.board.family

    def _judge_rest(self) -> None:
        if not (self._control.board.activity.is_at_rest() and self._control.board.moves.is_empty):
            raise MovingError("The robot is moving: wait until it rests, or stop it first.")
        self._control.board.judge_before()

    @contextlib.asynccontextmanager
    async def _one_request(self) -> AsyncIterator[None]:
        """One at a time, because the board's answers do not name the request."""
        if self._has_request:
            raise MovingError("Another request to the board is in progress: try again in a moment.")
        self._has_request = True
        try:
            yield
        finally:
            self._has_request = False
