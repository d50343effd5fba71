"""Whether the board still answers: asks an idle board by the cheapest harmless question that such a board
always answers, and counts the questions that stayed unanswered. Twin of shared/src/robot/heartbeat.ts.

Knows when it may ask and how much silence means that the board is gone; not what follows from that.
"""

import asyncio
from collections.abc import Awaitable, Callable

from servodeck.protocol.families import Question
from servodeck.protocol.timings import HEARTBEAT


class Heartbeat:
    def __init__(
        self,
        question: Callable[[], Question | None],
        ask: Callable[[Question], Awaitable[bool | None]],
        gone: Callable[[], None],
    ) -> None:
        """`question`: None while none may be asked: nobody looks, something runs, no such board answers
        anything. `ask`: False when no answer came, None when nobody can tell.
        """
        self._question = question
        self._ask = ask
        self._gone = gone
        self._runs = False
        self._misses = 0
        self._timer: asyncio.TimerHandle | None = None
        self._beating: asyncio.Task[None] | None = None

    def start(self, *, is_gone: bool) -> None:
        """`is_gone`: it has been silent already, so it is asked more often."""
        self.stop()
        self._runs = True
        self._misses = HEARTBEAT.misses if is_gone else 0
        self._wait()

    def stop(self) -> None:
        self._runs = False
        if self._timer:
            self._timer.cancel()
        if self._beating:
            self._beating.cancel()

    def heard(self) -> None:
        """The board said something: no need to ask for a while."""
        self._misses = 0
        if self._runs:
            self._wait()

    def _wait(self) -> None:
        if self._timer:
            self._timer.cancel()
        delay_ms = HEARTBEAT.stale_every_ms if self._misses else HEARTBEAT.every_ms
        self._timer = asyncio.get_running_loop().call_later(delay_ms / 1000, self._begin)

    def _begin(self) -> None:
        self._beating = asyncio.create_task(self._beat())

    async def _beat(self) -> None:
        question = self._question()
        answered = await self._ask(question) if question else None
        if answered is False:
            self._misses += 1
            if self._misses == HEARTBEAT.misses:
                self._gone()  # which may stop it
        if self._runs:
            self._wait()


ANSWER_S = 0.5  # the longest answer, that for six positions, takes 450 ms (X7)


class Silence:
    def __init__(self) -> None:
        self._answered: set[int] = set()
        self._asked_s: float | None = None
        self._misses = 0

    def asked(self, command: int, at_s: float) -> None:
        """That question leaves the wire then."""
        is_due = self._is_due(at_s)
        if command in self._answered and (self._asked_s is None or is_due):
            self._misses += is_due
            self._asked_s = at_s

    def heard(self, command: int) -> None:
        self._answered.add(command)
        self._asked_s, self._misses = None, 0

    def is_silent(self, now: float) -> bool:
        return self._misses + self._is_due(now) >= HEARTBEAT.misses

    def _is_due(self, now: float) -> bool:
        return self._asked_s is not None and now - self._asked_s >= ANSWER_S
