"""Invitations: once, two minutes, five tries."""

import pytest

from servodeck.access.entrance import CODE_TRIES, MAX_OPEN, Pairing
from servodeck.errors import BusyError, NotFoundError, PairingError, PairingLockedError


class Time:
    def __init__(self) -> None:
        self.now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def time() -> Time:
    return Time()


@pytest.fixture
def pairing(time: Time) -> Pairing:
    return Pairing(time)


def wrong(code: str | None) -> str:
    return str((int(code or "0") + 1) % 10**8).zfill(8)


def test_a_link_and_a_code_lead_to_the_same_invitation(pairing: Pairing) -> None:
    made = pairing.invite("driver", "Anna")
    assert made.code is not None
    assert len(made.code) == 8
    assert len(made.secret) >= 32
    assert pairing.find_by_link(made.secret) == pairing.find_by_code(made.code) == made


def test_once_used_it_is_over(pairing: Pairing) -> None:
    made = pairing.invite("driver", "Anna")
    pairing.withdraw(made.id)
    with pytest.raises(PairingError):
        pairing.find_by_link(made.secret)
    with pytest.raises(PairingError):
        pairing.find_by_code(made.code or "")
    with pytest.raises(NotFoundError):
        pairing.withdraw(made.id)


def test_after_two_minutes_it_is_over(pairing: Pairing, time: Time) -> None:
    made = pairing.invite("driver", "Anna")
    time.now_s = 119.9
    assert pairing.find_by_link(made.secret) == made
    time.now_s = 120.0
    with pytest.raises(PairingError):
        pairing.find_by_link(made.secret)
    with pytest.raises(PairingError):
        pairing.find_by_code(made.code or "")


def test_five_wrong_codes_spend_every_open_code_and_no_link(pairing: Pairing, time: Time) -> None:
    first, second = pairing.invite("viewer", ""), pairing.invite("owner", "")
    for attempt in range(CODE_TRIES):
        with pytest.raises(PairingError) as refused:
            pairing.find_by_code("00000000" if "00000000" not in (first.code, second.code) else "11111111")
        assert isinstance(refused.value, PairingLockedError) == (attempt == CODE_TRIES - 1)
    for invite in (first, second):
        with pytest.raises(PairingLockedError):
            pairing.find_by_code(invite.code or "")
        assert pairing.find_by_link(invite.secret).id == invite.id
    time.now_s = 500.0
    with pytest.raises(PairingLockedError):
        pairing.find_by_code("12345678")
    third = pairing.invite("viewer", "")
    assert pairing.find_by_code(third.code or "") == third


def test_new_invitations_and_right_codes_give_no_new_tries(pairing: Pairing) -> None:
    first = pairing.invite("viewer", "")
    for _ in range(CODE_TRIES - 1):
        with pytest.raises(PairingError):
            pairing.find_by_code(wrong(first.code))
    second = pairing.invite("viewer", "")
    assert pairing.find_by_code(second.code or "") == second
    other = next(
        code for code in ("00000000", "11111111", "22222222") if code not in (first.code, second.code)
    )
    with pytest.raises(PairingLockedError):
        pairing.find_by_code(other)


def test_only_so_many_are_open_at_once(pairing: Pairing, time: Time) -> None:
    made = [pairing.invite("viewer", "") for _ in range(MAX_OPEN)]
    assert len({invite.secret for invite in made} | {invite.code for invite in made}) == 2 * MAX_OPEN
    with pytest.raises(BusyError):
        pairing.invite("viewer", "")
    time.now_s = 120.0
    pairing.invite("viewer", "")
    assert len(pairing.open) == 1
