"""The lease by itself: each rule once, then two drivers, pages or programs, who do anything at any time
(F19).
"""

from dataclasses import dataclass, field

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from servodeck.errors import BusyError, ExpiredError, GatewayError, NotDrivingError
from servodeck.lease import ANSWER_S, COMMAND_S, GONE_S, QUIET_S, SILENT_S, Lease, Permit
from tests.amount import TIMES


@dataclass
class Told:
    """What the owner of the port was told."""

    events: list[str] = field(default_factory=list)

    def driver_quiet(self) -> None:
        self.events.append("quiet")

    def driver_silent(self) -> None:
        self.events.append("silent")

    def driver_lost(self) -> None:
        self.events.append("lost")

    def driver_changed(self) -> None:
        self.events.append("changed")

    def lease_changed(self) -> None:
        pass

    def take(self) -> list[str]:
        taken, self.events = self.events, []
        return taken


def new_lease(epoch: int = 0) -> tuple[Lease[str], Told]:
    told = Told()
    return Lease(epoch, told), told


def test_a_free_lease_is_given_at_once_with_a_new_epoch() -> None:
    lease, told = new_lease(epoch=41)
    lease.request("anna", 0.0)
    assert (lease.driver, lease.epoch, told.take()) == ("anna", 42, [])
    lease.request("anna", 1.0)
    assert (lease.epoch, told.take()) == (42, [])


def test_a_request_passes_when_the_driver_has_said_nothing_for_five_seconds() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    nonce = lease.issue(0.0)
    lease.request("bert", 0.1)
    assert lease.answer_in_s(1.1) == pytest.approx(4.0)
    for beat in range(1, 20):
        at_s = beat * 0.25
        lease.beat("anna", lease.issue(at_s))
        lease.advance(at_s)
    assert lease.driver == "anna"
    lease.advance(0.1 + ANSWER_S)
    assert (lease.driver, lease.asker, lease.epoch) == ("bert", None, 2)
    assert told.take() == ["changed"]
    with pytest.raises(NotDrivingError):
        lease.permit("anna", nonce, 5.1)


def test_a_refused_request_may_be_made_again_and_only_the_driver_refuses() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    with pytest.raises(BusyError):
        lease.request("carl", 0.0)
    with pytest.raises(NotDrivingError):
        lease.refuse("bert")
    lease.refuse("anna")
    assert (lease.driver, lease.asker, lease.answer_in_s(0.0)) == ("anna", None, None)
    lease.request("carl", 0.0)
    assert lease.asker == "carl"


def test_giving_it_up_is_allowing_whoever_asks() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    lease.release("anna", 1.0)
    assert lease.driver == "bert"
    lease.release("bert", 1.0)
    assert lease.driver is None
    assert lease.epoch == 2


def test_whoever_asks_may_take_that_back_and_a_stranger_can_give_up_nothing() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    lease.release("carl", 0.0)
    assert (lease.driver, lease.asker) == ("anna", "bert")
    lease.release("bert", 0.0)
    assert (lease.driver, lease.asker) == ("anna", None)


def test_taking_asks_nobody_and_forgets_who_asked() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    told.take()
    lease.take("carl", 0.0)
    assert (lease.driver, lease.asker, told.take()) == ("carl", None, ["changed"])


def test_a_silent_driver_loses_motion_then_groups_then_the_lease() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    told.take()
    for at_s, expected in (
        (QUIET_S - 0.001, []),
        (QUIET_S, ["quiet"]),
        (SILENT_S - 0.001, []),
        (SILENT_S, ["silent"]),
        (GONE_S - 0.001, []),
        (GONE_S, ["lost", "changed"]),
    ):
        lease.advance(at_s)
        assert told.take() == expected
    assert lease.driver is None


def test_the_whole_ladder_is_climbed_even_where_the_clock_jumped_over_it() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    told.take()
    lease.advance(1000.0)
    assert told.take() == ["quiet", "silent", "lost", "changed"]


def test_a_driver_who_is_heard_again_in_time_goes_on_driving() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    lease.advance(3.0)
    told.take()
    lease.beat("anna", lease.issue(3.0))
    lease.advance(3.0 + QUIET_S)
    assert (lease.driver, told.take()) == ("anna", ["quiet"])


