"""The board behind the port: joins its link, identification, estimate, moves, downloads, plays and readings.

Passes each packet that leaves and each report that comes to the parts that need it. Must not know clients,
nor who may request what.
"""

import asyncio
import contextlib
from collections.abc import Callable
from typing import Protocol

from servodeck import metrics
from servodeck.errors import (
    BoardSilentError,
    CancelledError,
    ClosedError,
    GatewayError,
    MovingError,
    PortLostError,
)
from servodeck.port.link import Link, Ports
from servodeck.port.ports import OpenPort
from servodeck.port.reader import inbox_of
from servodeck.port.wire import STOP_PACKET, Left, Owner, Wire
from servodeck.protocol.decoder import DecoderEvent, NoiseEvent, PacketEvent
from servodeck.protocol.families import FAMILIES, Family, carried
from servodeck.protocol.packets import STOP, CommandPacket, encoded, parse_report
from servodeck.protocol.timings import MOVE
from servodeck.protocol.values import Command, ReadBattery, Report, RunAccepted, RunStarted, RunStopped
from servodeck.robot.board.activity import Activity, Unattended
from servodeck.robot.board.download import Part
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.halt import Halts
from servodeck.robot.board.identification import Identification, Status
from servodeck.robot.board.identity import Answered, identity_state
from servodeck.robot.board.move_buffer import MoveBuffer
from servodeck.robot.board.playing import Plays
from servodeck.robot.board.port_families import PortFamilies
from servodeck.robot.board.readings import BatteryReader, Readings
from servodeck.robot.board.replies import Replies
from servodeck.robot.board.slots import SlotMemory
from servodeck.robot.board.storing import Jobs
from servodeck.snapshots import IdentityState, JobState, LinkState, PlayState, PortState, StoredGroup

# Three stops and the hold take a quarter of a second; a busy machine takes longer.
DRAIN_S = 2.0


class BoardEvents(Protocol):
    def board_lost(self) -> None:
        """An open port was lost, or the board has fallen silent; `board_changed` follows."""

    def stopped_again(self, since_s: float) -> None:
        """The stops have left that are sent when a port comes back or a board answers again, which was at
        `since_s`; or more is known of those of a STOP pressed then.
        """

    def board_changed(self) -> None:
        """The state of link, board, slots, unattended run or waiting servos has changed."""

    def is_latched(self) -> bool:
        """Motion is refused until a person resumes."""

    def is_watched(self) -> bool:
        """A client is connected, or the board is read for notifications."""

    def activity_changed(self) -> None: ...

    def battery_changed(self) -> None: ...

    def job_changed(self, state: JobState) -> None: ...

    def play_changed(self, state: PlayState) -> None: ...

    def unattended_time_over(self) -> None:
        """The time of the unattended run has passed."""

    def heard(self, report: Report, packet: bytes) -> None: ...

    def heard_noise(self, noise: NoiseEvent) -> None: ...

    def may_have_missed_stops(self) -> None:
        """The board says that a group runs: behind a stop it is one that waited while its flash worked,
        which drops stops (S9, S41). Or it answers for the first time since a packet was cut: the stops since
        then it may have taken for the rest of that.
        """


