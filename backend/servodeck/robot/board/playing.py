"""Frames that the gateway plays by its own clock: how far they are and how they ended. One play at a time.
Twin of shared/src/robot/playing.ts.

Knows frames, the moves that wait for the wire, and time; not who may begin or end a play.
"""

import asyncio
import logging
import math
import secrets
from collections.abc import Callable, Sequence
from dataclasses import replace

from servodeck.errors import CancelledError, GatewayError, MovingError, OutOfRangeError
from servodeck.port.wire import Left
from servodeck.protocol.families import Family, check, check_range
from servodeck.protocol.timings import MOVE, PLAY
from servodeck.protocol.values import Frame, Move, ServoTarget, extremes_of
from servodeck.robot.board.move_buffer import MoveBuffer, MoveRequest
from servodeck.robot.hub import Session, Throttle
from servodeck.snapshots import PlayState
from servodeck.value import value

# An event loop's timer may come so much too early.
CLOCK_GRAIN_MS = 0.001
# As often as other clients hear what left.
PUBLISH_EVERY_S = 0.05
log = logging.getLogger("servodeck.robot")


@value
class FrameGroup:
    """`times` 0: until stopped; each pass but the first begins with frame `loop_from`."""

    frames: Sequence[Frame]
    times: int
    loop_from: int


def judge_group(group: FrameGroup, family: Family) -> Sequence[ServoTarget]:
    """The least and the greatest position of each servo. Raises OutOfRangeError for what such a board cannot
    take, before anything of it leaves.
    """
    count = len(group.frames)
    if not 0 <= group.loop_from < count:
        raise OutOfRangeError(f"loopFrom is {group.loop_from}, allowed 0..{count - 1}")
    extremes = extremes_of(group.frames)
    times_ms = [frame.duration_ms for frame in group.frames]
    for duration_ms in (min(times_ms), max(times_ms)):
        check_range("durationMs", duration_ms, family.duration_ms, "ms")
    for target in extremes:
        check(Move(max(times_ms), (target,)), family)
    return extremes


# Called as each move leaves, with whether it is the very first one; raises what keeps it from leaving.
Judge = Callable[[bool], None]


class Playing:
    """One play, the owner of its moves: each on its deadline, counted from the start so that nothing drifts.
    The way to the first frame is gentle. A gateway that comes late plays later rather than dropping a frame.
    """

    def __init__(
        self,
        group: FrameGroup,
        by: Session,
        moves: MoveBuffer,
        now: Callable[[], float],
        judge: Judge,
        changed: Callable[[PlayState], None],
        over: Callable[["Playing", GatewayError | None], None],
        *,
        as_run: bool,
        is_battery_unknown: bool,
    ) -> None:
        """`as_run`: its driver need not be heard more often than of a run of the board."""
        self.by = by
        self.as_run = as_run
        frames, loop_from, times = group.frames, group.loop_from, group.times
        self.state = PlayState(
            id=secrets.token_hex(6),
            by=by.caller.name,
            status="playing",
            frame_index=0,
            frame_count=len(frames),
            times=times,
            battery_unknown=is_battery_unknown,
        )
        self.times = times
        self._frames = frames
        self._loop_from = loop_from
        self._count = len(frames) + (times - 1) * (len(frames) - loop_from) if times else math.inf
        self._moves = moves
        self._now = now
        self._judge = judge
        self._changed = changed
        self._over = over
        self._has_begun = self._is_stopped = False
        self._request: MoveRequest | None = None
        """The present frame."""
        self._lead = {target.servo for target in frames[0].targets}
        """The servos of the first frame that have not begun to leave."""
        self._lead_ms = max(frames[0].duration_ms, MOVE.first_ms)
        self._deadline_ms = 0.0
        self._earliest_ms = -math.inf
        """Not before: the frame under way would be cut short."""
        self._begun = 0
        self._timer: asyncio.TimerHandle | None = None

    def begin(self) -> None:
        self._deadline_ms = self._now_ms()
        self._begin_next()

    def end(self, error: GatewayError | None) -> None:
        """No frame begins any more. With `error` nothing of it leaves, else the last frame does."""
        self._is_stopped = True
        if self._timer:
            self._timer.cancel()
        self._request = None
        if error:
            self._moves.drop(CancelledError("The group that this frame belongs to has ended."), self)
        reason = {} if error is None else {"code": error.code, "detail": error.detail}
        self._update(status="ended" if error else "done", **reason)

    def _begin_next(self) -> None:
        if self._begun == self._count:
            self._over(self, None)
        elif self._may_begin():
            self._begin_frame()

    def _begin_frame(self) -> None:
        index, is_first = self._index_of(self._begun), self._begun == 0
        frame = self._frames[index]
        wait_ms: float = frame.duration_ms
        if is_first:
            frame = replace(frame, duration_ms=self._lead_ms)
            servos = [target.servo for target in frame.targets]
            wait_ms = self._lead_ms + self._moves.starts_within_s(servos) * 1000
        self._move(frame, is_lead=is_first)
        if self._is_stopped:
            return
        self._begun += 1
        self._deadline_ms += max(1, wait_ms)
        self._earliest_ms = self._now_ms() + wait_ms * (1 - PLAY.catch_up_share)
        self._wake_at(self._due_ms)
        self._update(frame_index=index)
        self._changed(self.state)

    def _may_begin(self) -> bool:
        """False: it is looked again."""
        late_ms = self._now_ms() - self._due_ms
        if late_ms < -CLOCK_GRAIN_MS:
            self._wake_at(self._due_ms)
            return False
        waits = self._request is not None and self._moves.is_waiting(self._request)
        if waits and late_ms < PLAY.give_up_ms:
            self._wake_at(self._now_ms() + PLAY.look_ms)
            return False
        if waits:
            self._count_skipped()
        if late_ms >= PLAY.late_ms:
            latest_ms = max(self.state.latest_ms, round(late_ms))
            self._update(late_frames=self.state.late_frames + 1, latest_ms=latest_ms)
        return True

    def _move(self, frame: Frame, *, is_lead: bool) -> None:
        request = self._request = MoveRequest(self, self._target_leaves)
        try:
            if not frame.targets:  # of a lead that names no servo nothing leaves at which it could be judged
                self._judge_begun()
            self._moves.put(frame.targets, frame.duration_ms, request)
        except GatewayError as error:
            self._over(self, error)
        else:
            request.left.add_done_callback(lambda left: self._left(left, is_lead=is_lead))

    def _target_leaves(self, target: ServoTarget, _starts: bool) -> None:
        self._judge_begun()
        if target.servo in self._lead:
            self._lead.discard(target.servo)
            if not self._lead:  # the way to the first frame leaves whole only now, and is not to be cut short
                self._deadline_ms = max(self._deadline_ms, self._now_ms() + self._lead_ms)

    def _judge_begun(self) -> None:
        self._judge(not self._has_begun)
        self._has_begun = True

    def _left(self, left: Left, *, is_lead: bool) -> None:
        """The way to the first frame is what makes the others gentle: without it none of them leaves."""
        error = None if left.cancelled() else left.exception()
        if self._request is None or not isinstance(error, GatewayError):
            return
        self._count_skipped()
        if is_lead:
            self._over(self, error)

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

    def _count_skipped(self) -> None:
        """A frame did not leave, because the next one took its place or it was refused."""
        self._update(skipped_frames=self.state.skipped_frames + 1)

    def _update(self, **changes: object) -> None:
        self.state = self.state.model_copy(update=changes)


