"""Sends clients the whole state when they join and whenever it changes.

Knows sessions, messages and the parts of the state; changes none of them.
"""

from collections.abc import Callable
from typing import Any

from servodeck import __version__
from servodeck.events import ActivityMessage, StateMessage, WelcomeMessage, encode
from servodeck.robot.board.board import Board
from servodeck.robot.driving import Driving
from servodeck.robot.hub import Hub, Session
from servodeck.robot.latch import Latch
from servodeck.robot.profile import RobotOfBoard


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
            activity=board.activity.state(),
            battery=board.battery.snapshot(),
            **self._state_fields(),
        )
        session.put(encode(welcome))

    def state(self, but: Session | None = None) -> None:
        if self._hub.sessions:  # the message classes are built with the first message, after the start
            self._hub.send_all(StateMessage(**self._state_fields()), but)

    def activity(self) -> None:
        if self._hub.sessions:
            self._hub.send_all(ActivityMessage(activity=self._board.activity.state()))

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
            "may_be_running": board.may_be_running,
        }
