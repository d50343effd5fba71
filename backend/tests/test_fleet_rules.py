"""The rules of the broker's door as a table, and its counters, rates and holds in time."""

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.callers import Role
from servodeck.fleet.messages import REQUESTS, MoveRequest
from servodeck.fleet.rules import (
    DOWNLOAD_BYTES,
    NO_SESSION,
    SMALL_BYTES,
    Accepted,
    Ignored,
    Judge,
    Origin,
    Received,
    Refusal,
    Repeated,
    Stop,
    Verdict,
)
from servodeck.fleet.topics import VERBS, Site, Verb

LAB = Site("lab")
ANNA = Origin("driver", "anna", "s1")
REPLY = "sd/1/lab/reply/anna/s1"
NOW_S = 1000.0
FRESH, OLD, STALE, OLDER = "i.1-4", "i.1-3", "i.1-2", "i.1-1"
NONCES = {FRESH: NOW_S - 0.1, OLD: NOW_S - 0.6, STALE: NOW_S - 3.1, OLDER: NOW_S - 10.1}
MOVE = {"v": 1, "n": 1, "nonce": FRESH, "targets": [{"servo": 1, "position": 1500}], "durationMs": 500}
PRESS = {"v": 1, "n": 1, "nonce": OLD, "slot": 1}
GROUP = {"slot": 1, "frames": [{"durationMs": 500, "positions": {"1": 1500}}]}
DEEP = b"[" * 1000 + b"]" * 1000


class Desk:
    """A judge whose clock the test sets."""

    def __init__(self) -> None:
        self.now_s = NOW_S
        self.judge = Judge(LAB, "arm-1", lambda: self.now_s)
        self.judge.issued(NONCES)

    def hear(
        self,
        verb: Verb | str,
        payload: Any,
        *,
        to: str = "arm-1",
        role: Role | str = "driver",
        user: str = "anna",
        reply_to: str | None = REPLY,
        is_retained: bool = False,
    ) -> Verdict | None:
        data = payload if isinstance(payload, bytes) else json.dumps(payload).encode()
        topic = f"sd/1/lab/{to}/do/{role}/{user}/{verb}"
        return self.judge.judge(Received(topic, data, is_retained, self.now_s, reply_to))


def with_(**fields: Any) -> dict[str, Any]:
    return {**MOVE, **fields}


REFUSED: dict[str, tuple[str, dict[str, Any]]] = {
    "retained": ("retained", {"verb": "move", "payload": MOVE, "is_retained": True}),
    "too large": ("tooLarge", {"verb": "move", "payload": b" " * (SMALL_BYTES + 1)}),
    "a download too large": ("tooLarge", {"verb": "download", "payload": b" " * (DOWNLOAD_BYTES + 1)}),
    "no JSON": ("malformed", {"verb": "move", "payload": b"\xff\x00"}),
    "empty": ("malformed", {"verb": "move", "payload": b""}),
    "too deep": ("malformed", {"verb": "move", "payload": DEEP}),
    "another version": ("malformed", {"verb": "move", "payload": with_(v=2)}),
    "an unknown field": ("malformed", {"verb": "move", "payload": with_(role="owner")}),
    "a field too few": ("malformed", {"verb": "move", "payload": {"v": 1, "n": 1}}),
    "a text for a number": ("malformed", {"verb": "move", "payload": with_(n="1")}),
    "no such verb": ("malformed", {"verb": "dance", "payload": MOVE}),
    "no such role": ("malformed", {"verb": "move", "payload": MOVE, "role": "king"}),
    "not for all": ("malformed", {"verb": "move", "payload": MOVE, "to": "all"}),
    "no response topic": ("malformed", {"verb": "move", "payload": MOVE, "reply_to": None}),
    "another user's response topic": (
        "malformed",
        {"verb": "move", "payload": MOVE, "reply_to": "sd/1/lab/reply/ben/s1"},
    ),
    "a response topic that is another gateway's": (
        "malformed",
        {"verb": "move", "payload": MOVE, "reply_to": "sd/1/lab/arm-2/do/owner/anna/erase"},
    ),
    "a viewer that moves": ("forbidden", {"verb": "move", "payload": MOVE, "role": "viewer"}),
    "a stopper that asks": (
        "forbidden",
        {"verb": "ask", "payload": {"v": 1, "n": 1, "nonce": FRESH, "action": "request"}, "role": "stopper"},
    ),
    "a driver that erases": ("forbidden", {"verb": "erase", "payload": {"v": 1, "n": 1, "nonce": FRESH}}),
    "too old": ("expired", {"verb": "move", "payload": with_(nonce=OLD)}),
    "of another epoch or gateway": ("expired", {"verb": "move", "payload": with_(nonce="i.0-9")}),
    "a run too old": ("expired", {"verb": "run", "payload": {"v": 1, "n": 1, "nonce": OLD, "slot": 1}}),
    "a press too old": ("expired", {"verb": "press", "payload": {**PRESS, "nonce": STALE}, "reply_to": None}),
    "a retained press": (
        "retained",
        {"verb": "press", "payload": PRESS, "reply_to": None, "is_retained": True},
    ),
    "a viewer that presses": (
        "forbidden",
        {"verb": "press", "payload": PRESS, "reply_to": None, "role": "viewer"},
    ),
    "a resume too old": ("expired", {"verb": "resume", "payload": {"v": 1, "n": 1, "nonce": OLD}}),
    "an ask too old": (
        "expired",
        {"verb": "ask", "payload": {"v": 1, "n": 1, "nonce": OLDER, "action": "request"}},
    ),
    "a beat too old": (
        "expired",
        {"verb": "beat", "payload": {"v": 1, "n": 1, "nonces": {"arm-1": "i.0-9"}}, "to": "all"},
    ),
}


