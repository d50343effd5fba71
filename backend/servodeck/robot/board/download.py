"""One download of one or several groups: the packets that store them, how far it is and how it ended.

The packets are made with pauses in which other tasks run, because a large group takes a while and a stop must
not wait for it. They are sent frame by frame, each after the acknowledgement of the one before: a second
packet during flash work overwrites the first one's data (S11). Twin of shared/src/robot/download.ts. Knows
packets, answers and time; not when a download may begin.
"""

import asyncio
import secrets
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress

from servodeck.callers import Caller
from servodeck.errors import CancelledError, GatewayError, NoAnswerError, OutOfRangeError
from servodeck.intents import FrameBody, GroupBody
from servodeck.port.wire import Left, Wire
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.timings import DOWNLOAD, wire_s
from servodeck.protocol.values import Download as StoreFrame
from servodeck.protocol.values import Frame, FrameStored, ServoTarget, extremes_of
from servodeck.robot.board.replies import Replies
from servodeck.snapshots import JobState
from servodeck.value import value


@value
class Group:
    slot: int
    name: str
    frames: Sequence[Frame]
    version: str = ""
    replaces: str | None = None
    document: str | None = None


@value
class Part:
    """One group of a download; `packets` in the order of its frames, for boards of the family `board`.
    `extremes`: the least and the greatest position of each servo. `version`: what it is called, by the client
    that requests it, to distinguish it from others; `replaces`: that of what they have seen in its slot, if
    they have looked; `document`: of the library, where it is of one.
    """

    slot: int
    name: str
    packets: Sequence[bytes]
    board: str
    extremes: Sequence[ServoTarget]
    version: str
    replaces: str | None
    document: str | None


def judge_parts(parts: Sequence[Part], board: str) -> None:
    """Raises OutOfRangeError where a slot is wanted twice, CancelledError where they were made for another
    family.
    """
    slots = [part.slot for part in parts]
    twice = next((slot for at, slot in enumerate(slots) if slot in slots[:at]), None)
    if twice is not None:
        raise OutOfRangeError(f"Slot {twice} is given twice.")
    if any(part.board != board for part in parts):
        raise CancelledError("Another board was chosen.")


async def frames_of(bodies: Sequence[FrameBody]) -> list[Frame]:
    """Other tasks run between two frames, as in `parts_of`."""
    frames = []
    for body in bodies:
        frames.append(body.frame())
        await asyncio.sleep(0)
    return frames


async def group_of(body: GroupBody) -> Group:
    frames = await frames_of(body.frames)
    return Group(body.slot, body.name, frames, body.version, body.replaces, body.document)


async def parts_of(groups: Sequence[Group], board: str) -> list[Part]:
    """Raises what such a board cannot take of them."""
    return [await part_of(group, board) for group in groups]


async def part_of(group: Group, board: str) -> Part:
    packets = []
    for packet in packets_of(group, board):
        packets.append(packet)
        await asyncio.sleep(0)
    return made_of(group, packets, board)


def made_of(group: Group, packets: Sequence[bytes], board: str) -> Part:
    return Part(
        group.slot,
        group.name,
        packets,
        board,
        extremes_of(group.frames),
        group.version or secrets.token_hex(8),
        group.replaces,
        group.document,
    )


def packets_of(group: Group, board: str) -> Iterator[bytes]:
    count = len(group.frames)
    if count == 0:
        raise OutOfRangeError("An action group needs at least one frame.")
    for index, frame in enumerate(group.frames):
        yield encode(StoreFrame(group.slot, count, index, frame), FAMILIES[board])


@value
class Progress:
    groups_stored: int
    frames_stored: int
    frame_count: int
    bytes_sent: int
    bytes_total: int
    remaining_s: float


class Tally:
    def __init__(self, now: Callable[[], float]) -> None:
        self._sizes: list[Sequence[int]] = []
        self._now = now
        self.frame_count = 0
        self.bytes_total = 0
        self._begun_s = now()
        self._s_per_byte = 0.0

    def add(self, sizes: Sequence[Sequence[int]]) -> None:
        """Bytes of each frame of each further group."""
        self._sizes += sizes
        self.frame_count += sum(map(len, sizes))
        self.bytes_total += sum(map(sum, sizes))

    def after(self, groups: int, frames: int) -> Progress:
        """So many groups are whole, and so many frames of the next one; none: it begins, or begins again. The
        time left is at least the wire's; the measured time of frames includes the flash.
        """
        whole, [part] = self._sizes[:groups], self._sizes[groups : groups + 1] or [()]
        part_sent = sum(part[:frames])
        if frames:
            self._s_per_byte = (self._now() - self._begun_s) / part_sent
        else:
            self._begun_s = self._now()
        sent = sum(map(sum, whole)) + part_sent
        left = self.bytes_total - sent
        return Progress(
            groups,
            sum(map(len, whole)) + frames,
            self.frame_count,
            sent,
            self.bytes_total,
            max(wire_s(left), self._s_per_byte * left),
        )


