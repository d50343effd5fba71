"""Asks the board what it can say of itself: where its servos stand, its firmware, its trims. Twin of
shared/src/robot/readings.ts.

Knows the questions and how long each may take; no client, and not how a packet leaves.
"""

import asyncio
import math
from collections.abc import Sequence
from typing import Literal, Protocol

from servodeck.errors import NoAnswerError
from servodeck.port.wire import Left
from servodeck.protocol.families import Family
from servodeck.protocol.timings import READ, wire_s
from servodeck.protocol.values import (
    AllPositions,
    Command,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Report,
    Version,
)
from servodeck.robot.board.answers import Answers
from servodeck.robot.board.move_plan import portions_of

Reading = Literal["positions", "version", "offsets"]
Key = tuple[Reading, tuple[int, ...]]


class ReadableBoard(Protocol):
    @property
    def family(self) -> Family: ...

    def put_question(self, question: Command) -> Left:
        """Puts it on the wire. Raises what keeps it from being asked."""


class Readings:
    def __init__(self, board: ReadableBoard, answers: Answers) -> None:
        self._board = board
        self._answers = answers
        self._under_way: dict[Key, asyncio.Task[None]] = {}

    async def read(self, what: Reading, servos: Sequence[int] = ()) -> None:
        """Until the board has said it, to everybody. Whoever asks the same meanwhile shares the answer.
        Raises what keeps it from being asked, and NoAnswerError.
        """
        key = (what, tuple(servos))
        if key not in self._under_way:
            self._under_way[key] = asyncio.create_task(self._read(*key))
            self._under_way[key].add_done_callback(lambda reading: self._ended(key, reading))
        await asyncio.shield(self._under_way[key])

    async def _read(self, what: Reading, servos: tuple[int, ...]) -> None:
        detail_s = READ.detail_timeout_ms / 1000
        family = self._board.family
        if what == "version":
            await self._ask(ReadVersion(), Version, detail_s)
        elif what == "offsets":
            await self._ask(ReadOffsets(), Offsets, detail_s)
        elif "readAllPositions" in family.commands:
            await self._ask(ReadAllPositions(), AllPositions, detail_s)
        else:
            for portion in portions_of(servos, family.servos_per_move):
                await self._ask(ReadPositions(tuple(portion)), Positions, positions_s(len(portion)))

    async def _ask(self, question: Command, answer: type[Report], wait_s: float) -> None:
        if await self._answers.ask(lambda: self._board.put_question(question), wait_s, answer) is None:
            raise NoAnswerError("The board did not answer in time.")

    def _ended(self, key: Key, reading: asyncio.Task[None]) -> None:
        del self._under_way[key]
        if not reading.cancelled():
            reading.exception()  # whoever asked has it; nobody may be left to take it


def positions_s(servo_count: int) -> float:
    """The board asks its servos one by one, then the answer needs its time on the wire."""
    answer_ms = wire_s(5 + 3 * servo_count) * 1000
    return (math.ceil(READ.position_ms * servo_count + answer_ms) + READ.margin_ms) / 1000
