"""Joins the parts: clients, lease, gate and board. Owns the latch and the robot's limits.

Knows what is asked and what may be done now. Must not know HTTP, WebSockets or how a byte reaches the port.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from servodeck.callers import Caller
from servodeck.errors import (
    CancelledError,
    LatchedError,
    MovingError,
    NotDrivingError,
    OutOfRangeError,
    PortLostError,
)
from servodeck.events import (
    BatteryMessage,
    HaltedMessage,
    JobMessage,
    NoiseMessage,
    PlayStateMessage,
    ReceivedMessage,
    ResumedMessage,
    RobotMessage,
)
from servodeck.files import Remembered
from servodeck.port.link import Ports
from servodeck.port.wire import STOP_PACKET, Job, Left, Owner
from servodeck.protocol.decoder import COMMAND_AT, DecoderEvent, PacketEvent
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.values import Command, Erase, Move, Run, ServoTarget
from servodeck.robot.board.board import Board
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.move_plan import judge_targets, packet_of
from servodeck.robot.board.moves import MoveRequest
from servodeck.robot.board.packet_rules import (
    DOWNLOAD,
    HARMLESS,
    MOVE,
    RUN,
    STOP,
    Part,
    is_harmless,
    judge_command,
    judge_latch,
    judge_parts,
    judge_single_packet,
    role_for,
)
from servodeck.robot.board.playing import FrameGroup, judge_group
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.broadcast import Broadcast, Relay
from servodeck.robot.driving import Driving
from servodeck.robot.hub import AGAINST_THE_RULES, Hub, Session
from servodeck.robot.latch import Cause, Latch, Watch
from servodeck.robot.lease import Permit
from servodeck.robot.motion.halt_plan import Unheld
from servodeck.robot.operations import Operations
from servodeck.robot.profile import ReadFacts, RecalledBoard, RobotLimits, RobotOfBoard, no_robot
from servodeck.snapshots import JobState, PlayState, UnheldServos

UNNAMED_PERSON = Cause("person")


class Control:
    def __init__(
        self,
        ports: Ports,
        now: Callable[[], float],
        board: str,
        named_device: str | None = None,
        *,
        simulated: bool = False,
        epoch: int = 0,
        slot_memory: SlotMemory | None = None,
        remembered: Remembered | None = None,
        recalls_board: bool = False,
        identifies_board: bool = False,
        polls_battery: bool = False,
        read_robot: ReadFacts = no_robot,
    ) -> None:
        """`named_device` is the port named at the start: always offered, even where the system does not list
        it. `simulated`: what is behind it is no real board. `epoch`: leases are counted on from there.
        Without `slot_memory` and `remembered` these are forgotten at the end.
        `recalls_board`: where nobody has said of which family the board is, it is as it was last.
        `identifies_board`: who it is, at each opening and before anything moves, and then whether it is still
        there; otherwise it is what it is taken for. `polls_battery`: the battery is read for everybody.
        `read_robot` asks the library.
        """
        self.named_device = named_device
        self.now = now
        self._latch = Latch(self._latch_changed)
        self.limits = RobotLimits()
        self.remembered = remembered or Remembered()
        self._recalled_board = RecalledBoard(self.remembered, is_wanted=recalls_board)
        self.robot = RobotOfBoard(self.limits, read_robot, self.remembered, self._robot_changed)
        self.hub = Hub()
        self._watch = Watch(self)
        self.driving = Driving(self.hub, now, epoch, self._watch)
        simulated_device = named_device if simulated else None
        self.board = Board(
            ports,
            now,
            board,
            simulated_device,
            slot_memory or SlotMemory(),
            self,
            identifies=identifies_board,
            polls_battery=polls_battery,
        )
        self._relay = Relay(self.hub, now, lambda: self.driving.driver)
        self._broadcast = Broadcast(self.hub, self.board, self._latch, self.robot, self.driving, now)
        self.operations = Operations(self)
        self._halting: Left | None = None
        self._pressed_s = 0.0
        self._stopped_s = -math.inf
        self._unheld: Unheld | None = None

    @property
    def latch(self) -> bool:
        """Motion is refused until somebody resumes."""
        return self._latch.cause is not None

    @property
    def unheld(self) -> UnheldServos | None:
        """What may go on in spite of the latest STOP."""
        unheld = self._unheld
        if unheld is None:
            return None
        servos = None if unheld.servos is None else list(unheld.servos)
        return UnheldServos(
            servos=servos, for_ms=None if unheld.for_ms == math.inf else math.ceil(unheld.for_ms)
        )

    # What clients ask

    def join(self, session: Session) -> None:
        """The welcome is the seat's first message."""
        self.hub.join(session)
        self._broadcast.welcome(session)
        self._broadcast.state(but=session)
        self.board.looked_at()
        self.driving.presence_changed(session)

    def leave(self, session: Session) -> None:
        """What waits of it does not leave, and what it still says is not heard. Twice is harmless."""
        session.ended.set()
        session.drop_pending()
        self.board.drop(session, CancelledError("The client disconnected."))
        self.limits.forget(session)
        self.hub.leave(session)
        self.driving.leave(session)
        self.driving.presence_changed(session)
        self._relay.forget(session)
        self._broadcast.state()

    def disconnect(
        self,
        caller_id: str,
        reason: str,
        by: str,
        *,
        still_drives: bool = False,
        group_goes_on: bool = False,
        also: Sequence[Session] = (),
    ) -> None:
        """What they move stops, what they still say is not heard, and nothing that they asked for leaves any
        more but stops. `still_drives`: they may come back and drive, so their download goes on, and the group
        that they let go on. `also`: seats of theirs that are no client's.
        """
        self._watch.disconnected(caller_id, by, group_goes_on=group_goes_on or still_drives)
        if not still_drives:
            self.board.jobs.disown(caller_id, CancelledError(reason))
        for session in (*self.hub.sessions, *also):
            if session.caller.id == caller_id:
                session.end(AGAINST_THE_RULES, reason)
                self.board.drop(session, CancelledError(reason))
                self.leave(session)

    def move(
        self, session: Session, targets: Sequence[ServoTarget], duration_ms: int, nonce: str | None
    ) -> Left:
        """The newest value of each servo counts; they leave together when the wire is free. `duration_ms` 0:
        as fast as the soft limit and the link allow. Resolves when each has left or a newer one has taken its
        place. Raises, or fails with, what keeps one from leaving.
        """
        board, driving = self.board, self.driving
        session.caller.require("driver")
        board.judge_known()
        judge_targets(targets, duration_ms, board.family)
        self.limits.judge(Move(duration_ms, tuple(targets)), session)
        board.link.wire()
        judge_latch(MOVE, self.latch)
        board.jobs.judge_idle()
        permit = driving.permit(session, nonce)
        # Whoever waits to start may do so as long as the driver is heard.
        waiting = replace(permit, until_s=math.inf)

        def judge(target: ServoTarget, starts: bool) -> None:
            driving.judge(waiting if starts else permit)
            board.judge_known()
            judge_latch(MOVE, self.latch)
            self.limits.judge(Move(duration_ms, (target,)), session)

        return board.moves.put(targets, duration_ms, MoveRequest(session, judge))

    def send(self, session: Session, packet_hex: str, nonce: str | None = None) -> Left:
        """Resolves when the packet has left the wire. Raises, or fails with, what keeps it from leaving. What
        is not harmless needs the lease and its `nonce`.
        """
        packet, command = judge_command(packet_hex, self.board.family_id)
        if isinstance(command, Erase):
            self.board.judge_carried("erase")
        session.caller.require(role_for(packet))
        self.limits.judge(command, session)
        wire = self.board.link.wire()
        if not is_harmless(packet):
            self.board.judge_known()
        judge_latch(packet[COMMAND_AT], self.latch)
        judge_single_packet(packet)
        if packet[COMMAND_AT] == STOP:
            return self.stop_once(session)
        self.board.jobs.judge_run(command, self.board.link.place)
        self.board.jobs.judge_idle()
        if isinstance(command, Run | Erase):
            self.board.plays.judge_idle()
        if is_harmless(packet):
            return wire.send(packet, session)
        left = wire.send(packet, session, judge=self._permitted(session, nonce))
        self.board.moves.begin_round()
        return left

    def put(self, session: Session, command: Command, permit: Permit) -> Left:
        """As `send`, of somebody who may have that command sent."""
        board = self.board
        packet = packet_of(command, board.family)
        session.caller.require(role_for(packet))
        self.limits.judge(command, session)
        wire = board.link.wire()
        board.judge_known()
        judge_latch(packet[COMMAND_AT], self.latch)
        board.jobs.judge_run(command, board.link.place)
        board.jobs.judge_idle()
        if isinstance(command, Run | Erase):
            board.plays.judge_idle()
        return wire.send(packet, session, judge=lambda: self.driving.judge(permit))

    def stop_once(self, session: Session) -> Left:
        """Ends the running group behind its frame in progress. It overtakes all that waits, and a run that it
        overtook does not start the group again behind it.
        """
        wire = self.board.link.wire()
        # It always goes, but the frame that it meets on the board is not stored for sure (S10).
        self.board.jobs.end(CancelledError("A stop ended the download before it was complete."))
        self.board.plays.end(CancelledError("The group was stopped."))
        self.board.jobs.judge_idle()
        wire.purge(is_run, CancelledError("A stop was sent before this run."))
        return wire.send(STOP_PACKET, session, urgent=True)

    def stop(self, cause: Cause = UNNAMED_PERSON) -> Left:
        """Latches in any case. Resolves when the stop sequence has left; raises when there is no port to
        stop. What may go on in spite of it `unheld` says.
        """
        self._stopped_s = self.now()
        self._latch.close(cause)
        self.board.jobs.end(LatchedError("STOP ended the download before it was complete."))
        left = self.board.halt(LatchedError("STOP was pressed before this was sent."))
        if left is not self._halting:
            self._halting, self._pressed_s = left, self.now()
            left.add_done_callback(self._halted)
        return left

    def resume(self, caller: Caller, session: Session | None = None) -> None:
        """Everybody but `session` hears whose word it was. Raises NotDrivingError while somebody else drives.
        Refused while the port is lost: whoever resumes shall see the robot's answer.
        """
        self.driving.judge_resume(caller)
        port = self.board.link.state
        if port.status == "lost":
            raise PortLostError(port.detail or "The serial port is lost.")
        if self._latch.open():
            self.board.motion.resumed(self.now())
            self._broadcast.everybody(ResumedMessage(by=caller.name), but=session)

    def name_board(self, caller: Caller, board: str) -> None:
        """Raises NotDrivingError where somebody else drives whatever else it was."""
        if board != self.board.family_id and not self.driving.may_rule(caller):
            raise NotDrivingError("Another client drives: only the driver or an owner may choose the board.")
        self.choose_family(board)

    def choose_family(self, board: str) -> None:
        """What every later packet is judged by, where its answers do not contradict; `unknown` has it asked
        again, and lets only harmless questions pass.
        """
        if board not in FAMILIES:
            raise OutOfRangeError(f"board is {board}, allowed: {', '.join(FAMILIES)}")
        self.board.choose_family(board)
        self._recalled_board.said(self.board)
        self._see_robot()

    def allow_unattended(self, session: Session, for_ms: int | None) -> None:
        """The run under way, without its driver; None: not any more."""
        if self.driving.driver is not session:
            raise NotDrivingError("Only the driver may let a run continue.")
        if for_ms is None:
            self.board.unattended.end()
            return
        run = self.board.run
        if run is None:
            raise CancelledError("Nothing is running.")
        self.board.unattended.allow(run, session, for_ms / 1000)

    def play(
        self,
        session: Session,
        group: FrameGroup,
        nonce: str | None,
        ended: Callable[[PlayState], None],
        *,
        as_run: bool = False,
    ) -> PlayState:
        """Begins to play it; raises what keeps it from that before anything leaves. `ended` hears how it
        ended. `as_run`: it ends with the silence that ends a run of the board, not with the one that ends
        what is driven by hand.
        """
        board = self.board
        session.caller.require("driver")
        board.judge_known()
        self.limits.judge_targets(judge_group(group, board.family))
        wire = board.link.wire()
        judge_latch(MOVE, self.latch)
        board.jobs.judge_idle()
        board.plays.judge_idle()
        if board.motion.group_may_run(self.now()) or wire.has_waiting(RUN):
            raise MovingError(end_of_group(board.motion.group_ends_in_s(self.now())))
        permit = self.driving.permit(session, nonce)
        if permit.issued_s < self._stopped_s:  # a large request may be slower than the STOP behind it
            raise CancelledError("STOP was pressed after this was requested.")

        def judge(is_first: bool) -> None:
            judge_latch(MOVE, self.latch)
            if is_first:
                self.driving.judge(permit)
            elif board.unattended.by is not session:
                self.driving.judge(replace(permit, until_s=math.inf))

        return board.plays.begin(group, session, judge, ended, as_run=as_run)

    def stop_playing(self) -> None:
        """What the gateway plays ends with its frame in progress."""
        self.board.plays.end(CancelledError("The group was stopped."))

    def download(
        self, parts: Sequence[Part], by: Caller, claim: Callable[[], object], behind: str | None = None
    ) -> JobState:
        """Begins to store them, or has the job `behind` which they come store them, too; raises what keeps it
        from that before anything is sent. `claim` raises where `by` may not.
        """
        board = self.board
        before = board.jobs.parts_of(behind) if behind else ()
        board.judge_carried("download")
        judge_parts((*before, *parts), board.family_id)
        for part in parts:
            self.limits.judge_targets(part.extremes)
            board.jobs.judge_replaced(part, board.link.place)
        if behind:
            claim()
            return board.jobs.add(behind, parts, by)
        wire = board.link.wire()
        board.judge_known()
        judge_latch(DOWNLOAD, self.latch)
        board.jobs.judge_idle()
        board.plays.judge_idle()
        is_clear = board.moves.is_empty and wire.is_clear_of(lambda command: command not in HARMLESS)
        if board.may_move() or not is_clear:
            raise MovingError(still_moving(board.motion, self.now()))
        claim()
        return board.jobs.begin(parts, by, board.link.place, wire)

    async def use_port(self, device: str, board: str | None = None) -> None:
        await self.board.quiet()
        self.robot.leave()
        if board:
            self._recalled_board.is_wanted = True
            self.board.recall(board)
        await self.board.link.use(device)
        if board:
            self._recalled_board.said(self.board)

    async def close_port(self) -> None:
        await self.board.quiet()
        self.robot.leave()
        await self.board.link.close()

    async def shut_down(self) -> None:
        """Stops the robot whatever it does and lets go of the port. Twice is harmless."""
        self._latch.cause = UNNAMED_PERSON  # nobody starts it again behind the stops
        await self.board.shut_down()
        self.hub.close()

    # What the board tells

    def port_opened(self) -> None:
        self._recalled_board.port_opened(self.board)

    def board_lost(self) -> None:
        self._latch.cause = Cause("loss")  # the change of the link's state follows and tells both

    def stopped_at_return(self, opened_s: float) -> None:
        self._tell_unheld(opened_s)

    def is_watched(self) -> bool:
        return len(self.hub) > 0

    def board_changed(self) -> None:
        self._broadcast.state()
        self._see_robot()

    def battery_changed(self) -> None:
        self._broadcast.everybody(BatteryMessage(battery=self.board.battery.snapshot()))

    def job_changed(self, state: JobState) -> None:
        self._broadcast.everybody(JobMessage(job=state))

    def play_changed(self, state: PlayState) -> None:
        self._broadcast.everybody(PlayStateMessage(play=state))

    def unattended_time_over(self) -> None:
        self._watch.end_quietly(CancelledError("The time allowed without a driver is over."))

    def received(self, event: DecoderEvent) -> None:
        is_packet = isinstance(event, PacketEvent)
        text = event.bytes.hex()
        self._relay.send_left()  # a question before its answer
        self._broadcast.everybody(ReceivedMessage(packet=text) if is_packet else NoiseMessage(bytes=text))

    def may_have_missed_stops(self) -> None:
        if self.latch:
            self.board.halt_again()

    def leaving(self, owner: Owner, packet: bytes, at_s: float) -> None:
        self._relay.leaving(owner, packet, at_s)

    # Inside

    def _permitted(self, session: Session, nonce: str | None) -> Callable[[], None]:
        permit = self.driving.permit(session, nonce)
        return lambda: self.driving.judge(permit)

    def _see_robot(self) -> None:
        link = self.board.link
        if link.state.status == "open":
            self.robot.use_board(self.board.family_id, link.place)

    def _latch_changed(self) -> None:
        self._broadcast.state()

    def _robot_changed(self) -> None:
        self._broadcast.everybody(RobotMessage(robot=self.robot.snapshot()))

    def _halted(self, left: Left) -> None:
        if not left.cancelled() and left.exception() is None:
            self._tell_unheld(self._pressed_s)

    def _tell_unheld(self, since_s: float) -> None:
        self._unheld = self.board.unheld_since(since_s)
        self._broadcast.everybody(HaltedMessage(unheld=self.unheld))


def still_moving(motion: Estimate, now: float) -> str:
    if motion.group_may_run(now):
        return end_of_group(motion.group_ends_in_s(now))
    if left_s := math.ceil(motion.moves_for_s(now) * 10) / 10:
        return f"The robot moves for up to {left_s:.1f} s more: wait until then."
    return "The robot is about to move: wait until it rests."


def end_of_group(ends_in_s: float | None) -> str:
    if ends_in_s is None:
        return "A group may be running, and its end is unknown: stop it, or release the lease."
    return f"A group runs for up to {ends_in_s:.1f} s more: wait, or release the lease to end it."


def is_run(job: Job) -> bool:
    return job.command == RUN