EDGE_FRAME_TIMEOUT_S = DOWNLOAD.edge_frame_timeout_ms / 1000
MIDDLE_FRAME_TIMEOUT_S = DOWNLOAD.middle_frame_timeout_ms / 1000


class Download:
    def __init__(
        self,
        packets: Sequence[bytes],
        send: Callable[[bytes], Left],
        replies: Replies,
        now: Callable[[], float],
        is_cancelled: Callable[[], bool],
        stored: Callable[[int], None],
    ) -> None:
        """`packets` in the order of their frames. `is_cancelled` is called between two frames; `stored` is
        called with the number of frames on the board, 0 at each beginning.
        """
        self._packets = packets
        self._send = send
        self._replies = replies
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
        if not await self._replies.to(left, self._timeout_s(index), FrameStored, not_before_s=arrives_s):
            self._owed_since_s = asked_s if self._owed_since_s is None else self._owed_since_s
            raise NoAnswerError(f"The board did not acknowledge frame {index + 1}.")

    async def _await_owed(self, index: int) -> None:
        """After a silence two answers may come for what the board takes for one question, the second one
        after as long a work as the first: what took so long once is waited for once more.
        """
        if self._owed_since_s is not None:
            await self._silence(max(self._timeout_s(index), self._now() - self._owed_since_s))
            self._owed_since_s = None

    async def _silence(self, quiet_s: float) -> None:
        for _ in range(DOWNLOAD.babble_limit + 1):
            if not await self._replies.unsolicited(quiet_s, FrameStored):
                return
        raise NoAnswerError("The board keeps repeating an acknowledgement.")

    def _timeout_s(self, index: int) -> float:
        is_edge = index in (0, len(self._packets) - 1)
        return EDGE_FRAME_TIMEOUT_S if is_edge else MIDDLE_FRAME_TIMEOUT_S

    def _refuse_if_cancelled(self) -> None:
        if self._is_cancelled():
            raise CancelledError("The download was cancelled.")


class Job:
    """The owner of its packets on the wire."""

    task: asyncio.Task[None]

    def __init__(
        self, parts: Sequence[Part], by: Caller, board: str, wire: Wire, now: Callable[[], float]
    ) -> None:
        """`board` is what its broken slots are remembered by."""
        self.parts: list[Part] = []
        self.by = by
        self.board = board
        self.wire = wire
        self.is_cancelled = False
        self.has_begun = False
        """The first byte of the present group has left, or may have."""
        self.broke = False
        """The slot of the present group was whole before: where nothing has left, it still is."""
        self._tally = Tally(now)
        first = parts[0]
        self.state = JobState(
            id=secrets.token_hex(6),
            by=by.name,
            status="running",
            slots=[],
            groups_stored=0,
            slot=first.slot,
            name=first.name,
            frames_stored=0,
            frame_count=0,
            bytes_sent=0,
            bytes_total=0,
            remaining_ms=0,
        )
        self.add(parts)

    def add(self, parts: Sequence[Part]) -> None:
        """Behind those that it has."""
        self.parts += parts
        self._tally.add([[len(packet) for packet in part.packets] for part in parts])
        self._update(
            {
                "slots": [part.slot for part in self.parts],
                "frame_count": self._tally.frame_count,
                "bytes_total": self._tally.bytes_total,
            }
        )

    @property
    def part(self) -> Part:
        """The present one, or the last."""
        return self.parts[min(self.state.groups_stored, len(self.parts) - 1)]

    def note(self, frames: int) -> None:
        """So many frames of the present group are stored."""
        self._note(self.state.groups_stored, frames)

    def note_whole(self) -> None:
        """The present group is stored."""
        self.has_begun = self.broke = False
        self._note(self.state.groups_stored + 1, 0)

    def conclude(self, error: GatewayError | None) -> None:
        status = "done" if error is None else "cancelled" if error.code == "cancelled" else "failed"
        reason = {} if error is None else {"code": error.code, "detail": error.detail}
        self._update({"status": status, "remaining_ms": 0, **reason})
        self.parts.clear()  # remembered is only how it ended

    def _note(self, groups: int, frames: int) -> None:
        progress = self._tally.after(groups, frames)
        self._update(
            {
                "groups_stored": progress.groups_stored,
                "frames_stored": progress.frames_stored,
                "bytes_sent": progress.bytes_sent,
                "remaining_ms": round(progress.remaining_s * 1000),
            }
        )
        self._update({"slot": self.part.slot, "name": self.part.name})

    def _update(self, what: dict[str, object]) -> None:
        self.state = self.state.model_copy(update=what)
