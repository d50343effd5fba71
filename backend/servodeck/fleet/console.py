"""The other side of the broker, for the command line, a fleet's page and tests: which robots are there,
requests to one of them and their answers, STOP for all of them, and the beat of a driver.

    with Console(broker, Site("lab"), "driver") as console:
        console.until(lambda: console.is_present("arm-1"), 2.0)
        console.ask("arm-1", "ask", action="request")
        console.ask("arm-1", "run", slot=3)       # Done, or raises RefusedError or NoAnswerError
        console.beat()                             # four times a second while it drives

All methods may be called from any thread and return at once, but `ask`, `stop_all` and `until`, which wait.
Knows no robot core: what gateways publish is all there is.
"""

import secrets
import threading
import time
from collections.abc import Callable, Collection
from concurrent.futures import Future, InvalidStateError, wait
from concurrent.futures import TimeoutError as FutureTimeoutError
from contextlib import suppress
from types import TracebackType
from typing import Any, Self

from pydantic import TypeAdapter, ValidationError

from servodeck.callers import Role
from servodeck.fleet.broker import Broker, Connection, Interest, Outgoing
from servodeck.fleet.heard import Heard, Presence, Robot
from servodeck.fleet.messages import (
    REQUESTS,
    About,
    Answer,
    AnyAnswer,
    BeatRequest,
    CancelRequest,
    Clock,
    CommitRequest,
    Done,
    Live,
    Online,
    RefusalCode,
    Refused,
    ReportRequest,
    State,
    SyncRequest,
    TimelyRequest,
    encode,
)
from servodeck.fleet.rules import Received
from servodeck.fleet.topics import ALL, Hold, Published, Reply, Site, Verb
from servodeck.value import value

ANSWER_S = 2.0
STOP_S = 1.0
STOP_AGAIN_S = (0.07, 0.14)
LOOK_S = 0.1
HOLD_S = 3600
EXPIRES_S = 1
QOS_0: Collection[Verb] = ("move", "beat", "sync")

answer_adapter: TypeAdapter[AnyAnswer] = TypeAdapter(Answer)

# With what its methods return.
__all__ = ["Console", "FleetError", "NoAnswerError", "Presence", "RefusedError", "Robot", "StopReport"]


class FleetError(Exception):
    """A request that was not done."""


class RefusedError(FleetError):
    def __init__(self, gateway: str, code: RefusalCode, detail: str) -> None:
        super().__init__(f"{gateway}: {detail}")
        self.gateway = gateway
        self.code = code
        self.detail = detail


class NoAnswerError(FleetError):
    """It was not sent, or nothing came back in time: whether it was done is unknown."""


@value
class StopReport:
    """Those that latched, those that latched but have no port to stop, with the reason, and those that were
    there and did not answer.
    """

    stopped: tuple[str, ...]
    refused: tuple[tuple[str, str], ...]
    missing: tuple[str, ...]


