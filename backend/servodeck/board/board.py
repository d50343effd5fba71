"""The board behind the port: what it is taken for, what left for it and what it said, and so what it may be
doing.

Knows packets and the link. Must not know clients, nor who may ask for what.
"""

import asyncio
import contextlib
from collections.abc import Callable
from typing import Protocol

from servodeck import metrics
from servodeck.access.gate import STOP, is_harmless, judge_packet
from servodeck.board.answers import Answers
from servodeck.board.battery import BatteryWatch
from servodeck.board.jobs import Jobs
from servodeck.board.motion import Motion
from servodeck.board.parts import Part
from servodeck.board.slot_memory import SlotMemory
from servodeck.board.stop_again import StopAgain
from servodeck.board.unattended import Unattended
from servodeck.errors import CancelledError, ClosedError, GatewayError, PortLostError
from servodeck.port.inbox import Inbox
from servodeck.port.link import Link, Ports
from servodeck.port.ports import OpenPort
from servodeck.port.silence import Silence
from servodeck.port.wire import STOP_PACKET, Job, Left, Owner, Wire
from servodeck.protocol.decoder import COMMAND_AT, DecoderEvent, PacketEvent
from servodeck.protocol.families import FAMILIES, Family
from servodeck.protocol.packets import parse_command, parse_report
from servodeck.protocol.values import RunAccepted, RunStarted
from servodeck.told import JobState, PortState, StoredGroup

DRAIN_S = 0.5


class BoardEvents(Protocol):
    def port_opened(self) -> None:
        """Nothing was sent on it; `board_changed` follows."""

    def port_lost(self) -> None:
        """It was open and is gone, unasked; `board_changed` follows."""

    def board_changed(self) -> None:
        """The port, what a slot holds or what goes on alone is another now."""

    def job_changed(self, state: JobState) -> None: ...

    def time_alone_over(self) -> None:
        """The run that was let go on may not any more."""

    def received(self, event: DecoderEvent) -> None: ...

    def run_told(self) -> None:
        """The board says that a group runs."""

    def leaving(self, owner: Owner, packet: bytes, at_s: float) -> None:
        """That packet moves, ends or stores something, and its last bit leaves then."""


