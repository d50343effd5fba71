"""The activity of the board: the estimate of its motion, the group that may run or that the gateway plays,
and the run that may continue without its driver; whether the board is silent, and whether it has received the
stops.

Knows packets, reports and time; no wire and no client, and not how a run is stopped.
"""

import asyncio
import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from servodeck.protocol.families import Family
from servodeck.protocol.packets import STOP, CommandPacket, encoded
from servodeck.protocol.timings import ESTIMATE, HEARTBEAT, LEASE
from servodeck.protocol.values import Command, Move, Report, Run
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.playing import Playing, Plays
from servodeck.robot.hub import Session
from servodeck.snapshots import ActivityState, Running, ShownRun, UnattendedRun
from servodeck.value import value

# A move that follows so soon is the same motion to a client: it hears of both only once.
LINGERS_S = ESTIMATE.last_ticks_ms / 1000
# Timers may fire as early as that.
SOONEST_S = 0.001
# A motion of unknown length is looked at so often.
LONGEST_WAIT_S = 3600.0


class Activity:
    def __init__(
        self,
        family: Family,
        plays: Plays,
        unattended: "Unattended",
        now: Callable[[], float],
        stop_again: Callable[[], object],
        run_ended: Callable[[], None],
        changed: Callable[[], None],
    ) -> None:
        """`stop_again` is called where the board may have missed the stops, `changed` when `state` is another
        besides its times.
        """
        self.unattended = unattended
        self._plays = plays
        self._now = now
        self._run_ended = run_ended
        self._motion = Estimate(family)
        self._silence = Silence()
        self._stop_again = StopAgain(
            now, lambda: self._motion.deaf_until_s, lambda: self._is_moving() and stop_again()
        )
        self._followed: Run | Playing | None = None
        self._changed = changed
        self._shown: tuple[object, ...] = (None, False)
        self._may_move = False
        self._looking: asyncio.TimerHandle | None = None

    @property
    def motion(self) -> Estimate:
        """A board that is silent may come back after its servos were turned by hand."""
        if self._silence.is_silent(self._now()):
            self._motion.silent(self._now())
        return self._motion

    @property
    def run(self) -> Run | Playing | None:
        """The motion that may continue without its driver: the group that may run, or that the gateway plays
        for a script.
        """
        play = self._plays.present
        return play if play and play.as_run else self.motion.run

    def may_move(self) -> bool:
        return self._plays.present is not None or self._is_moving()

    def may_still_move(self) -> bool:
        """Also with the last frame of a group that its driver has ended."""
        return self.may_move() or self.motion.last_frame_may_move(self._now())

    def running(self) -> Running | None:
        """The group of the board that may run, for clients."""
        motion, now = self.motion, self._now()
        if motion.run is None or not motion.group_may_run(now):
            return None
        ends_in_s = motion.group_ends_in_s(now)
        ends_in_ms = None if ends_in_s is None else math.ceil(ends_in_s * 1000)
        return Running(slot=motion.run.slot, times=motion.run.times, ends_in_ms=ends_in_ms)

    def state(self) -> ActivityState:
        """For clients."""
        running, motion = self.running(), self.motion
        if running is None:
            return ActivityState(running=None, may_move=self._may_move)
        shown = ShownRun(
            **running.model_dump(),
            begun_ms_ago=round((self._now() - motion.run_begun_s()) * 1000),
            acknowledged=motion.is_acknowledged,
        )
        return ActivityState(running=shown, may_move=self._may_move)

    def is_at_rest(self) -> bool:
        """Nothing moves, nor may anything unknown: flash work freezes servos and then lets them jump (S29,
        S39), and a move powers a released servo again (X7).
        """
        return not self.may_move() and self.motion.restless_for_s(self._now()) == 0

    def left(self, packet: CommandPacket, command: Command, at_s: float, *, is_halting: bool) -> None:
        """The last bit of that packet leaves then. `is_halting`: it is part of a stop sequence."""
        self.motion.left(command, at_s)
        if packet.number == STOP:
            self._stop_again.stopped(at_s)
        elif packet.is_harmless:
            self._silence.query_left(packet.number, at_s)
        elif not is_halting:
            self._stop_again.void()
        self.follow_run()

    def heard(self, report: Report, number: int) -> None:
        """`number`: of its packet."""
        self.motion.heard(report, self._now())
        self._stop_again.heard()
        self._silence.heard(number)  # after the estimate, which forgot positions in the silence
        self.follow_run()

    def follow_run(self) -> None:
        """A run may have begun or ended."""
        run, before = self.run, self._followed
        self._followed = run
        self.unattended.follow(run)
        if before and not run:
            self._run_ended()
        self._look()

    def hold(
        self, held: Sequence[CommandPacket], family: Family, *, is_again: bool = False
    ) -> CommandPacket | None:
        """As the robot stands when it leaves. The servos of the packets that are `held` are held already: a
        port may carry none that holds all of them. `is_again`: the hold before may not have been heard.
        """
        hold = (self.motion.hold_again if is_again else self.motion.hold)(self._now())
        if hold is None:
            return None
        moves = [packet.command for packet in held if isinstance(packet.command, Move)]
        servos = {target.servo for move in moves for target in move.targets}
        others = [target for target in hold.targets if target.servo not in servos]
        if not others:
            return None
        return encoded(replace(hold, targets=tuple(others[: family.servos_per_move])), family)

    def opened(self) -> None:
        """A port that was not lost before: its last owner may have begun a motion."""
        self._motion.opened(self._now())

    def lose(self, cut: Command | None = None) -> None:
        """The link is gone, and `cut` the command that it broke off."""
        self._motion.lost(self._now(), cut)
        self._silence = Silence()
        self._stop_again.void()
        self.unattended.follow(None)
        self._look()

    def filled(self, at_s: float) -> None:
        """The last bit of the filler leaves then that ends the packet that was cut."""
        self._motion.filled(at_s)
        self._look()

    def forget(self, family: Family) -> None:
        """It may be another board, and its last owner may have begun a motion."""
        self._motion = Estimate(family)
        self.opened()
        self.lose()

    def _look(self) -> None:
        """Whether anything moves has changed, or will without a further event."""
        if self._looking:
            self._looking.cancel()
            self._looking = None
        now = self._now()
        rests_in_s = self.motion.rests_in_s(now)
        moves = self._plays.present is not None or rests_in_s is None or rests_in_s > 0
        if moves:
            self._may_move, look_in_s = True, LONGEST_WAIT_S if rests_in_s is None else rests_in_s
            self._look_in(max(SOONEST_S, look_in_s), self._look)
        elif self._may_move:
            self._look_in(LINGERS_S, self._rests)
        self._show()

    def _look_in(self, seconds: float, look: Callable[[], None]) -> None:
        self._looking = asyncio.get_running_loop().call_later(seconds, look)

    def _rests(self) -> None:
        self._looking, self._may_move = None, False
        self._show()

    def _show(self) -> None:
        motion, now = self.motion, self._now()
        run = (motion.run, motion.run_begun_s()) if motion.group_may_run(now) else None
        shown = (run, run and motion.is_acknowledged, self._may_move)
        if shown != self._shown:
            self._shown = shown
            self._changed()

    def _is_moving(self) -> bool:
        return self.motion.group_may_run(self._now()) or self.motion.is_moving(self._now())


