"""A gateway on the simulated board itself, driven through a generated history and then stopped at one of its
doors: what STOP said and what the robot did. Twin of shared/src/robot/stopUnderTest.ts, from which the
histories come.
"""

import asyncio
import contextlib
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from functools import cache
from math import inf
from typing import Any

from fastapi import FastAPI
from pydantic import ValidationError

from servodeck.access.guard import Guard
from servodeck.api.app import create_app
from servodeck.api.websocket import take
from servodeck.callers import Caller
from servodeck.errors import GatewayError
from servodeck.intents import StopMessage, client_message
from servodeck.port.wire import Left
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, ReadPositions, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from servodeck.robot.control import UNNAMED_PERSON, Control
from servodeck.robot.latch import Cause
from servodeck.snapshots import UnheldServos
from tests.client import ANNA, Client
from tests.downloading import ended
from tests.fake_port import FakePorts
from tests.lockstep import SERVOS, History, Simulator, SteppedBoard
from tests.running import DEVICE, NO_LIBRARY, client_of, entrance_to
from tests.virtual_time import VirtualTimeLoop, now

Step = dict[str, Any]

OLGA = Caller("olga", "Olga", "owner")
GUEST = Caller("guest", "Bert", "viewer")
PASSER_BY = Caller("link", "Stop link", "stopper")
KNOWN_SLOT = 5
# The owner of the port before may have begun a motion: by then it has ended.
OPENED_LONG_AGO_S = 31.0
# What moves no longer than that needs no stop.
SILENCE_S = {"silent driver": 2.0}
STOP_REPEATS_S = (0.07, 0.14)
LOST_FOR_S = 0.1
ERASED_WITHIN_S = 3.0
HELD_WITHIN_S = 0.150
# The gateway may have something to say once more, as long as the board was deaf.
SETTLES_S = 4.0
# No move is longer.
REST_S = 36.0
GRAIN_S = 1e-4


@dataclass
class Said:
    """What one STOP said; times since the test began."""

    pressed_s: float
    left_s: float
    unheld: UnheldServos | None


@dataclass
class Outcome:
    said: list[Said]
    moved_s: Sequence[float]
    due_s: float
    was_latched: bool
    answered: Said | None
    """What the STOP said that has latched, or behind which a person resumed: they answer for that
    (docs/adr/0012).
    """
    thrown_by: Sequence[float]
    met: Sequence[str]

    @property
    def moved_on(self) -> bool:
        """In spite of STOP."""
        return max(self.moved_s) > self.said[0].left_s + HELD_WITHIN_S

    def broken(self) -> list[str]:
        """Servos that moved longer than STOP said, or though nothing was said."""
        if self.was_latched and not (self.said or self.answered):
            return []
        if not self.said:
            return [
                f"servo {servo} moved for {1000 * (moved_s - self.due_s):.1f} ms, and no stop came"
                for servo, moved_s in zip(SERVOS, self.moved_s, strict=True)
                if moved_s > max(self.due_s + HELD_WITHIN_S, self._answered_until_s(servo))
            ]
        return [
            f"servo {servo} moved for {1000 * (moved_s - said.pressed_s):.1f} ms, limit "
            f"{1000 * (limit_s - said.pressed_s):.1f}: {said.unheld}"
            for said in self.said
            for servo, moved_s in zip(SERVOS, self.moved_s, strict=True)
            if moved_s > (limit_s := said_of(said, servo)) + GRAIN_S
        ]

    def _answered_until_s(self, servo: int) -> float:
        return said_of(self.answered, servo) + GRAIN_S if self.answered else -inf


def said_of(said: Said, servo: int) -> float:
    held_s = said.left_s + HELD_WITHIN_S
    unheld = said.unheld
    if unheld is None or (unheld.servos is not None and servo not in unheld.servos):
        return held_s
    return inf if unheld.for_ms is None else max(held_s, said.pressed_s + unheld.for_ms / 1000)


