"""Requests of scripts over HTTP: each takes the lease by itself, for as long as the motion that it starts
lasts (docs/adr/0014).

Knows requests and the order in which their packets leave; no HTTP. `driving` decides who may drive,
requests.py what may leave.
"""

import asyncio
import math
from collections.abc import Awaitable, Callable, Coroutine, Mapping, Sequence
from typing import Any, Literal, TypeVar

from servodeck.callers import Caller, as_script
from servodeck.errors import CancelledError, MovingError, NotPairedError, OutOfRangeError
from servodeck.port.wire import Left
from servodeck.protocol.families import Family, check
from servodeck.protocol.packets import portions_of
from servodeck.protocol.values import Move, ServoTarget
from servodeck.robot.board.download import Part
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.move_buffer import FIRST_MOVE_STAGGER_S, first_ms
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from servodeck.robot.lease import Permit
from servodeck.robot.operations import Grant, Ran
from servodeck.robot.requests import end_of_group
from servodeck.snapshots import JobState, LeaseState, PlayState
from servodeck.value import value

T = TypeVar("T")


class ScriptSession(Session):
    """A program reads no messages."""

    def put(self, text: str) -> None:
        """Unread."""

    async def do(self, work: Coroutine[Any, Any, T]) -> T:
        """Returns or raises what `work` does; CancelledError where this session ended before."""
        try:
            return await self.begin(work)
        except asyncio.CancelledError:
            if self.close_reason:
                raise CancelledError(self.close_reason.reason) from None
            raise

    async def end_pending(self) -> None:
        """Returns when none of its tasks is running any more."""
        if pending := self.drop_pending():
            await asyncio.wait(pending)


ScriptAction = Literal["request", "take", "release", "heartbeat"]
IsWanted = Callable[[], Awaitable[bool]]


@value
class Moved:
    packets: int
    over_in_ms: int
    first_moves: tuple[int, ...]


class ScriptClaim:
    """Of a program, which sends one request at a time: it requests the lease with each request, and holds it
    for as long as the motion lasts.
    """

    def __init__(self, control: Control, session: Session, *, take: bool, beats: bool = False) -> None:
        """`beats`: its motion ends with its heartbeats (docs/adr/0056). Otherwise the request is its
        permission for the time of the motion.
        """
        self.session = session
        self._driving = control.driving
        self._now = control.now
        self._take = take
        self._beats = beats

    def claim(self) -> None:
        self._driving.claim_for(self.session, take=self._take)

    def permit(self) -> Permit:
        nonce = self._driving.claim_for(self.session, take=False)
        return self._driving.lease.permit(self.session, nonce, self._now())

    def renew(self) -> None:
        """Each of its packets gets a new permit."""

    def lasts(self, left: Left, for_s: float) -> None:
        if self._beats:
            self._driving.begin_beats(self.session)
        permitted_s = 0.0 if self._beats else for_s
        self._driving.vouch(self.session, 0.0)
        left.add_done_callback(lambda _: self._driving.vouch(self.session, permitted_s))


class ScriptGrant(Grant):
    """A grant that also allows to play a group."""

    def __init__(self, control: Control, claim: ScriptClaim) -> None:
        super().__init__(control, claim)
        self._session = claim.session

    async def play(self, group: FrameGroup, *, anyway: bool) -> PlayState:
        self._judge()
        state = await self._control.operations.play(
            self._claim, group, self._played, as_run=True, anyway=anyway
        )
        self._control.driving.vouch(self._session, 0.0)
        return state

    def _played(self, state: PlayState) -> None:
        """After a person has ended the play, its frame in progress continues."""
        if state.code in (None, "cancelled"):
            motion, now = self._control.board.motion, self._control.now()
            self._control.driving.vouch(self._session, motion.moves_for_s(now))


