"""The lease under two drivers, pages or programs, who do anything at any time (F19)."""

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from servodeck.errors import GatewayError
from servodeck.robot.lease import COMMAND_S, GONE_S, QUIET_S, Permit
from tests.amount import TIMES
from tests.test_lease import new_lease

DRIVERS = st.sampled_from(["anna", "bert"])


class TwoDrivers(RuleBasedStateMachine):
    """Records the grants of the lease and the messages, each with its client and time."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 0.0
        self.lease, self.recorder = new_lease()
        self.epochs: list[int] = []
        self.given: dict[str, list[tuple[str, float, int]]] = {"anna": [], "bert": []}
        self.waiting: list[tuple[Permit, float]] = []
        self.echoed_s = 0.0

    def note_grant(self, epoch: int) -> None:
        if self.lease.epoch != epoch:
            self.epochs.append(self.lease.epoch)
            self.echoed_s = self.now

    @rule(seconds=st.sampled_from([0.01, 0.1, 0.25, 0.3, 0.7, 1.3, 4.0, 60.0, 90_000.0]))
    def time_passes(self, seconds: float) -> None:
        self.now += seconds

    @rule()
    def timers_fire(self) -> None:
        epoch = self.lease.epoch
        self.lease.advance(self.now)
        self.note_grant(epoch)

    @rule(who=DRIVERS, action=st.sampled_from(["request", "release", "take", "leave", "refuse"]))
    def acts(self, who: str, action: str) -> None:
        epoch = self.lease.epoch
        try:
            if action == "refuse":
                self.lease.refuse(who)
            else:
                getattr(self.lease, action)(who, self.now)
        except GatewayError:
            pass
        self.note_grant(epoch)

    @rule(giver=DRIVERS, to=DRIVERS)
    def gives(self, giver: str, to: str) -> None:
        before, epoch = self.lease.driver, self.lease.epoch
        self.lease.give(giver, to, self.now)
        assert self.lease.driver == to
        if before != to:
            assert (self.lease.epoch, self.lease.giver, self.lease.requester) == (epoch + 1, giver, None)
        self.note_grant(epoch)

    @precondition(lambda self: self.lease.driver is not None)
    @rule()
    def driver_gets_a_nonce(self) -> None:
        assert self.lease.driver
        nonce = self.lease.issue(self.now)
        self.given[self.lease.driver].append((nonce, self.now, self.lease.epoch))

    @rule(who=DRIVERS, back=st.integers(1, 6))
    def beats(self, who: str, back: int) -> None:
        """With its newest nonce, or, as a frozen tab that wakes, with an old one."""
        for nonce, told_s, epoch in self.given[who][-back:][:1]:
            self.lease.heartbeat(who, nonce)
            if who == self.lease.driver and epoch == self.lease.epoch:
                self.echoed_s = max(self.echoed_s, told_s)

    @rule(who=DRIVERS, seconds=st.sampled_from([0.0, 0.5, 3.0, 30.0]))
    def vouches(self, who: str, seconds: float) -> None:
        """As a program: what it asked lasts so long."""
        self.lease.vouch(who, self.now + seconds)
        if who == self.lease.driver:
            self.echoed_s = max(self.echoed_s, self.now + seconds)

    @rule(who=DRIVERS, back=st.integers(1, 6))
    def commands(self, who: str, back: int) -> None:
        for nonce, told_s, epoch in self.given[who][-back:][:1]:
            may = who == self.lease.driver and epoch == self.lease.epoch and self.now - told_s <= COMMAND_S
            try:
                permit = self.lease.permit(who, nonce, self.now)
            except GatewayError:
                assert not may
            else:
                assert may
                self.echoed_s = max(self.echoed_s, told_s)
                self.waiting.append((permit, told_s))

    @rule()
    def the_port_takes_what_waits(self) -> None:
        waiting, self.waiting = self.waiting, []
        for permit, told_s in waiting:
            try:
                self.lease.judge(permit, self.now)
            except GatewayError:
                continue
            assert self.lease.driver is not None
            assert permit.epoch == self.lease.epoch  # I1
            assert self.now - told_s <= COMMAND_S + 1e-6  # I3
            assert self.now - self.echoed_s <= QUIET_S  # I3

    @invariant()
    def epochs_only_grow(self) -> None:
        assert self.epochs == sorted(set(self.epochs))

    @invariant()
    def a_silent_driver_never_stays_past_its_time(self) -> None:
        due_s = self.lease.due_s()
        assert (due_s is None) == (self.lease.driver is None)
        if due_s is not None and due_s > self.now:
            assert self.now - self.echoed_s < GONE_S


TwoDrivers.TestCase.settings = settings(max_examples=500 if TIMES > 1 else 60, stateful_step_count=40)
test_two_drivers_who_do_anything_at_any_time = TwoDrivers.TestCase
