"""How everything stands, told to whoever joins and to everybody when something of it has changed.

Knows seats, messages and the parts they are about; changes none of them.
"""

from collections.abc import Callable
from typing import Any

from servodeck import __version__
from servodeck.access.hub import Hub, Seat
from servodeck.board.board import Board
from servodeck.driving.driving import Driving
from servodeck.driving.latch import Latch
from servodeck.library.robot_of_board import RobotOfBoard
from servodeck.messages import StateMessage, WelcomeMessage, encode
from servodeck.schema import Message


class Telling:
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

    def welcome(self, seat: Seat) -> None:
        board = self._board
        welcome = WelcomeMessage(
            version=__version__,
            robot=self._robot.told(),
            lease=self._driving.state_for(seat),
            job=board.jobs.latest,
            play=board.plays.latest,
            motion=board.motion.told(self._now()),
            battery=board.battery.told(),
            **self._standing(),
        )
        seat.put(encode(welcome))

    def state(self, but: Seat | None = None) -> None:
        self.everybody(StateMessage(**self._standing()), but)

    def everybody(self, message: Message, but: Seat | None = None) -> None:
        self._hub.tell_all(encode(message), but)

    def _standing(self) -> dict[str, Any]:
        """The fields of `Standing`."""
        board, latch = self._board, self._latch
        return {
            "board": board.taken_for,
            "port": board.port,
            "link": board.link_state,
            "identity": board.identity,
            "latch": latch.cause is not None,
            "latched_by": latch.by,
            "stopped_by": latch.name,
            "clients": len(self._hub),
            "unattended": board.unattended.told(),
            "broken_slots": board.broken_slots,
            "slot_versions": board.slot_versions,
            "waiting_to_start": board.moves.waiting_to_start,
        }
