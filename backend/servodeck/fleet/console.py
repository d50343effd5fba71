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
from servodeck.fleet.clocks import Reading
from servodeck.fleet.exchange import NOBODY, Exchange
from servodeck.fleet.heard import Heard, Robot
from servodeck.fleet.messages import (
    About,
    Answer,
    AnyAnswer,
    Clock,
    Done,
    Live,
    Online,
    Refused,
    State,
)
from servodeck.fleet.outcomes import NoAnswerError, RefusedError, StopReport, report_of
from servodeck.fleet.rules import Received
from servodeck.fleet.topics import ALL, Hold, Published, Reply, Site, Verb

ANSWER_S = 2.0
STOP_S = 1.0
STOP_AGAIN_S = (0.07, 0.14)
LOOK_S = 0.1
HOLD_S = 3600
# Gateways of one message, which no gateway may find too large.
BEATS_AT_ONCE = 140

answer_adapter: TypeAdapter[AnyAnswer] = TypeAdapter(Answer)


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
        self._lock = threading.Lock()
        self._heard = Heard(now)
        # In which epoch: one user may have several sessions, of which one drives.
        self._drives: dict[str, int] = {}
        self._waits: dict[str, int] = {}
        self._holds: set[str] = set()
        self._news = threading.Condition()
        session = secrets.token_hex(4)
        reply_to = site.reply(self._user, session)
        state = Interest(0, wants_retained=True, as_published=False)
        interests = {
            site.published("+", "about"): state,
            site.published("+", "state"): state,
            site.published("+", "online"): Interest(1, wants_retained=False, as_published=False),
            site.holds(): state,
            reply_to: Interest(1, wants_retained=False, as_published=True),
        }
        self._connection = Connection(broker, f"{self._user}-{session}", interests, self, now)
        self._exchange = Exchange(
            self._connection.publish, site, role, self._user, reply_to, self._heard.nonce_of
        )

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
                self._set_drives(gateway, answer.epoch if answer.drives else None)
                if verb == "ask":
                    waits = fields["action"] == "request" and not answer.drives
                    self._set_waits(gateway, answer.epoch if waits else None)
                settle(lambda: answered.set_result(answer))

        correlation = self._exchange.expect(take)
        answered.add_done_callback(lambda _: self._exchange.forget(correlation))
        is_sent = self._exchange.send(gateway, verb, fields, correlation)
        if not is_sent:
            problem = f"{gateway} has not been heard." if is_sent is None else f"Not sent: {self.problem}"
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
            beaten = self._drives.keys() if gateways is None else self._drives.keys() & gateways
            newest = {name: self._heard.nonce_of(name) for name in beaten}
        known = [(name, nonce) for name, nonce in newest.items() if nonce]
        for begin in range(0, len(known), BEATS_AT_ONCE):
            nonces = dict(known[begin : begin + BEATS_AT_ONCE])
            self._exchange.send(ALL, "beat", {"nonces": nonces}, NOBODY)

    def beat_for(self, gateway: str, nonce: str) -> None:
        """The driver of that one was present when it had got that nonce."""
        self._exchange.send(gateway, "beat", {"nonces": {gateway: nonce}}, NOBODY)

    def stop(self, gateway: str) -> "Future[Done]":
        """STOP for one. As `request`."""
        return self.request(gateway, "stop")

    def stop_some(self, gateways: Collection[str], timeout_s: float = STOP_S) -> StopReport:
        """STOP for these alone. Waits until all have answered."""
        sent = {name: self.stop(name) for name in gateways}
        wait(sent.values(), timeout_s)
        missing = {name for name, answered in sent.items() if answered.cancel()}  # nobody waits any more
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
        answers = self._ask_all("stop", {}, present, timeout_s, STOP_AGAIN_S, hold)
        refused = {name: answer.detail for name, answer in answers.items() if isinstance(answer, Refused)}
        return report_of(answers.keys() - refused.keys(), refused, present - answers.keys())

    def commit(self, name: str, gateways: Collection[str], timeout_s: float) -> set[str]:
        """The promise of that name. Those of the gateways that have agreed in time."""
        return self._agreed("commit", name, gateways, timeout_s)

    def cancel(self, name: str, gateways: Collection[str], timeout_s: float) -> set[str]:
        """As `commit`: the promise is given up."""
        return self._agreed("cancel", name, gateways, timeout_s)

    def clock(self, gateway: str, timeout_s: float = ANSWER_S) -> Reading:
        """Reads the gateway's clock once. Raises NoAnswerError."""
        read: Future[Reading] = Future()

        def take(answer: AnyAnswer) -> None:
            heard_ms = self._now() * 1000
            if isinstance(answer, Clock):
                reading = Reading(asked_ms, answer.clock_ms, heard_ms)
                settle(lambda: read.set_result(reading))

        correlation = self._exchange.expect(take)
        asked_ms = self._now() * 1000
        self._exchange.send(gateway, "sync", {}, correlation)
        try:
            return read.result(timeout_s)
        except FutureTimeoutError:
            raise NoAnswerError(f"{gateway} did not say its time in {timeout_s:g} s.") from None
        finally:
            self._exchange.forget(correlation)

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

    def _agreed(self, verb: Verb, name: str, gateways: Collection[str], timeout_s: float) -> set[str]:
        answers = self._ask_all(verb, {"name": name}, gateways, timeout_s)
        return {gateway for gateway, answer in answers.items() if isinstance(answer, Done)}

    def _ask_all(
        self,
        verb: Verb,
        fields: dict[str, Any],
        expected: Collection[str],
        timeout_s: float,
        again_s: Collection[float] = (),
        beside: Outgoing | None = None,
    ) -> dict[str, AnyAnswer]:
        """Waits until those that are expected have answered; others may have, too."""
        answers: dict[str, AnyAnswer] = {}
        missing = set(expected)
        are_all_there = threading.Event()  # to wake up for each of a thousand would delay the next

        def take(answer: AnyAnswer) -> None:
            answers[answer.gateway] = answer
            missing.discard(answer.gateway)
            if not missing:
                are_all_there.set()

        correlation = self._exchange.expect(take)
        self._exchange.send(ALL, verb, fields, correlation)
        if beside:
            self._connection.publish(beside)
        for after_s in again_s:
            again = threading.Timer(after_s, self._exchange.send, (ALL, verb, fields, correlation))
            again.daemon = True
            again.start()
        if missing:
            are_all_there.wait(timeout_s)
        self._exchange.forget(correlation)
        return dict(answers)  # a late one may still come

    # In the connection's thread

    def connected(self) -> None:
        """Those that are there say so at once."""
        self._exchange.send(ALL, "report", {}, NOBODY)
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
            has_got_it = is_ours and state.epoch > self._waits.get(gateway, state.epoch)
            if has_got_it:
                del self._waits[gateway]
            has_passed = state.epoch > self._drives.get(gateway, state.epoch)
        if has_got_it:
            self._set_drives(gateway, state.epoch)
        elif has_passed or not is_ours:
            self._set_drives(gateway, None)

    def _take_answer(self, received: Received) -> str:
        answer = answer_adapter.validate_json(received.payload)
        if isinstance(answer, Done) and answer.state:
            self._take_state(answer.gateway, answer.state, received.at_s)
        self._exchange.answered(answer, received.correlation)
        return answer.gateway

    def _set_waits(self, gateway: str, epoch: int | None) -> None:
        """For the lease, since that epoch: its driver may let it pass later."""
        with self._lock:
            self._waits.pop(gateway, None)
            if epoch is not None:
                self._waits[gateway] = epoch

    def _set_drives(self, gateway: str, epoch: int | None) -> None:
        drives = epoch is not None
        with self._lock:
            did = self._drives.pop(gateway, None) is not None
            if epoch is not None:
                self._drives[gateway] = epoch
        if drives and not did:
            self.watch(gateway)
        elif did and not drives:
            self.unwatch(gateway)

    def _say(self, gateway: str) -> None:
        with self._news:
            self._news.notify_all()
        self._changed(gateway)


def settle(act: Callable[[], None]) -> None:
    """The same answer may come twice, and nobody may wait any more."""
    with suppress(InvalidStateError):
        act()
