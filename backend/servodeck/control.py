"""Joins the parts: clients, gate, link and board. Owns the latch and the memory of what the robot may be
doing.

Knows what is asked and what may be done now. Must not know HTTP, WebSockets or how a byte reaches the port.
"""

import asyncio
import contextlib
import logging
from collections.abc import Callable

from servodeck import __version__, metrics
from servodeck.answers import Answers
from servodeck.battery import BatteryWatch
from servodeck.broken_slots import BrokenSlots
from servodeck.decoder import COMMAND_AT
from servodeck.driving import Driving
from servodeck.errors import (
    CancelledError,
    ClosedError,
    GatewayError,
    LatchedError,
    MovingError,
    NotDrivingError,
    OutOfRangeError,
    PortLostError,
)
from servodeck.gate import RUN, STOP, is_harmless, judge_by_hand, judge_group, judge_latch, judge_packet
from servodeck.hub import Hub, Seat
from servodeck.inbox import Inbox
from servodeck.jobs import Group, Jobs
from servodeck.link import Link, Ports
from servodeck.messages import (
    HaltedMessage,
    JobMessage,
    JobState,
    LimitsMessage,
    Message,
    NoiseMessage,
    PortState,
    ReceivedMessage,
    ServoLimits,
    StateMessage,
    WelcomeMessage,
    encode,
)
from servodeck.motion import Motion
from servodeck.packets import FAMILIES, DecoderEvent, PacketEvent, parse_command, parse_report
from servodeck.ports import OpenPort
from servodeck.relay import Relay
from servodeck.robot import RobotLimits
from servodeck.unattended import Unattended
from servodeck.wire import STOP_PACKET, Job, Left, Owner, Wire, always

