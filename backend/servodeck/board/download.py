"""Stores one action group on the board: stop and wait, frame by frame, because a second packet during flash
work overwrites the first one's data (S11).

Knows packets, answers and time; no lease, no port and nobody who looks on. The page's session does the same
on its own links (shared/src/session/download.ts, frameStore.ts); shared/protocol/scenarios/download.json
holds both to each other.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress

from servodeck.board.answers import Answers
from servodeck.errors import CancelledError, NoAnswerError
from servodeck.port.wire import Left
from servodeck.protocol.timings import DOWNLOAD, wire_s
from servodeck.protocol.values import FrameStored

EDGE_FRAME_TIMEOUT_S = DOWNLOAD.edge_frame_timeout_ms / 1000
MIDDLE_FRAME_TIMEOUT_S = DOWNLOAD.middle_frame_timeout_ms / 1000


class Download:
    def __init__(
        self,
        packets: Sequence[bytes],
        send: Callable[[bytes], Left],
        answers: Answers,
        now: Callable[[], float],
        is_cancelled: Callable[[], bool],
        stored: Callable[[int], None],
    ) -> None:
        """`packets` in the order of their frames. `is_cancelled` is asked between two frames; `stored` hears
        how many the board has, 0 at each beginning.
        """
        self._packets = packets
        self._send = send
        self._answers = answers
        self._now = now
        self._is_cancelled = is_cancelled
        self._stored = stored
        # When the oldest packet left whose answer is still owed.
        self._owed_since_s: float | None = None

    async def settle(self, owed_s: float) -> None:
        """Before the first frame: an answer that an earlier download did not wait for would be taken for
        ours.
        """
        self._stored(0)
        if owed_s > 0:
            await self._silence(owed_s)
        self._refuse_if_cancelled()

    async def store(self) -> None:
        """Raises CancelledError, or NoAnswerError when the board stayed silent through every restart. Nothing
        but a restart repairs a frame that is not stored for sure: written over another one it is ANDed (S36).
        """
        for _ in range(DOWNLOAD.restarts):
            with suppress(NoAnswerError):
                await self._store_all()
                return
        await self._store_all()

    async def _store_all(self) -> None:
        self._stored(0)
        for index in range(len(self._packets)):
            self._refuse_if_cancelled()
            await self._store_frame(index)
            self._stored(index + 1)

    async def _store_frame(self, index: int) -> None:
        """A frame written twice with the same bytes is what it was (S36), the last one too: its commit writes
        the same count (S34). Frame 0 erases the slot each time (S33): repeating it is a restart and counted
        as one.
        """
        try:
            await self._ask(index)
        except NoAnswerError:
            if index == 0:
                raise
            await self._ask(index)
        await self._await_owed(index)

    async def _ask(self, index: int) -> None:
        packet, asked_s = self._packets[index], self._now()
        arrives_s = asked_s + wire_s(len(packet))
        left = self._send(packet)
        if not await self._answers.to(left, self._timeout_s(index), FrameStored, not_before_s=arrives_s):
            self._owed_since_s = asked_s if self._owed_since_s is None else self._owed_since_s
            raise NoAnswerError(f"The board did not say that it has stored frame {index + 1}.")

    async def _await_owed(self, index: int) -> None:
        """After a silence two answers may come for what the board takes for one question, the second one
        after as long a work as the first: what took so long once is waited for once more.
        """
        if self._owed_since_s is not None:
            await self._silence(max(self._timeout_s(index), self._now() - self._owed_since_s))
            self._owed_since_s = None

    async def _silence(self, quiet_s: float) -> None:
        for _ in range(DOWNLOAD.babble_limit + 1):
            if not await self._answers.unasked(quiet_s, FrameStored):
                return
        raise NoAnswerError("The board says again and again that it has stored a frame.")

    def _timeout_s(self, index: int) -> float:
        is_edge = index in (0, len(self._packets) - 1)
        return EDGE_FRAME_TIMEOUT_S if is_edge else MIDDLE_FRAME_TIMEOUT_S

    def _refuse_if_cancelled(self) -> None:
        if self._is_cancelled():
            raise CancelledError("The download was cancelled.")
