"""Moves that wait for the wire: the newest value of each servo, merged, as many in a packet as it takes, made
when the wire is free; and the next parts of those that are under way (parts.py). Servos of unknown place
start slowly and one after another (safety.md section 2).

Knows targets, time and the wire. The caller judges who may move a servo, at the request and again when each
packet leaves. Twin of shared/src/robot/moveBuffer.ts.
"""

import asyncio
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from math import inf
from typing import Protocol

from servodeck.callers import SHORTEST_WAIT_S
from servodeck.errors import GatewayError
from servodeck.port.link import Link
from servodeck.port.wire import CLOCK_GRAIN_S, Left, Owner, fail, settle
from servodeck.protocol import timings
from servodeck.protocol.families import Family
from servodeck.protocol.packets import MOVE, CommandPacket, encoded
from servodeck.protocol.values import ServoTarget
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.motion.parts import ServoOrder
from servodeck.value import value

FIRST_MOVE_MS = timings.MOVE.first_ms
FIRST_MOVE_STAGGER_S = timings.MOVE.first_stagger_ms / 1000


class MovedBoard(Protocol):
    @property
    def family(self) -> Family: ...
    @property
    def motion(self) -> Estimate: ...
    @property
    def link(self) -> Link: ...


@dataclass(eq=False, slots=True)
class MoveRequest:
    """One request. `judge` raises what keeps that target from leaving now; its second argument: it was begun
    before or may have waited, a later part or the servo's first move. `left` resolves when each value has
    begun to leave or a newer one has taken its place.
    """

    owner: Owner
    judge: Callable[[ServoTarget, bool], None]
    left: Left = field(default_factory=lambda: asyncio.get_running_loop().create_future())
    open: set[int] = field(default_factory=set)

    def done(self, servo: int) -> None:
        self.open.discard(servo)
        if not self.open:
            settle(self.left)


@value
class Wish:
    target: ServoTarget
    duration_ms: int
    request: MoveRequest
    round: int
    """It leaves behind the moves that waited when that round began."""


