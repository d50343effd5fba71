"""Requests of clients and scripts: each is checked against limits, latch, lease and the motion and downloads
in progress, and then passed to the board. Must not know how a client is connected, nor how a byte reaches the
port.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from servodeck.callers import Caller, Role
from servodeck.errors import (
    CancelledError,
    MalformedError,
    MovingError,
    NotSupportedError,
    OutOfRangeError,
)
from servodeck.port.wire import STOP_PACKET, Job, Left, Wire
from servodeck.protocol.families import FAMILIES, check
from servodeck.protocol.packets import (
    DOWNLOAD,
    ERASE,
    HARMLESS,
    MOVE,
    RUN,
    STOP,
    CommandPacket,
    check_command,
    encoded,
)
from servodeck.protocol.values import Command, Erase, Move, Run, ServoTarget
from servodeck.robot.board.board import Board
from servodeck.robot.board.download import Part, judge_parts
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.move_buffer import MoveRequest
from servodeck.robot.board.playing import FrameGroup, judge_group
from servodeck.robot.hub import Session
from servodeck.robot.latch import Latch, judge_latch
from servodeck.robot.lease import Lease, Permit
from servodeck.robot.profile import RobotLimits
from servodeck.snapshots import JobState, PlayState


class Requests:
    def __init__(
        self,
        board: Board,
        lease: Lease[Session],
        limits: RobotLimits,
        latch: Latch,
        now: Callable[[], float],
    ) -> None:
        self._board = board
        self._lease = lease
        self._limits = limits
        self._latch = latch
        self._now = now
        self.stop_count = 0
        """Requests to end a group or a play; not STOP."""

    def move(
        self, session: Session, targets: Sequence[ServoTarget], duration_ms: int, nonce: str | None
    ) -> Left:
        """The newest value of each servo counts; they leave together when the wire is free. `duration_ms` 0:
        as fast as the soft limit and the link allow. Resolves when each has left or a newer one has taken its
        place. Raises, or fails with, what keeps one from leaving.
        """
        board = self._board
        session.caller.require("driver")
        board.identification.judge_known()
        judge_named_once(targets)
        for target in targets:
            check(Move(duration_ms, (target,)), board.family)
        self._limits.judge(Move(duration_ms, tuple(targets)), session)
        board.link.wire()
        judge_latch(MOVE, self._latch.is_closed)
        board.jobs.judge_idle()
        self._judge_no_run()
        permit = self._lease.permit(session, nonce, self._now())
        return self._put_move(session, targets, duration_ms, permit)

    def move_by(self, session: Session, move: Move, permit: Permit) -> Left:
        """As `move`, with a permit."""
        self._judge_put(session, encoded(move, self._board.family), move)
        self._judge_no_run()
        return self._put_move(session, move.targets, move.duration_ms, permit)

    def _put_move(
        self, session: Session, targets: Sequence[ServoTarget], duration_ms: int, permit: Permit
    ) -> Left:
        board = self._board
        # Later parts, and servos that wait to start, may leave as long as the driver is heard.
        waiting = replace(permit, until_s=math.inf)

        def judge(target: ServoTarget, may_wait: bool) -> None:
            self._judge_driver(waiting if may_wait else permit)
            board.identification.judge_known()
            judge_latch(MOVE, self._latch.is_closed)
            self._judge_no_run()
            self._limits.judge(Move(duration_ms, (target,)), session)

        return board.moves.put(targets, duration_ms, MoveRequest(session, judge))

    def send(self, session: Session, packet_hex: str, nonce: str | None = None) -> Left:
        """Resolves when the packet has left the wire. Raises, or fails with, what keeps it from leaving. What
        is not harmless needs the lease and its `nonce`.
        """
        packet = judge_packet(packet_hex, self._board.family_id)
        command = packet.command
        assert command
        if isinstance(command, Erase):
            self._board.link.judge_carried("erase")
        session.caller.require(role_for(packet))
        self._limits.judge(command, session)
        wire = self._board.link.wire()
        if not packet.is_harmless:
            self._board.identification.judge_known()
        judge_latch(packet.number, self._latch.is_closed)
        if packet.number == DOWNLOAD:  # a frame alone only breaks the slot it goes to (S33, S35)
            raise NotSupportedError(
                "A single frame cannot be stored: use POST /api/download for a whole group."
            )
        if packet.number == STOP:
            return self.stop_once(session)
        self._judge_begun_by_hand(command)
        if packet.is_harmless:
            return wire.send(packet, session)
        permitted, moves = self._permitted(session, nonce), self._board.moves
        this_round = moves.begin_round()

        def judge() -> None:
            permitted()
            self._judge_under_way(command)
            if isinstance(command, Move):
                self._judge_hastened(command)
                moves.overtaken([target.servo for target in command.targets], this_round)

        return wire.send(packet, session, judge=judge)

    def _judge_begun_by_hand(self, command: Command) -> None:
        """Raises what keeps a packet that leaves as it is from beginning its motion now."""
        board = self._board
        board.jobs.judge_run(command, board.link.place)
        board.jobs.judge_idle()
        if isinstance(command, Run | Erase):
            board.plays.judge_idle()
        self._judge_under_way(command)

    def _judge_under_way(self, command: Command) -> None:
        """Also as it leaves: what waited before it may have begun meanwhile."""
        board = self._board
        if isinstance(command, Run) and board.activity.may_move():
            raise MovingError(still_moving(board.motion, self._now()))
        if isinstance(command, Move):
            self._judge_no_run()

    def put(self, session: Session, command: Command, permit: Permit) -> Left:
        """As `send`, with a permit."""
        packet = encoded(command, self._board.family)
        wire = self._judge_put(session, packet, command)
        return wire.send(packet, session, judge=lambda: self._judge_driver(permit))

    def _judge_put(self, session: Session, packet: CommandPacket, command: Command) -> Wire:
        board = self._board
        session.caller.require(role_for(packet))
        self._limits.judge(command, session)
        wire = board.link.wire()
        board.identification.judge_known()
        judge_latch(packet.number, self._latch.is_closed)
        board.jobs.judge_run(command, board.link.place)
        board.jobs.judge_idle()
        if isinstance(command, Run | Erase):
            board.plays.judge_idle()
        return wire

    def _judge_no_run(self) -> None:
        """A frame would make a moved servo faster, and the servo what the frame moves (S26)."""
        motion, now = self._board.motion, self._now()
        if motion.group_may_run(now):
            raise MovingError(end_of_group(motion.group_ends_in_s(now)))

    def _judge_hastened(self, move: Move) -> None:
        """A packet by hand leaves as it is, so one that would make another servo faster is refused."""
        rest_ms = self._board.motion.hastened_ms(move, self._now())
        if rest_ms:
            raise OutOfRangeError(
                f"Another servo is under way for {rest_ms} ms more and would get there as fast as this move. "
                "Give the packet that time at least, or wait."
            )

    def stop_once(self, session: Session) -> Left:
        """Ends the running group behind its frame in progress. It overtakes all that waits, and a run that it
        overtook does not start the group again behind it.
        """
        wire = self._board.link.wire()
        self.stop_count += 1
        # It always goes, but the frame that it meets on the board is not stored for sure (S10).
        self._board.jobs.end(CancelledError("A stop ended the download before it was complete."))
        self._board.plays.end(CancelledError("The group was stopped."))
        self._board.jobs.judge_idle()
        wire.purge(is_run, CancelledError("A stop was sent before this run."))
        return wire.send(STOP_PACKET, session, urgent=True)

    def play(
        self,
        session: Session,
        group: FrameGroup,
        permit_of: Callable[[], Permit],
        ended: Callable[[PlayState], None],
        *,
        as_run: bool,
        is_battery_unknown: bool,
    ) -> PlayState:
        """Begins to play it; raises what prevents it before a packet leaves."""
        board = self._board
        session.caller.require("driver")
        board.identification.judge_known()
        self._limits.judge_targets(judge_group(group, board.family))
        wire = board.link.wire()
        judge_latch(MOVE, self._latch.is_closed)
        board.jobs.judge_idle()
        board.plays.judge_idle()
        self._judge_no_run()
        if wire.has_waiting(RUN):
            raise MovingError(end_of_group(None))
        permit = permit_of()
        if permit.issued_s < self._latch.stopped_s:  # a large request may be slower than the STOP behind it
            raise CancelledError("STOP was pressed after this was requested.")

        def judge(is_first: bool) -> None:
            judge_latch(MOVE, self._latch.is_closed)
            if is_first:
                self._judge_driver(permit)
            elif board.unattended.by is not session:
                self._judge_driver(replace(permit, until_s=math.inf))

        return board.plays.begin(
            group, session, judge, ended, as_run=as_run, is_battery_unknown=is_battery_unknown
        )

    def stop_playing(self) -> None:
        """The play of the gateway ends with its frame in progress."""
        self.stop_count += 1
        self._board.plays.end(CancelledError("The group was stopped."))

    def download(
        self, parts: Sequence[Part], by: Caller, claim: Callable[[], object], behind: str | None = None
    ) -> JobState:
        """Begins to store them, or has the job `behind` which they come store them, too; raises what keeps it
        from that before anything is sent. `claim` raises where `by` may not.
        """
        board = self._board
        before = board.jobs.parts_of(behind) if behind else ()
        board.link.judge_carried("download")
        judge_parts((*before, *parts), board.family_id)
        for part in parts:
            self._limits.judge_targets(part.extremes)
            board.jobs.judge_replaced(part, board.link.place)
        if behind:
            claim()
            return board.jobs.add(behind, parts, by)
        wire = board.link.wire()
        board.identification.judge_known()
        judge_latch(DOWNLOAD, self._latch.is_closed)
        board.jobs.judge_idle()
        board.plays.judge_idle()
        is_clear = board.moves.is_empty and wire.is_clear_of(lambda number: number not in HARMLESS)
        if not (board.activity.is_at_rest() and is_clear):
            raise MovingError(still_moving(board.motion, self._now()))
        board.judge_before()
        claim()
        return board.jobs.begin(parts, by, board.link.place, wire)

    def _permitted(self, session: Session, nonce: str | None) -> Callable[[], None]:
        permit = self._lease.permit(session, nonce, self._now())
        return lambda: self._judge_driver(permit)

    def _judge_driver(self, permit: Permit) -> None:
        self._lease.judge(permit, self._now())


def judge_named_once(targets: Sequence[ServoTarget]) -> None:
    """Raises OutOfRangeError for a servo with two targets: which of them was meant is unknown."""
    seen: set[int] = set()
    for target in targets:
        if target.servo in seen:
            raise OutOfRangeError(f"Servo {target.servo} is named twice.")
        seen.add(target.servo)


def judge_packet(text: str, board: str) -> CommandPacket:
    """The packet in `text` (hex) when it is one command that board can take. Raises what is wrong with it."""
    try:
        packet = bytes.fromhex(text)
    except ValueError:
        raise MalformedError("The packet is not in hex digits.") from None
    return CommandPacket(check_command(packet, FAMILIES[board]), packet)


def role_for(packet: CommandPacket) -> Role:
    """The least role that may send it: questions do no harm, an erased board is empty for all clients."""
    if packet.number == STOP:
        return "stopper"
    if packet.is_harmless:
        return "viewer"
    return "owner" if packet.number == ERASE else "driver"


def still_moving(motion: Estimate, now: float) -> str:
    if motion.group_may_run(now):
        return end_of_group(motion.group_ends_in_s(now))
    if left_s := math.ceil(max(motion.moves_for_s(now), motion.restless_for_s(now)) * 10) / 10:
        return f"The robot moves for up to {left_s:.1f} s more: wait until then."
    return "The robot is about to move: wait until it rests."


def end_of_group(ends_in_s: float | None) -> str:
    if ends_in_s is None:
        return "A group may be running, and its end is unknown: stop it, or release the lease."
    return f"A group runs for up to {ends_in_s:.1f} s more: wait, or release the lease to end it."


def is_run(job: Job) -> bool:
    return job.number == RUN
