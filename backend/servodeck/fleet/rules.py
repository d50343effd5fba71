"""Judges each message that a broker delivers to a gateway: stop, a request to be carried out, a repeated
one, or a refusal (docs/adr/0048). It runs before anything reaches the gateway's own loop, so that a flood
costs that nothing.

Pure: arrival times and nonces come in. Decides nothing about motion; lease, latch and limits come behind.
"""

from collections import OrderedDict
from collections.abc import Callable, Mapping
from hashlib import sha256
from typing import TypeVar

from pydantic import ValidationError

from servodeck.callers import RANKS, Rate, Role
from servodeck.fleet.messages import (
    REQUESTS,
    AnyRequest,
    BeatRequest,
    RefusalCode,
    TimelyRequest,
)
from servodeck.fleet.topics import ALL, VERBS, VERBS_FOR_ALL, Command, Hold, Reply, Site, Verb, is_name
from servodeck.schema import first_problem
from servodeck.value import value

SMALL_BYTES, DOWNLOAD_BYTES = 16 * 1024, 512 * 1024
# Of each user; a driver sends moves and beats.
DRIVER_RATE, VIEWER_RATE = (100.0, 100), (2.0, 10)
SESSIONS_AT_MOST = 256
# Of presses: no session has this name.
NO_SESSION = ""
LEAST_ROLE: dict[Verb, Role] = {
    "stop": "stopper",
    "report": "stopper",
    "ask": "driver",
    "beat": "driver",
    "move": "driver",
    "run": "driver",
    "press": "driver",
    "resume": "driver",
    "download": "driver",
    "erase": "owner",
    "sync": "driver",
    "prepare": "driver",
    "commit": "driver",
    "cancel": "driver",
}

K = TypeVar("K")
V = TypeVar("V")


@value
class Received:
    """`reply_to` and `correlation` are properties of the message; `at_s` its arrival."""

    topic: str
    payload: bytes
    is_retained: bool
    at_s: float
    reply_to: str | None = None
    correlation: bytes | None = None


@value
class Origin:
    """One session of one user, in the role of the topic."""

    role: Role
    user: str
    session: str


@value
class Stop:
    """`user` is None for one whose name cannot be one. `origin` is None where no answer can be sent."""

    user: str | None
    origin: Origin | None


@value
class Accepted:
    """`at_s`: its arrival."""

    origin: Origin
    verb: Verb
    request: AnyRequest
    at_s: float


@value
class Repeated:
    """`answer` is None while the first one is not answered yet."""

    origin: Origin
    answer: bytes | None


@value
class Refusal:
    """`origin` is None where no answer can be sent."""

    origin: Origin | None
    n: int | None
    code: RefusalCode
    detail: str


@value
class Ignored:
    """Of no concern: a hold that was withdrawn or is known, a beat for other gateways."""


Verdict = Stop | Accepted | Repeated | Refusal | Ignored


class Counter:
    """Of one session: its newest request, and the answer to that."""

    def __init__(self) -> None:
        self.n = -1
        self.answer: bytes | None = None


