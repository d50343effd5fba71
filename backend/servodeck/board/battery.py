"""The battery: one question to the board for all who want to know, and the newest word of it.

Knows the question and its answer; no client, and not how a packet leaves.
"""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass

from servodeck.board.answers import Answers
from servodeck.errors import NoAnswerError
from servodeck.port.wire import Left
from servodeck.protocol.timings import BATTERY
from servodeck.protocol.values import Battery, Report

BATTERY_PACKET = "5555020f"
BATTERY_WAIT_S = BATTERY.timeout_ms / 1000


@dataclass(frozen=True, slots=True)
class BatteryReading:
    battery_mv: int
    at_s: float


class BatteryWatch:
    def __init__(self, answers: Answers, ask: Callable[[str], Left], now: Callable[[], float]) -> None:
        """`ask` puts that packet on the wire."""
        self.newest: BatteryReading | None = None
        self._answers = answers
        self._ask = ask
        self._now = now
        self._question: asyncio.Task[int] | None = None

    def heard(self, report: Report) -> None:
        if isinstance(report, Battery):
            self.newest = BatteryReading(report.battery_mv, self._now())

    def forget(self) -> None:
        """It is another board now."""
        self.newest = None

    async def read(self) -> int:
        """In mV. Whoever asks while a question is under way shares its answer."""
        if self._question is None:
            self._question = asyncio.create_task(self._read())
            self._question.add_done_callback(self._asked)
        return await asyncio.shield(self._question)

    async def _read(self) -> int:
        report = await self._answers.to(self._ask(BATTERY_PACKET), BATTERY_WAIT_S, Battery)
        if not isinstance(report, Battery):
            raise NoAnswerError("The board did not tell its battery voltage. Not every board can.")
        return report.battery_mv

    def _asked(self, question: asyncio.Task[int]) -> None:
        self._question = None
        if not question.cancelled():
            question.exception()  # whoever asked has it; nobody may be left to take it
