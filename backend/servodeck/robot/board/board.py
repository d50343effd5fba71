"""The board behind the port: what it is taken for, what left for it and what it said, and so what it may be
doing.

Knows packets and the link. Must not know clients, nor who may ask for what.
"""

import asyncio
import contextlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Protocol

from servodeck import metrics
from servodeck.errors import (
    BoardSilentError,
    BoardUnknownError,
    CancelledError,
    ClosedError,
    GatewayError,
    LatchedError,
    MovingError,
    NoAnswerError,
    NotOnThisCableError,
    PortLostError,
)
from servodeck.port.hid_reports import ReportInbox
from servodeck.port.link import Link, Ports
from servodeck.port.ports import OpenPort
from servodeck.port.reader import Inbox
from servodeck.port.wire import STOP_PACKET, Job, Left, Owner, Wire
from servodeck.protocol.decoder import DecoderEvent, NoiseEvent, PacketEvent
from servodeck.protocol.families import FAMILIES, UNKNOWN, Family, Question, Withheld, carried
from servodeck.protocol.packets import CommandPacket, encoded, parse_report
from servodeck.protocol.timings import BATTERY, IDENTIFY, wire_s
from servodeck.protocol.values import Battery, Command, Move, Report, Run, RunAccepted, RunStarted
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.identification import Identification, Silence, Status
from servodeck.robot.board.identity import QUESTIONS, identity_state
from servodeck.robot.board.move_buffer import MoveBuffer
from servodeck.robot.board.playing import Playing, Plays, Unattended
from servodeck.robot.board.readings import BatteryPoll, BatteryReader, Readings
from servodeck.robot.board.replies import Replies
from servodeck.robot.board.resync import StopAgain, filler_for, repeat_stop
from servodeck.robot.board.rules import STOP, Part, is_harmless, packet_of
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.board.storing import Jobs
from servodeck.robot.motion.halt_plan import Unheld
from servodeck.snapshots import IdentityState, JobState, LinkState, PlayState, PortState, StoredGroup

DRAIN_S = 0.5


class BoardEvents(Protocol):
    def port_opened(self) -> None:
        """Nothing was sent on it; `board_changed` follows."""

    def board_lost(self) -> None:
        """Its port was open and is gone, unasked, or it has fallen silent; `board_changed` follows."""

    def stopped_at_return(self, since_s: float) -> None:
        """The stops have left that a port gets which has come back, or a board which answers again; that was
        then.
        """

    def board_changed(self) -> None:
        """The link, the board, a slot, what goes on alone or what waits to start is another now."""

    def is_watched(self) -> bool:
        """Somebody would see what the board says unasked."""

    def battery_changed(self) -> None: ...

    def job_changed(self, state: JobState) -> None: ...

    def play_changed(self, state: PlayState) -> None: ...

    def unattended_time_over(self) -> None:
        """The run that was let go on may not any more."""

    def heard(self, report: Report, packet: bytes) -> None: ...

    def heard_noise(self, noise: NoiseEvent) -> None: ...

    def may_have_missed_stops(self) -> None:
        """The board says that a group runs: behind a stop it is one that it kept while its flash worked,
        which drops stops (S9, S41). Or it answers for the first time since a packet was cut: the stops since
        then it may have taken for the rest of that.
        """

    def leaving(self, owner: Owner, command: Command, at_s: float) -> None:
        """It moves, ends or stores something, and its last bit leaves then."""


