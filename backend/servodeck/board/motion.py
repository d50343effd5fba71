"""Where the packets that left this wire have taken the servos: what a stop needs when no page tells it, and
what a script may ask for.

Pure: time comes in. Knows moves only: once a group may have run, the page's estimate (shared/src/motion)
knows more, and this one nothing but its end until the next moves have ended.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from math import inf

from servodeck.board.hearing import Hearing
from servodeck.protocol.families import Family
from servodeck.protocol.packets import encode, parse_command
from servodeck.protocol.values import (
    Command,
    Move,
    Release,
    Report,
    Run,
    RunFinished,
    RunStarted,
    RunStopped,
    ServoTarget,
    Stop,
)
from servodeck.told import MotionTold, ServoWay

SHORTEST_MOVE_MS = 20  # S25, S27
LONGEST_MOVE_MS = 30_000  # S25, L5
# Longer than the start or the end of a run takes to be told: neither shall be taken for the next one's.
RUN_TOLD_S = 0.5
# Any new target re-times every servo of these (S26); the others' servos keep their own time.
SHARED_TIME = frozenset({"doc", "openarm-old", "openarm-new"})
# A group that is not heard to end is over that long after its computed end.
END_GRACE_S = 1.5
# The end of this one starts the next ones (S49), each with a word of its own.
CHAIN_FROM_SLOT = 100
# A LeArm looks every 110 ms whether a frame is over (L7).
POLLED = frozenset({"learm-esp32", "learm-esp32-bus"})


@dataclass(frozen=True, slots=True)
class Track:
    """One servo's way; `start` is None where nobody knows where it began."""

    start: float | None
    target: int
    begin_s: float
    duration_s: float

    @property
    def end_s(self) -> float:
        return self.begin_s + self.duration_s

    def at(self, now: float) -> float | None:
        if now >= self.end_s:
            return self.target
        if self.start is None:
            return None
        return self.start + (self.target - self.start) * max(0.0, now - self.begin_s) / self.duration_s