SILENT_S = LEASE.silent_ms / 1000
ANSWER_S = 0.5  # the longest answer, that for six positions, takes 450 ms (X7)


class Silence:
    def __init__(self) -> None:
        self._answered: set[int] = set()
        self._queried_s: float | None = None
        self._misses = 0

    def query_left(self, command: int, at_s: float) -> None:
        """The last bit of that question leaves at `at_s`."""
        is_due = self._is_due(at_s)
        if command in self._answered and (self._queried_s is None or is_due):
            self._misses += is_due
            self._queried_s = at_s

    def heard(self, command: int) -> None:
        self._answered.add(command)
        self._queried_s, self._misses = None, 0

    def is_silent(self, now: float) -> bool:
        return self._misses + self._is_due(now) >= HEARTBEAT.misses

    def _is_due(self, now: float) -> bool:
        return self._queried_s is not None and now - self._queried_s >= ANSWER_S


class StopAgain:
    """One more stop behind flash work, in which a board keeps one packet and drops the others (S9, S41,
    S53): a group could begin behind three stops.
    """

    def __init__(
        self, now: Callable[[], float], deaf_until_s: Callable[[], float], stop: Callable[[], object]
    ) -> None:
        self._now = now
        self._deaf_until_s = deaf_until_s
        self._stop = stop
        self._timer: asyncio.TimerHandle | None = None

    def stopped(self, at_s: float) -> None:
        """A stop leaves; its last bit then."""
        if at_s < self._deaf_until_s():
            self._plan()
        else:
            self.void()

    def heard(self) -> None:
        """The board has sent something, so it may receive packets from now on."""
        if self._timer:
            self._plan()

    def void(self) -> None:
        """Another motion has begun since, or the board has changed."""
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _plan(self) -> None:
        self.void()
        delay_s = max(0.0, self._deaf_until_s() - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._due)

    def _due(self) -> None:
        self._timer = None
        self._stop()