DRAIN_S = 0.5
log = logging.getLogger("servodeck.robot")


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
        broken_slots: BrokenSlots | None = None,
    ) -> None:
        """`named_device` is the port named at the start: always offered, even where the system does not list
        it. `simulated`: what is behind it is no real board. `epoch`: leases are counted on from there.
        Without `broken_slots` these are forgotten at the end.
        """
        self.board = board
        self.named_device = named_device
        self._simulated_device = named_device if simulated else None
        self.now = now
        self.latch = False
        self.answers = Answers()
        self.battery = BatteryWatch(self.answers, lambda packet: self.send(self, packet), now)
        self.limits = RobotLimits()
        self.hub = Hub()
        self.link = Link(ports, self._make_wire, self, now)
        self.driving = Driving(self.hub, now, epoch, self)
        self.jobs = Jobs(self, self.answers, now, broken_slots or BrokenSlots())
        self._relay = Relay(self.hub, now)
        self.motion = Motion(FAMILIES[board])
        self.unattended = Unattended(now, self._end_alone, self._tell_state)
        self.halts = 0
        """How often what was under way has been ended."""
        self._halting: Left | None = None

    @property
    def port(self) -> PortState:
        """How the port stands, as clients are told."""
        state = self.link.state
        is_simulated = state.device is not None and state.device == self._simulated_device
        return state.model_copy(update={"simulated": is_simulated})

    # What clients ask

    def join(self, seat: Seat) -> None:
        """The welcome is the seat's first message."""
        self.hub.join(seat)
        seat.put(encode(self._welcome(seat)))
        self._tell_state(but=seat)

    def leave(self, seat: Seat) -> None:
        self._drop(seat, CancelledError("The client has left."))
        self.limits.forget(seat)
        self.hub.leave(seat)
        self.driving.leave(seat)
        self._relay.forget(seat)
        self._tell_state()

    def send(self, owner: Owner, packet_hex: str, nonce: str | None = None) -> Left:
        """Resolves when the packet has left the wire. Raises, or fails with, what keeps it from leaving. What
        is not harmless needs the lease and its `nonce`.
        """
        packet = judge_packet(packet_hex, self.board)
        self.limits.judge(packet, owner)
        wire = self.link.wire()
        judge_latch(packet, self.latch)
        judge_by_hand(packet)
        self.jobs.judge_run(parse_command(packet), self.link.place)
        self._judge_idle(packet)
        judge = always if is_harmless(packet) else self._permitted(owner, nonce)
        command = packet[COMMAND_AT]
        if command == STOP:
            # A stop overtakes all that waits; a run it overtook must not start the group again behind it.
            wire.purge(is_run, CancelledError("A stop has overtaken this run."))
        return wire.send(packet, owner, urgent=command == STOP, judge=judge)

    def stop(self, hold: bytes | None, owner: Owner = None) -> Left:
        """Latches in any case. Resolves when the stop sequence has left; raises when there is no port to
        stop.
        """
        self._set_latch(True)
        self.jobs.end(LatchedError("Stopped before all of it was stored."))
        left = self._halt(hold, LatchedError("Stopped before it left."), owner)
        if left is not self._halting:
            self._halting = left
            left.add_done_callback(self._halted)
        return left

    async def end_motion(self) -> None:
        """Without the latch: what moves ends, because its driver begins something else."""
        if self.may_move():
            await self._halt(None, CancelledError("Its driver has begun something else."))

    def may_move(self) -> bool:
        return self.motion.group_may_run(self.now()) or self.motion.is_moving(self.now())

    def resume(self) -> None:
        """Refused while the port is lost: whoever resumes shall see the robot's answer."""
        if self.link.state.status == "lost":
            raise PortLostError(self.link.state.detail or "The serial port is gone.")
        self._set_latch(False)

    def name_board(self, seat: Seat, board: str) -> None:
        """Raises NotDrivingError where somebody else drives whatever else it was."""
        if board != self.board and not self.driving.may_rule(seat):
            raise NotDrivingError("Somebody else drives: which board it is changes only under their hands.")
        self.take_for(board)

    def take_for(self, board: str) -> None:
        """What every later packet is judged by; `unknown` lets only harmless questions pass. Everybody is
        told, also where nothing changed.
        """
        if board not in FAMILIES:
            raise OutOfRangeError(f"board is {board}, allowed: {', '.join(FAMILIES)}")
        if board != self.board:
            self.jobs.judge_idle()
            self.board = board
            self._forget_limits()
            self.battery.forget()
            self._forget_motion()
            with contextlib.suppress(GatewayError):
                self.link.wire().purge(is_no_stop, CancelledError("The board is taken for another one now."))
        self._tell_state()

    def let_go_on(self, seat: Seat, for_ms: int | None) -> None:
        """The run under way, without its driver; None: not any more."""
        if self.driving.driver is not seat:
            raise NotDrivingError("Only who drives may let a run go on.")
        if for_ms is None:
            self.unattended.end()
            return
        run = self.motion.run
        if run is None:
            raise CancelledError("Nothing runs any more.")
        if run.times == 0:
            raise OutOfRangeError("times is 0: what goes on without its driver has an end.")
        self.unattended.allow(run, seat, for_ms / 1000)

    def limit(self, seat: Seat, servos: list[ServoLimits]) -> None:
        """How far the robot's servos may be turned, by whoever said so last; every other client is told.
        Who may not say so now is told what holds.
        """
        if not self.driving.may_rule(seat):
            seat.put(encode(LimitsMessage(type="limits", servos=self.limits.told())))
            return
        self.limits.set(servos)
        self._tell(LimitsMessage(type="limits", servos=servos), but=seat)

    def download(self, group: Group, by: str, claim: Callable[[], object]) -> JobState:
        """Begins to store it; raises what keeps it from that before anything is sent. `claim` raises where
        `by` may not.
        """
        packets = judge_group(group.slot, group.frames, self.board)
        for packet in packets:
            self.limits.judge(packet, None)
        wire = self.link.wire()
        judge_latch(packets[0], self.latch)
        self.jobs.judge_idle()
        if self.may_move() or not wire.is_clear_of(lambda packet: not is_harmless(packet)):
            raise MovingError("The robot is moving, or a group may still run: wait, or stop it first.")
        claim()
        self.motion.unstored(group.slot)
        return self.jobs.begin(group, packets, by, self.link.place, wire)

    async def use_port(self, device: str, board: str | None = None) -> None:
        await self._quiet()
        self._forget_limits()
        self.board = board or self.board
        await self.link.use(device)

    async def close_port(self) -> None:
        await self._quiet()
        self._forget_limits()
        await self.link.close()

    async def shut_down(self) -> None:
        """Stops the robot whatever it does, waits for the stops to leave, lets go of the port. Twice is
        harmless.
        """
        self.latch = True  # nobody starts it again behind the stops
        self.jobs.end(CancelledError("The gateway is ending."))
        with contextlib.suppress(GatewayError, TimeoutError):
            left = self._halt(None, CancelledError("The gateway is ending."))
            await asyncio.wait_for(asyncio.shield(left), DRAIN_S)
        await self.link.close()
        self.hub.close()

    # What the link tells

    def port_opened(self, wire: Wire) -> None:
        metrics.port_openings.inc()
        self._forget_motion()
        wire.send(STOP_PACKET, self, urgent=True)

    def port_lost(self) -> None:
        metrics.port_losses.inc()
        self.latch = True  # the change of the port's state follows and tells both
        self.jobs.end(PortLostError("The serial port went away before all of it was stored."))
        self._forget_motion()

    def port_changed(self) -> None:
        self._tell_state()

    # What a download tells

    def job_changed(self, state: JobState) -> None:
        self._tell(JobMessage(job=state))

    def broken_slots_changed(self) -> None:
        self._tell_state()

    def group_stored(self, group: Group) -> None:
        self.motion.stored(group.slot, group.frames)

    # What the lease tells

    def driver_quiet(self) -> None:
        self._drop(self.driving.driver, CancelledError("Its driver was not heard any more."))
        if self.motion.is_moving(self.now()):
            self._stop_for_nobody()

    def driver_silent(self) -> None:
        if self.may_move() and not self.unattended.by:
            self._stop_for_nobody()

    def driver_lost(self) -> None:
        self.driver_silent()

    def driver_changed(self) -> None:
        """What one driver began does not go on under the next; nobody has to resume for it."""
        goes_on_alone = self.unattended.by and self.driving.driver is None
        if self.may_move() and not goes_on_alone:
            self._end_quietly(NotDrivingError("Somebody else drives now."))

    def lease_changed(self) -> None:
        if self.driving.driver and self.unattended.by not in (None, self.driving.driver):
            self._end_quietly(NotDrivingError("Somebody else drives now."))
        self.driving.tell_all()

    # Inside

    def _permitted(self, owner: Owner, nonce: str | None) -> Callable[[], None]:
        permit = self.driving.permit(owner, nonce)
        return lambda: self.driving.judge(permit)

    def _drop(self, owner: Owner, reason: GatewayError) -> None:
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(lambda job: job.owner is owner, reason)

    def _judge_idle(self, packet: bytes) -> None:
        """A stop always goes, but the frame it meets on the board is not stored for sure (S10)."""
        if packet[COMMAND_AT] == STOP:
            self.jobs.end(CancelledError("A stop ended it before all of it was stored."))
        self.jobs.judge_idle()

    def _end_quietly(self, reason: GatewayError) -> None:
        """Without the latch: somebody is there, or it was said beforehand."""
        with contextlib.suppress(GatewayError):
            self._halt(None, reason)

    def _end_alone(self) -> None:
        self._end_quietly(CancelledError("The time in which it might go on alone is over."))

    def _stop_for_nobody(self) -> None:
        """STOP because nobody watches over what moves: whoever goes on has to look first."""
        with contextlib.suppress(GatewayError):
            self.stop(None)

    def _welcome(self, seat: Seat) -> Message:
        return WelcomeMessage(
            version=__version__,
            board=self.board,
            port=self.port,
            latch=self.latch,
            clients=len(self.hub),
            unattended=self.unattended.told(),
            limits=self.limits.told(),
            lease=self.driving.state_for(seat),
            broken_slots=self._broken_slots(),
            job=self.jobs.latest,
        )

    def _tell_state(self, but: Seat | None = None) -> None:
        state = StateMessage(
            board=self.board,
            port=self.port,
            latch=self.latch,
            clients=len(self.hub),
            unattended=self.unattended.told(),
            broken_slots=self._broken_slots(),
        )
        self.hub.tell_all(encode(state), but)

    def _broken_slots(self) -> list[int]:
        return self.jobs.broken(self.link.place)

    def _tell(self, message: Message, but: Seat | None = None) -> None:
        self.hub.tell_all(encode(message), but)

    def _forget_limits(self) -> None:
        if self.limits.told():
            self._tell(LimitsMessage(type="limits", servos=[]))
        self.limits.clear()

    def _set_latch(self, latch: bool) -> None:
        if latch != self.latch:
            self.latch = latch
            log.info("stopped" if latch else "resumed")
            self._tell_state()

    def _halt(self, hold: bytes | None, reason: GatewayError, owner: Owner = None) -> Left:
        self.halts += 1
        return self.link.wire().halt(hold or self.motion.hold(self.now()), reason, owner)

    def _halted(self, left: Left) -> None:
        if not left.cancelled() and left.exception() is None:
            self._tell(HaltedMessage())

    async def _quiet(self) -> None:
        """Before the port is given up: ends a group that only this gateway could still stop."""
        self.jobs.end(ClosedError("The port was closed before all of it was stored."))
        if self.motion.group_may_run(self.now()):
            with contextlib.suppress(GatewayError):
                await self._halt(None, CancelledError("The port is being closed."))
        self._forget_motion()

    def _forget_motion(self) -> None:
        self.motion = Motion(FAMILIES[self.board])
        self.unattended.follow(None)

    def _make_wire(self, port: OpenPort) -> Wire:
        inbox = Inbox(self._take)
        gap_s = FAMILIES[self.board].service_gap_ms / 1000
        return Wire(port, gap_s=gap_s, now=self.now, received=inbox.push, leaving=self._leaving)

    def _leaving(self, owner: Owner, packet: bytes, at_s: float) -> None:
        self.motion.left(packet, at_s)
        self.unattended.follow(self.motion.run)
        self.jobs.left(parse_command(packet), at_s)
        is_told = packet[COMMAND_AT] == STOP or not is_harmless(packet)
        if is_told and owner is not self:  # its own stop at the opening ends nothing that anybody began
            self._relay.leaving(owner, packet, at_s)

    def _take(self, event: DecoderEvent) -> None:
        """One event of the board's decoder."""
        if not isinstance(event, PacketEvent):
            metrics.noise.inc(len(event.bytes))
            self._tell(NoiseMessage(bytes=event.bytes.hex()))
            return
        metrics.received.labels(metrics.name_of(event.packet.command)).inc()
        with contextlib.suppress(GatewayError):
            self.link.wire().answered(event.packet.command)
        self._tell(ReceivedMessage(packet=event.bytes.hex()))
        report = parse_report(event.packet, FAMILIES[self.board])
        self.motion.heard(report, self.now())
        self.unattended.follow(self.motion.run)
        self.battery.heard(report)
        self.jobs.heard(report, self.link.place)
        self.answers.heard(report, self.now())


def is_no_stop(job: Job) -> bool:
    return job.packet[COMMAND_AT] != STOP


def is_run(job: Job) -> bool:
    return job.packet[COMMAND_AT] == RUN
