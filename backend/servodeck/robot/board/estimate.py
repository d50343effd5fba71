"""The state of the robot as the gateway knows it: the motion estimate, fed with the commands that left the
wire and the reports of the board, and the groups it stored itself. Twin of shared/src/robot/estimate.ts.

Pure: time comes in, in seconds. Knows commands and reports; no wire, no client.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from math import inf
from typing import Any

from servodeck.protocol.families import Family
from servodeck.protocol.timings import ESTIMATE, MOVE, RUN, STOP, wire_ms
from servodeck.protocol.values import (
    AllPositions,
    Command,
    Download,
    Erase,
    Erased,
    Frame,
    Move,
    Positions,
    Release,
    Report,
    Run,
    RunAccepted,
    RunFinished,
    RunStarted,
    RunStopped,
    SetSpeed,
    Stop,
)
from servodeck.robot.board.slots import GroupMemory
from servodeck.robot.motion.halt_plan import HaltPlan, Unheld, halt_plan, hold_after_stop, unheld_since
from servodeck.robot.motion.model import (
    UNKNOWN_MOTION,
    UnknownRun,
    either_of,
    farthest_from,
    forgotten,
    gentle_ms,
    held_at,
    inherited,
    only_released,
    position_at,
    remaining_ms,
    target_of,
    unknown_rest_ms,
)
from servodeck.robot.motion.motion import (
    advance,
    after_command,
    after_cut_packet,
    after_filler,
    hears,
    latest_end_ms,
)
from servodeck.robot.motion.parts import (
    ServoOrder,
    carries_all,
    interval_ms,
    is_unfinished,
    move_bytes,
    next_part,
    part_due_ms,
)
from servodeck.robot.motion.reports import after_cut, after_end, after_report, reports_end
from servodeck.robot.motion.tracks import last_end_ms, only, stands
from servodeck.snapshots import MotionState, ReportedPosition, ServoWay

# Longer than the board takes to report the start or end of a run: neither shall be taken for the next one's.
RUN_REPORT_MS = 500
# Seconds and milliseconds of one instant may differ by so much.
CLOCK_GRAIN_MS = 0.001
# An end later than that is a bound, for which no client waits.
LONGEST_SHOWN_MS = 3_600_000


class Estimate:
    def __init__(self, family: Family) -> None:
        self.family = family
        self._memory = GroupMemory()
        self._reported: dict[int, tuple[int, float]] = {}
        """By servo: the position that the board reported last, and when."""
        self._motion = UNKNOWN_MOTION
        self._at_ms = -inf
        """Until then everything is booked: the packet on the wire has left by then."""
        self._run: Run | None = None
        self._requested: Run | None = None
        """The run that left last."""
        self._run_at_ms = -inf
        self.is_acknowledged = False
        """The board has said that it received that run."""
        self._over_ms = -inf
        """The board may still report the end of its group until then, and is taken to play it."""
        self._unheard_until_ms = -inf
        """A move that the board may take up late has ended by then."""
        self._last_frame_until_ms = -inf
        """The last frame of a group that was ended, and whose frames are unknown, is over by then."""
        self._resumed_at_ms = -inf
        self._missed = UNKNOWN_MOTION
        """As it is if the board misses the packet on the wire."""
        self._cut: Command | None = None
        """What a loss of the link has cut last."""

    def played_frames(self, slot: int) -> Sequence[Frame] | None:
        return self._memory.played_frames(slot)

    def stored(self, slot: int, packets: Sequence[bytes], now: float) -> None:
        """That slot holds these packets now. A frame that was due began from its content before."""
        self._advance(now)
        self._memory.store(slot, packets)

    def left(self, command: Command, at_s: float) -> None:
        """The last bit of that command leaves then."""
        at_ms = self._advance(at_s)
        self._at_ms = at_ms
        if isinstance(command, Release):
            for servo in command.servos:  # it drops
                self._reported.pop(servo, None)
        self._missed = self._motion
        is_heard, ran = hears(self._motion, at_ms), self._motion.run
        self._change_memory(command, is_heard=is_heard)
        self._motion = after_command(self._motion, command, at_ms, self)
        is_ended = isinstance(ran, UnknownRun) and self._motion.run is None
        if is_ended and self._run_at_ms > self._resumed_at_ms:
            self._last_frame_until_ms = self._motion.restless_until_ms
        if isinstance(command, Run) and self._motion.run:
            self._run = self._requested = command
            self._run_at_ms, self._over_ms = at_ms, -inf
            self.is_acknowledged = False
        elif isinstance(command, Stop) and is_heard:
            self._over_ms = -inf
        elif isinstance(command, Move) and not is_heard:
            duration_ms = max(command.duration_ms, self.family.shortest_move_ms)
            # Deaf no more, it may still take the move for the rest of a packet that was cut, or not.
            self._unheard_until_ms = max(at_ms, self._motion.deaf_until_ms) + duration_ms

    def heard(self, report: Report, at_s: float) -> None:
        at_ms = self._advance(at_s)
        if isinstance(report, Positions | AllPositions):
            self._reported |= {one.servo: (one.position, at_s) for one in report.positions}
        if isinstance(report, Erased) and Erased in self._motion.answers_owed:
            self._memory.empty()
        if isinstance(report, RunAccepted):
            self.is_acknowledged = True
        if isinstance(report, RunStarted):
            self._started(report, at_ms)
        elif isinstance(report, RunFinished | RunStopped):
            self._ended(report, at_ms)
        else:
            self._motion = after_report(self._motion, report, at_ms, self)

    def resumed(self, now: float) -> None:
        """A person answers for what may continue of groups that were stopped before; it may all the same."""
        self._resumed_at_ms = self._advance(now)
        self._last_frame_until_ms = -inf

    def silent(self, now: float) -> None:
        """The board may have moved or restarted unseen; what ran may still run."""
        motion = self._motion
        if motion.tracks or any(held_at(motion.readings, servo) is not None for servo in motion.readings):
            self._forget(self._advance(now))

    def lost(self, now: float, cut: Command | None = None) -> None:
        """The link is gone: what the board does and holds is unknown. The command that was `cut` may have
        arrived or not, and where nothing ends it the board takes what comes next for its rest.
        """
        self._memory.clear()
        self._reported.clear()
        at_ms = self._advance(now)
        missed = forgotten(self._missed, at_ms, latest_end_ms(self._missed, self))
        self._forget(at_ms)
        if cut:
            self._motion = after_cut_packet(either_of(self._motion, missed), self.family)
            self._cut = cut

    def filled(self, at_s: float) -> None:
        """The last bit of the filler leaves then that ends the packet that was cut."""
        if isinstance(self._cut, Move):
            self._motion = after_filler(self._motion, self._cut, self._advance(at_s), self.family)

    def opened(self, now: float) -> None:
        """The last owner of the port may have set something in motion."""
        self.lost(now)
        self._motion = inherited(self._motion, self._advance(now))

    @property
    def may_swallow(self) -> bool:
        """The board may take what is sent next for the rest of a packet that was cut."""
        return self._motion.may_swallow > 0

    @property
    def deaf_until_s(self) -> float:
        """The board may not hear what leaves before."""
        return self._motion.deaf_until_ms / 1000

    @property
    def run(self) -> Run | None:
        """The group that may run: it was not stopped, and as far as is known it has not ended."""
        return self._run

    @property
    def _grace_ms(self) -> float:
        """A board that reports the end of its groups is waited for; where none is reported, ours counts."""
        return RUN.end_grace_ms if reports_end(self.family) else 0

    def run_begun_s(self) -> float:
        """When the run left that may run."""
        return self._run_at_ms / 1000

    def rests_in_s(self, now: float) -> float | None:
        """At most, until nothing may move any more; None where that is unknown."""
        if self.group_may_run(now):
            return self.group_ends_in_s(now)
        left_ms = self._motion.restless_until_ms - self._advance(now)
        return max(self.moves_for_s(now), left_ms / 1000)

    def group_may_run(self, now: float) -> bool:
        self._advance(now)
        return self._run is not None

    def group_ends_in_s(self, now: float) -> float | None:
        """At the latest, for a group that may run; None where only the board could report it."""
        now_ms = self._advance(now)
        end_ms = latest_end_ms(self._motion, self) + self._grace_ms if self._motion.run else self._over_ms
        left_ms = max(0.0, end_ms - now_ms)
        return None if left_ms > LONGEST_SHOWN_MS else left_ms / 1000

    def moves_for_s(self, now: float) -> float:
        """At most, as far as the moves go that it knows; a group is another matter."""
        now_ms = self._advance(now)
        return max(0.0, remaining_ms(self._motion, now_ms), self._unheard_until_ms - now_ms) / 1000

    def is_moving(self, now: float) -> bool:
        """A move is under way; a group is another matter, and what it moves."""
        now_ms = self._advance(now)
        is_on_its_way = self._run is None and remaining_ms(self._motion, now_ms) > CLOCK_GRAIN_MS
        return is_on_its_way or now_ms < self._unheard_until_ms

    def last_frame_may_move(self, now: float) -> bool:
        """Of a group that was ended, where it is unknown how long that takes."""
        now_ms = self._advance(now)
        return now_ms < min(self._last_frame_until_ms, self._motion.restless_until_ms)

    def restless_for_s(self, now: float) -> float:
        """At most, servos of which nothing is known may still move: in the last frame of an unknown group
        that was ended, also behind a resume. The last ticks of anything else do not count.
        """
        now_ms = self._advance(now)
        left_ms = self._motion.restless_until_ms - now_ms
        return left_ms / 1000 if left_ms > ESTIMATE.last_ticks_ms else 0.0

    def is_unknown(self, servo: int, now: float) -> bool:
        """It was not moved, and the board has not reported where it stands."""
        now_ms = self._advance(now)
        return target_of(self._motion, servo) is None and position_at(self._motion, servo, now_ms) is None

    def first_moves_ms(self, servos: Collection[int], now: float) -> float:
        """The time left of first moves that a move of those servos would make faster or slower."""
        return gentle_ms(self._motion, servos, self._advance(now), self.family)

    def take_part(
        self, orders: Sequence[ServoOrder], servos_per_move: int, least_ms: float, now: float
    ) -> Move | None:
        """The next packet: these orders, and the servos under way that have to go on with it (parts.py); None
        where nothing has to leave now. An order of 0 ms is as fast as the soft limit lets it be, from where
        the servo is when the packet arrives. It counts as sent. `least_ms`: of a first move.
        """
        now_ms = self._advance(now)
        servos = {order.servo for order in orders}
        if carries_all(self.family):
            least_ms = max(least_ms, unknown_rest_ms(self._motion, servos, now_ms))
        part = next_part(
            self._motion, self._timed(orders, now_ms), now_ms, self.family, servos_per_move, least_ms
        )
        if part is None:
            return None
        self._motion = replace(self._motion, courses=part.courses)
        return part.move

    def _timed(self, orders: Sequence[ServoOrder], now_ms: float) -> Sequence[ServoOrder]:
        """Those that are to go as fast as they may arrive together."""
        arrives_ms = now_ms + wire_ms(move_bytes(len(orders)))
        ways = [
            farthest_from(self._motion, order.servo, order.position, arrives_ms, self.family)
            for order in orders
            if order.duration_ms == 0
        ]
        swift_ms = max(soft_ms(max(ways, default=0), self.family), interval_ms(len(orders), self.family))
        return [replace(order, duration_ms=swift_ms) if order.duration_ms == 0 else order for order in orders]

    def part_due_s(self, now: float) -> float:
        """When the next part has to begin to leave, without a new order; infinite where none follows."""
        return part_due_ms(self._motion, self._advance(now)) / 1000

    @property
    def unfinished(self) -> Sequence[int]:
        """The servos that still have to be sent on."""
        return [servo for servo, course in self._motion.courses.items() if is_unfinished(course)]

    def drop_parts(self, servos: Collection[int]) -> None:
        """What is left of the moves of these servos is not sent."""
        courses = {servo: each for servo, each in self._motion.courses.items() if servo not in servos}
        self._motion = replace(self._motion, courses=courses)

    def hastened_ms(self, move: Move, now: float) -> int:
        """A move of that time would make another servo under way faster: how long it takes at least, else
        0.
        """
        now_ms = self._advance(now)
        if not carries_all(self.family):
            return 0
        moved = {target.servo for target in move.targets}
        others = only(
            self._motion.tracks, lambda track, servo: servo not in moved and not stands(track, now_ms)
        )
        rest_ms = math.ceil(last_end_ms(others, now_ms) - now_ms)
        return rest_ms if rest_ms > move.duration_ms + self.family.motion.tick_ms else 0

    def halt_plan(self, now: float, holds_to_follow: int = 0) -> HaltPlan:
        """The plan of a STOP pressed now: its hold, and the unheld motion."""
        return halt_plan(self._motion, self._advance(now), self, holds_to_follow)

    def hold(self, now: float) -> Move | None:
        """The move that holds the robot, if it begins to leave now, a gap behind a stop."""
        return hold_after_stop(self._motion, self._advance(now) - self.family.service_gap_ms, self)

    def hold_again(self, now: float) -> Move | None:
        """The same where the one before may not have been heard: the servos have gone on, and are not torn
        back. Where it was heard, nothing moves.
        """
        again = self.hold(now)
        if again is None:
            return None
        left_ms = remaining_ms(self._motion, self._advance(now))
        if left_ms <= CLOCK_GRAIN_MS:
            return replace(again, duration_ms=max(STOP.hold_again_ms, again.duration_ms))
        # A move under way takes no longer for being held again, and a tick that has begun is never cut.
        tick_ms = self.family.motion.tick_ms
        longest_ms = (1 + math.ceil(left_ms / tick_ms)) * tick_ms
        return replace(again, duration_ms=min(again.duration_ms, longest_ms))

    def unheld_since(self, pressed_s: float, now: float, holds_to_follow: int = 0) -> Unheld | None:
        """The unheld motion of a STOP pressed at `pressed_s`, whose last packet left just now."""
        return unheld_since(pressed_s * 1000, self._motion, self._advance(now), self, holds_to_follow)

    def snapshot(self, now: float) -> MotionState:
        """For a client that joins now."""
        self._advance(now)
        readings = self._motion.readings
        released = list(only_released(readings))
        reported = [
            ReportedPosition(
                servo=servo,
                position=position,
                age_ms=round((now - at_s) * 1000),
                is_current=servo in readings and readings[servo].position == position,
            )
            for servo, (position, at_s) in self._reported.items()
        ]
        if self._run:
            return MotionState(servos=[], run_slot=self._run.slot, released=released, reported=reported)
        ways = [
            ServoWay(
                servo=servo,
                start=None if track.start_leeway == inf else track.start,
                target=round(track.to),
                begun_ms_ago=round(now * 1000 - track.start_ms, 1),
                duration_ms=round(track.duration_ms, 1),
                **self._goal_of(servo, now),
            )
            for servo, track in self._motion.tracks.items()
            if track.to_leeway < inf
        ]
        return MotionState(servos=ways, run_slot=None, released=released, reported=reported)

    def _goal_of(self, servo: int, now: float) -> dict[str, Any]:
        course = self._motion.courses.get(servo)
        if course is None or not is_unfinished(course):
            return {}
        return {"goal": round(course.to), "goal_within_ms": round(course.end_ms - now * 1000, 1)}

    def _forget(self, at_ms: float) -> None:
        self._memory.forget_speeds()
        self._motion = forgotten(self._motion, at_ms, latest_end_ms(self._motion, self))

    def _advance(self, now: float) -> float:
        """Does what was due; returns the time in milliseconds."""
        now_ms = max(round(now * 1000, 6), self._at_ms)
        ran = self._motion.run
        end_ms = latest_end_ms(self._motion, self) if ran else -inf
        self._motion = advance(self._motion, now_ms, self)
        if ran and not self._motion.run:
            self._over_ms = end_ms + self._grace_ms
        if not self._motion.run and now_ms >= self._over_ms:
            self._run = None
        return now_ms

    def _change_memory(self, command: Command, *, is_heard: bool) -> None:
        match command:
            case Erase():
                self._memory.clear()
            case Download(slot):
                self._memory.clear(slot)
            case SetSpeed(slot, percent):
                self._memory.set_speed(slot, percent if is_heard else None)

    def _started(self, report: RunStarted, at_ms: float) -> None:
        """By a key or a pad at the board; one that was requested may have been stopped since."""
        is_ours = self._requested is not None and self._requested.slot == report.slot
        self.is_acknowledged = True
        if is_ours and self._run is None and at_ms - self._run_at_ms < RUN_REPORT_MS:
            return
        self._motion = after_report(self._motion, report, at_ms, self)
        if self._run is None or self._run.slot != report.slot:
            self._run, self._run_at_ms = Run(report.slot, report.times), at_ms

    def _ended(self, report: RunFinished | RunStopped, at_ms: float) -> None:
        """Where it may be the end of the run before, or another one may follow by itself, a group may still
        run.
        """
        run, end_ms = self._motion.run, latest_end_ms(self._motion, self)
        chained_slot = self.family.motion.chained_slot
        is_in_doubt = isinstance(run, UnknownRun) and (
            at_ms - self._run_at_ms < RUN_REPORT_MS
            or (
                isinstance(report, RunFinished)
                and chained_slot is not None
                and run.slot is not None
                and run.slot > chained_slot
            )
        )
        if isinstance(report, RunFinished):
            self._motion = after_end(self._motion, report.slot, at_ms, self)
        else:
            self._motion = after_cut(self._motion, at_ms, self)
        self._over_ms = end_ms if is_in_doubt else -inf
        self._advance(at_ms / 1000)


def soft_ms(way: float, family: Family) -> int:
    """The soft limit: so long a servo takes at least for that way, in board units."""
    share = way / (family.position.max - family.position.min)
    # Boards cut what is no whole tick.
    return math.ceil(share * MOVE.range_ms / family.motion.tick_ms) * family.motion.tick_ms