def test_a_program_is_waited_for_as_long_as_what_it_asked_lasts_and_two_seconds() -> None:
    lease, told = new_lease()
    lease.request("script", 0.0)
    lease.vouch("script", 10.0)
    lease.vouch("script", 3.0)
    lease.vouch("anna", 90.0)
    for at_s, expected in (
        (10.0 + QUIET_S - 0.001, []),
        (10.0 + QUIET_S, ["quiet"]),
        (10.0 + SILENT_S - 0.001, []),
        (10.0 + SILENT_S, ["silent", "lost", "changed"]),
    ):
        assert lease.due_s() is not None
        lease.advance(at_s)
        assert told.take() == expected
    lease.request("carl", 20.0)
    lease.request("script", 20.0)
    lease.release("carl", 21.0)
    lease.advance(21.0 + SILENT_S)
    assert lease.driver is None
    lease.request("carl", 30.0)
    lease.advance(30.0 + SILENT_S)
    assert lease.driver == "carl"


def test_an_old_nonce_is_no_sign_of_life() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    told.take()
    old = lease.issue(0.0)
    lease.beat("anna", old)
    lease.beat("anna", old)
    lease.beat("bert", lease.issue(0.5))
    lease.advance(QUIET_S)
    assert told.take() == ["quiet"]


def test_a_command_counts_from_its_nonce_at_the_gate_and_again_at_the_port() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    nonce = lease.issue(0.0)
    permit = lease.permit("anna", nonce, COMMAND_S)
    lease.judge(permit, COMMAND_S)
    with pytest.raises(ExpiredError):
        lease.judge(permit, COMMAND_S + 0.001)
    for late in (nonce, "never issued", None):
        with pytest.raises(ExpiredError):
            lease.permit("anna", late, COMMAND_S + 0.001)


def test_what_waits_at_the_port_does_not_outlive_its_epoch() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    permit = lease.permit("anna", lease.issue(0.0), 0.0)
    lease.release("anna", 0.1)
    with pytest.raises(NotDrivingError):
        lease.judge(permit, 0.1)
    lease.request("anna", 0.1)
    with pytest.raises(NotDrivingError):
        lease.judge(permit, 0.1)


def test_a_nonce_of_an_earlier_epoch_is_worth_nothing() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    nonce = lease.issue(0.0)
    lease.release("anna", 0.0)
    lease.request("anna", 0.0)
    with pytest.raises(ExpiredError):
        lease.permit("anna", nonce, 0.1)


def test_a_driver_who_leaves_is_lost_and_an_asker_who_leaves_is_forgotten() -> None:
    lease, told = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    told.take()
    lease.leave("bert", 0.0)
    assert (lease.asker, told.take()) == (None, [])
    lease.leave("anna", 0.0)
    assert (lease.driver, told.take()) == (None, ["lost", "changed"])


DRIVERS = st.sampled_from(["anna", "bert"])


class TwoDrivers(RuleBasedStateMachine):
    """Keeps its own account of who was given the lease when, and what was told to whom and when."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 0.0
        self.lease, self.told = new_lease()
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
            assert (self.lease.epoch, self.lease.giver, self.lease.asker) == (epoch + 1, giver, None)
        self.note_grant(epoch)

    @precondition(lambda self: self.lease.driver is not None)
    @rule()
    def driver_is_told_a_nonce(self) -> None:
        assert self.lease.driver
        nonce = self.lease.issue(self.now)
        self.given[self.lease.driver].append((nonce, self.now, self.lease.epoch))

    @rule(who=DRIVERS, back=st.integers(1, 6))
    def beats(self, who: str, back: int) -> None:
        """With its newest nonce, or, as a frozen tab that wakes, with an old one."""
        for nonce, told_s, epoch in self.given[who][-back:][:1]:
            self.lease.beat(who, nonce)
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
    def a_silent_driver_is_never_kept_past_its_time(self) -> None:
        due_s = self.lease.due_s()
        assert (due_s is None) == (self.lease.driver is None)
        if due_s is not None and due_s > self.now:
            assert self.now - self.echoed_s < GONE_S


TwoDrivers.TestCase.settings = settings(max_examples=500 if TIMES > 1 else 60, stateful_step_count=40)
test_two_drivers_who_do_anything_at_any_time = TwoDrivers.TestCase
