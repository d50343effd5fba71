"""Carries out, on the gateway's own loop, what the judge has accepted: each verb is a request to the robot
core, as a page makes it. The sessions of users that drive over the broker, and their loss.

Knows verbs and the robot core; no topic and no broker. What may move is judged there.
"""

import contextlib
from collections.abc import Awaitable, Callable
from typing import Any

from servodeck import metrics
from servodeck.callers import Caller
from servodeck.errors import CancelledError, GatewayError, NotDrivingError
from servodeck.fleet.messages import (
    AskRequest,
    BeatRequest,
    CancelRequest,
    CommitRequest,
    Done,
    DownloadRequest,
    EraseRequest,
    MoveRequest,
    PrepareRequest,
    PressRequest,
    Refused,
    ReportRequest,
    ResumeRequest,
    RunRequest,
)
from servodeck.fleet.promises import Promise, Promises
from servodeck.fleet.reports import Nonces, Reports
from servodeck.fleet.rules import SESSIONS_AT_MOST, Accepted, Origin
from servodeck.protocol.values import ServoTarget
from servodeck.robot.board.download import group_of, parts_of
from servodeck.robot.control import Control
from servodeck.robot.hub import AGAINST_THE_RULES, Session
from servodeck.robot.operations import PageClaim, Ran
from servodeck.robot.scripts import ScriptClaim

# A group that was begun by a button is stopped after this time, at the latest.
PRESSED_MS = 600_000

Send = Callable[[Done | Refused], None]


class FleetSession(Session):
    """What it needs to know is in the gateway's reports."""

    def put(self, text: str) -> None:
        """Unread."""


