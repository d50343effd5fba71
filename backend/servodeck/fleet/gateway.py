"""The gateway as a client of a broker: one more door of the robot core (docs/adr/0048).

What arrives is judged in the connection's thread; only what is to be carried out reaches the gateway's loop,
where its reports are made, too. A broker that is lost, or does not bring back the gateway's own state, is a
driver that is lost.
"""

import asyncio
import contextlib
import logging
import secrets
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from pydantic import ValidationError

from servodeck.callers import Caller
from servodeck.errors import GatewayError
from servodeck.fleet.broker import Broker, Connection, Interest, Outgoing
from servodeck.fleet.messages import About, Clock, Done, Online, Refused, State, encode
from servodeck.fleet.reports import Facts, Nonces, Page, Reports
from servodeck.fleet.rules import Accepted, Judge, Origin, Received, Refusal, Repeated, Stop
from servodeck.fleet.sessions import Sessions
from servodeck.fleet.topics import ALL, Kind, Published, Site
from servodeck.robot.control import Control
from servodeck.robot.hub import Session, Throttle
from servodeck.robot.latch import Cause
from servodeck.schema import Message
from servodeck.snapshots import FleetStatus

STATE_S, LIVE_S, CHANGE_S = 1.0, 0.05, 0.1
# A console believes in a gateway for so long after its last state.
FRESH_S = 3
ECHO_S = 3.0
ALONE_S = 30.0
# A console repeats a STOP for so long, and needs one answer.
STOP_REPEATED_S = 0.5
STOPS_ANSWERED_AT_ONCE = 8
NO_PAGE = Page()
log = logging.getLogger("servodeck.fleet")


class Watcher(Session):
    """The broker as a client that only listens: the battery is read for it, too."""

    def __init__(self, changed: Callable[[], None]) -> None:
        super().__init__(Caller("broker", "The broker", "viewer"), answers=False)
        self._changed = changed

    def put(self, _text: str) -> None:
        self._changed()

    def put_later(self, _text: Callable[[], str]) -> None:
        """Packets that left are no concern of it."""


