"""Waits for what the board says to a question. Knows kinds of reports and time; no packet and no port.

Boards number nothing: an answer is told apart by its kind alone.
"""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager

from servodeck.packets import Report
from servodeck.wire import Left

Answer = asyncio.Future[Report]


class Answers:
    def __init__(self) -> None:
        self._waiting: list[tuple[tuple[type[Report], ...], Answer]] = []

    def heard(self, report: Report) -> None:
        for kinds, answer in self._waiting:
            if isinstance(report, kinds) and not answer.done():
                answer.set_result(report)

    async def to(self, left: Left, wait_s: float, *kinds: type[Report]) -> Report | None:
        """The first report of those kinds from now until that long after the question `left`; None where none
        came. Raises what kept the question from leaving.
        """
        with self._expecting(kinds) as answer:
            await left
            try:
                return await asyncio.wait_for(answer, wait_s)
            except TimeoutError:
                return None

    @contextmanager
    def _expecting(self, kinds: tuple[type[Report], ...]) -> Iterator[Answer]:
        waiting = (kinds, asyncio.get_running_loop().create_future())
        self._waiting.append(waiting)
        try:
            yield waiting[1]
        finally:
            self._waiting.remove(waiting)
