"""Frames that the gateway plays by its own clock: how far they are and how they ended. One play at a time.
Twin of shared/src/robot/playing.ts.

Knows frames, the moves that wait for the wire, and time; not who may begin a play, and not when somebody else
ends it.
"""

import asyncio
import logging
import secrets
from collections.abc import Callable, Sequence

from servodeck.errors import CancelledError, GatewayError, MovingError, OutOfRangeError
from servodeck.port.wire import Left
from servodeck.protocol.families import Family
from servodeck.protocol.limits import PacketError, check, check_range
from servodeck.protocol.values import Frame, Move, ServoTarget
from servodeck.robot.board.move_buffer import MoveBuffer, MoveRequest
from servodeck.robot.board.player import Player
from servodeck.robot.board.rules import extremes_of, refusal_of
from servodeck.robot.hub import Session
from servodeck.snapshots import PlayState
from servodeck.value import value

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
    try:
        for duration_ms in (min(times_ms), max(times_ms)):
            check_range("durationMs", duration_ms, family.duration_ms, "ms")
        for target in extremes:
            check(Move(max(times_ms), (target,)), family)
    except PacketError as error:
        raise refusal_of(error) from error
    return extremes


# Asked as each move leaves, whether it is the very first one; raises what keeps it from leaving.
Judge = Callable[[bool], None]


class Playing:
    """One play, the owner of its moves."""

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
    ) -> None:
        """`as_run`: its driver need not be heard more often than of a run of the board."""
        self.by = by
        self.as_run = as_run
        self.state = PlayState(
            id=secrets.token_hex(6),
            by=by.caller.name,
            status="playing",
            frame_index=0,
            frame_count=len(group.frames),
            times=group.times,
        )
        self.times = group.times
        self._moves = moves
        self._judge = judge
        self._has_begun = self._has_moved = False
        self._changed = changed
        self._over = over
        self._player = Player(group.frames, group.times, group.loop_from, self, now, lambda: over(self, None))
        self._request: MoveRequest | None = None
        """The present frame."""
        self._lead = {target.servo for target in group.frames[0].targets}
        """Those of them that have not begun to leave."""

    def begin(self) -> None:
        self._player.begin()

    def end(self) -> None:
        """Nothing of it leaves any more."""
        self._player.stop()
        self._request = None
        self._moves.drop(CancelledError("The group that this frame belongs to has ended."), self)

    def note_end(self, error: GatewayError | None) -> None:
        reason = {} if error is None else {"code": error.code, "detail": error.detail}
        self._update({"status": "ended" if error else "done", **reason})

    # What the player asks

    def starts_within_ms(self, first: Frame) -> float:
        return self._moves.starts_within_s([target.servo for target in first.targets]) * 1000

    def move(self, frame: Frame) -> None:
        is_lead = not self._has_moved
        self._has_moved = True
        request = self._request = MoveRequest(self, self._target_leaves)
        try:
            self._moves.put(frame.targets, frame.duration_ms, request)
        except GatewayError as error:
            self._over(self, error)
        else:
            request.left.add_done_callback(lambda left: self._left(left, is_lead=is_lead))

    def is_waiting(self) -> bool:
        return self._request is not None and self._moves.is_waiting(self._request)

    def frame_began(self, index: int) -> None:
        self._update({"frame_index": index})
        self._changed(self.state)

    # Inside

    def _target_leaves(self, target: ServoTarget, _starts: bool) -> None:
        self._judge(not self._has_begun)
        self._has_begun = True
        if target.servo in self._lead:
            self._lead.discard(target.servo)
            if not self._lead:
                self._player.lead_leaves()

    def _left(self, left: Left, *, is_lead: bool) -> None:
        """The way to the first frame is what makes the others gentle: without it none of them leaves."""
        error = None if left.cancelled() else left.exception()
        if self._request is None or not isinstance(error, GatewayError):
            return
        self._player.refused()
        if is_lead:
            self._over(self, error)

    def _update(self, what: dict[str, object]) -> None:
        played = self._player.played
        counts = {
            "late_frames": played.late_frames,
            "latest_ms": played.latest_ms,
            "skipped_frames": played.skipped_frames,
        }
        self.state = self.state.model_copy(update=counts | what)


class Plays:
    def __init__(
        self, moves: MoveBuffer, events: Callable[[PlayState], None], now: Callable[[], float]
    ) -> None:
        """`events` hears how far the latest one is."""
        self._moves = moves
        self._publish = events
        self._now = now
        self.present: Playing | None = None
        self.latest: PlayState | None = None
        self._ended: Callable[[PlayState], None] = lambda _: None
        self._published_s = float("-inf")
        self._publish_timer: asyncio.TimerHandle | None = None

    def begin(
        self,
        group: FrameGroup,
        by: Session,
        judge: Judge,
        ended: Callable[[PlayState], None],
        *,
        as_run: bool,
    ) -> PlayState:
        """Raises MovingError while another one lasts. `ended` hears how it ended, by whichever cause."""
        self.judge_idle()
        play = Playing(group, by, self._moves, self._now, judge, self._changed, self._finish, as_run=as_run)
        self.present, self._ended = play, ended
        facts = {"frames": len(group.frames), "times": group.times}
        log.info("play begun", extra={"facts": facts})
        play.begin()
        return play.state

    def end(self, error: GatewayError) -> None:
        """At once; the frame in progress goes on where it is not held."""
        if self.present:
            self._finish(self.present, error)

    def disown(self, caller_id: str, error: GatewayError) -> None:
        """That caller may not drive any more: ends the play that they began."""
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
        """At once, and not more often than anybody can see."""
        self.latest = state
        if self._publish_timer is None:
            delay_s = max(0.0, self._published_s + PUBLISH_EVERY_S - self._now())
            if delay_s:
                self._publish_timer = asyncio.get_running_loop().call_later(delay_s, self._publish_latest)
            else:
                self._publish_latest()

    def _finish(self, play: Playing, error: GatewayError | None) -> None:
        if play is not self.present:
            return
        self.present = None
        play.end()
        play.note_end(error)
        log.info("play %s", play.state.status, extra={"facts": {"code": play.state.code}})
        self.latest, ended = play.state, self._ended
        self._ended = lambda _: None
        self._publish_latest()
        ended(play.state)

    def _publish_latest(self) -> None:
        if self._publish_timer:
            self._publish_timer.cancel()
        self._publish_timer, self._published_s = None, self._now()
        if self.latest:
            self._publish(self.latest)