class Judge:
    """Called in the thread of the broker's client, but `issued` and `answered`, which replace one value."""

    def __init__(self, site: Site, gateway: str, now: Callable[[], float]) -> None:
        self._site = site
        self._gateway = gateway
        self._now = now
        self._nonces: Mapping[str, float] = {}
        self._counters: OrderedDict[Origin, Counter] = OrderedDict()
        self._rates: OrderedDict[tuple[str, str], Rate] = OrderedDict()
        self._holds: OrderedDict[bytes, None] = OrderedDict()
        self.is_cloned = False

    def issued(self, nonces: Mapping[str, float]) -> None:
        """All nonces that are valid now, with the time of their issue: those of the present epoch."""
        self._nonces = nonces

    def answered(self, origin: Origin, n: int, answer: bytes) -> None:
        """For the case that the request comes again."""
        counter = self._counters.get(origin)
        if counter and counter.n == n:
            counter.answer = answer

    def judge(self, received: Received) -> Verdict | None:
        """None for a topic that is none of a request."""
        match self._site.parse(received.topic):
            case Hold(_, user):
                return self._judge_hold(user, received)
            case Command(gateway, role, user, verb) if gateway in (ALL, self._gateway):
                origin = self._origin_of(role, user, received.reply_to)
                if verb == "stop":
                    return Stop(named(user), origin)
                return self._judge_request(gateway, role, user, verb, origin, received)
        return None

    def _judge_hold(self, user: str, received: Received) -> Stop | Ignored:
        """Each once: after a resume, a connection that is made again must not stop the robot again."""
        key = sha256(received.payload).digest()
        if not received.payload or key in self._holds:
            return Ignored()
        bounded(self._holds, key, lambda: None)
        return Stop(named(user), None)

    def _origin_of(self, role: str, user: str, reply_to: str | None) -> Origin | None:
        reply = self._site.parse(reply_to or "")
        if role not in RANKS or not is_name(user):
            return None
        if not isinstance(reply, Reply) or reply.user != user or not is_name(reply.session):
            return None
        return Origin(role, user, reply.session)

    def _judge_request(
        self, gateway: str, role: str, user: str, verb: str, origin: Origin | None, received: Received
    ) -> Verdict:
        if not self._rate_of(role, user).take():  # unanswered: an answer to each would be a flood, too
            return Refusal(None, None, "tooMany", "Too many requests: wait a moment.")
        if role not in RANKS or verb not in VERBS or (gateway == ALL and verb not in VERBS_FOR_ALL):
            return Refusal(origin, None, "malformed", f"There is no request {verb} of a {role} to {gateway}.")
        if received.is_retained:
            return Refusal(origin, None, "retained", "A request must not be retained.")
        most = DOWNLOAD_BYTES if verb == "download" else SMALL_BYTES
        if len(received.payload) > most:
            return Refusal(origin, None, "tooLarge", f"A {verb} may have {most} bytes at most.")
        if RANKS[role] < RANKS[LEAST_ROLE[verb]]:
            detail = f"{user} has the role {role}; this needs the role {LEAST_ROLE[verb]}."
            return Refusal(origin, None, "forbidden", detail)
        if origin is None and verb == "press":  # buttons cannot ask for an answer
            origin = Origin(role, user, NO_SESSION)
        if origin is None:
            detail = "A request needs a response topic below the asking user's own."
            return Refusal(None, None, "malformed", detail)
        try:
            request = REQUESTS[verb].model_validate_json(received.payload)
        except ValidationError as error:
            return Refusal(origin, None, "malformed", first_problem(error))
        return self._judge_order(origin, verb, request, received.at_s)

    def _judge_order(self, origin: Origin, verb: Verb, request: AnyRequest, at_s: float) -> Verdict:
        counter = bounded(self._counters, origin, Counter)
        if request.n == counter.n:
            return Repeated(origin, counter.answer)
        if request.n < counter.n:
            return Refusal(origin, request.n, "superseded", "A newer request of this session came before it.")
        counter.n, counter.answer = request.n, None
        if self.is_cloned and verb != "report":
            detail = "Another gateway has the same name: neither is driven over the broker."
            return Refusal(origin, request.n, "cloned", detail)
        if isinstance(request, TimelyRequest) and not self._is_fresh(request.nonce, at_s, request.WITHIN_S):
            return Refusal(origin, request.n, "expired", "This request is too old.")
        if isinstance(request, BeatRequest):
            nonce = request.nonces.get(self._gateway)
            if nonce is None:
                return Ignored()
            if nonce not in self._nonces:
                return Refusal(origin, request.n, "expired", "This beat is too old.")
        return Accepted(origin, verb, request, at_s)

    def _is_fresh(self, nonce: str, at_s: float, within_s: float) -> bool:
        issued_s = self._nonces.get(nonce)
        return issued_s is not None and at_s - issued_s <= within_s

    def _rate_of(self, role: str, user: str) -> Rate:
        per_second, burst = DRIVER_RATE if role in ("driver", "owner") else VIEWER_RATE
        return bounded(self._rates, (role, user), lambda: Rate(per_second, burst, self._now))


def named(user: str) -> str | None:
    return user if is_name(user) else None


def bounded(known: OrderedDict[K, V], key: K, make: Callable[[], V]) -> V:
    """Of the key, made if it is new; the one that was not asked for longest goes."""
    found = known.get(key)
    if key not in known:
        found = known[key] = make()
    known.move_to_end(key)
    if len(known) > SESSIONS_AT_MOST:
        known.popitem(last=False)
    return found  # type: ignore[return-value]
