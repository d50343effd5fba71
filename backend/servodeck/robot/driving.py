"""The lease of connected clients: the driver, the client that requests to drive, and those that may hand
over. Sends each client its view of the lease, and the driver its nonces. Counts the starts of the gateway on
disk, so that no lease of an earlier start is valid.

Knows sessions, timers and one small file, no packet and no port; latch.py decides what stops when a driver is
lost.
"""

import asyncio
import contextlib
from collections.abc import Callable
from pathlib import Path

from servodeck.callers import SHORTEST_WAIT_S, Caller
from servodeck.errors import CancelledError, NotDrivingError, NotFoundError
from servodeck.events import LeaseStateMessage, TickMessage, encode
from servodeck.files import write_whole
from servodeck.intents import LeaseAction
from servodeck.robot.hub import Hub, Session
from servodeck.robot.lease import GONE_S, HEARTBEAT_S, Lease, LeaseEvents
from servodeck.snapshots import Candidate, LeaseState

# A timer this late means that the process was held up: messages of the driver wait to be read, and a tick
# that was not sent could not be answered. So a tick is sent and its answer awaited before a silence counts.
HELD_UP_S = 0.1
CATCH_UP_S = 0.1


class Driving:
    def __init__(self, hub: Hub, now: Callable[[], float], epoch: int, events: LeaseEvents) -> None:
        self._hub = hub
        self._now = now
        self.lease: Lease[Session] = Lease(epoch, events)
        """Commands are judged by it directly; only this class grants it or passes it on."""
        self._timer: asyncio.TimerHandle | None = None
        self._tick_s = 0.0
        self._wake_s = 0.0
        self._catches_up = False

    @property
    def driver(self) -> Session | None:
        return self.lease.driver

    def act(self, session: Session, action: LeaseAction) -> None:
        """Raises ForbiddenError, BusyError, NotDrivingError, or CancelledError for a session that has
        ended.
        """
        require_present(session)
        now = self._now()
        match action:
            case "request":
                session.caller.require("driver")
                self.lease.request(session, now)
            case "take":
                session.caller.require("owner")
                self.lease.take(session, now)
            case "release":
                self.lease.release(session, now)
            case "refuse":
                self.lease.refuse(session)
        self._plan()

    def give(self, giver: Session, to: str) -> None:
        """Hands the lease to a connected client that may drive. Raises ForbiddenError, NotDrivingError for a
        client that neither drives nor is an owner, or NotFoundError.
        """
        require_present(giver)
        giver.caller.require("driver")
        driver = self.lease.driver
        if not giver.caller.may("owner") and (driver is None or driver.caller.id != giver.caller.id):
            raise NotDrivingError("Only the driver or an owner may hand over the robot.")
        self.lease.give(giver, self._candidate(to), self._now())
        self._plan()

    def _candidate(self, caller_id: str) -> Session:
        """Of several windows the one that requests the lease, else the latest."""
        found = [
            session
            for session in self._hub.sessions
            if session.caller.id == caller_id and could_drive(session)
        ]
        if not found:
            raise NotFoundError("No connected client with that id may drive.")
        requester = self.lease.requester
        return requester if requester in found else found[-1]

    def leave(self, session: Session) -> None:
        self.lease.leave(session, self._now())
        self._plan()

    def presence_changed(self, session: Session) -> None:
        """It came or went: sends the list of candidates to the clients that may hand over."""
        if not could_drive(session):
            return
        for one in self._hub.sessions:
            if one.caller.id != session.caller.id and self._may_give(one):
                self.send_state(one)

    def _may_give(self, session: Session) -> bool:
        return session is self.lease.driver or session.caller.may("owner")

    def _candidates(self, giver: Session) -> list[Candidate]:
        """Each person once, also with several windows."""
        if not self._may_give(giver):
            return []
        driver = self.lease.driver
        but = {giver.caller.id} | ({driver.caller.id} if driver else set())
        found = {one.caller.id: one.caller.name for one in self._hub.sessions if could_drive(one)}
        return [Candidate(id=key, name=name) for key, name in found.items() if key not in but]

    def claim_for(self, session: Session, *, take: bool) -> str:
        """For a program, which sends one request at a time: a new nonce; takes the lease where it is free, or
        with `take`. Raises ForbiddenError, CancelledError, or NotDrivingError that names who drives.
        """
        require_present(session)
        session.caller.require("driver")
        driver = self.lease.driver
        if take:
            self.act(session, "take")
        elif driver is None:
            self.act(session, "request")
        elif driver is not session:
            raise NotDrivingError(f'{driver.caller.name} drives. An owner may take over with "take": true.')
        return self.lease.issue(self._now())

    def vouch(self, session: Session, for_s: float) -> None:
        """The motion that the program requested is permitted for so long from now, 0: it is a heartbeat;
        ignored for a session that has ended.
        """
        if not session.ended.is_set():
            self.lease.vouch(session, self._now() + for_s)
            self._plan()

    def begin_beats(self, session: Session) -> None:
        """The motion that the program begins ends with its heartbeats."""
        if not session.ended.is_set():
            self.lease.begin_beats(session, self._now())
            self._plan()

    def judge_request(self, caller: Caller, nonce: str) -> None:
        """For requests of a page beside its WebSocket: only the driver has the nonce. A large request takes
        longer. Raises NotDrivingError or ExpiredError.
        """
        self.lease.permit(self.driving_page(caller), nonce, self._now(), GONE_S)

    def driving_page(self, caller: Caller) -> Session:
        """The page that drives, for its requests beside its WebSocket. Raises NotDrivingError."""
        driver = self.lease.driver
        if driver is None or driver.caller.id != caller.id:
            raise NotDrivingError(f"{driver.caller.name if driver else 'No client'} drives.")
        return driver

    def may_rule(self, caller: Caller) -> bool:
        """Whether they may change what moves are judged by: while another drives, only an owner may."""
        return self.driver is None or self.driver.caller.id == caller.id or caller.may("owner")

    def judge_resume(self, caller: Caller) -> None:
        """Raises ForbiddenError, or NotDrivingError that names who may."""
        caller.require("driver")
        if self.driver and not self.may_rule(caller):
            name = self.driver.caller.name
            raise NotDrivingError(f"{name} drives: only {name} or an owner may resume.")

    def state_for(self, session: Session) -> LeaseState:
        lease = self.lease
        granted_in_s = lease.granted_in_s(self._now())
        return LeaseState(
            you=session.caller.name,
            driver=name_of(lease.driver),
            drives=lease.driver is session,
            requested_by=name_of(lease.requester),
            has_requested=lease.requester is session,
            granted_in_ms=None if granted_in_s is None else round(granted_in_s * 1000),
            may_drive=session.caller.may("driver"),
            may_take=session.caller.may("owner"),
            granted_by=name_of(lease.giver) if lease.driver is session else None,
            candidates=self._candidates(session),
        )

    def send_states(self) -> None:
        """Each client its own view; the driver gets a nonce with it."""
        for session in self._hub.sessions:
            self.send_state(session)
        if self.lease.driver:
            self._tick(self.lease.driver)

    def send_state(self, session: Session) -> None:
        session.put(encode(LeaseStateMessage(lease=self.state_for(session))))

    def _tick(self, driver: Session) -> None:
        now = self._now()
        self._tick_s = now + HEARTBEAT_S
        driver.put(encode(TickMessage(nonce=self.lease.issue(now))))

    def _plan(self) -> None:
        if self._catches_up:
            return
        if self._timer:
            self._timer.cancel()
        due_s = self.lease.due_s()
        if due_s is not None:
            self._wake_in(min(due_s, self._tick_s) - self._now())

    def _wake_in(self, delay_s: float) -> None:
        delay_s = max(SHORTEST_WAIT_S, delay_s)
        self._wake_s = self._now() + delay_s
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._wake)

    def _wake(self) -> None:
        is_late = self._now() - self._wake_s > HELD_UP_S
        # Once, however late the next timer is: a driver who is gone must not be waited for longer.
        self._catches_up = is_late and not self._catches_up
        if self._catches_up and self.lease.driver:
            self._tick(self.lease.driver)
            self._wake_in(CATCH_UP_S)
            return
        self._catches_up = False
        self.lease.advance(self._now())
        if self.lease.driver and self._now() >= self._tick_s:
            self._tick(self.lease.driver)
        self._plan()


def require_present(session: Session) -> None:
    """Requests of a session that has ended are refused."""
    if session.ended.is_set():
        raise CancelledError("The client disconnected.")


def could_drive(session: Session) -> bool:
    return session.answers and session.caller.may("driver")


def name_of(session: Session | None) -> str | None:
    return None if session is None else session.caller.name


GRANTS_PER_START = 2**32


def first_epoch(folder: Path) -> int:
    """The epoch from which the leases of this start are counted. A folder that cannot be written is no
    error.
    """
    file = folder / "epoch"
    start = read_start(file) + 1
    with contextlib.suppress(OSError):
        write_whole(file, str(start))
    return start * GRANTS_PER_START


def read_start(file: Path) -> int:
    try:
        return max(0, int(file.read_text("ascii")))
    except (OSError, ValueError):
        return 0
