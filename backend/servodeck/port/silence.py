"""Whether the board has fallen silent: what it has answered before it does not answer any more, so it may be
off.

Pure: time comes in. Knows numbers of questions, no packet and no meaning; what follows is for whoever asks.
"""

from servodeck.protocol.timings import HEARTBEAT

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