class Scripts:
    def __init__(self, control: Control, still_lets_in: Callable[[Caller], bool]) -> None:
        """`still_lets_in` is called again when a request has been read: that may take a while."""
        self._control = control
        self._still_lets_in = still_lets_in
        self._sessions: dict[str, ScriptSession] = {}

    async def move(
        self,
        caller: Caller,
        duration_ms: int,
        positions: Mapping[int, int],
        *,
        take: bool,
        beats: bool,
        is_wanted: IsWanted,
    ) -> Moved:
        """Until its last packet has left; what is not wanted any more does not leave. `beats`: the move ends
        with the heartbeats of its program.
        """
        session = self._session_of(caller)
        claim = ScriptClaim(self._control, session, take=take, beats=beats)
        moved = await session.do(self._move(claim, duration_ms, positions, is_wanted))
        if not beats:
            self._control.board.unattended.allow_move(session, duration_ms / 1000)
        return moved

    async def _move(
        self,
        claim: ScriptClaim,
        duration_ms: int,
        positions: Mapping[int, int],
        is_wanted: IsWanted,
    ) -> Moved:
        control = self._control
        family, now = self._family(), control.now()
        if control.board.motion.group_may_run(now):
            raise MovingError(end_of_group(control.board.motion.group_ends_in_s(now)))
        plan = plan_move(duration_ms, positions, family, control.board.motion, now, control.limits.name_of)
        for step in plan.steps:
            control.limits.judge(step.move, claim.session)
        grant = Grant(control, claim)
        for step in plan.steps:
            await asyncio.sleep(step.after_s)
            if not await is_wanted():
                raise CancelledError("The client disconnected.")
            await grant.send(step.move, duration_ms / 1000)
        # A time of 0 is that of the soft limit.
        over_in_ms = duration_ms or math.ceil(control.board.motion.moves_for_s(control.now()) * 1000)
        return Moved(len(plan.steps), over_in_ms, plan.first_moves)

    async def run(
        self,
        caller: Caller,
        slot: int,
        times: int,
        *,
        take: bool,
        continue_ms: int | None = None,
        anyway: bool = False,
    ) -> Ran:
        """Ends the present motion first. `anyway`: also where the battery is at its alarm."""
        session = self._session_of(caller)
        claim = ScriptClaim(self._control, session, take=take)

        async def run() -> Ran:
            ran = await self._control.operations.run(claim, slot, times, anyway=anyway)
            if continue_ms is not None:
                self._control.allow_unattended(session, continue_ms)
            return ran

        return await session.do(run())

    async def play(
        self,
        caller: Caller,
        group: FrameGroup,
        *,
        take: bool,
        continue_ms: int | None = None,
        anyway: bool = False,
    ) -> PlayState:
        """Begins it."""
        session = self._session_of(caller)
        claim = ScriptClaim(self._control, session, take=take)
        return await session.do(self._play(claim, group, continue_ms, anyway=anyway))

    async def _play(
        self, claim: ScriptClaim, group: FrameGroup, continue_ms: int | None, *, anyway: bool
    ) -> PlayState:
        self._family()
        session, grant = claim.session, ScriptGrant(self._control, claim)
        await grant.after_the_stop()
        state = await grant.play(group, anyway=anyway)
        if continue_ms is not None:
            self._control.allow_unattended(session, continue_ms)
        return state

    def download(self, caller: Caller, parts: Sequence[Part], behind: str | None, *, take: bool) -> JobState:
        """Needs the lease to begin with, and no driver from then on."""
        session, driving = self._session_of(caller), self._control.driving

        def claim() -> None:
            driving.claim_for(session, take=take)

        job = self._control.requests.download(parts, session.caller, claim, behind)
        driving.vouch(session, 0.0)
        return job

    async def erase(self, caller: Caller, *, take: bool) -> None:
        """Until the board reports that it is done."""
        session = self._session_of(caller)
        claim = ScriptClaim(self._control, session, take=take)
        await session.do(self._control.operations.erase(claim))

    def act(self, caller: Caller, action: ScriptAction) -> LeaseState:
        """On the lease alone; after a `heartbeat` what this script has begun may continue."""
        session, driving = self._session_of(caller), self._control.driving
        if action != "heartbeat":
            driving.act(session, action)
        driving.vouch(session, 0.0)
        return driving.state_for(session)

    def give(self, caller: Caller, to: str) -> LeaseState:
        """To a person with an open page."""
        session = self._session_of(caller)
        self._control.driving.give(session, to)
        return self._control.driving.state_for(session)

    async def disconnect(
        self,
        caller_id: str,
        reason: str,
        by: str,
        *,
        still_drives: bool = False,
        run_continues: bool = False,
    ) -> None:
        """Revokes a caller or its role: its requests of pages and over HTTP have ended when this returns. Its
        unattended group is stopped in the name of `by`, or continues.
        """
        own = self._sessions.pop(caller_id, None)
        also = (own,) if own else ()
        self._control.disconnect(
            caller_id, reason, by, still_drives=still_drives, run_continues=run_continues, also=also
        )
        if own:
            await own.end_pending()

    def _family(self) -> Family:
        self._control.board.identification.judge_known()
        return self._control.board.family

    def _session_of(self, caller: Caller) -> ScriptSession:
        if not self._still_lets_in(caller):
            raise NotPairedError("This device is no longer paired, or its role has changed.")
        session = self._sessions.setdefault(caller.id, ScriptSession(caller))
        session.caller = as_script(caller)  # an owner may have renamed it
        return session


@value
class Step:
    """`after_s`: since the step before."""

    move: Move
    after_s: float


@value
class MovePlan:
    """`first_moves` are the servos that start one after another."""

    steps: tuple[Step, ...]
    first_moves: tuple[int, ...]


def plan_move(
    duration_ms: int,
    positions: Mapping[int, int],
    family: Family,
    motion: Estimate,
    now: float,
    name_of: Callable[[int], str],
) -> MovePlan:
    """In exactly that time, as a script requests it. Raises what the board cannot take, and a first move that
    would be too fast: it is refused, not silently made slower.
    """
    new = tuple(servo for servo in sorted(positions) if motion.is_unknown(servo, now))
    known = tuple(servo for servo in sorted(positions) if servo not in new)
    needs_ms = max(first_ms(known, motion, now), first_ms(new, motion, now))
    judge_time(duration_ms, new, needs_ms, family, name_of)
    portions = [*portions_of(known, family.servos_per_move), *((servo,) for servo in new)]
    moves = [
        Move(duration_ms, tuple(ServoTarget(servo, positions[servo]) for servo in portion))
        for portion in portions
    ]
    for move in moves:
        check(move, family)
    starts = len(moves) - len(new)
    waits = [FIRST_MOVE_STAGGER_S if index > starts else 0.0 for index in range(len(moves))]
    return MovePlan(tuple(map(Step, moves, waits)), new)


def judge_time(
    duration_ms: int, new: Sequence[int], needs_ms: float, family: Family, name_of: Callable[[int], str]
) -> None:
    if duration_ms >= needs_ms:
        return
    why = (
        f"the position of {', '.join(map(name_of, new))} is unknown before the first move"
        if new
        else "a servo is still in its first move"
    )
    raise OutOfRangeError(f"timeMs is {duration_ms}, allowed {needs_ms}..{family.duration_ms.max}: {why}")