class Board:
    def __init__(
        self,
        ports: Ports,
        now: Callable[[], float],
        family_id: str,
        simulated_device: str | None,
        slot_memory: SlotMemory,
        events: BoardEvents,
        *,
        identifies: bool = False,
        polls_battery: bool = False,
    ) -> None:
        """`family_id` is a family's name; `identifies` has that checked at each opening, and watched.
        `polls_battery`: it is asked for its battery now and then. `simulated_device`: what is behind that
        port is no real board.
        """
        self.family_id = family_id
        self.identification = Identification(self, FAMILIES[family_id], identifies=identifies)
        self._polls_battery = polls_battery
        self._simulated_device = simulated_device
        self._events = events
        self._now = now
        self.link = Link(ports, self._make_wire, self, now)
        self.replies = Replies()
        self.battery = BatteryReader(self, self.replies, now)
        self.readings = Readings(self, self.replies)
        self._battery_poll = BatteryPoll(self._may_poll_battery, self.battery.read)
        self.jobs = Jobs(self, self.replies, now, slot_memory)
        self.moves = MoveBuffer(self, now, events.board_changed)
        self.plays = Plays(self.moves, self._play_changed, now)
        self._motion = Estimate(FAMILIES[family_id])
        self._silence = Silence()
        self._cut: tuple[str, CommandPacket] | None = None
        """The packet that a loss has cut on its way to the board at that place, until filler has ended it."""
        self._was_lost = False
        self.returning: asyncio.Task[None] | None = None
        """The stops that a port gets which has come back are leaving."""
        self._stop_again = StopAgain(now, lambda: self._motion.deaf_until_s, self._stop_unheard)
        self._run: Run | Playing | None = None
        self.unattended = Unattended(now, events.unattended_time_over, events.board_changed)
        self.halts = 0
        """How often what was under way has been ended."""

    @property
    def family(self) -> Family:
        """As far as the port carries what it takes."""
        return carried(self.family_id, self.link.longest_packet)

    def judge_carried(self, kind: Withheld) -> None:
        """Raises where no hardware has confirmed how such a cable carries it."""
        if kind in self.link.withheld:
            raise NotOnThisCableError(
                f"The board's own USB cable carries no {kind} yet: no hardware has confirmed how. "
                "Use its serial header with an adapter, or Bluetooth."
            )

    @property
    def motion(self) -> Estimate:
        """A board that is silent may come back after its servos were turned by hand."""
        if self._silence.is_silent(self._now()):
            self._motion.silent(self._now())
        return self._motion

    @property
    def port(self) -> PortState:
        """How the port stands, as clients are told."""
        state = self.link.state
        is_simulated = state.device is not None and state.device == self._simulated_device
        withheld = sorted(self.link.withheld)
        return state.model_copy(update={"simulated": is_simulated, "withheld": withheld})

    @property
    def broken_slots(self) -> list[int]:
        return self.jobs.broken(self.link.place)

    @property
    def slot_versions(self) -> dict[str, StoredGroup]:
        """By slot, as JSON has it."""
        return {str(slot): stored for slot, stored in self.jobs.stored(self.link.place).items()}

    @property
    def link_state(self) -> LinkState:
        """The way to the board and the board itself, as clients are told."""
        port = self.link.state
        if port.status != "open":
            return LinkState(status=port.status, code=port.code, detail=port.detail)
        status, error = self.identification.state.status, self.identification.state.error
        assert status != "closed"
        return LinkState(
            status=status, code=error.code if error else None, detail=error.detail if error else None
        )

    @property
    def identity(self) -> IdentityState:
        return identity_state(self.identification.evidence)

    def judge_known(self) -> None:
        """Raises what keeps it from being told anything that moves or stores: nobody knows which board it is,
        or whether it is there. Without a port nothing can be said but that.
        """
        state = self.identification.state
        if state.error:
            raise state.error
        if state.status == "identifying":
            raise MovingError("The board is being identified: try again in a moment.")
        if self.identification.claim is UNKNOWN:
            raise BoardUnknownError(
                "The board is unknown and no port is open to identify it. Open a port, or choose the board."
            )

    @property
    def run(self) -> Run | Playing | None:
        """What may go on without its driver, if anything: the group that may run, or that a script has the
        gateway play.
        """
        play = self.plays.present
        return play if play and play.as_run else self.motion.run

    def may_move(self) -> bool:
        return self.plays.present is not None or self._is_moving()

    def _is_moving(self) -> bool:
        return self.motion.group_may_run(self._now()) or self.motion.is_moving(self._now())

    def may_still_move(self) -> bool:
        """Also with the last frame of a group that its driver has ended."""
        return self.may_move() or self.motion.last_frame_may_move(self._now())

    def choose_family(self, family: str) -> None:
        """A person has said so; `unknown` has it asked again. Raises MovingError while it stores."""
        self.jobs.judge_idle()
        self.identification.choose(FAMILIES[family])

    def recall(self, family: str) -> None:
        """What is connected next is taken for that until somebody says otherwise."""
        self.identification.claim = FAMILIES[family]
        self.family_id = family

    def _drop_all(self, reason: GatewayError) -> None:
        """What waits for the wire does not leave any more, but stops."""
        self.plays.end(reason)
        self.moves.drop(reason)
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(is_no_stop, reason)

    def drop(self, owner: Owner, reason: GatewayError) -> None:
        """What that one asked for and waits for the wire does not leave any more."""
        self.moves.drop(reason, owner)
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(lambda job: job.owner is owner, reason)

    def halt(self, reason: GatewayError) -> Left:
        """Resolves when the stop sequence has left; raises when there is no port to stop."""
        self.halts += 1
        self.plays.end(reason)
        self.moves.drop(reason)
        return self.link.wire().halt(self._hold, reason)

    def unheld_since(self, pressed_s: float) -> Unheld | None:
        """What may go on in spite of a stop pressed then, whose last packet left just now."""
        return self.motion.unheld_since(pressed_s, self._now())

    def halt_again(self) -> Left | None:
        """As `halt`; None where there is no port to stop."""
        with contextlib.suppress(GatewayError):
            return self.halt(
                CancelledError("The board was stopped again, because it may have missed the first stop.")
            )
        return None

    def end_motion(self) -> Left | None:
        """Without the latch: what moves ends, because its driver begins something else. As `halt`; None where
        nothing moves.
        """
        if not self.may_move():
            return None
        return self.halt(CancelledError("The driver began something else."))

    async def quiet(self) -> None:
        """Before the port is given up: ends what only this gateway could still stop."""
        self.jobs.end(ClosedError("The port was closed before the download was complete."))
        self.plays.end(ClosedError("The port was closed."))
        self._was_lost = False
        if self.motion.group_may_run(self._now()):
            with contextlib.suppress(GatewayError):
                await self.halt(CancelledError("The port is being closed."))
        self._forget_motion()

    async def shut_down(self) -> None:
        """Stops whatever it does, waits for the stops to leave, lets go of the port. Twice is harmless."""
        ending = CancelledError("The gateway is shutting down.")
        self.jobs.end(ending)
        with contextlib.suppress(GatewayError, TimeoutError):
            await asyncio.wait_for(asyncio.shield(self.halt(ending)), DRAIN_S)
        await self.link.close()

    # What the link tells

    def port_opened(self, wire: Wire) -> None:
        metrics.totals.port_openings += 1
        self._events.port_opened()
        self._lose_motion()
        if self._was_lost:
            self.returning = asyncio.create_task(self._stop_at_return(wire))
        else:
            self._motion.opened(self._now())
            wire.send(STOP_PACKET, self, urgent=True)
        self._was_lost = False
        self.identification.begin()

    def _stop_as_it_answers(self) -> None:
        """It may have moved or restarted behind our back."""
        answers_s, stops = self._now(), self.halt_again()

        def left(stops: Left) -> None:
            if not stops.cancelled() and stops.exception() is None:
                self._events.stopped_at_return(answers_s)

        if stops:
            stops.add_done_callback(left)

    async def _stop_at_return(self, wire: Wire) -> None:
        """What moved when it was lost may move on. Where somebody presses STOP meanwhile, its stops leave in
        place of these.
        """
        opened_s, halts = self._now(), self.halts
        try:
            with contextlib.suppress(GatewayError):  # lost once more
                await repeat_stop(
                    lambda: wire.send(STOP_PACKET, self, urgent=True), self._now, lambda: halts == self.halts
                )
                if halts == self.halts:
                    self._events.stopped_at_return(opened_s)
        finally:
            self.returning = None

    def port_lost(self, unfinished: CommandPacket | None) -> None:
        metrics.totals.port_losses += 1
        self._was_lost = True
        self._events.board_lost()
        self.jobs.end(PortLostError("The serial port was lost before the download was complete."))
        self.plays.end(PortLostError("The serial port was lost."))
        is_filler = unfinished is not None and unfinished.command is None
        if not is_filler:
            self._cut = (self.link.place, unfinished) if unfinished else None
        self._lose_motion(unfinished.command if unfinished else None)

    def port_changed(self) -> None:
        if self.link.state.status != "open":
            self.identification.ended()
            self.moves.drop(PortLostError("The serial port is no longer open."))
            self._lose_motion()  # also what left with the last breath of the port
        self._events.board_changed()

    # What its identification asks and tells

    async def ask(self, question: Question) -> Report | None:
        if question == "readBattery" and self.identification.state.status != "identifying":
            try:
                return Battery(await self.battery.read())  # shared with whoever asks at the same time
            except NoAnswerError:
                return None
        packet, answer = QUESTIONS[question].packet, QUESTIONS[question].answer
        async with self.replies.asking:
            # No board answers what has not reached it yet.
            earliest_s = self._now() + wire_s(len(packet.data))
            try:
                left = self.link.wire().send(packet, self)
                timeout_s = IDENTIFY.timeout_ms / 1000
                return await self.replies.to(left, timeout_s, answer, not_before_s=earliest_s)
            except (LatchedError, CancelledError):
                return None  # a stop empties the queue; it does not answer the question

    def may_ask(self) -> bool:
        return self._events.is_watched() and self.is_idle()

    def is_idle(self) -> bool:
        return not (self.jobs.is_busy() or self.may_still_move())

    def drive(self, family: Family) -> None:
        """What was asked of the one it was taken for does not leave."""
        if family.id == self.family_id:
            return
        self.family_id = family.id
        self.battery.forget()
        self._forget_motion()
        self._drop_all(CancelledError("Another board was chosen."))

    def entered(self, before: Status) -> None:
        status = self.identification.state.status
        if before == "ready" and status not in ("ready", "closed"):
            self._no_longer_ready(status)
        if before == "stale" and status not in ("stale", "closed"):
            self._stop_as_it_answers()
        if self._polls_battery and status == "ready" and before != "ready":
            self._battery_poll.begin()
        elif status != "ready":
            self._battery_poll.end()
        if self.link.state.status == "open":
            self._events.board_changed()

    def _no_longer_ready(self, status: Status) -> None:
        """It may have moved, restarted or been changed for another before it is ready again."""
        self._lose_motion()
        self.jobs.end(BoardSilentError("The board stopped answering before the download was complete."))
        self._drop_all(BoardSilentError("The board stopped answering before this was sent."))
        if status == "stale":
            self._events.board_lost()

    # What its battery and its readings ask and tell

    def put_question(self, question: Command) -> Left:
        wire = self.link.wire()
        if self.identification.state.status != "stale":
            self.judge_known()
        packet = packet_of(question, self.family)
        self.jobs.judge_idle()
        return wire.send(packet, self)

    def battery_changed(self) -> None:
        self._events.battery_changed()

    def looked_at(self) -> None:
        """Somebody begins to look on: what nobody wanted to know for a while is asked now."""
        newest = self.battery.newest
        if newest is None or self._now() - newest.at_s > BATTERY.every_ms / 1000:
            self._battery_poll.looked_at()

    def _may_poll_battery(self) -> bool:
        can_tell = "readBattery" in self.family.answers and not self.battery.is_silent
        return can_tell and self.identification.state.status == "ready" and self.may_ask()

    # What a download tells

    def job_changed(self, state: JobState) -> None:
        if state.status != "running":
            self._battery_poll.has_ended()
        self._events.job_changed(state)

    def slots_changed(self) -> None:
        self._events.board_changed()

    def group_stored(self, part: Part) -> None:
        self.motion.stored(part.slot, part.packets, self._now())

    # Inside

    def _play_changed(self, state: PlayState) -> None:
        self._follow_run()
        if self.plays.present is None:
            self._battery_poll.has_ended()
        self._events.play_changed(state)

    def _stop_unheard(self) -> None:
        if self._is_moving():
            self.halt_again()

    def _hold(self, held: Sequence[CommandPacket]) -> CommandPacket | None:
        """As the robot stands when it leaves; of a board that nobody knows nothing is held. Where the port
        carries no packet that holds all servos, the others follow those that are `held`.
        """
        hold, family = self.motion.hold(self._now()), self.family
        is_known = self.identification.state.status in ("ready", "stale")
        if not (hold and is_known) or (held and family is FAMILIES[self.family_id]):
            return None
        moves = [packet.command for packet in held if isinstance(packet.command, Move)]
        servos = {target.servo for move in moves for target in move.targets}
        others = [target for target in hold.targets if target.servo not in servos]
        if not others:
            return None
        return encoded(replace(hold, targets=tuple(others[: family.servos_per_move])), family)

    def _follow_run(self) -> None:
        run, before = self.run, self._run
        self._run = run
        self.unattended.follow(run)
        if before and not run:
            self._battery_poll.has_ended()

    def _forget_motion(self) -> None:
        """It may be another board, and whoever had the port before may have set something in motion."""
        self._motion = Estimate(FAMILIES[self.family_id])
        self._motion.opened(self._now())
        self._lose_motion()

    def _lose_motion(self, cut: Command | None = None) -> None:
        self._motion.lost(self._now(), cut)
        self._silence = Silence()
        self._stop_again.void()
        self.unattended.follow(None)

    def _filler(self) -> CommandPacket | None:
        """What ends the packet that was cut, where this board bears it."""
        place, packet = self._cut or ("", None)
        filler = self.family.resync_filler
        if packet is None or filler is None or place != self.link.place:
            return None
        return CommandPacket(None, filler_for(packet.data, filler))

    def _make_wire(self, port: OpenPort) -> Wire:
        gap_s = self.family.service_gap_ms / 1000
        inbox = ReportInbox(self._take) if port.in_reports else Inbox(self._take)
        return Wire(
            port,
            gap_s=gap_s,
            now=self._now,
            received=inbox.push,
            leaving=self._leaving,
            first=self._filler(),
        )

    def _leaving(self, owner: Owner, packet: CommandPacket, at_s: float) -> None:
        command = packet.command
        if command is None:  # filler
            return
        self.motion.left(command, at_s)
        if is_harmless(packet) and packet.number != STOP:
            self._silence.asked(packet.number, at_s)
        if packet.number == STOP:
            self._stop_again.stopped(at_s)
        elif not (is_harmless(packet) or self.link.wire().is_halting):
            self._stop_again.void()
        self._follow_run()
        self.jobs.left(command, at_s, self.link.place)
        is_opening = packet.number == STOP and owner is self
        if not is_opening:  # which ends nothing that anybody began
            self._events.leaving(owner, command, at_s)

    def _take(self, event: DecoderEvent) -> None:
        if not isinstance(event, PacketEvent):
            self._events.heard_noise(event)
            metrics.totals.noise_bytes += len(event.bytes)
            self.identification.heard_noise(event.bytes)
            return
        report = parse_report(event.packet, self.identification.heard_as or self.family)
        self._events.heard(report, event.bytes)
        metrics.received[metrics.name_of(event.packet.command)] += 1
        with contextlib.suppress(GatewayError):
            self.link.wire().answered(event.packet.command)
        may_have_swallowed = self.motion.may_swallow
        self.motion.heard(report, self._now())
        self._stop_again.heard()
        self._silence.heard(event.packet.command)  # behind it: what was forgotten in the silence stays so
        self._follow_run()
        self.battery.heard(report)
        self.jobs.heard(report, self.link.place)
        self.replies.heard(report, self._now())
        hears_again = may_have_swallowed and not self.motion.may_swallow
        if hears_again or isinstance(report, RunAccepted | RunStarted):
            self._events.may_have_missed_stops()
        self.identification.heard(report, event.bytes)


def is_no_stop(job: Job) -> bool:
    return job.number != STOP