@pytest.mark.parametrize(("code", "message"), REFUSED.values(), ids=REFUSED)
def test_refused(code: str, message: dict[str, Any]) -> None:
    verdict = Desk().hear(**message)
    assert isinstance(verdict, Refusal)
    assert verdict.code == code


ACCEPTED: dict[str, dict[str, Any]] = {
    "a move": {"verb": "move", "payload": MOVE},
    "an owner's move": {"verb": "move", "payload": MOVE, "role": "owner"},
    "a press with the nonce of a state": {"verb": "press", "payload": PRESS, "reply_to": None},
    "a report": {"verb": "report", "payload": {"v": 1, "n": 0}, "role": "viewer"},
    "a report for all": {"verb": "report", "payload": {"v": 1, "n": 0}, "to": "all"},
    "an ask with the nonce of a state": {
        "verb": "ask",
        "payload": {"v": 1, "n": 1, "nonce": OLD, "action": "request"},
    },
    "a download that took its time": {
        "verb": "download",
        "payload": {"v": 1, "n": 1, "nonce": OLD, "groups": [GROUP]},
    },
    "a beat for several": {
        "verb": "beat",
        "payload": {"v": 1, "n": 1, "nonces": {"arm-1": OLD, "arm-2": "x"}},
        "to": "all",
    },
}


@pytest.mark.parametrize("message", ACCEPTED.values(), ids=ACCEPTED)
def test_accepted(message: dict[str, Any]) -> None:
    verdict = Desk().hear(**message)
    assert isinstance(verdict, Accepted)
    assert verdict.verb == message["verb"]


STOPS: dict[str, dict[str, Any]] = {
    "of a stopper": {"payload": {"v": 1, "n": 1}, "role": "stopper"},
    "retained": {"payload": {"v": 1, "n": 1}, "is_retained": True},
    "malformed": {"payload": b"\xff" * SMALL_BYTES * 2},
    "empty": {"payload": b""},
    "without a response topic": {"payload": b"", "reply_to": None},
    "of an unknown role": {"payload": b"", "role": "king"},
    "of a strange user": {"payload": b"", "user": " "},
    "for all": {"payload": b"", "to": "all"},
}


@pytest.mark.parametrize("message", STOPS.values(), ids=STOPS)
def test_a_stop_is_done_whatever_it_carries(message: dict[str, Any]) -> None:
    desk = Desk()
    desk.judge.is_cloned = True
    for _ in range(300):  # no rate either
        assert isinstance(desk.hear("stop", **message), Stop)


def test_a_beat_for_other_gateways_is_not_answered() -> None:
    beat = {"v": 1, "n": 1, "nonces": {"arm-2": FRESH}}
    assert Desk().hear("beat", beat, to="all") == Ignored()


def test_the_same_number_again_gets_the_same_answer_and_an_older_one_is_superseded() -> None:
    desk = Desk()
    first = desk.hear("move", with_(n=7))
    assert isinstance(first, Accepted)
    assert isinstance(first.request, MoveRequest)
    assert desk.hear("move", with_(n=7)) == Repeated(ANNA, None)
    desk.judge.answered(ANNA, 7, b"done")
    assert desk.hear("move", with_(n=7)) == Repeated(ANNA, b"done")
    older = desk.hear("move", with_(n=6))
    assert isinstance(older, Refusal)
    assert older.code == "superseded"
    # An answer that comes late is not taken for that of a newer request.
    assert isinstance(desk.hear("move", with_(n=8)), Accepted)
    desk.judge.answered(ANNA, 7, b"done")
    assert desk.hear("move", with_(n=8)) == Repeated(ANNA, None)