class Sessions:
    def __init__(self, control: Control, gateway: str, nonces: Nonces, reports: Reports) -> None:
        self._control = control
        self._gateway = gateway
        self._nonces = nonces
        self._reports = reports
        self._sessions: dict[Origin, FleetSession] = {}
        self._acts: dict[type[Any], Callable[[FleetSession, Any], Awaitable[Done | None]]] = {
            ReportRequest: self._report,
            AskRequest: self._ask,
            BeatRequest: self._beat,
            MoveRequest: self._move,
            RunRequest: self._run,
            PressRequest: self._press,
            ResumeRequest: self._resume,
            DownloadRequest: self._download,
            EraseRequest: self._erase,
            PrepareRequest: self._prepare,
            CommitRequest: self._commit,
            CancelRequest: self._cancel,
        }
        self._promises = Promises(control, self._keep_promise, reports.note_start)
        # When it was done, and when it had come.
        self._stop = (control.stopped_s, control.stopped_s)

    @property
    def drives(self) -> bool:
        """One of them has the lease."""
        return isinstance(self._control.driving.driver, FleetSession)

    def is_driver(self, origin: Origin) -> bool:
        driver = self._control.driving.driver
        return driver is not None and driver is self._sessions.get(origin)

    def carry_out(self, accepted: Accepted, send: Send) -> None:
        """`send` gets the answer; a beat has one only where it is refused."""
        session = self._session_of(accepted.origin)
        session.begin(self._answered(session, accepted, send))

    def lose(self, reason: str) -> None:
        """They cannot be heard any more: as if each had disconnected. Runs that need no driver continue."""
        self._promises.give_up()
        for session in self._sessions.values():
            session.end(AGAINST_THE_RULES, reason)
            self._control.leave(session)
        self._sessions.clear()

    def stopped(self, came_s: float) -> None:
        """STOP was done just now, of which the latest one came at that time over the broker."""
        self._stop = (self._control.stopped_s, came_s)

    def _stop_came_s(self) -> float:
        """The latest one, over the broker or not."""
        done_s, came_s = self._stop
        return came_s if done_s == self._control.stopped_s else self._control.stopped_s

    async def _answered(self, session: FleetSession, accepted: Accepted, send: Send) -> None:
        n = accepted.request.n
        try:
            if isinstance(accepted.request, ResumeRequest) and self._stop_came_s() >= accepted.at_s:
                raise CancelledError("STOP was pressed after this was requested.")
            done = await self._acts[type(accepted.request)](session, accepted.request)
        except GatewayError as error:
            metrics.refused[error.code] += 1
            send(Refused(gateway=self._gateway, n=n, code=error.code, detail=error.detail))
        else:
            if done:
                send(done)

    async def _report(self, session: FleetSession, request: ReportRequest) -> Done:
        return self._done(session, request.n, state=self._reports.state())

    async def _ask(self, session: FleetSession, request: AskRequest) -> Done:
        self._control.driving.act(session, request.action)
        return self._done(session, request.n)

    async def _beat(self, session: FleetSession, request: BeatRequest) -> None:
        lease = self._control.driving.lease
        if lease.driver is not session:
            raise NotDrivingError("This session does not drive.")
        lease.heartbeat(session, self._nonces.of_lease(request.nonces[self._gateway]))

    async def _move(self, session: FleetSession, request: MoveRequest) -> Done:
        targets = [ServoTarget(target.servo, target.position) for target in request.targets]
        nonce = self._nonces.of_lease(request.nonce)
        await self._control.requests.move(session, targets, request.duration_ms, nonce)
        return self._done(session, request.n)

    async def _run(self, session: FleetSession, request: RunRequest) -> Done:
        claim = self._claim(session, request.nonce)
        ran = await self._control.operations.run(claim, request.slot, request.times, anyway=request.anyway)
        if request.continue_for_ms is not None:
            self._control.allow_unattended(session, request.continue_for_ms)
        return self._ran(session, request.n, ran)

    async def _press(self, session: FleetSession, request: PressRequest) -> Done:
        """Takes a free lease, as a script does, and nobody keeps it behind a button."""
        claim = ScriptClaim(self._control, session, take=False)
        ran = await self._control.operations.run(claim, request.slot, 1)
        self._control.allow_unattended(session, PRESSED_MS)
        return self._ran(session, request.n, ran)

    async def _resume(self, session: FleetSession, request: ResumeRequest) -> Done:
        self._control.resume(session.caller, session)
        return self._done(session, request.n)

    async def _download(self, session: FleetSession, request: DownloadRequest) -> Done:
        control, nonce = self._control, self._nonces.of_lease(request.nonce)
        control.board.identification.judge_known()
        groups = [await group_of(body) for body in request.groups]
        parts = await parts_of(groups, control.board.family_id)

        def claim() -> None:
            control.driving.lease.permit(session, nonce, control.now(), DownloadRequest.WITHIN_S)

        job = control.requests.download(parts, session.caller, claim, request.behind)
        return self._done(session, request.n, job=job)

    async def _erase(self, session: FleetSession, request: EraseRequest) -> Done:
        outcome = await self._control.operations.erase(self._claim(session, request.nonce))
        return self._done(session, request.n, outcome=outcome)

    async def _prepare(self, session: FleetSession, request: PrepareRequest) -> Done:
        """The battery is judged here: a run that is due may not wait for an answer of the board."""
        guard = self._control.battery_guard
        if not request.anyway:
            await guard.ask()
            guard.judge()
        lease, now = self._control.driving.lease, self._control.now()
        lease.permit(session, self._nonces.of_lease(request.nonce), now, PrepareRequest.WITHIN_S)
        self._promises.prepare(session, request)
        return self._done(session, request.n)

    async def _commit(self, session: FleetSession, request: CommitRequest) -> Done | None:
        return self._done(session, request.n) if self._promises.commit(session, request.name) else None

    async def _cancel(self, session: FleetSession, request: CancelRequest) -> Done | None:
        return self._done(session, request.n) if self._promises.cancel(session, request.name) else None

    def _keep_promise(self, promise: Promise) -> None:
        async def kept() -> None:
            with contextlib.suppress(GatewayError):  # the state says that nothing runs
                command = promise.command
                await self._control.operations.run(promise, command.slot, command.times, anyway=True)

        promise.session.begin(kept())

    def _claim(self, session: FleetSession, nonce: str) -> PageClaim:
        return PageClaim(self._control, session, self._nonces.of_lease(nonce))

    def _ran(self, session: FleetSession, n: int, ran: Ran) -> Done:
        return self._done(session, n, outcome=ran.outcome, battery_unknown=ran.is_battery_unknown or None)

    def _done(self, session: FleetSession, n: int, **results: Any) -> Done:
        driving = self._control.driving
        return Done(
            gateway=self._gateway,
            n=n,
            nonce=self._nonces.newest(),
            epoch=driving.lease.epoch,
            drives=driving.driver is session,
            **results,
        )

    def _session_of(self, origin: Origin) -> FleetSession:
        found = self._sessions.get(origin)
        if found is None:
            if len(self._sessions) >= SESSIONS_AT_MOST:
                self._drop_one()
            caller = Caller(f"broker:{origin.user}", origin.user, origin.role)
            found = self._sessions[origin] = FleetSession(caller, answers=False)
        return found

    def _drop_one(self) -> None:
        """The oldest one that does not drive."""
        driver = self._control.driving.driver
        origin = next(origin for origin, session in self._sessions.items() if session is not driver)
        self._control.leave(self._sessions.pop(origin))
