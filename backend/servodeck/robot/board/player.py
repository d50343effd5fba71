"""Plays frames: each move on its deadline, counted from the start so that nothing drifts. The way to the
first frame is gentle. A gateway that comes late plays later rather than dropping a frame. Twin of
the player in shared/src/robot/playing.ts.

Knows time and moves; no wire, no document.
"""

import asyncio
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Protocol

from servodeck.protocol.timings import MOVE, PLAY
from servodeck.protocol.values import Frame
from servodeck.value import value

# An event loop's timer may come so much too early.
CLOCK_GRAIN_MS = 0.001


class FrameSender(Protocol):
    def starts_within_ms(self, first: Frame) -> float:
        """Until the last servo of the first frame may start."""

    def move(self, frame: Frame) -> None: ...

    def is_waiting(self) -> bool:
        """The frame asked for last has not begun to leave: another one would take its place."""

    def frame_began(self, index: int) -> None: ...


@value
class Played:
    """What came of the deadlines. `late_frames` began so late that those behind them were put off, the latest
    by `latest_ms`. `skipped_frames` had not left when the next one took their place, or were refused.
    `is_whole`: the last frame has ended.
    """

    late_frames: int = 0
    latest_ms: int = 0
    skipped_frames: int = 0
    is_whole: bool = False


class Player:
    def __init__(
        self,
        frames: Sequence[Frame],
        times: int,
        loop_from: int,
        sender: FrameSender,
        now: Callable[[], float],
        over: Callable[[], None],
    ) -> None:
        """`times` 0: until stopped; each pass but the first begins with frame `loop_from`. `now` in seconds.
        `over`: the last frame has ended.
        """
        self.played = Played()
        self._frames = frames
        self._loop_from = loop_from
        self._count = len(frames) + (times - 1) * (len(frames) - loop_from) if times else math.inf
        self._sender = sender
        self._now = now
        self._over = over
        self._lead_ms = max(frames[0].duration_ms, MOVE.first_ms)
        self._deadline_ms = 0.0
        self._begun = 0
        self._earliest_ms = -math.inf
        """Not before: the frame under way would be cut short."""
        self._timer: asyncio.TimerHandle | None = None
        self._is_stopped = False

    def begin(self) -> None:
        self._deadline_ms = self._now_ms()
        self._begin_next()

    def lead_leaves(self) -> None:
        """The last move of the way to the first frame leaves now, not before: it is not to be cut short."""
        self._deadline_ms = max(self._deadline_ms, self._now_ms() + self._lead_ms)

    def refused(self) -> None:
        """A frame did not leave."""
        self.played = replace(self.played, skipped_frames=self.played.skipped_frames + 1)

    def stop(self) -> None:
        self._is_stopped = True
        if self._timer:
            self._timer.cancel()

    def _begin_next(self) -> None:
        if self._begun == self._count:
            self.played = replace(self.played, is_whole=True)
            self._over()
        elif self._may_begin():
            self._begin_frame()

    def _begin_frame(self) -> None:
        index = self._index_of(self._begun)
        frame, is_first = self._frames[index], self._begun == 0
        duration_ms = self._lead_ms if is_first else frame.duration_ms
        wait_ms = duration_ms + (self._sender.starts_within_ms(frame) if is_first else 0)
        self._sender.move(replace(frame, duration_ms=duration_ms))
        if self._is_stopped:
            return
        self._begun += 1
        self._deadline_ms += max(1, wait_ms)
        self._earliest_ms = self._now_ms() + wait_ms * (1 - PLAY.catch_up_share)
        self._wake_at(self._due_ms)
        self._sender.frame_began(index)

    def _may_begin(self) -> bool:
        """False: it is looked again."""
        late_ms = self._now_ms() - self._due_ms
        if late_ms < -CLOCK_GRAIN_MS:
            self._wake_at(self._due_ms)
            return False
        waits = self._begun > 0 and self._sender.is_waiting()
        if waits and late_ms < PLAY.give_up_ms:
            self._wake_at(self._now_ms() + PLAY.look_ms)
            return False
        if waits:
            self.refused()
        if late_ms >= PLAY.late_ms:
            self.played = replace(
                self.played,
                late_frames=self.played.late_frames + 1,
                latest_ms=max(self.played.latest_ms, round(late_ms)),
            )
        return True

    @property
    def _due_ms(self) -> float:
        return max(self._deadline_ms, self._earliest_ms)

    def _index_of(self, count: int) -> int:
        beyond, length = count - len(self._frames), len(self._frames)
        return count if beyond < 0 else self._loop_from + beyond % (length - self._loop_from)

    def _now_ms(self) -> float:
        return self._now() * 1000

    def _wake_at(self, at_ms: float) -> None:
        delay_s = max(0.0, at_ms / 1000 - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._begin_next)
