"""What clients hear unasked: the whole state when they join and when something of it has changed, and the
commands that have left the wire.

Knows seats, messages and the parts they are about; changes none of them.
"""

import asyncio
from collections.abc import Callable, Collection
from functools import lru_cache
from typing import Any

from servodeck import __version__
from servodeck.events import LeftMessage, StateMessage, WelcomeMessage, encode
from servodeck.packet_models import command_model
from servodeck.port.wire import Owner
from servodeck.protocol.values import Command, Move
from servodeck.robot.board.board import Board
from servodeck.robot.driving import Driving
from servodeck.robot.hub import Hub, Session
from servodeck.robot.latch import Latch
from servodeck.robot.profile import RobotOfBoard
from servodeck.schema import Message
from servodeck.value import value


class Broadcast:
    def __init__(
        self,
        hub: Hub,
        board: Board,
        latch: Latch,
        robot: RobotOfBoard,
        driving: Driving,
        now: Callable[[], float],
    ) -> None:
        self._hub = hub
        self._board = board
        self._latch = latch
        self._robot = robot
        self._driving = driving
        self._now = now

    def welcome(self, session: Session) -> None:
        board = self._board
        welcome = WelcomeMessage(
            version=__version__,
            robot=self._robot.snapshot(),
            lease=self._driving.state_for(session),
            job=board.jobs.latest,
            play=board.plays.latest,
            motion=board.motion.snapshot(self._now()),
            battery=board.battery.snapshot(),
            **self._state_fields(),
        )
        session.put(encode(welcome))

    def state(self, but: Session | None = None) -> None:
        if self._hub.sessions:  # what a message is made of is built with the first one, behind the start
            self.everybody(StateMessage(**self._state_fields()), but)

    def everybody(self, message: Message, but: Session | None = None) -> None:
        self._hub.send_all(encode(message), but)

    def _state_fields(self) -> dict[str, Any]:
        """The fields of `GatewayState`."""
        board, latch = self._board, self._latch
        return {
            "board": board.family_id,
            "port": board.port,
            "link": board.link_state,
            "identity": board.identity,
            "latch": latch.cause is not None,
            "latched_by": latch.by,
            "stopped_by": latch.name,
            "clients": len(self._hub),
            "unattended": board.unattended.snapshot(),
            "broken_slots": board.broken_slots,
            "slot_versions": board.slot_versions,
            "waiting_to_start": board.moves.waiting_to_start,
        }


FLUSH_S = 0.05

Commands = tuple[Command, ...]


@value
class Leaving:
    """`known_to` heard of it apart."""

    command: Command
    at_s: float
    known_to: Collection[Session]


class Relay:
    def __init__(self, hub: Hub, now: Callable[[], float], driver: Callable[[], Session | None]) -> None:
        self._hub = hub
        self._now = now
        self._driver = driver
        self._leaving: list[Leaving] = []
        self._after: dict[Session, Commands] = {}
        self._timer: asyncio.TimerHandle | None = None

    def leaving(self, owner: Owner, command: Command, at_s: float) -> None:
        """Its last bit leaves then; clients hear of it then: its `owner` and the driver at once."""
        driver = self._driver()
        known_to = [session for session in self._hub.sessions if session is owner or session is driver]
        for session in known_to:
            text = text_of((command,))
            asyncio.get_running_loop().call_later(max(0.0, at_s - self._now()), session.put, text)
        self._leaving.append(Leaving(command, at_s, known_to))
        if self._timer is None:
            self._plan()

    def send_left(self) -> None:
        """What has left by now is sent before what follows from it."""
        if self._timer:
            self._timer.cancel()
            self._flush()

    def forget(self, session: Session) -> None:
        self._after.pop(session, None)

    def _plan(self) -> None:
        delay_s = max(FLUSH_S, self._leaving[0].at_s - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._flush)

    def _flush(self) -> None:
        now = self._now()
        left = [each for each in self._leaving if each.at_s <= now]
        self._leaving = self._leaving[len(left) :]
        self._timer = None
        if self._leaving:
            self._plan()
        latest = newest(tuple(each.command for each in left))
        knowing = {session for each in left for session in each.known_to}
        for session in self._hub.sessions:
            known = session in knowing
            unheard = tuple(each.command for each in left if session not in each.known_to) if known else ()
            self._publish(session, newest(unheard) if known else latest)

    def _publish(self, session: Session, commands: Commands) -> None:
        if not commands:
            return
        behind = self._after.get(session)
        self._after[session] = commands if behind is None else newest(behind + commands)
        if behind is None:
            session.put_later(lambda: text_of(self._after.pop(session, ())))


@lru_cache(maxsize=16)
def text_of(commands: Commands) -> str:
    """The same for most seats, and then made once."""
    return encode(LeftMessage(commands=[command_model(command) for command in commands]))


@lru_cache(maxsize=16)
def newest(commands: Commands) -> Commands:
    """Without the moves whose every servo was sent elsewhere right after."""
    latest: list[Command] = []
    moved: set[int] = set()
    for command in reversed(commands):
        servos = {target.servo for target in command.targets} if isinstance(command, Move) else None
        if servos is None:
            moved.clear()
        elif servos <= moved:
            continue
        else:
            moved |= servos
        latest.append(command)
    return tuple(reversed(latest))
