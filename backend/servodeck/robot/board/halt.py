"""The stop sequence of the board with what it holds, and the stops that are sent because the board may have
missed something: when a lost port has come back, or the board answers again. Twin of shared/src/robot/halt.ts
and resync.ts.

Knows the board and its wire; not who may stop it, nor the latch.
"""

import asyncio
import contextlib
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from servodeck.errors import CancelledError, GatewayError
from servodeck.port.wire import CLOCK_GRAIN_S, STOP_PACKET, Left, Wire
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import DOWNLOAD, RUN, CommandPacket
from servodeck.protocol.timings import LINE, STOP, wire_s
from servodeck.robot.motion.halt_plan import Unheld

if TYPE_CHECKING:
    from servodeck.robot.board.board import Board


class Halts:
    def __init__(self, board: "Board", now: Callable[[], float], stopped: Callable[[float], None]) -> None:
        """`stopped` is called when stops have left that no person pressed, with the time since when the board
        may have moved.
        """
        self._board = board
        self._now = now
        self._stopped = stopped
        self._cut: tuple[str, CommandPacket] | None = None
        """The packet that a loss has cut on its way to the board at that place, until filler has ended it."""
        self.count = 0
        """The number of halts."""
        self.was_lost = False
        """The port was lost, and has not come back."""
        self.at_return: asyncio.Task[None] | None = None
        """Its stops are leaving, because the port has come back."""

    def halt(self, reason: GatewayError) -> Left:
        """Resolves when the stop sequence has left; raises when there is no port to stop."""
        self.count += 1
        self._board.plays.end(reason)
        self._board.moves.drop(reason)
        return self._board.link.wire().halt(self._hold, reason)

    def halt_again(self) -> None:
        """The board may have missed the first stops. What these hold ends later than reported then."""
        again_s = self._now()

        def left(stops: Left) -> None:
            if not stops.cancelled() and stops.exception() is None:
                self._stopped(again_s)

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

    def unheld_since(self, pressed_s: float) -> Unheld | None:
        """The unheld motion of a stop pressed at `pressed_s`, whose last packet left just now."""
        return self._board.motion.unheld_since(pressed_s, self._now())

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

    def port_opened(self, wire: Wire) -> None:
        """After a loss servos may still move, so several stops leave. Otherwise one is enough, for motion
        that an owner of the port before this gateway has begun.

        """
        if self.was_lost:
            self.at_return = asyncio.create_task(self._stop_at_return(wire))
        else:
            wire.send(STOP_PACKET, self._board, urgent=True)
        self.was_lost = False

    async def _stop_at_return(self, wire: Wire) -> None:
        """A STOP that is pressed meanwhile takes the place of these."""
        opened_s, before = self._now(), self.count
        try:
            with contextlib.suppress(GatewayError):  # lost once more
                await repeat_stop(
                    lambda: wire.send(STOP_PACKET, self._board, urgent=True),
                    self._now,
                    lambda: before == self.count,
                )
                if before == self.count:
                    self._stopped(opened_s)
        finally:
            self.at_return = None

    def _hold(self, held: Sequence[CommandPacket]) -> CommandPacket | None:
        """Of a board that is unknown nothing is held; where the port carries whole packets, one holds all."""
        board = self._board
        is_known = board.identification.state.status in ("ready", "stale")
        is_whole = board.family is FAMILIES[board.family_id]
        return board.activity.hold(held, board.family) if is_known and not (held and is_whole) else None


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
    return bytes([0]) + bytes([filler]) * len(cut)


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