class Motion:
    def __init__(self, family: Family) -> None:
        self._family = family
        self._tracks: dict[int, Track] = {}
        self._passes_s: dict[int, float] = {}
        self.run: Run | None = None
        """The group that may run: nobody has stopped it, and the board has not said that it ended."""
        self._asked: Run | None = None
        self._run_s = 0.0
        self._run_end_s = inf
        self._hearing = Hearing(family)
        self._restless_until_s = -inf
        """A move that the board may take up late has ended by then."""

    def stored(self, slot: int, durations_ms: Sequence[int]) -> None:
        """What that slot holds now, for sure."""
        slack_s, pace = (0.35, 1.2) if self._family.id in POLLED else (0.0, 1.0)
        self._passes_s[slot] = sum(ms / 1000 * pace + slack_s for ms in durations_ms)

    def unstored(self, slot: int) -> None:
        self._passes_s.pop(slot, None)

    @property
    def deaf_until_s(self) -> float:
        """The board may not hear what leaves before."""
        return self._hearing.deaf_until_s

    def group_may_run(self, now: float) -> bool:
        return self.run is not None and now < self._run_end_s

    def group_ends_in_s(self, now: float) -> float | None:
        """At the latest, for a group that may run; None where only the board could tell."""
        return None if math.isinf(self._run_end_s) else max(0.0, self._run_end_s - now)

    def left(self, packet: bytes, at_s: float) -> None:
        """The last bit of that packet leaves then."""
        command = parse_command(packet)
        was_deaf_until_s = self._hearing.deaf_until_s
        if command and not self._hearing.left(command, at_s):
            self._unheard(command, at_s)
            return
        if self._hearing.deaf_until_s != was_deaf_until_s:
            self._deafened(at_s)
        match command:
            case Move(duration_ms, targets) if not self.group_may_run(at_s):
                self._move(duration_ms, targets, at_s)
            case Run() as run:
                self._run_end_s = self._end_s(run, at_s)
                self._asked, self._run_s = run, at_s
                self._follow(run)
            case Stop():
                self.run = None
                self._stop(at_s)
            case Release(servos):
                for servo in servos:
                    self._tracks.pop(servo, None)

    def heard(self, report: Report, at_s: float) -> None:
        self._hearing.heard(report, at_s)
        if isinstance(report, RunStarted):
            self._started(Run(report.slot, report.times), at_s)
        may_chain = isinstance(report, RunFinished) and self.run and self.run.slot >= CHAIN_FROM_SLOT
        is_end = isinstance(report, RunFinished | RunStopped) and not may_chain
        if is_end and at_s - self._run_s >= RUN_TOLD_S:
            self.run = None

    def forget(self) -> None:
        """The board may have moved or restarted unseen: where nothing is known nothing is held either."""
        self._tracks.clear()
        self._restless_until_s = -inf

    def told(self, now: float) -> MotionTold:
        """As whoever comes now is told of it."""
        run = self.run if self.group_may_run(now) else None
        ways = [
            ServoWay(
                servo=servo,
                start=track.start,
                target=track.target,
                begun_ms_ago=round((now - track.begin_s) * 1000, 1),
                duration_ms=round(track.duration_s * 1000, 1),
            )
            for servo, track in self._tracks.items()
        ]
        return MotionTold(servos=ways, run_slot=run.slot if run else None)

    def is_moving(self, now: float) -> bool:
        """A move is under way; a group is another matter."""
        return now < self._restless_until_s or any(now < track.end_s for track in self._tracks.values())

    def is_unknown(self, servo: int) -> bool:
        """Nobody has said where it shall go, so nobody knows where it stands."""
        return servo not in self._tracks

    def first_moves_ms(self, servos: Collection[int], now: float) -> int:
        """How long first moves still take that a move of those servos would make faster or slower."""
        retimed = self._tracks if self._family.id in SHARED_TIME else servos
        tracks = [self._tracks[servo] for servo in retimed if servo in self._tracks]
        ends_s = [track.end_s for track in tracks if track.at(now) is None]
        return math.ceil((max(ends_s, default=now) - now) * 1000)

    def hold(self, now: float) -> bytes | None:
        """The move that freezes each servo whose place is known, as soon as that makes no other one jump."""
        known = {servo: track.at(now) for servo, track in self._tracks.items()}
        targets = tuple(ServoTarget(servo, round(at)) for servo, at in known.items() if at is not None)
        if not targets:
            return None
        targets = targets[: self._family.servos_per_move]
        command: Command = Move(
            self._hold_ms([servo for servo in known if known[servo] is None], now), targets
        )
        return encode(command, self._family)

    def _deafened(self, at_s: float) -> None:
        """Servos at rest stay; those under way freeze and jump (S29), but they arrive."""
        if self.run:
            self._run_end_s = inf
        until_s = self._hearing.deaf_until_s
        self._tracks = {
            servo: track
            if track.end_s <= at_s
            else replace(track, start=None, duration_s=max(track.end_s, until_s) - track.begin_s)
            for servo, track in self._tracks.items()
        }

    def _unheard(self, command: Command, at_s: float) -> None:
        """It is dropped or comes late: where it may move to is not known, and of what moved already only its
        end was. Whether a stop was heard nobody knows either.
        """
        if isinstance(command, Run):
            self._run_end_s, self._asked, self._run_s = inf, command, at_s
            self._follow(command)
            return
        aims = (
            {target.servo: target.position for target in command.targets} if isinstance(command, Move) else {}
        )
        freed = command.servos if isinstance(command, Release) else ()
        self._tracks = {
            servo: track
            for servo, track in self._tracks.items()
            if track.end_s <= at_s and aims.get(servo, track.target) == track.target and servo not in freed
        }
        if isinstance(command, Move):
            duration_s = max(command.duration_ms, SHORTEST_MOVE_MS) / 1000
            self._restless_until_s = self._hearing.deaf_until_s + duration_s

    def _end_s(self, run: Run, at_s: float) -> float:
        """Unknown behind another group, which goes on in its place (S46)."""
        pass_s = self._passes_s.get(run.slot)
        if pass_s is None or run.times == 0 or run.slot >= CHAIN_FROM_SLOT or self.group_may_run(at_s):
            return inf
        return at_s + pass_s * run.times + END_GRACE_S

    def _started(self, run: Run, at_s: float) -> None:
        """By a key or a pad at the board; one that was asked for may have been stopped since."""
        is_ours = self._asked and self._asked.slot == run.slot and at_s - self._run_s < RUN_TOLD_S
        if is_ours or (self.run and self.run.slot == run.slot):
            return
        self._run_end_s, self._run_s = inf, at_s
        self._follow(run)

    def _follow(self, run: Run) -> None:
        self.run = run
        self._tracks.clear()

    def _stop(self, at_s: float) -> None:
        """LeArms end moves, too, and not of all servos (L9)."""
        if self._family.id in POLLED:
            self._tracks = {servo: track for servo, track in self._tracks.items() if track.end_s <= at_s}

    def _hold_ms(self, unknown: list[int], now: float) -> int:
        """Boards of shared time would make a servo in its first move snap to its target (docs/adr/0002)."""
        if not unknown or self._family.id not in SHARED_TIME:
            return SHORTEST_MOVE_MS
        longest_s = max(self._tracks[servo].end_s for servo in unknown) - now
        return min(LONGEST_MOVE_MS, max(SHORTEST_MOVE_MS, round(longest_s * 1000)))

    def _move(self, duration_ms: int, targets: tuple[ServoTarget, ...], at_s: float) -> None:
        aims = {target.servo: target.position for target in targets}
        if self._family.id in SHARED_TIME:
            aims = {servo: track.target for servo, track in self._tracks.items()} | aims
        duration_s = min(max(duration_ms, SHORTEST_MOVE_MS), LONGEST_MOVE_MS) / 1000
        before = dict(self._tracks)
        for servo, position in aims.items():
            start = before[servo].at(at_s) if servo in before else None
            self._tracks[servo] = Track(start, position, at_s, duration_s)