class Board:
    def __init__(
        self,
        ports: Ports,
        now: Callable[[], float],
        family: Family,
        families: PortFamilies,
        slot_memory: SlotMemory,
        events: BoardEvents,
        leaving: Callable[[Owner, Command, float], None],
        *,
        identifies: bool = False,
        polls_battery: bool = False,
    ) -> None:
        """`family` before the first opening; from then on `families` names it for each port. `identifies`:
        that is checked at each opening, and the board is watched afterwards. `polls_battery`: the battery is
        read regularly. `leaving` gets each command that moves, ends or stores something, with its owner and
        the time when its last bit leaves.
        """
        self.family_id = family.id
        self._families = families
        self._is_new_port = False
        self._events = events
        self._command_leaves = leaving
        self._now = now
        self.slot_memory = slot_memory
        self.link = Link(ports, self._make_wire, self, now)
        self.replies = Replies()
        self.battery = BatteryReader(self, self.replies, now, polls=polls_battery)
        self.readings = Readings(self, self.replies, self.battery, now)
        self.identification = Identification(self, self.readings.answer_to, family, identifies=identifies)
        self.jobs = Jobs(self, self.replies, now, slot_memory)
        self.moves = MoveBuffer(self, now, events.board_changed)
        self.plays = Plays(self.moves, self._play_changed, now)
        self.unattended = Unattended(now, events.unattended_time_over, events.board_changed)
        self.halts = Halts(self, now, events.stopped_again, events.is_latched)
        self._identifies = identifies
        self.may_be_running = False
        """What others began before the port was opened may continue: the board has not answered yet."""
        self._doubt: asyncio.TimerHandle | None = None
        self.activity = Activity(
            *(family, self.plays, self.unattended, now),
            stop_again=self.halts.halt_again,
            run_ended=self.battery.motion_ended,
            changed=events.activity_changed,
        )

    @property
    def family(self) -> Family:
        """With the limits of the port: it may carry shorter packets than the board takes."""
        return carried(self.family_id, self.link.longest_packet)

    @property
    def motion(self) -> Estimate:
        return self.activity.motion

    @property
    def port(self) -> PortState:
        """The state of the port, for clients."""
        state = self.link.state
        is_simulated = self._families.is_simulated(state.device)
        withheld = sorted(self.link.withheld)
        return state.model_copy(update={"simulated": is_simulated, "withheld": withheld})

    @property
    def broken_slots(self) -> list[int]:
        return self.slot_memory.broken(self.link.place)

    @property
    def slot_versions(self) -> dict[str, StoredGroup]:
        """By slot, as JSON has it."""
        return {str(slot): stored for slot, stored in self.slot_memory.stored(self.link.place).items()}

    @property
    def link_state(self) -> LinkState:
        """The way to the board and the board itself, for clients."""
        port = self.link.state
        if port.status != "open":
            return LinkState(status=port.status, code=port.code, detail=port.detail)
        return self.identification.link_state

    @property
    def identity(self) -> IdentityState:
        return identity_state(self.identification.evidence)

    def choose_family(self, family: str) -> None:
        """A person has chosen it; `unknown` has the board identified again. Raises MovingError while it
        stores, or while it moves and no STOP was pressed: what moves would be forgotten, and nothing would
        end it.
        """
        self.jobs.judge_idle()
        if family != self.family_id and not self._events.is_latched() and self.activity.may_still_move():
            raise MovingError("The robot is moving: wait until it rests, or stop it first.")
        self.identification.choose(FAMILIES[family])

    def _drop_all(self, reason: GatewayError) -> None:
        """Packets that wait for the wire are dropped, except stops."""
        self.plays.end(reason)
        self.moves.drop(reason)
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(lambda job: job.number != STOP, reason)

    def drop(self, owner: Owner, reason: GatewayError) -> None:
        """Drops the packets of `owner` that wait for the wire."""
        self.moves.drop(reason, owner)
        with contextlib.suppress(GatewayError):
            self.link.wire().purge(lambda job: job.owner is owner, reason)

    async def quiet(self) -> None:
        """Before the port is closed: ends all motion that only this gateway can still stop."""
        self.jobs.end(ClosedError("The port was closed before the download was complete."))
        self.plays.end(ClosedError("The port was closed."))
        self.halts.was_lost = False
        if self.motion.group_may_run(self._now()):
            with contextlib.suppress(GatewayError):
                await self.halts.end_before_closing(CancelledError("The port is being closed."))
        self.activity.forget(FAMILIES[self.family_id])

    async def shut_down(self) -> None:
        """Stops the board, waits for the stops to leave, closes the port. May be called twice."""
        ending = CancelledError("The gateway is shutting down.")
        self.jobs.end(ending)
        may_move = self.activity.may_still_move()
        with contextlib.suppress(GatewayError, TimeoutError):
            stops = self.halts.end_before_closing(ending) if may_move else self.halts.halt(ending)
            await asyncio.wait_for(asyncio.shield(stops), DRAIN_S)
        await self.link.close()

    # Events of the link

    def port_opened(self, wire: Wire) -> asyncio.Task[None]:
        metrics.totals.port_openings += 1
        self.battery.port_opened()
        self.activity.lose()
        is_first = not self.halts.was_lost
        if is_first:
            self.activity.opened()
        claim = self.identification.claim
        is_vouched = self._families.is_vouched(self.link.state.device, claim)
        # A board that is taken at its family's word is one that was started with this gateway.
        self.may_be_running = self._identifies and not is_vouched
        stops = self.halts.port_opened(wire)
        if is_first:  # the last frame that others began may have begun only when these left
            stops.add_done_callback(self._stopped_at_opening)
        self.identification.begin(stops, is_vouched=is_vouched)
        return stops

    def port_lost(self, unfinished: CommandPacket | None) -> None:
        metrics.totals.port_losses += 1
        self.halts.lost(self.link.place, unfinished)
        self._events.board_lost()
        self.jobs.end(PortLostError("The serial port was lost before the download was complete."))
        self.plays.end(PortLostError("The serial port was lost."))
        self.activity.lose(unfinished.command if unfinished else None)

    def port_changed(self) -> None:
        if self.link.state.status != "open":
            self._end_doubt()
            self.identification.ended()
            self.moves.drop(PortLostError("The serial port is no longer open."))
            self.activity.lose()  # also for packets that left just before
        if self.link.state.status in ("opening", "closed"):
            self._forget_board()
        self._events.board_changed()

    # Events and questions of the identification

    def may_ask(self) -> bool:
        return self._events.is_watched() and self.is_idle()

    def is_idle(self) -> bool:
        return not (self.jobs.is_busy() or self.activity.may_still_move())

    def drive(self, family: Family) -> None:
        """Packets for the family before are dropped."""
        if family.id == self.family_id:
            return
        self.family_id = family.id
        self.battery.forget()
        self.activity.forget(FAMILIES[self.family_id])
        self._drop_all(CancelledError("Another board was chosen."))

    def entered(self, before: Status) -> None:
        status = self.identification.state.status
        if before == "ready" and status not in ("ready", "closed"):
            self._no_longer_ready(status)
        if before == "stale" and status not in ("stale", "closed"):
            self.halts.halt_again()  # it may have moved or restarted unheard
        if status == "ready" and self.may_be_running:
            self._judge_doubt()
        if "ready" in (before, status) and before != status:
            self.battery.board_ready(is_ready=status == "ready")
        if self.link.state.status == "open":
            self._events.board_changed()

    def answered(self) -> asyncio.Task[None]:
        return self.halts.answered()

    def judge_before(self) -> None:
        """Raises MovingError while what others began before the port was opened may continue."""
        if self.may_be_running:
            raise MovingError(
                "The board does not answer, so what was started before the port was opened may still run: "
                f"wait until {MOVE.longest_ms // 1000} s have passed."
            )

    def _stopped_at_opening(self, _stops: asyncio.Task[None]) -> None:
        if self.link.state.status == "open":
            self.activity.opened()

    def _judge_doubt(self) -> None:
        """A board that answers nothing has finished its longest frame by then."""
        if any(isinstance(one, Answered) for one in self.identification.evidence):
            self._end_doubt()
        else:
            delay_s = MOVE.longest_ms / 1000
            self._doubt = asyncio.get_running_loop().call_later(delay_s, self._end_doubt_later)

    def _end_doubt_later(self) -> None:
        self._end_doubt()
        self._events.board_changed()

    def _end_doubt(self) -> None:
        if self._doubt:
            self._doubt.cancel()
        self._doubt, self.may_be_running = None, False

    def _no_longer_ready(self, status: Status) -> None:
        """Before it is ready again, it may have moved, restarted or been exchanged."""
        self.activity.lose()
        self.jobs.end(BoardSilentError("The board stopped answering before the download was complete."))
        self._drop_all(BoardSilentError("The board stopped answering before this was sent."))
        if status == "stale":
            self._events.board_lost()

    # Questions of its battery and its readings

    def put_question(self, question: Command) -> Left:
        wire = self.link.wire()
        if self.identification.state.status != "stale":
            self.identification.judge_known()
        packet = encoded(question, self.family)
        self.jobs.judge_idle()
        return wire.send(packet, self)

    def battery_changed(self) -> None:
        self._events.battery_changed()

    # Events of a download

    def job_changed(self, state: JobState) -> None:
        if state.status != "running":
            self.battery.motion_ended()
        self._events.job_changed(state)

    def slots_changed(self) -> None:
        self._events.board_changed()

    def group_stored(self, part: Part) -> None:
        self.motion.stored(part.slot, part.packets, self._now())

    # Inside

    def _play_changed(self, state: PlayState) -> None:
        self.activity.follow_run()
        if self.plays.present is None:
            self.battery.motion_ended()
        self._events.play_changed(state)

    def _forget_board(self) -> None:
        """Another board may be at the next port."""
        self.battery.forget()
        self.jobs.forget()
        self._is_new_port = True
        self._take_for_named()

    def _take_for_named(self) -> None:
        """The board at the port is driven as the family that was named for it."""
        if device := self.link.state.device:
            self.identification.claim = self._families.at(device, self.link.place)
            self.drive(self.identification.claim)

    def _make_wire(self, port: OpenPort) -> Wire:
        if self._is_new_port:  # its place is known only now
            self._is_new_port = False
            self._take_for_named()
        gap_s = self.family.service_gap_ms / 1000
        return Wire(
            port,
            gap_s=gap_s,
            now=self._now,
            received=inbox_of(port, self._take).push,
            leaving=self._leaving,
            first=self.halts.filler(self.link.place, self.family.resync_filler),
        )

    def _leaving(self, owner: Owner, packet: CommandPacket, at_s: float) -> None:
        command = packet.command
        if command is None:  # filler
            self.activity.filled(at_s)
            return
        is_halting = self.link.wire().is_halting or owner is self.halts
        self.halts.left(packet, is_halting=is_halting)
        # Each stop of a row is a packet of its own.
        for _ in range(len(packet.data) // len(STOP_PACKET.data) if packet.number == STOP else 1):
            self.activity.left(packet, command, at_s, is_halting=is_halting)
        if isinstance(command, ReadBattery):
            self.battery.query_left(at_s)
        self.jobs.left(command, at_s, self.link.place)
        is_opening = packet.number == STOP and owner is self
        if not is_opening:  # which ends no motion of a client
            self._command_leaves(owner, command, at_s)

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
        if isinstance(report, RunStopped):
            self.halts.confirmed()
        may_have_swallowed = self.motion.may_swallow
        self.activity.heard(report, event.packet.command)
        self.battery.heard(report)
        self.jobs.heard(report, self.link.place)
        self.replies.heard(report, self._now())
        hears_again = may_have_swallowed and not self.motion.may_swallow
        if hears_again or isinstance(report, RunAccepted | RunStarted):
            self._events.may_have_missed_stops()
        self.identification.heard(report, event.bytes)