class Plays:
    def __init__(
        self, moves: MoveBuffer, events: Callable[[PlayState], None], now: Callable[[], float]
    ) -> None:
        """`events` is called with the progress of the latest play."""
        self._moves = moves
        self._events = events
        self._now = now
        self._progress = Throttle(self._publish, PUBLISH_EVERY_S, now)
        self.present: Playing | None = None
        self.latest: PlayState | None = None
        self._ended: Callable[[PlayState], None] = lambda _: None

    def begin(
        self,
        group: FrameGroup,
        by: Session,
        judge: Judge,
        ended: Callable[[PlayState], None],
        *,
        as_run: bool,
        is_battery_unknown: bool,
    ) -> PlayState:
        """Raises MovingError while another one lasts. `ended` is called with its final state."""
        self.judge_idle()
        play = Playing(
            *(group, by, self._moves, self._now, judge, self._changed, self._finish),
            as_run=as_run,
            is_battery_unknown=is_battery_unknown,
        )
        self.present, self._ended = play, ended
        facts = {"frames": len(group.frames), "times": group.times}
        log.info("play begun", extra={"facts": facts})
        play.begin()
        return play.state

    def end(self, error: GatewayError) -> None:
        """At once; the frame in progress continues where it is not held."""
        if self.present:
            self._finish(self.present, error)

    def disown(self, caller_id: str, error: GatewayError) -> None:
        """Ends the play of that caller, which may not drive any more."""
        if self.present and self.present.by.caller.id == caller_id:
            self.end(error)

    def judge_idle(self) -> None:
        if self.present:
            state = self.present.state
            raise MovingError(
                f"{state.by} plays a group from here (frame {state.frame_index + 1} of {state.frame_count}): "
                "stop it, or wait for its end."
            )

    def _changed(self, state: PlayState) -> None:
        self.latest = state
        self._progress.soon()

    def _finish(self, play: Playing, error: GatewayError | None) -> None:
        if play is not self.present:
            return
        self.present = None
        play.end(error)
        log.info("play %s", play.state.status, extra={"facts": {"code": play.state.code}})
        self.latest, ended = play.state, self._ended
        self._ended = lambda _: None
        self._progress.at_once()
        ended(play.state)

    def _publish(self) -> None:
        if self.latest:
            self._events(self.latest)