class Console:
    def __init__(
        self,
        broker: Broker,
        site: Site,
        role: Role,
        changed: Callable[[str], None] = lambda _: None,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """`role`: one that the broker gives to the user of `broker`. `changed` is called in the connection's
        thread with the name of the gateway that said something, empty for the connection itself. Raises
        ValueError without a user.
        """
        if not broker.user:
            raise ValueError("a console needs a user: mqtts://USER@HOST")
        self._site = site
        self._user = broker.user
        self._role: Role = role
        self._changed = changed
        self._now = now
        self._session = secrets.token_hex(4)
        self._reply_to = site.reply(self._user, self._session)
        self._lock = threading.Lock()
        self._n = 0
        self._heard = Heard(now)
        self._pending: dict[bytes, Callable[[AnyAnswer], None]] = {}
        self._drives: set[str] = set()
        self._waits: set[str] = set()
        self._holds: set[str] = set()
        self._news = threading.Condition()
        state = Interest(0, wants_retained=True, as_published=False)
        interests = {
            site.published("+", "about"): state,
            site.published("+", "state"): state,
            site.published("+", "online"): Interest(1, wants_retained=False, as_published=False),
            site.holds(): state,
            self._reply_to: Interest(1, wants_retained=False, as_published=True),
        }
        client_id = f"{self._user}-{self._session}"
        self._connection = Connection(broker, client_id, interests, self, now)

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.end()

    def start(self) -> None:
        self._connection.start()

    def end(self) -> None:
        """Gateways that it drives lose their driver."""
        self._connection.end()

    @property
    def now_s(self) -> float:
        return self._now()

    @property
    def problem(self) -> str | None:
        """Why it is not connected; None while it is."""
        return self._connection.problem

    def robots(self) -> list[Robot]:
        """All that have ever said something or are retained, by name."""
        return self._heard.robots()

    def robot(self, name: str) -> Robot | None:
        return self._heard.robot(name)

    def is_present(self, name: str) -> bool:
        robot = self.robot(name)
        return robot is not None and robot.presence == "present"

    def until(self, is_so: Callable[[], bool], timeout_s: float) -> bool:
        """Waits until that is so, looking again whenever something was heard; False: not in time."""
        deadline_s = self._now() + timeout_s
        while not is_so():
            left_s = deadline_s - self._now()
            if left_s <= 0:
                return False
            with self._news:
                self._news.wait(min(left_s, LOOK_S))
        return True

    def drives(self, gateway: str) -> bool:
        """Whether this console has its lease, as far as is known."""
        with self._lock:
            return gateway in self._drives

    def watch(self, gateway: str) -> None:
        """Its `live` reports come, too, until `unwatch`."""
        topic = self._site.published(gateway, "live")
        self._connection.subscribe(topic, Interest(0, wants_retained=False, as_published=True))

    def unwatch(self, gateway: str) -> None:
        self._connection.unsubscribe(self._site.published(gateway, "live"))

    def request(self, gateway: str, verb: Verb, **fields: Any) -> "Future[Done]":
        """`fields` as the request has them, but `v` and `n`; `nonce` is the newest one by default. The
        result, or RefusedError, or NoAnswerError where it cannot be sent.
        """
        answered: Future[Done] = Future()

        def take(answer: AnyAnswer) -> None:
            if isinstance(answer, Refused):
                error = RefusedError(gateway, answer.code, answer.detail)
                settle(lambda: answered.set_exception(error))
            elif isinstance(answer, Done):
                self._heard.nonce(gateway, answer.nonce)
                self._set_drives(gateway, answer.drives)
                if verb == "ask":
                    self._set_waits(gateway, fields["action"] == "request" and not answer.drives)
                settle(lambda: answered.set_result(answer))

        correlation = self._await_answers(take)
        answered.add_done_callback(lambda _: self._forget(correlation))
        with self._lock:  # so that requests leave in the order of their numbers
            payload = self._payload(gateway, verb, fields)
            is_sent = payload is not None and self._send(gateway, verb, payload, correlation)
        if not is_sent:
            problem = f"{gateway} has not been heard." if payload is None else f"Not sent: {self.problem}"
            answered.set_exception(NoAnswerError(problem))
        return answered

    def ask(self, gateway: str, verb: Verb, *, timeout_s: float = ANSWER_S, **fields: Any) -> Done:
        """As `request`, and waits. One that was too old, because the lease has passed or nothing newer was
        heard, is made anew once, but no move. Raises RefusedError or NoAnswerError.
        """
        try:
            return self.result_of(gateway, self.request(gateway, verb, **fields), timeout_s)
        except RefusedError as error:
            if error.code != "expired" or verb == "move":
                raise
        self.result_of(gateway, self.request(gateway, "report"), timeout_s)
        return self.result_of(gateway, self.request(gateway, verb, **fields), timeout_s)

    def result_of(self, gateway: str, answered: "Future[Done]", timeout_s: float = ANSWER_S) -> Done:
        """Of a request to that gateway. Raises RefusedError or NoAnswerError."""
        try:
            return answered.result(timeout_s)
        except FutureTimeoutError:
            answered.cancel()
            why = f" Has {self._user} the role {self._role}?" if self._connection.was_denied else ""
            raise NoAnswerError(f"{gateway} did not answer in {timeout_s:g} s.{why}") from None

    def beat(self, gateways: Collection[str] | None = None) -> None:
        """The driver is present: for those of these gateways, or of all, whose lease this console has."""
        with self._lock:
            beaten = self._drives if gateways is None else self._drives.intersection(gateways)
            newest = {name: self._heard.nonce_of(name) for name in beaten}
            nonces = {name: nonce for name, nonce in newest.items() if nonce}
            if nonces:
                self._send(ALL, "beat", encode(BeatRequest(n=self._next(), nonces=nonces)), b"")

    def beat_for(self, gateway: str, nonce: str) -> None:
        """The driver of that one was present when it had got that nonce."""
        with self._lock:
            self._send(gateway, "beat", encode(BeatRequest(n=self._next(), nonces={gateway: nonce})), b"")

    def stop(self, gateway: str) -> "Future[Done]":
        """STOP for one. As `request`."""
        return self.request(gateway, "stop")

    def stop_some(self, gateways: Collection[str], timeout_s: float = STOP_S) -> StopReport:
        """STOP for these alone. Waits until all have answered."""
        sent = {name: self.stop(name) for name in gateways}
        wait(sent.values(), timeout_s)
        missing = {name for name, answered in sent.items() if not answered.done()}
        errors = {name: sent[name].exception() for name in sent.keys() - missing}
        missing |= {name for name, error in errors.items() if isinstance(error, NoAnswerError)}
        refused = {n: error.detail for n, error in errors.items() if isinstance(error, RefusedError)}
        return report_of(sent.keys() - refused.keys() - missing, refused, missing)

    def stop_all(self, timeout_s: float = STOP_S) -> StopReport:
        """STOP for all, and for those that connect later until `withdraw_holds`. Waits until all that are
        present have answered.
        """
        present = {robot.name for robot in self.robots() if robot.presence != "silent"}
        topic = self._site.hold(self._role, self._user)
        hold = Outgoing(topic, secrets.token_hex(8).encode(), 1, True, HOLD_S)
        answers = self._ask_all("stop", b"", present, timeout_s, STOP_AGAIN_S, hold)
        refused = {name: answer.detail for name, answer in answers.items() if isinstance(answer, Refused)}
        return report_of(answers.keys() - refused.keys(), refused, present - answers.keys())

    def commit(self, name: str, gateways: Collection[str], timeout_s: float) -> set[str]:
        """The promise of that name. Those of the gateways that have agreed in time."""
        return self._agreed("commit", CommitRequest, name, gateways, timeout_s)

    def cancel(self, name: str, gateways: Collection[str], timeout_s: float) -> set[str]:
        """As `commit`: the promise is given up."""
        return self._agreed("cancel", CancelRequest, name, gateways, timeout_s)

    def clock(self, gateway: str, timeout_s: float = ANSWER_S) -> tuple[float, float]:
        """By how many ms the gateway's clock is ahead of this one, and to how many ms that is sure: half of
        the time that question and answer took. Raises NoAnswerError.
        """
        read: Future[tuple[float, float]] = Future()

        def take(answer: AnyAnswer) -> None:
            took_ms = self._now() * 1000 - asked_ms
            if isinstance(answer, Clock):
                reading = (answer.clock_ms - asked_ms - took_ms / 2, took_ms / 2)
                settle(lambda: read.set_result(reading))

        correlation = self._await_answers(take)
        with self._lock:
            payload = encode(SyncRequest(n=self._next()))
            asked_ms = self._now() * 1000
            self._send(gateway, "sync", payload, correlation)
        try:
            return read.result(timeout_s)
        except FutureTimeoutError:
            raise NoAnswerError(f"{gateway} did not say its time in {timeout_s:g} s.") from None
        finally:
            self._forget(correlation)

    @property
    def holds(self) -> frozenset[str]:
        """The topics of the holds that stop those that connect later."""
        with self._lock:
            return frozenset(self._holds)

    def withdraw_holds(self) -> None:
        """Gateways that connect from now on do not stop any more, whoever has stopped all. Resumes none. For
        drivers and owners; others withdraw their own hold alone.
        """
        for topic in self.holds | {self._site.hold(self._role, self._user)}:
            self._connection.publish(Outgoing(topic, b"", 1, True))

    def _agreed(
        self, verb: Verb, model: type[CommitRequest], name: str, gateways: Collection[str], timeout_s: float
    ) -> set[str]:
        with self._lock:
            payload = encode(model(n=self._next(), name=name))
        answers = self._ask_all(verb, payload, gateways, timeout_s)
        return {gateway for gateway, answer in answers.items() if isinstance(answer, Done)}

    def _ask_all(
        self,
        verb: Verb,
        payload: bytes,
        expected: Collection[str],
        timeout_s: float,
        again_s: Collection[float] = (),
        beside: Outgoing | None = None,
    ) -> dict[str, AnyAnswer]:
        """Waits until those that are expected have answered; others may have, too."""
        answers: dict[str, AnyAnswer] = {}
        missing = set(expected)

        def take(answer: AnyAnswer) -> None:
            answers[answer.gateway] = answer
            missing.discard(answer.gateway)

        correlation = self._await_answers(take)
        self._send(ALL, verb, payload, correlation)
        if beside:
            self._connection.publish(beside)
        for after_s in again_s:
            again = threading.Timer(after_s, self._send, (ALL, verb, payload, correlation))
            again.daemon = True
            again.start()
        self.until(lambda: not missing, timeout_s)
        self._forget(correlation)
        return answers

    def _await_answers(self, take: Callable[[AnyAnswer], None]) -> bytes:
        """`take` is called in the connection's thread; the correlation of the request."""
        correlation = secrets.token_bytes(8)
        self._pending[correlation] = take
        return correlation

    def _forget(self, correlation: bytes) -> None:
        self._pending.pop(correlation, None)

    # In the connection's thread

    def connected(self) -> None:
        """Those that are there say so at once."""
        with self._lock:
            self._send(ALL, "report", encode(ReportRequest(n=self._next())), b"")
        self._say("")

    def lost(self) -> None:
        with self._lock:
            self._drives.clear()
            self._waits.clear()
        self._say("")

    def received(self, received: Received) -> None:
        with suppress(ValidationError):  # of another version: as if it had said nothing
            self._say(self._take(received))

    def _take(self, received: Received) -> str:
        """The gateway that said it; empty for what other people said."""
        match self._site.parse(received.topic):
            case Published(gateway, "about") if not received.payload:
                self._heard.removed(gateway)
                return gateway
            case Published(gateway, "about"):
                self._heard.about(gateway, About.model_validate_json(received.payload))
                return gateway
            case Published(gateway, "state"):
                state = State.model_validate_json(received.payload)
                self._take_state(gateway, state, None if received.is_retained else received.at_s)
                return gateway
            case Published(gateway, "live"):
                self._heard.live(gateway, Live.model_validate_json(received.payload))
                return gateway
            case Published(gateway, "online"):
                self._heard.online(gateway, Online.model_validate_json(received.payload))
                return gateway
            case Hold():
                with self._lock:
                    (self._holds.add if received.payload else self._holds.discard)(received.topic)
            case Reply():
                return self._take_answer(received)
        return ""

    def _take_state(self, gateway: str, state: State, heard_s: float | None) -> None:
        self._heard.state(gateway, state, heard_s)
        if heard_s is None:
            return
        is_ours = state.driver == self._user
        with self._lock:
            has_got_it = is_ours and gateway in self._waits
            self._waits -= {gateway} if has_got_it else set()
        if has_got_it or not is_ours:
            self._set_drives(gateway, has_got_it)

    def _take_answer(self, received: Received) -> str:
        answer = answer_adapter.validate_json(received.payload)
        if isinstance(answer, Done) and answer.state:
            self._take_state(answer.gateway, answer.state, received.at_s)
        take = self._pending.get(received.correlation or b"")
        if take:
            take(answer)
        return answer.gateway

    def _set_waits(self, gateway: str, waits: bool) -> None:
        """For the lease: its driver may let it pass later."""
        with self._lock:
            (self._waits.add if waits else self._waits.discard)(gateway)

    def _set_drives(self, gateway: str, drives: bool) -> None:
        with self._lock:
            did = gateway in self._drives
            (self._drives.add if drives else self._drives.discard)(gateway)
        if drives and not did:
            self.watch(gateway)
        elif did and not drives:
            self.unwatch(gateway)

    def _say(self, gateway: str) -> None:
        with self._news:
            self._news.notify_all()
        self._changed(gateway)

    # Within the lock

    def _next(self) -> int:
        self._n += 1
        return self._n

    def _payload(self, gateway: str, verb: Verb, fields: dict[str, Any]) -> bytes | None:
        """None where it needs a nonce, and the gateway has said none. Raises ValidationError."""
        if verb == "stop":
            return b""
        model, n = REQUESTS[verb], self._next()
        if issubclass(model, TimelyRequest):
            nonce = self._heard.nonce_of(gateway)
            return None if nonce is None else encode(model(**{"n": n, "nonce": nonce, **fields}))
        return encode(model(n=n, **fields))

    def _send(self, gateway: str, verb: Verb, payload: bytes, correlation: bytes) -> bool:
        topic = self._site.command(gateway, self._role, self._user, verb)
        return self._connection.publish(
            Outgoing(
                topic,
                payload,
                0 if verb in QOS_0 else 1,
                expires_s=None if verb == "stop" else EXPIRES_S,  # a late stop is better than none
                reply_to=self._reply_to,
                correlation=correlation,
            )
        )


def report_of(stopped: Collection[str], refused: dict[str, str], missing: Collection[str]) -> StopReport:
    return StopReport(tuple(sorted(stopped)), tuple(sorted(refused.items())), tuple(sorted(missing)))


def settle(act: Callable[[], None]) -> None:
    """The same answer may come twice, and nobody may wait any more."""
    with suppress(InvalidStateError):
        act()
