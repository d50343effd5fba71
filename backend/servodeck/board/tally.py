"""How far the groups of one download have come together, and how long the rest takes.

Knows sizes and time. The page's session counts alike (shared/src/session/tally.ts).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from servodeck.protocol.timings import wire_s


@dataclass(frozen=True, slots=True)
class Progress:
    groups_stored: int
    frames_stored: int
    frame_count: int
    bytes_sent: int
    bytes_total: int
    remaining_s: float


class Tally:
    def __init__(self, now: Callable[[], float]) -> None:
        self._sizes: list[Sequence[int]] = []
        self._now = now
        self.frame_count = 0
        self.bytes_total = 0
        self._begun_s = now()
        self._s_per_byte = 0.0

    def add(self, sizes: Sequence[Sequence[int]]) -> None:
        """Bytes of each frame of each further group."""
        self._sizes += sizes
        self.frame_count += sum(map(len, sizes))
        self.bytes_total += sum(map(sum, sizes))

    def after(self, groups: int, frames: int) -> Progress:
        """So many groups are whole, and so many frames of the next one; none: it begins, or begins again. The
        time left is at least the wire's; what frames really took includes the flash.
        """
        whole, [part] = self._sizes[:groups], self._sizes[groups : groups + 1] or [()]
        part_sent = sum(part[:frames])
        if frames:
            self._s_per_byte = (self._now() - self._begun_s) / part_sent
        else:
            self._begun_s = self._now()
        sent = sum(map(sum, whole)) + part_sent
        left = self.bytes_total - sent
        return Progress(
            groups,
            sum(map(len, whole)) + frames,
            self.frame_count,
            sent,
            self.bytes_total,
            max(wire_s(left), self._s_per_byte * left),
        )
