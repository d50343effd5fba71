"""Joins the parts: clients, lease, latch, board and robot profile; stops and resumes the robot.

requests.py judges all other requests. Must not know HTTP, WebSockets or how a byte reaches the port.
"""

import asyncio
import contextlib
import math
from collections.abc import Callable, Sequence

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
from servodeck.packet_models import report_model
from servodeck.port.diagnosis import Heard
from servodeck.port.link import Ports
from servodeck.port.wire import Left, Owner
from servodeck.protocol.decoder import NoiseEvent
from servodeck.protocol.families import FAMILIES, UNKNOWN, Family
from servodeck.protocol.timings import MOVE
from servodeck.protocol.values import Command, Report
from servodeck.robot.acts import Acts
from servodeck.robot.battery_guard import BatteryGuard
from servodeck.robot.board.board import Board
from servodeck.robot.board.port_families import PortFamilies
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.broadcast import Broadcast
from servodeck.robot.driving import Driving
from servodeck.robot.hub import AGAINST_THE_RULES, Hub, Relay, Session
from servodeck.robot.latch import Cause, Latch, Watch
from servodeck.robot.motion.halt_plan import Unheld
from servodeck.robot.operations import Operations
from servodeck.robot.profile import ReadFacts, RobotLimits, RobotOfBoard, no_robot
from servodeck.robot.requests import Requests
from servodeck.snapshots import JobState, LatchedBy, PlayState, UnheldServos

