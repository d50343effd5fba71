"""One download of one or several groups: what it stores, how far it is and how it ended.

Knows packets and a wire; not when it may begin, and not what it leaves behind.
"""

import asyncio
import secrets
from collections.abc import Callable, Sequence

from servodeck.board.parts import Part
from servodeck.board.tally import Tally
from servodeck.callers import Caller
from servodeck.errors import GatewayError
from servodeck.port.wire import Wire
from servodeck.told import JobState


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
