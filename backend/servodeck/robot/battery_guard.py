"""Refuses new runs while the battery is at its alarm, where the robot on the board says so: for every door,
because each run and each play is judged here. Twin of shared/src/robot/batteryGuard.ts.

Knows the board and the robot; no client.
"""

import contextlib
from collections.abc import Callable

from servodeck.errors import BatteryLowError, GatewayError
from servodeck.robot.board.battery_rule import RunLimit, Verdict, verdict
from servodeck.robot.board.board import Board
from servodeck.robot.profile import RobotOfBoard


class BatteryGuard:
    def __init__(self, board: Board, robot: RobotOfBoard, now: Callable[[], float]) -> None:
        self._board = board
        self._robot = robot
        self._now = now

    @property
    def must_ask(self) -> bool:
        """What is known is not enough, and an answer may help."""
        if self._robot.is_being_read:
            return True
        return self._verdict() == "unknown" and self._board.battery.may_answer

    @property
    def may_ask(self) -> bool:
        """At rest only: a question disturbs what runs, and a load bends the answer."""
        return self._board.is_idle()

    async def ask(self) -> None:
        """Also where no answer comes."""
        await self._robot.until_read()
        if self.must_ask and self.may_ask:
            with contextlib.suppress(GatewayError):
                await self._board.battery.read()

    def judge(self) -> bool:
        """Whether something runs although the battery is not known. Raises BatteryLowError."""
        found, limit, rested = self._verdict(), self._limit(), self._board.battery.rested
        if found == "low" and limit and rested:
            now_v, alarm_v = rested.battery_mv / 1000, limit.alarm_mv / 1000
            raise BatteryLowError(
                f"The battery is at {now_v:.2f} V, its alarm at {alarm_v:.2f} V: new runs are refused."
            )
        return found == "unknown"

    def _verdict(self) -> Verdict:
        rested = self._board.battery.rested
        if rested is None:
            return verdict(self._limit(), None, 0)
        return verdict(self._limit(), rested.battery_mv, (self._now() - rested.at_s) * 1000)

    def _limit(self) -> RunLimit | None:
        """None where the robot is to run on, or is one that a version before stored."""
        facts = self._robot.facts
        if facts is None or facts.alarm_mv is None or facts.battery_policy in (None, "tell"):
            return None
        return RunLimit(facts.alarm_mv, self._board.family.battery_ceiling_mv)
