"""The right to move the robot: one driver at a time, whose heartbeat shows that a person is present.

Pure: time comes in, no socket, port or disk. Must not know what a packet means; the owner of the port acts on
`LeaseEvents`.
"""

from typing import Generic, Literal, Protocol, TypeVar

from servodeck.errors import BusyError, ExpiredError, NotDrivingError
from servodeck.protocol.timings import LEASE, MOVE
from servodeck.value import value

HEARTBEAT_S = LEASE.beat_ms / 1000
COMMAND_S = MOVE.expires_ms / 1000
QUIET_S = LEASE.quiet_ms / 1000
SILENT_S = LEASE.silent_ms / 1000
GONE_S = LEASE.gone_ms / 1000
ANSWER_S = LEASE.answer_ms / 1000

Silence = Literal["none", "quiet", "silent"]
NEXT_RUNG_S: dict[Silence, float] = {"none": QUIET_S, "quiet": SILENT_S, "silent": GONE_S}

H = TypeVar("H")


class LeaseEvents(Protocol):
    def driver_quiet(self) -> None:
        """Nothing was heard for so long that endless motion must end."""

    def driver_silent(self) -> None:
        """Still nothing: groups that the board runs must end, too."""

    def driver_lost(self) -> None:
        """The driver is gone without a release; `driver_changed` follows."""

    def driver_changed(self) -> None:
        """The driver before does not drive any more: its motion must end."""

    def lease_changed(self) -> None:
        """The state for clients has changed."""


@value
class Permit:
    """The permission of one command to move the robot: in that epoch, from the issue of its nonce until
    `until_s`.
    """

    epoch: int
    issued_s: float
    until_s: float