class Watched(Control):
    """Notes each STOP."""

    def __init__(self, board: SteppedBoard, family: str) -> None:
        super().__init__(board, now, family)
        self._stepped = board
        self.said: list[Said] = []
        self.pressed_s: list[float] = []

    def stop(self, cause: Cause = UNNAMED_PERSON) -> Left:
        self.pressed_s.append(now())
        self._stepped.note_press()
        return super().stop(cause)

    def stopped_again(self, since_s: float) -> None:
        super().stopped_again(since_s)
        self.said.append(Said(since_s, now(), self.unheld))

    def _halted(self, left: Left) -> None:
        super()._halted(left)
        if not left.cancelled() and left.exception() is None:
            self.said.append(Said(self._pressed_s, now(), self.unheld))


@cache
def the_app() -> Guard:
    """Making one takes longer than a history."""
    guard = create_app(Control(FakePorts(), now, "doc"), NO_LIBRARY, entrance_to(now=now))
    assert isinstance(guard, Guard)
    return guard


async def press_over_http(here: "Driven") -> None:
    app = the_app()
    assert isinstance(app.app, FastAPI)
    app.app.state.control = here.control
    async with client_of(app) as client:
        answer = await client.post("/api/stop")
    assert answer.status_code in (200, 503), answer.text


def pressed_on_a_page(caller: Caller) -> Callable[["Driven"], Awaitable[None]]:
    async def press(here: "Driven") -> None:
        take(StopMessage(type="stop"), Client(here.control, caller), here.control)

    return press


async def press_by_the_driver(here: "Driven") -> None:
    take(StopMessage(type="stop"), here.page, here.control)


async def fall_silent(here: "Driven") -> None:
    here.page.beats = False


async def leave(here: "Driven") -> None:
    here.control.leave(here.page)


DOORS: dict[str, Callable[["Driven"], Awaitable[None]]] = {
    "driver": press_by_the_driver,
    "viewer": pressed_on_a_page(GUEST),
    "stop-only link": pressed_on_a_page(PASSER_BY),
    "HTTP": press_over_http,
    # There it comes only where something moves as far as the gateway knows.
    "silent driver": fall_silent,
    "driver gone": leave,
}


class Driven:
    def __init__(self, board: SteppedBoard, family: str) -> None:
        self.family = FAMILIES[family]
        self.board = board
        self.control = Watched(board, family)
        self.page: Client
        self._moves = 0
        self._resumed_s = -inf
        self._begun_before_resume = (0, 0)

    @property
    def answered(self) -> Said | None:
        """What was said by the STOP that latched, or behind which a person resumed, where nothing was begun
        since.
        """
        if self.control.latch:
            return self.control.said[-1] if self.control.said else None
        if self._begun() != self._begun_before_resume:
            return None
        return next(
            (one for one in reversed(self.control.said) if one.pressed_s <= self._resumed_s),
            None,
        )

    def _begun(self) -> tuple[int, int]:
        return self.board.runs, self._moves

    def resume(self) -> None:
        was_latched = self.control.latch
        self.control.resume(OLGA)
        self.board.note_resume()
        if was_latched:
            self._resumed_s, self._begun_before_resume = now(), self._begun()

    def say(self, message: dict[str, Any]) -> None:
        """As its page would; what cannot be said is not."""
        control = self.control
        with contextlib.suppress(GatewayError):
            if control.driving.driver is None:
                control.driving.act(self.page, "request")
        asked = {"id": 1, **message}
        if message["type"] != "stopGroup":
            asked["nonce"] = self.page.nonce
        with contextlib.suppress(ValidationError):
            take(client_message.validate_python(asked), self.page, control)

    def download(self, slot: int, frames: Sequence[Frame]) -> None:
        group = Group(slot, "", frames)
        with contextlib.suppress(GatewayError):
            part = made_of(group, list(packets_of(group, self.family.id)), self.family.id)
            self.control.requests.download([part], ANNA, lambda: None)

    async def take(self, step: Step) -> None:
        kind = step["kind"]
        self._moves += kind == "move"
        if make := INTENTS.get(kind):
            self.say({"type": kind, **make(step)})
        elif act := ACTS.get(kind):
            with contextlib.suppress(GatewayError):
                act(self, step)
        # What was lost is away for that long, and something.
        pause_ms = step["ms"] if kind == "wait" else step.get("awayMs", 1500) if kind == "loss" else 0
        await asyncio.sleep(pause_ms / 1000)

    def read(self) -> None:
        packet = encode(ReadPositions(SERVOS), self.family)
        self.say({"type": "packet", "bytes": packet.hex()})

    def cancel(self) -> None:
        if job := self.control.board.jobs.latest:
            self.control.board.jobs.cancel(job.id)

    async def stored(self) -> None:
        if job := self.control.board.jobs.latest:
            await ended(self.control, job)

    async def prepare(self, history: History) -> None:
        await self.control.use_port(DEVICE)
        await asyncio.sleep(OPENED_LONG_AGO_S)
        self.page = Client(self.control, OLGA)
        centre = (self.family.position.min + self.family.position.max) // 2
        targets = [{"servo": servo, "position": centre} for servo in SERVOS[:2]]
        self.say({"type": "move", "targets": targets, "durationMs": 1500})
        await asyncio.sleep(2.5)
        if "download" in self.family.commands:
            if history.get("wasErased"):
                self.say({"type": "erase"})
                await asyncio.sleep(ERASED_WITHIN_S)
            self.download(KNOWN_SLOT, frames_of(history["known"]))
            await self.stored()


