"""Puts questions to the board one at a time, and waits for its reports. Twin of shared/src/robot/replies.ts.

Packets have no numbers: an answer is recognised by its kind alone. Knows kinds of reports and time; no packet
and no port.
"""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf

from servodeck.port.wire import Left
from servodeck.protocol.values import Report

Answer = asyncio.Future[Report]


@dataclass(frozen=True, slots=True, eq=False)
class Expected:
    kinds: tuple[type[Report], ...]
    not_before_s: float
    answer: Answer


class Replies:
    def __init__(self) -> None:
        self._expected: list[Expected] = []
        self.asking = asyncio.Lock()
        """Held by the one question that is under way: a board that talks to its servos keeps one packet and
        drops the others (S9, S52).
        """

    def heard(self, report: Report, at_s: float) -> None:
        for expected in self._expected:
            is_it = isinstance(report, expected.kinds) and at_s >= expected.not_before_s
            if is_it and not expected.answer.done():
                expected.answer.set_result(report)

    async def ask(self, put: Callable[[], Left], wait_s: float, *kinds: type[Report]) -> Report | None:
        """As `to`, once all earlier queries have been answered or given up. `put` puts the question on
        the wire.
        """
        async with self.asking:
            return await self.to(put(), wait_s, *kinds)

    async def to(
        self, left: Left, wait_s: float, *kinds: type[Report], not_before_s: float = -inf
    ) -> Report | None:
        """The first report of those kinds from now until that long after the question `left`; None where none
        came. Raises what kept the question from leaving. A report before `not_before_s` belongs to an earlier
        question.
        """
        with self._expecting(kinds, not_before_s) as answer:
            await left
            return await within(wait_s, answer)

    async def unsolicited(self, wait_s: float, *kinds: type[Report]) -> Report | None:
        """As `to`, without a question."""
        with self._expecting(kinds, -inf) as answer:
            return await within(wait_s, answer)

    @contextmanager
    def _expecting(self, kinds: tuple[type[Report], ...], not_before_s: float) -> Iterator[Answer]:
        expected = Expected(kinds, not_before_s, asyncio.get_running_loop().create_future())
        self._expected.append(expected)
        try:
            yield expected.answer
        finally:
            self._expected.remove(expected)


async def within(wait_s: float, answer: Answer) -> Report | None:
    # Not wait_for: Python 3.11's swallows a cancellation that meets the result.
    done, _ = await asyncio.wait({answer}, timeout=wait_s)
    return answer.result() if done else None
