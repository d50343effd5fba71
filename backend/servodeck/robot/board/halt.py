"""The stop sequence of the board with what it holds, and the stops that are sent because the board may have
missed something: when a lost port has come back, or the board answers again. Twin of shared/src/robot/halt.ts
and resync.ts.

Knows the board and its wire; not who may stop it, nor the latch.
"""

import asyncio
import contextlib
import math
from collections.abc import Awaitable, Callable, Coroutine, Sequence
from typing import TYPE_CHECKING, Any

from servodeck.errors import CancelledError, GatewayError
from servodeck.port.wire import CLOCK_GRAIN_S, STOP_PACKET, Left, Wire, stop_packets
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import DOWNLOAD, RUN, CommandPacket
from servodeck.protocol.packets import STOP as STOP_NUMBER
from servodeck.protocol.timings import LINE, STOP, wire_s
from servodeck.robot.board.identity import QUESTIONS
from servodeck.robot.motion.halt_plan import Unheld
from servodeck.snapshots import StopOutcome

if TYPE_CHECKING:
    from servodeck.robot.board.board import Board


class Halts:
    def __init__(
        self,
        board: "Board",
        now: Callable[[], float],
        stopped: Callable[[float], None],
        is_latched: Callable[[], bool],
    ) -> None:
        """`stopped` is called when stops have left that no person pressed, with the time since when the board
        may have moved, and when more is known of those of a STOP pressed then. `is_latched`: no person has
        resumed.
        """
        self._board = board
        self._now = now
        self._stopped = stopped
        self._is_latched = is_latched
        self._cut: tuple[str, CommandPacket] | None = None
        """The packet that a loss has cut on its way to the board at that place, until filler has ended it."""
        self.count = 0
        """The number of halts."""
        self.was_lost = False
        """The port was lost, and has not come back."""
        self.at_opening: asyncio.Task[None] | None = None
        """Its stops are leaving, because the port was opened."""
        self._insisting: asyncio.Task[None] | None = None
        self._is_unanswered = False
        self._is_superseded = False
        """Something else that moves the robot has left since."""
        self._holds_to_follow = 0
        """While the board has not confirmed the stops, the hold leaves so often more."""

    def halt(self, reason: GatewayError) -> Left:
        """Resolves when the stop sequence has left; raises when there is no port to stop."""
        self.count += 1
        self._is_unanswered = self._is_superseded = False
        self._board.plays.end(reason)
        self._board.moves.drop(reason)
        wire = self._board.link.wire()
        self._holds_to_follow = STOP.holds_again if self.left_over_bytes(wire) else 0
        return wire.halt(self._hold, reason, self._question)

    def halt_again(self) -> None:
        """The board may have missed the first stops. What these hold ends later than reported then."""
        again_s = self._now()

        def left(stops: Left) -> None:
            if not stops.cancelled() and stops.exception() is None:
                self._stopped(again_s)
                self.insist(again_s)

        with contextlib.suppress(GatewayError):  # no port to stop
            self.halt(
                CancelledError("The board was stopped again, because it may have missed the first stop.")
            ).add_done_callback(left)

    def end_motion(self) -> Left | None:
        """Without the latch: what moves ends, because its driver begins something else. As `halt`; None where
        nothing moves.
        """
        if not self._board.activity.may_move():
            return None
        return self.halt(CancelledError("The driver began something else."))

    def end_for_good(self, reason: GatewayError) -> Left:
        """Without the latch, and nothing is to follow: as `halt`, and stops go on where the board may have
        missed these. Resolves when the stop sequence has left.
        """

        def has_left(stops: Left) -> None:
            if not stops.cancelled() and stops.exception() is None:
                self._go_on(holds=True)

        left = self.halt(reason)
        left.add_done_callback(has_left)
        return left

    async def end_before_closing(self, reason: GatewayError) -> None:
        """Behind it this gateway can stop nothing any more: done when all stops have left."""
        await self.halt(reason)
        wire, mine = self._board.link.wire(), self.count

        def is_wanted() -> bool:
            return mine == self.count and not wire.is_confirmed

        await self._rows(wire, self.left_over_bytes(wire), is_wanted, holds=True)

    async def end_group(self, stops: Callable[[], Awaitable[None]]) -> None:
        """`stops` end a group behind its frame: more of them go on, without a hold, unless another stop has
        taken their place.
        """
        before, self._is_superseded = self.count, False
        if not self._is_latched():
            with contextlib.suppress(GatewayError):  # no port
                self._board.link.wire().forget_answers()
        await stops()
        if before == self.count and not self._is_latched():
            self._go_on(holds=False)

    def _go_on(self, *, holds: bool) -> None:
        """As `insist` for an end without the latch: until anything else is to move the robot."""
        try:
            wire = self._board.link.wire()
        except GatewayError:  # no port
            return
        mine = self.count

        def is_wanted() -> bool:
            is_over = self._is_superseded or wire.has_motion_waiting
            return mine == self.count and not wire.is_confirmed and not is_over

        async def rows() -> None:
            with contextlib.suppress(GatewayError):  # lost: the stops at its return are others
                await self._rows(wire, self.left_over_bytes(wire), is_wanted, holds=holds)

        self._begin(rows())

    def _begin(self, insisting: Coroutine[Any, Any, None]) -> None:
        if self._insisting:
            self._insisting.cancel()
        self._insisting = asyncio.create_task(insisting)

    def left(self, packet: CommandPacket, *, is_halting: bool) -> None:
        """That packet leaves."""
        if not (is_halting or packet.is_harmless):
            self._is_superseded = True

    def unheld_since(self, pressed_s: float) -> Unheld | None:
        """The unheld motion of a stop pressed at `pressed_s`, whose last packet left just now."""
        if self._is_unanswered:
            return Unheld(None, math.inf)
        holds = 0 if self.outcome == "confirmed" else self._holds_to_follow
        return self._board.motion.unheld_since(pressed_s, self._now(), holds)

    @property
    def outcome(self) -> StopOutcome:
        """What has become of the latest stops."""
        if self._is_unanswered:
            return "unanswered"
        with contextlib.suppress(GatewayError):  # no port
            if self._board.link.wire().is_confirmed:
                return "confirmed"
        return "sent"

    def confirmed(self) -> None:
        """The board says that it has stopped."""
        with contextlib.suppress(GatewayError):  # no port any more
            self._board.link.wire().is_confirmed = True

    def lost(self, place: str, unfinished: CommandPacket | None) -> None:
        """The port at that place is lost, and that packet was on its way."""
        self.was_lost = True
        if unfinished is None or unfinished.command is not None:
            self._cut = (place, unfinished) if unfinished else None

    def filler(self, place: str, filler_byte: int | None) -> CommandPacket | None:
        """Filler that ends the packet that was cut, if this board bears it."""
        cut_at, packet = self._cut or ("", None)
        if packet is None or filler_byte is None or cut_at != place:
            return None
        return CommandPacket(None, filler_for(packet.data, filler_byte))

    def port_opened(self, wire: Wire) -> asyncio.Task[None]:
        """What others may have left unfinished on the line is filled with stops, then the robot is stopped:
        motion that an owner of the port before this gateway has begun, or that a loss has left. Done when
        these stops have left; nothing else leaves before.
        """
        is_return, self.was_lost = self.was_lost, False
        self._holds_to_follow = 0
        self.at_opening = asyncio.create_task(self._stop_at_opening(wire, is_return=is_return))
        return self.at_opening

    def answered(self) -> asyncio.Task[None]:
        """The board answers for the first time since the port was opened: now it hears for sure."""
        return asyncio.create_task(self._stop_quietly(self._board.link.wire(), self.count))

    async def _stop_at_opening(self, wire: Wire, *, is_return: bool) -> None:
        opened_s, before = self._now(), self.count
        try:
            if byte_count := self.left_over_bytes(wire):
                with contextlib.suppress(GatewayError):  # lost once more
                    stops = stop_packets(byte_count)
                    await wire.send_made(STOP_NUMBER, lambda: stops, self._board, urgent=True)
            await self._stop_quietly(wire, before)
            if is_return and before == self.count:
                self._stopped(opened_s)
                self.insist(opened_s, 0)
        finally:
            self.at_opening = None

    async def _stop_quietly(self, wire: Wire, before: int) -> None:
        """A STOP that is pressed meanwhile takes the place of these."""
        with contextlib.suppress(GatewayError):  # lost once more
            await repeat_stop(
                lambda: wire.send(STOP_PACKET, self._board, urgent=True),
                self._now,
                lambda: before == self.count,
            )
            if wire.halting:
                await asyncio.shield(wire.halting)

    def left_over_bytes(self, wire: Wire) -> int:
        """The board may take so many for the rest of what others left on the line; reports are whole
        packets.
        """
        return 0 if wire.in_reports else self._board.family.left_over_bytes

    def insist(self, pressed_s: float, byte_count: int | None = None) -> None:
        """A stray byte before STOP makes the board take all of it for the rest of a packet (S3, S4). So stops
        go on behind it until the board has confirmed them, or cannot miss them any more, with the hold again
        where the stray bytes are over; then seldom, until a person resumes. `byte_count`: of those that go
        on; without it as many as such a board may miss.
        """
        mine = self.count
        try:
            wire = self._board.link.wire()
        except GatewayError:  # no port
            return
        if byte_count is None:
            byte_count = self.left_over_bytes(wire)

        def is_wanted() -> bool:
            return mine == self.count and self._is_latched() and not wire.is_confirmed

        self._begin(self._insist(wire, pressed_s, byte_count, is_wanted))

    async def _insist(
        self, wire: Wire, pressed_s: float, byte_count: int, is_wanted: Callable[[], bool]
    ) -> None:
        with contextlib.suppress(GatewayError):  # lost: the stops at its return are others
            await self._rows(wire, byte_count, is_wanted, holds=True)
            if is_wanted():
                self._holds_to_follow = 0
            if is_wanted() and wire.is_heard:
                await self._send(wire, STOP_PACKET, is_wanted)
                await self._hold_again(wire, is_wanted)
                if is_wanted():
                    wire.is_confirmed = True
                    self._stopped(pressed_s)
            elif is_wanted() and (byte_count or wire.asked):
                self._is_unanswered = wire.asked is not None
                self._stopped(pressed_s)
            while is_wanted():
                await asyncio.sleep(STOP.again_every_ms / 1000)
                if is_wanted():
                    await self._remind(wire, is_wanted)

    async def _rows(self, wire: Wire, byte_count: int, is_wanted: Callable[[], bool], *, holds: bool) -> None:
        """As many stops as a stray byte can make the board miss; the hold behind the first and last row."""
        for sent in range(0, byte_count, STOP.stray_bytes):
            if not is_wanted() or wire.is_heard:
                return
            await self._send(wire, stop_packets(min(STOP.stray_bytes, byte_count - sent)), is_wanted)
            if holds and (sent == 0 or sent + STOP.stray_bytes >= byte_count):
                await self._hold_again(wire, is_wanted)

    async def _remind(self, wire: Wire, is_wanted: Callable[[], bool]) -> None:
        if wire.is_heard:
            self.halt_again()
        elif self._board.identification.state.status != "identifying":
            await self._send(wire, STOP_PACKET, is_wanted)
            question = self._question()
            if question and is_wanted():
                await self._send(wire, question, is_wanted)
                wire.asked = question.number

    async def _hold_again(self, wire: Wire, is_wanted: Callable[[], bool]) -> None:
        held: list[CommandPacket] = []
        while is_wanted() and (hold := self._hold(held, is_again=True)):
            await self._send(wire, hold, is_wanted)
            held.append(hold)

    async def _send(self, wire: Wire, packet: CommandPacket, is_wanted: Callable[[], bool]) -> None:
        await wire.send_made(packet.number, lambda: packet if is_wanted() else None, self, urgent=True)

    def _question(self) -> CommandPacket | None:
        """None where such a board may stay silent. A board that is busy would lose a stop to it (S9)."""
        question = self._board.family.stop_confirmed_by
        is_busy = self._board.motion.deaf_until_s > self._now()
        return QUESTIONS[question].packet if question and self._is_known() and not is_busy else None

    def _is_known(self) -> bool:
        return self._board.identification.state.status in ("ready", "stale")

    def _hold(self, held: Sequence[CommandPacket], *, is_again: bool = False) -> CommandPacket | None:
        """Of a board that is unknown nothing is held; where the port carries whole packets, one holds all."""
        board = self._board
        is_whole = board.family is FAMILIES[board.family_id]
        if not self._is_known() or (held and is_whole):
            return None
        return board.activity.hold(held, board.family, is_again=is_again)