INTENTS: dict[str, Callable[[Step], dict[str, Any]]] = {
    "move": lambda step: {"durationMs": step["durationMs"], "targets": step["targets"]},
    "run": lambda step: {"slot": step["slot"], "times": step["times"]},
    "erase": lambda _step: {},
    "release": lambda step: {"servos": step["servos"]},
}
ACTS: dict[str, Callable[[Driven, Step], None]] = {
    "endGroup": lambda here, _step: here.say({"type": "stopGroup"}),
    "read": lambda here, _step: here.read(),
    "speed": lambda here, step: here.say(
        {"type": "setSpeed", "slot": step["slot"], "percent": step["percent"]}
    ),
    "halt": lambda here, _step: here.control.stop().add_done_callback(taken),
    "resume": lambda here, _step: here.resume(),
    "download": lambda here, step: here.download(step.get("slot", KNOWN_SLOT), frames_of(step["frames"])),
    "cancel": lambda here, _step: here.cancel(),
    "loss": lambda here, _step: here.board.lose(LOST_FOR_S),
    "restart": lambda here, _step: here.board.restart(),
    "noise": lambda here, step: here.board.disturb(step["bytes"]),
}


def taken(left: Left) -> None:
    if not left.cancelled():
        left.exception()


def targets_of(shape: dict[str, Any]) -> tuple[ServoTarget, ...]:
    return tuple(ServoTarget(target["servo"], target["position"]) for target in shape["targets"])


def frames_of(shapes: Sequence[dict[str, Any]]) -> list[Frame]:
    return [Frame(shape["durationMs"], targets_of(shape)) for shape in shapes]


async def outcome_of(simulator: Simulator, family: str, history: History, door: str) -> Outcome:
    board = SteppedBoard(simulator, family, history)
    here = Driven(board, family)
    control = here.control
    await here.prepare(history)
    for step in history["steps"]:
        await here.take(step)
    pressed_before, was_latched = len(control.pressed_s), control.latch
    due_s = now() + SILENCE_S.get(door, 0)
    with contextlib.suppress(GatewayError):
        await DOORS[door](here)
    await asyncio.sleep(SETTLES_S)
    until_s = now() + REST_S
    while (at_s := board.run_on(until_s)) < until_s:
        await asyncio.sleep(at_s - now())
        await asyncio.sleep(SETTLES_S)
    # Pressed again while it stops it joins the STOP under way.
    pressed_s = min(control.pressed_s[pressed_before:], default=inf)
    said = [one for one in control.said if one.left_s >= pressed_s]
    outcome = Outcome(said, board.moved_s, due_s, was_latched, here.answered, board.thrown_by, board.met)
    await control.board.link.close()
    return outcome


def stopped(simulator: Simulator, family: str, history: History, door: str) -> Outcome:
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(outcome_of(simulator, family, history, door))