class Board:
    def __init__(
        self,
        ports: Ports,
        now: Callable[[], float],
        taken_for: str,
        simulated_device: str | None,
        slot_memory: SlotMemory,
        events: BoardEvents,
    ) -> None:
        """`taken_for` is a family's name. `simulated_device`: what is behind that port is no real board."""
        self.taken_for = taken_for
        self._simulated_device = simulated_device
        self._events = events
        self._now = now
        self.link = Link(ports, self._make_wire, self, now)
        self.answers = Answers()
        self.battery = BatteryWatch(self.answers, self._ask, now)
        self.jobs = Jobs(self, self.answers, now, slot_memory)
        self._motion = Motion(self.family)
        self._silence = Silence()
        self._stop_again = StopAgain(now, lambda: self._motion.deaf_until_s, self._stop_unheard)
        self.unattended = Unattended(now, events.time_alone_over, events.board_changed)
        self.halts = 0
        """How often what was under way has been ended."""

    @property
    def family(self) -> Family:
        return FAMILIES[self.taken_for]

    @property
    def motion(self) -> Motion:
        """A board that is silent may come back after its servos were turned by hand."""
        if self._silence.is_silent(self._now()):
            self._motion.forget()
        return self._motion

    @property
    def port(self) -> PortState:
        """How the port stands, as clients are told."""
        state = self.link.state
        is_simulated = state.device is not None and state.device == self._simulated_device
        return state.model_copy(update={"simulated": is_simulated})

    @property
    def broken_slots(self) -> list[int]:
        return self.jobs.broken(self.link.place)

    @property
    def slot_versions(self) -> dict[str, StoredGroup]:
        """By slot, as JSON has it."""
        return {str(slot): stored for slot, stored in self.jobs.stored(self.link.place).items()}

    def may_move(self) -> bool:
        return self.motion.group_may_run(self._now()) or self.motion.is_moving(self._now())

    def take_for(self, family: str) -> None:
        """What was asked of the one it was taken for does not leave. Raises MovingError while it stores."""
        self.jobs.judge_idle()
        self.taken_for = family
        self.battery.forget()
        self._forget_motion()
        self.drop(is_no_stop, CancelledError("The board is taken for another one now."))

    def drop(self, which: Callable[[Job], bool], reason: GatewayError) -> None:
        """What waits for the wire, if there is one."""
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(which, reason)

    def halt(self, hold: bytes | None, reason: GatewayError, owner: Owner = None) -> Left:
        """Resolves when the stop sequence has left; raises when there is no port to stop."""
        self.halts += 1
        return self.link.wire().halt(hold or self.motion.hold(self._now()), reason, owner)

    def halt_again(self) -> None:
        with contextlib.suppress(GatewayError):
            self.halt(None, CancelledError("The board was stopped once more: it may not have heard it."))

    async def end_motion(self) -> None:
        """Without the latch: what moves ends, because its driver begins something else."""
        if self.may_move():
            await self.halt(None, CancelledError("Its driver has begun something else."))

    async def quiet(self) -> None:
        """Before the port is given up: ends what only this gateway could still stop."""
        self.jobs.end(ClosedError("The port was closed before all of it was stored."))
        if self.motion.group_may_run(self._now()):
            with contextlib.suppress(GatewayError):
                await self.halt(None, CancelledError("The port is being closed."))
        self._forget_motion()

    async def shut_down(self) -> None:
        """Stops whatever it does, waits for the stops to leave, lets go of the port. Twice is harmless."""
        ending = CancelledError("The gateway is ending.")
        self.jobs.end(ending)
        with contextlib.suppress(GatewayError, TimeoutError):
            await asyncio.wait_for(asyncio.shield(self.halt(None, ending)), DRAIN_S)
        await self.link.close()

    # What the link tells

    def port_opened(self, wire: Wire) -> None:
        metrics.port_openings.inc()
        self._events.port_opened()
        self._forget_motion()
        wire.send(STOP_PACKET, self, urgent=True)

    def port_lost(self) -> None:
        metrics.port_losses.inc()
        self._events.port_lost()
        self.jobs.end(PortLostError("The serial port went away before all of it was stored."))
        self._forget_motion()

    def port_changed(self) -> None:
        if self.link.state.status != "open":
            self._forget_motion()  # also what left with the last breath of the port
        self._events.board_changed()

    # What a download tells

    def job_changed(self, state: JobState) -> None:
        self._events.job_changed(state)

    def slots_changed(self) -> None:
        self._events.board_changed()

    def group_begun(self, part: Part) -> None:
        self.motion.unstored(part.slot)

    def group_stored(self, part: Part) -> None:
        self.motion.stored(part.slot, part.durations_ms)

    # Inside

    def _ask(self, question: str) -> Left:
        packet = judge_packet(question, self.taken_for)
        self.jobs.judge_idle()
        return self.link.wire().send(packet, self)

    def _stop_unheard(self) -> None:
        if self.may_move():
            self.halt_again()

    def _forget_motion(self) -> None:
        self._motion = Motion(self.family)
        self._silence = Silence()
        self._stop_again.void()
        self.unattended.follow(None)

    def _make_wire(self, port: OpenPort) -> Wire:
        gap_s = self.family.service_gap_ms / 1000
        inbox = Inbox(self._take)
        return Wire(port, gap_s=gap_s, now=self._now, received=inbox.push, leaving=self._leaving)

    def _leaving(self, owner: Owner, packet: bytes, at_s: float) -> None:
        self.motion.left(packet, at_s)
        if is_harmless(packet) and packet[COMMAND_AT] != STOP:
            self._silence.asked(packet[COMMAND_AT], at_s)
        if packet[COMMAND_AT] == STOP:
            self._stop_again.stopped(at_s)
        elif not (is_harmless(packet) or self.link.wire().is_halting):
            self._stop_again.void()
        self.unattended.follow(self.motion.run)
        self.jobs.left(parse_command(packet), at_s, self.link.place)
        is_told = packet[COMMAND_AT] == STOP or not is_harmless(packet)
        if is_told and owner is not self:  # its own stop at the opening ends nothing that anybody began
            self._events.leaving(owner, packet, at_s)

    def _take(self, event: DecoderEvent) -> None:
        self._events.received(event)
        if not isinstance(event, PacketEvent):
            metrics.noise.inc(len(event.bytes))
            return
        metrics.received.labels(metrics.name_of(event.packet.command)).inc()
        with contextlib.suppress(GatewayError):
            self.link.wire().answered(event.packet.command)
        report = parse_report(event.packet, self.family)
        self.motion.heard(report, self._now())
        self._stop_again.heard()
        self._silence.heard(event.packet.command)  # behind it: what was forgotten in the silence stays so
        self.unattended.follow(self.motion.run)
        self.battery.heard(report)
        self.jobs.heard(report, self.link.place)
        self.answers.heard(report, self._now())
        if isinstance(report, RunAccepted | RunStarted):
            self._events.run_told()


def is_no_stop(job: Job) -> bool:
    return job.packet[COMMAND_AT] != STOP