def test_each_session_counts_for_itself() -> None:
    desk = Desk()
    assert isinstance(desk.hear("move", with_(n=7)), Accepted)
    other = desk.hear("move", with_(n=1), reply_to="sd/1/lab/reply/anna/s2")
    assert isinstance(other, Accepted)


def test_a_grant_voids_all_nonces() -> None:
    desk = Desk()
    desk.judge.issued({})
    verdict = desk.hear("move", MOVE)
    assert isinstance(verdict, Refusal)
    assert verdict.code == "expired"


@pytest.mark.parametrize(("role", "burst", "per_second"), [("driver", 100, 100), ("viewer", 10, 2)])
def test_too_many_are_not_answered(role: Role, burst: int, per_second: int) -> None:
    desk = Desk()
    verdicts = [desk.hear("report", {"v": 1, "n": n}, role=role) for n in range(burst + 1)]
    assert all(isinstance(verdict, Accepted) for verdict in verdicts[:-1])
    assert verdicts[-1] == Refusal(None, None, "tooMany", "Too many requests: wait a moment.")
    desk.now_s += 1
    later = [desk.hear("report", {"v": 1, "n": 1000 + n}, role=role) for n in range(per_second + 1)]
    assert [isinstance(verdict, Accepted) for verdict in later] == [True] * per_second + [False]


def test_a_clone_reports_and_does_nothing_else() -> None:
    desk = Desk()
    desk.judge.is_cloned = True
    verdict = desk.hear("move", MOVE)
    assert isinstance(verdict, Refusal)
    assert verdict.code == "cloned"
    assert isinstance(desk.hear("report", {"v": 1, "n": 2}), Accepted)


def test_a_hold_stops_once_and_its_withdrawal_does_not() -> None:
    desk = Desk()

    def hold(payload: bytes) -> Verdict | None:
        return desk.judge.judge(Received(LAB.hold("driver", "anna"), payload, True, NOW_S))

    assert hold(b"one") == Stop("anna", None)
    assert hold(b"one") == Ignored()
    assert hold(b"") == Ignored()
    assert hold(b"two") == Stop("anna", None)


def test_no_number_of_sessions_takes_the_memory() -> None:
    desk = Desk()
    for number in range(2000):
        desk.now_s += 1
        reply_to = f"sd/1/lab/reply/u{number}/s"
        desk.hear("report", {"v": 1, "n": 1}, user=f"u{number}", reply_to=reply_to)
    # The newest ones are known, the oldest may begin anew.
    newest = desk.hear("report", {"v": 1, "n": 1}, user="u1999", reply_to="sd/1/lab/reply/u1999/s")
    oldest = desk.hear("report", {"v": 1, "n": 1}, user="u0", reply_to="sd/1/lab/reply/u0/s")
    assert isinstance(newest, Repeated)
    assert isinstance(oldest, Accepted)


def test_a_name_that_cannot_be_one_is_not_repeated() -> None:
    verdict = Desk().hear("stop", b"", user="\n" * 1000)
    assert verdict == Stop(None, None)


def as_json(value: object) -> bytes:
    return json.dumps(value).encode()


TOPICS = st.sampled_from(sorted(VERBS)).map("arm-1/do/driver/anna/{}".format) | st.lists(
    st.text(max_size=8) | st.sampled_from(["arm-1", "all", "do", "hold", "owner", "anna", "stop"]),
    max_size=6,
).map("/".join)
SHAPES = {**MOVE, "slot": 1, "action": "take", "nonces": {"arm-1": FRESH}, "name": "x"}
FIELDS = {key: st.just(value) | st.integers() | st.text(max_size=4) for key, value in SHAPES.items()}
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from([*SHAPES, "x"]), inner),
)
PAYLOADS = st.binary(max_size=64) | (VALUES | st.fixed_dictionaries({}, optional=FIELDS)).map(as_json)


@given(TOPICS, PAYLOADS, st.booleans(), st.text(max_size=8) | st.just(REPLY))
def test_nothing_that_a_broker_delivers_raises_or_passes_by_chance(
    topic: str, payload: bytes, is_retained: bool, reply_to: str
) -> None:
    verdict = Desk().judge.judge(Received("sd/1/lab/" + topic, payload, is_retained, NOW_S, reply_to))
    if isinstance(verdict, Accepted):
        assert verdict.request == REQUESTS[verdict.verb].model_validate_json(payload)
        assert not is_retained
        if verdict.verb == "press":  # the one request without an answer, in no session of a person
            assert verdict.origin in (ANNA, replace(ANNA, session=NO_SESSION))
        else:
            assert reply_to == REPLY


@pytest.mark.parametrize("topic", ["sd/1/lab/arm-2/do/driver/anna/move", "sd/1/lab/arm-1/state", "x"])
def test_other_topics_are_no_requests(topic: str) -> None:
    assert Desk().judge.judge(Received(topic, b"", False, NOW_S)) is None