def filler_for(cut: bytes, filler: int) -> bytes:
    """Ends a packet that a lost port has cut: the board would wait for the rest of it for ever, and swallow
    the stop that comes after the return (S2, docs/adr/0007).

    It is unknown how much of the packet arrived, so the bytes must be harmless at every place of it. A
    first 00 ends the wait for LEN at once (S1) and makes a move whose count is missing an empty one, where
    the filler would have the board read what earlier packets left behind (S13); but it names slot 0, which a
    run and a download must not get. What arrived of a move before the cut takes effect: no byte can prevent
    that.
    """
    if cut[COMMAND_AT] in (RUN, DOWNLOAD):
        return bytes([filler]) * LINE.filler_bytes
    # Each stop of a row is a packet of its own.
    byte_count = len(STOP_PACKET.data) if cut[COMMAND_AT] == STOP_NUMBER else len(cut)
    return bytes([0]) + bytes([filler]) * byte_count


async def repeat_stop(
    send: Callable[[], Left], now: Callable[[], float], is_wanted: Callable[[], bool] = lambda: True
) -> None:
    """Sends a stop now, and repeats of it: each begins to leave so long after the one before, or later where
    the wire is taken. Two that are closer may both fall into the time in which a board hears none (S54). No
    more of them leave once `is_wanted` says no.
    """
    due_s = now()
    for _ in range(1 + STOP.repeats):
        # In a loop: event loops round to milliseconds.
        while (left_s := due_s - now()) > CLOCK_GRAIN_S:  # noqa: ASYNC110 (nothing announces a time)
            await asyncio.sleep(left_s)
        if not is_wanted():
            return
        await send()
        due_s = now() - wire_s(len(STOP_PACKET.data)) + STOP.repeat_every_ms / 1000
