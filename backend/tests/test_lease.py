"""The lease by itself: each rule once."""

from dataclasses import dataclass, field

import pytest

from servodeck.errors import BusyError, ExpiredError, NotDrivingError
from servodeck.robot.lease import ANSWER_S, COMMAND_S, GONE_S, QUIET_S, SILENT_S, Lease


@dataclass
class Recorder:
    """What the owner of the port was recorder."""

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


def new_lease(epoch: int = 0) -> tuple[Lease[str], Recorder]:
    recorder = Recorder()
    return Lease(epoch, recorder), recorder


def test_a_free_lease_is_given_at_once_with_a_new_epoch() -> None:
    lease, recorder = new_lease(epoch=41)
    lease.request("anna", 0.0)
    assert (lease.driver, lease.epoch, recorder.take()) == ("anna", 42, [])
    lease.request("anna", 1.0)
    assert (lease.epoch, recorder.take()) == (42, [])


def test_a_request_passes_when_the_driver_has_said_nothing_for_five_seconds() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    nonce = lease.issue(0.0)
    lease.request("bert", 0.1)
    assert lease.granted_in_s(1.1) == pytest.approx(4.0)
    for beat in range(1, 20):
        at_s = beat * 0.25
        lease.heartbeat("anna", lease.issue(at_s))
        lease.advance(at_s)
    assert lease.driver == "anna"
    lease.advance(0.1 + ANSWER_S)
    assert (lease.driver, lease.requester, lease.epoch) == ("bert", None, 2)
    assert recorder.take() == ["changed"]
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
    assert (lease.driver, lease.requester, lease.granted_in_s(0.0)) == ("anna", None, None)
    lease.request("carl", 0.0)
    assert lease.requester == "carl"


def test_releasing_it_grants_the_request() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    lease.release("anna", 1.0)
    assert lease.driver == "bert"
    lease.release("bert", 1.0)
    assert lease.driver is None
    assert lease.epoch == 3  # a loss counts, too: what was permitted before it does not leave behind it


def test_a_request_may_be_withdrawn_and_others_release_nothing() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    lease.release("carl", 0.0)
    assert (lease.driver, lease.requester) == ("anna", "bert")
    lease.release("bert", 0.0)
    assert (lease.driver, lease.requester) == ("anna", None)


def test_taking_needs_no_consent_and_drops_the_request() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    recorder.take()
    lease.take("carl", 0.0)
    assert (lease.driver, lease.requester, recorder.take()) == ("carl", None, ["changed"])


def test_a_silent_driver_loses_motion_then_groups_then_the_lease() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    recorder.take()
    for at_s, expected in (
        (QUIET_S - 0.001, []),
        (QUIET_S, ["quiet"]),
        (SILENT_S - 0.001, []),
        (SILENT_S, ["silent"]),
        (GONE_S - 0.001, []),
        (GONE_S, ["lost", "changed"]),
    ):
        lease.advance(at_s)
        assert recorder.take() == expected
    assert lease.driver is None


def test_the_whole_ladder_is_climbed_even_where_the_clock_jumped_over_it() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    recorder.take()
    lease.advance(1000.0)
    assert recorder.take() == ["quiet", "silent", "lost", "changed"]


def test_a_driver_that_is_heard_again_in_time_continues_driving() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    lease.advance(3.0)
    recorder.take()
    lease.heartbeat("anna", lease.issue(3.0))
    lease.advance(3.0 + QUIET_S)
    assert (lease.driver, recorder.take()) == ("anna", ["quiet"])


def test_motion_with_beats_is_not_covered_by_what_was_permitted_before() -> None:
    lease, recorder = new_lease()
    lease.request("script", 0.0)
    lease.vouch("script", 30.0)
    lease.begin_beats("anna", 1.0)
    lease.begin_beats("script", 1.0)
    lease.vouch("script", 1.9)
    lease.advance(1.9 + SILENT_S - 0.001)
    assert recorder.take() == []
    lease.advance(1.9 + SILENT_S)
    assert recorder.take() == ["quiet", "silent", "lost", "changed"]


def test_a_program_is_waited_for_as_long_as_what_it_asked_lasts_and_two_seconds() -> None:
    lease, recorder = new_lease()
    lease.request("script", 0.0)
    lease.vouch("script", 10.0)
    lease.vouch("script", 3.0)
    lease.vouch("anna", 90.0)
    for at_s, expected in (
        (10.0 + QUIET_S, []),
        (10.0 + SILENT_S - 0.001, []),
        (10.0 + SILENT_S, ["quiet", "silent", "lost", "changed"]),
    ):
        assert lease.due_s() is not None
        lease.advance(at_s)
        assert recorder.take() == expected
    lease.request("carl", 20.0)
    lease.request("script", 20.0)
    lease.release("carl", 21.0)
    lease.advance(21.0 + SILENT_S)
    assert lease.driver is None
    lease.request("carl", 30.0)
    lease.advance(30.0 + SILENT_S)
    assert lease.driver == "carl"


def test_an_old_nonce_is_no_sign_of_life() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    recorder.take()
    old = lease.issue(0.0)
    lease.heartbeat("anna", old)
    lease.heartbeat("anna", old)
    lease.heartbeat("bert", lease.issue(0.5))
    lease.advance(QUIET_S)
    assert recorder.take() == ["quiet"]


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


def test_what_had_to_wait_for_an_end_may_begin_as_long_as_its_driver_is_heard() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    lease.heartbeat("anna", lease.issue(1.0))
    lease.judge(lease.renewed_permit("anna", 1.0 + QUIET_S), 1.0 + QUIET_S)
    with pytest.raises(ExpiredError):
        lease.renewed_permit("anna", 1.001 + QUIET_S)
    with pytest.raises(NotDrivingError):
        lease.renewed_permit("bert", 1.0)


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


def test_a_driver_who_leaves_is_lost_and_a_requester_who_leaves_is_forgotten() -> None:
    lease, recorder = new_lease()
    lease.request("anna", 0.0)
    lease.request("bert", 0.0)
    recorder.take()
    lease.leave("bert", 0.0)
    assert (lease.requester, recorder.take()) == (None, [])
    lease.leave("anna", 0.0)
    assert (lease.driver, recorder.take()) == (None, ["lost", "changed"])


def test_what_was_permitted_before_a_loss_is_not_permitted_by_the_next_grant_to_the_same_one() -> None:
    lease, _ = new_lease()
    lease.request("anna", 0.0)
    permit = lease.permit("anna", lease.issue(0.0), 0.0)
    lease.release("anna", 0.1)
    with pytest.raises(NotDrivingError):
        lease.judge(permit, 0.1)
    lease.request("anna", 0.2)
    with pytest.raises(NotDrivingError):
        lease.judge(permit, 0.2)
