"""What is sent because the board may have missed something: filler that ends a packet which a lost port has
cut, and one more stop after flash work. Twin of shared/src/robot/resync.ts.

A cut packet leaves the board waiting for the rest of it, for ever: it would swallow the stop that comes after
the return (S2, docs/adr/0007). While the board works on its flash it keeps one packet and drops the others
(S9, S41, S53), so a group could begin behind three stops. Knows bytes and time, no wire.
"""

import asyncio
import contextlib
from collections.abc import Callable

from servodeck.errors import GatewayError
from servodeck.port.wire import CLOCK_GRAIN_S, STOP_PACKET, Left, Wire
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.protocol.packets import DOWNLOAD, RUN, CommandPacket
from servodeck.protocol.timings import LINE, STOP, wire_s


def filler_for(cut: bytes, filler: int) -> bytes:
    """It is unknown how much of the packet arrived, so the bytes must be harmless at every place of it. A
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


class Returns:
    """What a link that was lost leaves behind: a packet that it has cut, and motion that may go on."""

    def __init__(self, now: Callable[[], float], send_stop: Callable[[Wire], Left]) -> None:
        self._now = now
        self._send_stop = send_stop
        self._cut: tuple[str, CommandPacket] | None = None
        """The packet that a loss has cut on its way to the board at that place, until filler has ended it."""
        self.was_lost = False
        self.stops: asyncio.Task[None] | None = None
        """They are leaving, because the port has come back."""

    def lost(self, place: str, unfinished: CommandPacket | None) -> None:
        self.was_lost = True
        if unfinished is None or unfinished.command is not None:
            self._cut = (place, unfinished) if unfinished else None

    def filler(self, place: str, filler_byte: int | None) -> CommandPacket | None:
        """What ends the packet that was cut, where this board bears it."""
        cut_at, packet = self._cut or ("", None)
        if packet is None or filler_byte is None or cut_at != place:
            return None
        return CommandPacket(None, filler_for(packet.data, filler_byte))

    def stop(self, wire: Wire, halts: Callable[[], int], stopped: Callable[[float], None]) -> None:
        """What moved when it was lost may move on. Where somebody presses STOP meanwhile (one more of
        `halts`), its stops leave in place of these. `stopped` hears that they have left, and when the port
        opened.
        """
        self.stops = asyncio.create_task(self._stop(wire, halts, stopped))

    async def _stop(self, wire: Wire, halts: Callable[[], int], stopped: Callable[[float], None]) -> None:
        opened_s, before = self._now(), halts()
        try:
            with contextlib.suppress(GatewayError):  # lost once more
                await repeat_stop(lambda: self._send_stop(wire), self._now, lambda: before == halts())
                if before == halts():
                    stopped(opened_s)
        finally:
            self.stops = None


class StopAgain:
    def __init__(
        self, now: Callable[[], float], deaf_until_s: Callable[[], float], stop: Callable[[], object]
    ) -> None:
        self._now = now
        self._deaf_until_s = deaf_until_s
        self._stop = stop
        self._timer: asyncio.TimerHandle | None = None

    def stopped(self, at_s: float) -> None:
        """A stop leaves; its last bit then."""
        if at_s < self._deaf_until_s():
            self._plan()
        else:
            self.void()

    def heard(self) -> None:
        """The board has said something: it may hear from now on."""
        if self._timer:
            self._plan()

    def void(self) -> None:
        """Something else has begun since, or the board is another one."""
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _plan(self) -> None:
        self.void()
        delay_s = max(0.0, self._deaf_until_s() - self._now())
        self._timer = asyncio.get_running_loop().call_later(delay_s, self._due)

    def _due(self) -> None:
        self._timer = None
        self._stop()