UNNAMED_PERSON = Cause("person")
# Longer than a port takes to open and a LeArm to start and to be identified (L1).
IDENTIFIED_WITHIN_S = 8.0
# Longer than the longest frame that others can have begun.
SETTLED_WITHIN_S = MOVE.longest_ms / 1000 + 1


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
        is_monitored: bool = False,
        read_robot: ReadFacts = no_robot,
    ) -> None:
        """`named_device` is the port named at the start: always offered, even where the system does not list
        it. `simulated`: it leads to a simulated board. `epoch`: the first epoch of the leases. `slot_memory`
        and `remembered` outlive the process; without them nothing does. `board` is the family at the port
        that is used first; `recalls_board`: an unknown one is the one chosen last for the port.
        `identifies_board`: the board is identified at each opening, before anything moves, and watched
        afterwards, unless it is a simulated one that is what its starter names; otherwise it is taken for the
        family that was named for its port. `polls_battery`: the battery is read for all clients.
        `is_monitored`: also while no client is connected. `read_robot` reads the library.
        """
        self.named_device = named_device
        self._is_monitored = is_monitored
        self.now = now
        self.acts = Acts()
        self._latch = Latch(self._latch_changed)
        self.limits = RobotLimits()
        self.remembered = remembered or Remembered()
        family = FAMILIES[board]
        is_named = not (recalls_board and family is UNKNOWN)
        self._families = PortFamilies(
            self.remembered, family if is_named else None, named_device if simulated else None
        )
        self.robot = RobotOfBoard(self.limits, read_robot, self.remembered, self._robot_changed)
        self.hub = Hub()
        self._watch = Watch(self)
        self.driving = Driving(self.hub, now, epoch, self._watch)
        self._relay = Relay(self.hub, now, lambda: self.driving.driver)
        self.board = Board(
            ports,
            now,
            family,
            self._families,
            slot_memory or SlotMemory(),
            self,
            self._leaving,
            identifies=identifies_board,
            polls_battery=polls_battery,
        )
        self._broadcast = Broadcast(self.hub, self.board, self._latch, self.robot, self.driving, now)
        self.battery_guard = BatteryGuard(self.board, self.robot, now)
        self.requests = Requests(self.board, self.driving.lease, self.limits, self._latch, now)
        self.operations = Operations(self)
        self._halting: Left | None = None
        self._changed = asyncio.Event()
        self._pressed_s = 0.0
        self._unheld: Unheld | None = None

    @property
    def latch(self) -> bool:
        """Motion is refused until a person resumes."""
        return self._latch.is_closed

    @property
    def latched_by(self) -> LatchedBy | None:
        """Why motion is refused; None while it is not."""
        return self._latch.by

    @property
    def stopped_by(self) -> str | None:
        """The name of the person who pressed STOP, if known."""
        return self._latch.name

    @property
    def stopped_s(self) -> float:
        """Time of the latest STOP; before any, minus infinity."""
        return self._latch.stopped_s

    @property
    def unheld(self) -> UnheldServos | None:
        """Motion that the latest STOP could not hold."""
        unheld = self._unheld
        if unheld is None:
            return None
        servos = None if unheld.servos is None else list(unheld.servos)
        return UnheldServos(
            servos=servos, for_ms=None if unheld.for_ms == math.inf else math.ceil(unheld.for_ms)
        )

    # Requests of clients

    def join(self, session: Session) -> None:
        """The welcome is the first message of the session."""
        self.hub.join(session)
        self._broadcast.welcome(session)
        self._broadcast.state(but=session)
        self.board.battery.client_joined()
        self.driving.presence_changed(session)

    def leave(self, session: Session) -> None:
        """Its waiting packets are dropped, and its later messages ignored. May be called twice."""
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
        run_continues: bool = False,
        also: Sequence[Session] = (),
    ) -> None:
        """Stops the motion of that caller, ignores its later messages, and drops its packets, except stops.
        `still_drives`: it may connect again and drive, so its download and its unattended group continue.
        `also`: its sessions that are not connected clients.

        """
        self._watch.disconnected(caller_id, by, run_continues=run_continues or still_drives)
        if not still_drives:
            self.board.jobs.disown(caller_id, CancelledError(reason))
        for session in (*self.hub.sessions, *also):
            if session.caller.id == caller_id:
                session.end(AGAINST_THE_RULES, reason)
                self.board.drop(session, CancelledError(reason))
                self.leave(session)

    def stop(self, cause: Cause = UNNAMED_PERSON) -> Left:
        """Latches in any case. Resolves when the stop sequence has left; raises when there is no port to
        stop. `unheld` has the motion that could not be held.
        """
        self._latch.close(cause, self.now())
        self.board.unattended.end_move()
        self.acts.note("stopped", cause.name, "" if cause.by == "person" else cause.by)
        self.board.jobs.end(LatchedError("STOP ended the download before it was complete."))
        left = self.board.halts.halt(LatchedError("STOP was pressed before this was sent."))
        if left is not self._halting:
            self._halting, self._pressed_s = left, self.now()
            left.add_done_callback(self._halted)
        return left

    def resume(self, caller: Caller, session: Session | None = None) -> None:
        """All clients but `session` are notified. Raises NotDrivingError while another client drives. Refused
        while the port is lost, because the person who resumes must see the robot react.

        """
        self.driving.judge_resume(caller)
        port = self.board.link.state
        if port.status == "lost":
            raise PortLostError(port.detail or "The serial port is lost.")
        if self._latch.open():
            self.acts.note("resumed", caller.name)
            self.board.motion.resumed(self.now())
            self.hub.send_all(ResumedMessage(by=caller.name), but=session)

    async def until_identified(self) -> None:
        """Returns when the board is identified, or cannot be now: then the request is refused with the
        reason. Raises CancelledError where STOP was pressed meanwhile.
        """
        unknown = ("opening", "identifying")
        await self._wait_while(lambda: self.board.link_state.status in unknown, IDENTIFIED_WITHIN_S)

    async def until_settled(self) -> None:
        """Also until what others began before the port was opened has ended."""
        await self.until_identified()
        await self._wait_while(lambda: self.board.may_be_running, SETTLED_WITHIN_S)

    async def _wait_while(self, is_so: Callable[[], bool], within_s: float) -> None:
        stopped_s = self._latch.stopped_s
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(within_s):
                while is_so():
                    await self._changed.wait()
        if self._latch.stopped_s != stopped_s:
            raise CancelledError("STOP was pressed after this was requested.")

    def name_board(self, caller: Caller, board: str) -> None:
        """Raises NotDrivingError where another client drives another family."""
        if board != self.board.family_id and not self.driving.may_rule(caller):
            raise NotDrivingError("Another client drives: only the driver or an owner may choose the board.")
        self.choose_family(board)
        self.acts.note("boardChosen", caller.name, board)

    def choose_family(self, board: str) -> None:
        """The family by which packets are judged, unless the board's answers contradict it; `unknown` has it
        identified again, and lets only harmless questions pass.
        """
        if board not in FAMILIES:
            raise OutOfRangeError(f"board is {board}, allowed: {', '.join(FAMILIES)}")
        self.board.choose_family(board)
        self._note_choice(FAMILIES[board])
        self._see_robot()

    def allow_unattended(self, session: Session, for_ms: int | None) -> None:
        """Allows the present run to continue without its driver; None: not any more."""
        if self.driving.driver is not session:
            raise NotDrivingError("Only the driver may let a run continue.")
        if for_ms is None:
            self.board.unattended.end()
            return
        run = self.board.activity.run
        if run is None:
            raise CancelledError("Nothing is running.")
        self.board.unattended.allow(run, session, for_ms / 1000)
        self.acts.note("allowedUnattended", session.caller.name)

    def stop_playing(self, caller: Caller) -> None:
        """The play of the gateway ends with its frame in progress, whoever began it."""
        if self.board.plays.present:
            self.acts.note("endedGroup", caller.name)
        self.requests.stop_playing()

    def calibrate(self, session: Session, servo: int | None) -> None:
        """It may move that servo beyond its limits, until None or its end."""
        self.limits.calibrate(session, servo)
        if servo is not None:
            self.acts.note("calibrated", session.caller.name, str(servo))

    async def use_port(self, device: str, board: str | None = None) -> None:
        await self.board.quiet()
        self.robot.leave()
        family = FAMILIES[board] if board else None
        self._families.use(device, family)
        await self.board.link.use(device)
        if family:
            self._note_choice(family)

    async def find_rate(self, caller: Caller) -> tuple[int, Heard] | None:
        """Listens on the port at other speeds, where the robot is at rest and no other client drives.
        Meanwhile no STOP reaches it; it is stopped as the port is opened again.
        """
        driver = self.driving.driver
        if driver is not None and driver.caller.id != caller.id:
            raise NotDrivingError(f"{driver.caller.name} drives: the port cannot be given up now.")
        if not self.board.is_idle():
            raise MovingError("The robot is not at rest, or may not be: stop it before the port is given up.")
        await self.board.quiet()
        return await self.board.link.find_rate()

    async def close_port(self) -> None:
        await self.board.quiet()
        self.robot.leave()
        await self.board.link.close()

    async def shut_down(self) -> None:
        """Stops the robot and closes the port. May be called twice."""
        self._latch.cause = UNNAMED_PERSON  # so that it is not started again behind the stops
        await self.board.shut_down()
        self.hub.close()

    # Events of the board

    def board_lost(self) -> None:
        if not self.latch:
            self.acts.note("stopped", None, "loss")
        self._latch.cause = Cause("loss")  # the change of the link's state follows and publishes both

    def stopped_again(self, since_s: float) -> None:
        self._publish_unheld(since_s)

    def is_latched(self) -> bool:
        return self.latch

    def is_watched(self) -> bool:
        return self._is_monitored or len(self.hub) > 0

    def board_changed(self) -> None:
        self._changed.set()
        self._changed = asyncio.Event()
        self._broadcast.state()
        self._see_robot()

    def activity_changed(self) -> None:
        self._broadcast.activity()

    def battery_changed(self) -> None:
        self.hub.send_all(BatteryMessage(battery=self.board.battery.snapshot()))

    def job_changed(self, state: JobState) -> None:
        self.acts.job_is(state)
        self.hub.send_all(JobMessage(job=state))

    def play_changed(self, state: PlayState) -> None:
        self.acts.play_is(state)
        self.hub.send_all(PlayStateMessage(play=state))

    def unattended_time_over(self) -> None:
        self._watch.end_quietly(CancelledError("The time allowed without a driver is over."))

    def heard(self, report: Report, packet: bytes) -> None:
        self._relay.send_left()  # a question before its answer
        self.hub.send_all(ReceivedMessage(report=report_model(report), bytes=packet.hex()))

    def heard_noise(self, noise: NoiseEvent) -> None:
        self._relay.send_left()
        self.hub.send_all(NoiseMessage(reason=noise.reason, bytes=noise.bytes.hex()))

    def may_have_missed_stops(self) -> None:
        if self.latch:
            self.board.halts.halt_again()

    # Inside

    def _note_choice(self, family: Family) -> None:
        """A family that the answers of the board contradict is not remembered."""
        board = self.board
        if board.identification.state.status != "refused" or family is UNKNOWN:
            self._families.chosen(family, board.link.state.device, board.link.place)

    def _leaving(self, owner: Owner, command: Command, at_s: float) -> None:
        # Moves of pages are merged and leave in the name of the driver; those of a play are one act.
        is_merged = owner is self.board.moves and self.board.plays.present is None
        sender = self.driving.driver if is_merged else owner
        if isinstance(sender, Session):
            self.acts.left(command, sender.caller.name)
        self._relay.leaving(owner, command, at_s)

    def _see_robot(self) -> None:
        link = self.board.link
        if link.state.status == "open":
            self.robot.use_board(self.board.family_id, link.place)

    def _latch_changed(self) -> None:
        self._broadcast.state()

    def _robot_changed(self) -> None:
        self.hub.send_all(RobotMessage(robot=self.robot.snapshot()))

    def _halted(self, left: Left) -> None:
        if not left.cancelled() and left.exception() is None:
            self._publish_unheld(self._pressed_s)
            self.board.halts.insist(self._pressed_s)

    def _publish_unheld(self, since_s: float) -> None:
        self._unheld = self.board.halts.unheld_since(since_s)
        self.hub.send_all(HaltedMessage(outcome=self.board.halts.outcome, unheld=self.unheld))