class FleetGateway:
    def __init__(
        self,
        control: Control,
        broker: Broker,
        site: Site,
        name: str,
        page: Page = NO_PAGE,
        announced: Callable[[About], Iterable[Outgoing]] = lambda _: (),
    ) -> None:
        """`announced`: what else is published when the gateway says what it is."""
        self._announced = announced
        self._control = control
        self._site = site
        self._name = name
        # Another one at each start: a copy of this gateway is found by it, and the broker takes both.
        self._instance = secrets.token_hex(4)
        self._judge = Judge(site, name, control.now)
        self._nonces = Nonces(control, self._instance, self._judge.issued)
        self._reports = Reports(control, name, self._instance, page, self._nonces)
        self._sessions = Sessions(control, name, self._nonces, self._reports)
        self._watcher = Watcher(self._changed)
        self._soon = Throttle(self._publish_state, CHANGE_S, control.now)
        self._refused: Counter[str] = Counter()
        self._stops: deque[tuple[Stop, Received]] = deque()
        self._stops_lock = threading.Lock()
        self._stops_answered: deque[tuple[tuple[str | None, bytes], float]] = deque(maxlen=8)
        self._echo_s = self._foreign_s = 0.0
        self._is_heard = False
        self._about: About | None = None
        self._facts: Facts | None = None
        self._tasks: list[asyncio.Task[None]] = []
        self._drives = asyncio.Event()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._is_ending = self._will_look = False
        client_id = f"{name}-{self._instance}"
        will, interests = self._online(False), interests_of(site, name)
        self._connection = Connection(broker, client_id, interests, self, control.now, will)

    def start(self) -> None:
        """On the gateway's loop."""
        self._loop = asyncio.get_running_loop()
        self._control.join(self._watcher)
        self._tasks = [asyncio.create_task(self._report()), asyncio.create_task(self._report_live())]
        self._connection.start()

    def end(self) -> None:
        """Says that it leaves. The loop may have ended."""
        self._is_ending = True
        for task in self._tasks:
            with contextlib.suppress(RuntimeError):
                task.cancel()
        self._connection.end(self._online(False))

    def status(self) -> FleetStatus:
        problem = self._connection.problem
        if self._connection.is_connected and not self._is_heard:
            problem = "The broker does not bring back this gateway's state: may it read its own topic?"
        return FleetStatus(
            broker=self._connection.broker.address,
            site=self._site.name,
            name=self._name,
            is_connected=self._connection.is_connected,
            is_cloned=self._judge.is_cloned,
            problem=problem,
            refused=dict(self._refused),
        )

    # In the connection's thread

    def connected(self) -> None:
        self._connection.publish(self._online(True))
        self._on_loop(self._came)

    def lost(self) -> None:
        self._on_loop(lambda: self._lose("The broker was lost."))

    def received(self, received: Received) -> None:
        match self._site.parse(received.topic):
            case Published(_, "state"):
                self._heard_state(received.payload)
            case Published(_, "online"):
                self._heard_online(received.payload)
            case _:
                self._heard_request(received)

    def _heard_state(self, payload: bytes) -> None:
        try:
            instance = State.model_validate_json(payload).instance
        except ValidationError:
            return
        if instance == self._instance:
            self._echo_s, self._is_heard = self._control.now(), True
        else:
            self._foreign_s = self._control.now()
            if not self._judge.is_cloned:
                self._judge.is_cloned = True
                self._on_loop(self._cloned)

    def _heard_online(self, payload: bytes) -> None:
        """The last will of an earlier connection may come behind the present one."""
        with contextlib.suppress(ValidationError):
            if not Online.model_validate_json(payload).is_online and not self._is_ending:
                self._connection.publish(self._online(True))

    def _heard_request(self, received: Received) -> None:
        match self._judge.judge(received):
            case Stop() as stop:
                with self._stops_lock:
                    self._stops.append((stop, received))
                    is_first = len(self._stops) == 1
                if is_first:  # a flood of them is one on the loop
                    self._on_loop(self._stop)
            case Accepted(_, "sync", request):
                self._send(received, encode(self._clock(request.n, received.at_s)))
            case Accepted() as accepted:
                self._on_loop(lambda: self._carry_out(accepted, received))
            case Repeated(_, answer) if answer:
                self._send(received, answer)
            case Refusal() as refusal:
                self._refuse(refusal, received)

    def _refuse(self, refusal: Refusal, received: Received) -> None:
        self._refused[refusal.code] += 1
        if refusal.origin:
            answer = encode(
                Refused(gateway=self._name, n=refusal.n, code=refusal.code, detail=refusal.detail)
            )
            self._keep(refusal.origin, refusal.n, answer)
            self._send(received, answer)

    def _clock(self, n: int, at_s: float) -> Clock:
        """Here, because the loop may be busy for longer than a clock is uncertain."""
        return Clock(gateway=self._name, n=n, clock_ms=at_s * 1000)

    def _on_loop(self, call: Callable[[], None]) -> None:
        assert self._loop
        with contextlib.suppress(RuntimeError):  # it is closed: the process is ending
            self._loop.call_soon_threadsafe(call)

    # On the gateway's loop

    def _stop(self) -> None:
        with self._stops_lock:
            stops = list(self._stops)
            self._stops.clear()
        error: GatewayError | None = None
        try:
            self._control.stop(Cause("person", stops[0][0].user))
        except GatewayError as raised:
            error = raised
        self._sessions.stopped(max(received.at_s for _, received in stops))
        for origin, received in to_be_answered(stops):
            if self._is_first(received):
                self._send(received, encode(self._stopped(origin, error)))

    def _is_first(self, received: Received) -> bool:
        """Not the repetition of a STOP that was answered a moment ago: of a thousand gateways the second and
        third answers would hold up the first ones.
        """
        if received.correlation is None:
            return True
        now, key = self._control.now(), (received.reply_to, received.correlation)
        if any(key == one and now - at_s < STOP_REPEATED_S for one, at_s in self._stops_answered):
            return False
        self._stops_answered.append((key, now))
        return True

    def _stopped(self, origin: Origin, error: GatewayError | None) -> Done | Refused:
        if error:
            return Refused(gateway=self._name, n=None, code=error.code, detail=error.detail)
        epoch, drives = self._control.driving.lease.epoch, self._sessions.is_driver(origin)
        return Done(gateway=self._name, n=None, nonce=self._nonces.newest(), epoch=epoch, drives=drives)

    def _carry_out(self, accepted: Accepted, received: Received) -> None:
        def answer(message: Done | Refused) -> None:
            text = encode(message)
            self._keep(accepted.origin, accepted.request.n, text)
            self._send(received, text)

        self._sessions.carry_out(accepted, answer)

    def _keep(self, origin: Origin, n: int | None, answer: bytes) -> None:
        if n is not None:
            self._judge.answered(origin, n, answer)

    def _send(self, received: Received, answer: bytes) -> None:
        if received.reply_to:
            self._connection.publish(
                Outgoing(received.reply_to, answer, 1, expires_s=FRESH_S, correlation=received.correlation)
            )

    def _came(self) -> None:
        self._echo_s, self._is_heard, self._about = self._control.now(), False, None
        self._stops_answered.clear()
        self._publish_about()
        self._soon.at_once()

    def _lose(self, reason: str) -> None:
        self._sessions.lose(reason)
        self._changed()

    def _cloned(self) -> None:
        log.warning("another gateway has the same name", extra={"facts": {"name": self._name}})
        self._lose("Another gateway has the same name.")
        self._soon.soon()

    def _changed(self) -> None:
        """Of the robot, or of who drives it. Whatever it is about, a stop above all, comes first."""
        if not self._will_look:
            self._will_look = True
            asyncio.get_running_loop().call_soon(self._look)

    def _look(self) -> None:
        self._will_look = False
        self._nonces.forget_old()
        if self._sessions.drives:
            self._drives.set()
        facts = self._reports.facts()
        if facts != self._facts:
            self._facts = facts
            self._soon.soon()

    async def _report(self) -> None:
        while True:
            self._soon.at_once()
            self._publish_about()
            self._judge_echo()
            await asyncio.sleep(STATE_S)

    async def _report_live(self) -> None:
        while await self._drives.wait():
            if not self._sessions.drives:
                self._drives.clear()
                continue
            self._publish("live", self._reports.live())
            await asyncio.sleep(LIVE_S)

    def _judge_echo(self) -> None:
        now = self._control.now()
        if self._connection.is_connected and now - self._echo_s > ECHO_S:
            self._is_heard = False
            self._lose("The broker does not bring back what this gateway says.")
        if self._judge.is_cloned and now - self._foreign_s > ALONE_S:
            self._judge.is_cloned = False

    def _publish_state(self) -> None:
        self._facts = self._reports.facts()
        self._reports.is_cloned = self._judge.is_cloned
        self._publish("state", self._reports.state(), is_retained=True, expires_s=FRESH_S)

    def _publish_about(self) -> None:
        about = self._reports.about()
        if about != self._about and self._publish("about", about, is_retained=True, qos=1):
            self._about = about
            for message in self._announced(about):
                self._connection.publish(message)

    def _publish(self, kind: Kind, message: Message, **how: Any) -> bool:
        topic = self._site.published(self._name, kind)
        return self._connection.publish(Outgoing(topic, encode(message), **how))

    def _online(self, is_online: bool) -> Outgoing:
        payload = encode(Online(instance=self._instance, is_online=is_online))
        return Outgoing(self._site.published(self._name, "online"), payload, 1, is_retained=True)


def interests_of(site: Site, name: str) -> dict[str, Interest]:
    """What is retained is not a request, except a hold."""
    fresh = Interest(1, wants_retained=False, as_published=True)
    return {
        site.commands_to(name): fresh,
        site.commands_to(ALL): fresh,
        site.holds(): Interest(1, wants_retained=True, as_published=True),
        site.published(name, "state"): fresh,
        site.published(name, "online"): fresh,
    }


def to_be_answered(stops: Sequence[tuple[Stop, Received]]) -> list[tuple[Origin, Received]]:
    """One of each correlation, and of each session the latest ones: a flood gets no flood of answers."""
    by_session: dict[Origin, dict[bytes | None, Received]] = {}
    for stop, received in stops:
        if stop.origin:
            by_session.setdefault(stop.origin, {})[received.correlation] = received
    return [
        (origin, received)
        for origin, asked in by_session.items()
        for received in list(asked.values())[-STOPS_ANSWERED_AT_ONCE:]
    ]