@value
class AllowedRun:
    run: Run | Playing
    by: Session
    until_s: float


@value
class AllowedMove:
    by: Session
    until_s: float


class Unattended:
    def __init__(
        self, now: Callable[[], float], over: Callable[[], None], changed: Callable[[], None]
    ) -> None:
        """`over` is called when its time has passed, `changed` when its state for clients has changed."""
        self._now = now
        self._over = over
        self._changed = changed
        self._present: AllowedRun | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._move: AllowedMove | None = None
        self._move_timer: asyncio.TimerHandle | None = None

    @property
    def by(self) -> Session | None:
        return self._present.by if self._present else None

    def snapshot(self) -> UnattendedRun | None:
        if self._present is None:
            return self._move_snapshot()
        run, left_s = self._present.run, max(0.0, self._present.until_s - self._now())
        slot = run.slot if isinstance(run, Run) else None
        return UnattendedRun(
            slot=slot, times=run.times, by=self._present.by.caller.name, ends_in_ms=round(left_s * 1000)
        )

    def _move_snapshot(self) -> UnattendedRun | None:
        if self._move is None:
            return None
        left_s = max(0.0, self._move.until_s - self._now())
        name = self._move.by.caller.name
        return UnattendedRun(slot=None, times=1, by=name, ends_in_ms=round(left_s * 1000), is_move=True)

    def allow(self, run: Run | Playing, by: Session, for_s: float) -> None:
        self._show(AllowedRun(run, by, self._now() + for_s))

    def allow_move(self, by: Session, for_s: float) -> None:
        """A move that ends by itself, also without the program that began it. Clients see it where it
        outlives that program's silence.
        """
        if for_s > SILENT_S:
            self._show_move(AllowedMove(by, self._now() + for_s))

    def end_move(self, but: Session | None = None) -> None:
        """It has ended or was stopped; that of `but` continues."""
        if self._move and self._move.by is not but:
            self._show_move(None)

    def end(self) -> None:
        """It has no owner any more, or its driver is back."""
        if self._present:
            self._show(None)

    def follow(self, run: Run | Playing | None) -> None:
        """`run` is the present run as far as is known; the permission was for one run alone."""
        if run:
            self.end_move()
        if self._present and self._present.run is not run:
            self._show(None)

    def _show_move(self, move: "AllowedMove | None") -> None:
        if self._move_timer:
            self._move_timer.cancel()
        self._move, self._move_timer = move, None
        if move:
            delay_s = move.until_s - self._now()
            self._move_timer = asyncio.get_running_loop().call_later(delay_s, self.end_move)
        self._changed()

    def _show(self, allowed: AllowedRun | None) -> None:
        if self._timer:
            self._timer.cancel()
        self._present, self._timer = allowed, None
        if allowed:
            delay_s = allowed.until_s - self._now()
            self._timer = asyncio.get_running_loop().call_later(delay_s, self._over)
        self._changed()