class Lease(Generic[H]):
    def __init__(self, epoch: int, events: LeaseEvents) -> None:
        """Every grant and every loss increments `epoch`, so that a permit is valid for one grant only."""
        self.epoch = epoch
        self.driver: H | None = None
        self.requester: H | None = None
        # The client that handed it to the driver; None where it was not handed over.
        self.giver: H | None = None
        self.silence: Silence = "none"
        self._events = events
        self._answer_until_s = 0.0
        self._heard_s = 0.0
        self._is_program = False
        self._programs: set[H] = set()
        self._count = 0
        self._issued: dict[str, float] = {}

    def request(self, who: H, now: float) -> None:
        """Gets a free lease at once, another one when its driver has let `ANSWER_S` pass. Raises BusyError
        where another client has requested it already.
        """
        if who in (self.driver, self.requester):
            return
        if self.driver is None:
            self._grant(who, now)
            return
        if self.requester is not None:
            raise BusyError("Another client has requested it already.")
        self.requester, self._answer_until_s = who, now + ANSWER_S
        self._events.lease_changed()

    def refuse(self, who: H) -> None:
        if who is not self.driver:
            raise NotDrivingError("Only the driver can refuse.")
        self._forget_requester()

    def release(self, who: H, now: float) -> None:
        """To the client that requested it, or to none. A client may withdraw its own request."""
        if who is self.requester:
            self._forget_requester()
        elif who is self.driver:
            self._pass_on(now)

    def take(self, who: H, now: float) -> None:
        """Without a request to the driver."""
        if who is not self.driver:
            self._grant(who, now)

    def give(self, giver: H, to: H, now: float) -> None:
        """Without a request of `to`, and before a pending request. The caller judges who may."""
        if to is not self.driver:
            self._grant(to, now, giver)

    def leave(self, who: H, now: float) -> None:
        """The client has disconnected."""
        self._programs.discard(who)
        if who is self.driver:
            self._events.driver_lost()
            self._pass_on(now)
        elif who is self.requester:
            self._forget_requester()

    def issue(self, now: float) -> str:
        """A nonce for the driver, which shows the greatest age of a message with it; no clock of the client
        is used.
        """
        self._count += 1
        nonce = f"{self.epoch}-{self._count}"
        self._issued = {known: at for known, at in self._issued.items() if now - at <= GONE_S}
        self._issued[nonce] = now
        return nonce

    def heartbeat(self, who: H, nonce: str) -> None:
        """Counts from when the nonce was issued: a late one is no sign of life now."""
        issued_s = self._issued.get(nonce, 0.0)
        if who is self.driver and issued_s > self._heard_s:
            self._heard_s, self.silence = issued_s, "none"

    def vouch(self, who: H, until_s: float) -> None:
        """The motion of a program is permitted until then, which counts as a heartbeat at that time. Until
        now: it is a heartbeat. A silent program loses the lease sooner than a person, and its motion is
        stopped later: it sends fewer heartbeats.
        """
        self._programs.add(who)
        if who is self.driver:
            self._is_program = True
            if until_s > self._heard_s:
                self._heard_s, self.silence = until_s, "none"

    def begin_beats(self, who: H, now: float) -> None:
        """A program begins motion that ends with its heartbeats: no permission of an earlier motion covers
        it.
        """
        self._programs.add(who)
        if who is self.driver:
            self._is_program = True
            self._heard_s, self.silence = now, "none"

    def permit(self, who: H, nonce: str | None, now: float, within_s: float = COMMAND_S) -> Permit:
        """For one command. Raises NotDrivingError or ExpiredError."""
        if who is not self.driver:
            raise NotDrivingError(
                "Another client drives." if self.driver else "No client drives: request the lease first."
            )
        issued_s = None if nonce is None else self._issued.get(nonce)
        if nonce is None or issued_s is None or now - issued_s > within_s:
            raise ExpiredError("This request is too old.")
        self.heartbeat(who, nonce)
        return Permit(self.epoch, issued_s, issued_s + within_s)

    def renewed_permit(self, who: H, now: float) -> Permit:
        """For a request whose preceding motion has ended by now. Raises NotDrivingError, or ExpiredError
        where nothing was heard for so long that nothing may begin.
        """
        permit = Permit(self.epoch, self._heard_s, self._heard_s + QUIET_S)
        if who is not self.driver:
            raise NotDrivingError("Another client drives now.")
        self.judge(permit, now)
        return permit

    def judge(self, permit: Permit, now: float) -> None:
        """Called when the command is about to leave. Raises NotDrivingError or ExpiredError."""
        if permit.epoch != self.epoch:
            raise NotDrivingError("Another client drives now.")
        if now > permit.until_s:
            raise ExpiredError("This request waited too long to be sent.")

    def granted_in_s(self, now: float) -> float | None:
        """How long the driver may still refuse; None where there is no request."""
        return None if self.requester is None else max(0.0, self._answer_until_s - now)

    def due_s(self) -> float | None:
        """When `advance` has something to do, if nothing is heard until then."""
        if self.driver is None:
            return None
        rung_s = self._heard_s + (SILENT_S if self._is_program else NEXT_RUNG_S[self.silence])
        return rung_s if self.requester is None else min(rung_s, self._answer_until_s)

    def advance(self, now: float) -> None:
        """Does everything that is due."""
        if self.driver is None:
            return
        self._climb(now - self._heard_s)
        if self.requester is not None and now >= self._answer_until_s:
            self._pass_on(now)

    def _climb(self, silence_s: float) -> None:
        quiet_s, gone_s = (SILENT_S, SILENT_S) if self._is_program else (QUIET_S, GONE_S)
        if self.silence == "none" and silence_s >= quiet_s:
            self.silence = "quiet"
            self._events.driver_quiet()
        if self.silence == "quiet" and silence_s >= SILENT_S:
            self.silence = "silent"
            self._events.driver_silent()
        if silence_s >= gone_s and self.driver is not None:
            self._events.driver_lost()
            self._pass_on(self._heard_s + silence_s)

    def _pass_on(self, now: float) -> None:
        if self.requester is not None:
            self._grant(self.requester, now)
            return
        self.epoch += 1
        self.driver = self.giver = None
        self._issued.clear()
        self._events.driver_changed()
        self._events.lease_changed()

    def _grant(self, who: H, now: float, giver: H | None = None) -> None:
        before = self.driver
        self.epoch += 1
        self.driver, self.requester, self.giver = who, None, giver
        self.silence, self._heard_s = "none", now
        self._is_program = who in self._programs
        self._issued.clear()
        if before is not None:
            self._events.driver_changed()
        self._events.lease_changed()

    def _forget_requester(self) -> None:
        if self.requester is not None:
            self.requester = None
            self._events.lease_changed()