class MoveBuffer:
    def __init__(self, board: MovedBoard, now: Callable[[], float], changed: Callable[[], None]) -> None:
        """`changed` is called when other servos wait to start."""
        self._board = board
        self._now = now
        self._changed = changed
        self._wishes: dict[int, Wish] = {}
        self._going: dict[int, Wish] = {}
        """By servo: the request that moved it last, whose rest may leave in later parts."""
        self._queued: Left | None = None
        self._round = 0
        self._next_start_s = -inf
        self._timer: asyncio.TimerHandle | None = None
        self._part_timer: asyncio.TimerHandle | None = None
        self.waiting_to_start: list[int] = []
        """Servos that start from an unknown position, in the order of their starts."""

    @property
    def is_empty(self) -> bool:
        return not self._wishes and not self._board.motion.unfinished

    def is_waiting(self, request: MoveRequest) -> bool:
        """Something of it has not begun to leave."""
        return any(wish.request is request for wish in self._wishes.values())

    def starts_within_s(self, servos: Collection[int]) -> float:
        """Until the last of them has started, if no others are requested; others may be waiting already."""
        motion, now = self._board.motion, self._now()
        count = sum(motion.is_unknown(servo, now) for servo in {*self._wishes, *servos})
        return max(0.0, self._next_start_s - now) + (count - 1) * FIRST_MOVE_STAGGER_S if count else 0.0

    def put(self, targets: Sequence[ServoTarget], duration_ms: int, request: MoveRequest) -> Left:
        """`duration_ms` 0: as fast as the soft limit and the link allow. Raises where no port is open."""
        self._board.link.wire()
        for target in targets:
            before = self._wishes.get(target.servo)
            request.open.add(target.servo)
            self._wishes[target.servo] = Wish(target, duration_ms, request, self._round)
            if before and before.request is not request:
                before.request.done(target.servo)
        self._queue_up()
        return request.left

    def begin_round(self) -> int:
        """Later moves leave behind the packets that wait for the wire now."""
        self._round += 1
        self._queued = None
        return self._round

    def overtaken(self, servos: Collection[int], by_round: int) -> None:
        """Drops the targets of those servos from before that round, and what is left of their moves."""
        self._board.motion.drop_parts(servos)
        for servo in servos:
            self._going.pop(servo, None)
        for servo in servos:
            wish = self._wishes.get(servo)
            if wish and wish.round < by_round:
                del self._wishes[servo]
                wish.request.done(servo)
        self._plan_starts()

    def drop(self, reason: GatewayError, owner: Owner = None) -> None:
        """Drops the moves of `owner`, or all, and what is left of those under way."""
        motion = self._board.motion
        others = {servo for servo, wish in self._going.items() if owner not in (None, wish.request.owner)}
        motion.drop_parts([servo for servo in motion.unfinished if servo not in others])
        self._plan_part()
        for servo, wish in list(self._wishes.items()):
            if owner is None or wish.request.owner is owner:
                self._refuse(servo, reason)
        self._plan_starts()

    def _queue_up(self) -> None:
        if (self._queued and not self._queued.done()) or not (self._next_servos() or self._part_is_due()):
            return
        taken: list[Wish] = []
        this_round = self._round
        left = self._board.link.wire().send_made(MOVE, lambda: self._make(taken, this_round), self)
        left.add_done_callback(lambda left: self._left(taken, left))
        self._queued = left

    def _left(self, taken: Sequence[Wish], left: Left) -> None:
        settle_all(taken, left)
        self._plan_part()  # as many servos as are under way now make its packet

    def _make(self, taken: list[Wish], this_round: int) -> CommandPacket | None:
        """The next move; the wire is free for it."""
        if this_round == self._round:
            self._queued = None
        now, family, motion = self._now(), self._board.family, self._board.motion
        starts = self._start_due()
        for servo in self._next_servos():
            is_due = self._wishes[servo].round <= this_round and len(taken) < family.servos_per_move
            if is_due and self._may_leave(servo, starts=starts):
                taken.append(self._wishes.pop(servo))
        if starts and taken:
            self._next_start_s = now + FIRST_MOVE_STAGGER_S
        self._judge_parts(but={wish.target.servo for wish in taken})
        servos = [wish.target.servo for wish in taken]
        orders = [ServoOrder(wish.target.servo, wish.target.position, wish.duration_ms) for wish in taken]
        move = motion.take_part(orders, family.servos_per_move, first_ms(servos, motion, now), now)
        self._going |= {wish.target.servo: wish for wish in taken}
        self._plan_starts()
        self._plan_part()
        self._queue_up()
        return encoded(move, family) if move else None

    def _judge_parts(self, but: Collection[int]) -> None:
        """What its request may not move any more stands at the end of its part."""
        for servo in [servo for servo in self._board.motion.unfinished if servo not in but]:
            wish = self._going.get(servo)
            try:
                if wish:
                    wish.request.judge(wish.target, True)
            except GatewayError:
                self._board.motion.drop_parts([servo])

    def _part_is_due(self) -> bool:
        now = self._now()
        return self._board.motion.part_due_s(now) <= now + CLOCK_GRAIN_S

    def _plan_part(self) -> None:
        """Sets a timer for the next part."""
        if self._part_timer:
            self._part_timer.cancel()
            self._part_timer = None
        now = self._now()
        due_s = self._board.motion.part_due_s(now)
        if due_s < inf:
            delay_s = max(SHORTEST_WAIT_S, due_s - now)
            self._part_timer = asyncio.get_running_loop().call_later(delay_s, self._part_comes_due)

    def _part_comes_due(self) -> None:
        self._part_timer = None
        self._queue_up()
        if self._queued is None:  # a timer may fire a little early
            self._plan_part()

    def _next_servos(self) -> list[int]:
        """The servos that may leave now: one that starts, else all whose position is known."""
        unknown = self._unknown()
        if unknown and self._start_due():
            return unknown[:1]
        return [servo for servo in self._wishes if servo not in unknown]

    def _unknown(self) -> list[int]:
        motion, now = self._board.motion, self._now()
        return [servo for servo in self._wishes if motion.is_unknown(servo, now)]

    def _start_due(self) -> bool:
        return bool(self._unknown()) and self._now() >= self._next_start_s - CLOCK_GRAIN_S

    def _start(self) -> None:
        self._timer = None
        self._queue_up()
        if self._queued is None:  # a timer may fire a little early
            self._plan_starts()

    def _may_leave(self, servo: int, *, starts: bool) -> bool:
        wish = self._wishes[servo]
        try:
            wish.request.judge(wish.target, starts)
        except GatewayError as error:
            self._refuse(servo, error)
            return False
        return True

    def _refuse(self, servo: int, reason: GatewayError) -> None:
        fail(self._wishes.pop(servo).request.left, reason)

    def _plan_starts(self) -> None:
        """Publishes the servos that wait to start, and sets a timer for the next one."""
        if self._timer:
            self._timer.cancel()
            self._timer = None
        waiting = self._unknown()
        if waiting:
            delay_s = max(SHORTEST_WAIT_S, self._next_start_s - self._now())
            self._timer = asyncio.get_running_loop().call_later(delay_s, self._start)
        if waiting != self.waiting_to_start:
            self.waiting_to_start = waiting
            self._changed()


def settle_all(taken: Sequence[Wish], left: Left) -> None:
    """The outcome of a packet is that of each target in it."""
    error = None if left.cancelled() else left.exception()
    for wish in taken:
        if isinstance(error, GatewayError):
            fail(wish.request.left, error)
        else:
            wish.request.done(wish.target.servo)


def first_ms(servos: Collection[int], motion: Estimate, now: float) -> float:
    """The least duration of a move of these servos, in ms, where one of them starts from an unknown position
    or is still in its first move; else 0.

    """
    if any(motion.is_unknown(servo, now) for servo in servos):
        return FIRST_MOVE_MS
    return min(FIRST_MOVE_MS, motion.first_moves_ms(servos, now))
