"""Which robot of the library stands on the board, the same for everybody: its limits and its poses.

Knows what the library says of robots, no text of one; no client, and not who may change what.
"""

import asyncio
import logging
from collections.abc import Callable

from servodeck.board.robot import RobotLimits
from servodeck.errors import ConflictError, GatewayError, NotFoundError, OutOfRangeError
from servodeck.files.remembered import Remembered
from servodeck.library.library_messages import RobotFacts
from servodeck.threads import in_thread
from servodeck.told import RobotTold

ReadFacts = Callable[[str], tuple[RobotFacts, int]]
"""Of a robot outside the trash, with its revision. Blocks; raises a GatewayError."""
log = logging.getLogger("servodeck.robot")


def no_robot(_document: str) -> tuple[RobotFacts, int]:
    """A library that holds none."""
    raise NotFoundError("The library does not hold that.")


class RobotOfBoard:
    def __init__(
        self, limits: RobotLimits, read: ReadFacts, remembered: Remembered, changed: Callable[[], None]
    ) -> None:
        """`changed`: it is another one now, or any robot of the library is."""
        self._limits = limits
        self._read = read
        self._remembered = remembered
        self._changed = changed
        self._board: tuple[str, str] | None = None
        self._document: str | None = None
        self._revision = 0
        self._last_told: RobotTold | None = None
        self._reading: asyncio.Task[None] | None = None
        self.facts: RobotFacts | None = None

    def told(self) -> RobotTold | None:
        return RobotTold(id=self._document, revision=self._revision) if self._document else None

    def stands_on(self, family: str, place: str) -> None:
        """That board is at hand: what was remembered of it holds from now on. Until the library has told its
        limits nothing moves.
        """
        if (family, place) == self._board:
            return
        self.leave()
        self._board = family, place
        self._document = self._remembered.robot_on(self._key())
        if self._document:
            self._limits.await_them()
            self._reading = asyncio.create_task(self._recall(self._document))
        if self.told() != self._last_told:
            self._tell()

    def leave(self) -> None:
        """No board is at hand. Clients hear that from the port."""
        if self._reading:
            self._reading.cancel()
        self._board = self._reading = None
        self._forget()

    async def put(self, document: str, instead_of: str | None) -> None:
        """For everybody, and remembered. Raises a ConflictError where a third one stands there,
        NotFoundError, or OutOfRangeError for one that is built on another board.
        """
        board = self._board
        self._judge(document, instead_of)
        facts, revision = await in_thread(lambda: self._read(document))
        if board is None or self._board != board:
            raise ConflictError("No such board is connected any more.")
        self._judge(document, instead_of)
        if facts.board != board[0]:
            raise OutOfRangeError(f"{facts.name} is built on a board {facts.board}, not {board[0]}.")
        self._remembered.remember_robot(self._key(), document)
        self._hold(document, revision, facts)
        await self._remembered.kept()

    def changes_limits(self, document: str, facts: RobotFacts) -> bool:
        """Whether moves would be judged otherwise."""
        known = self.facts
        return document == self._document and (known is None or known.limits != facts.limits)

    def written(self, document: str, revision: int, facts: RobotFacts) -> None:
        """Answers may come in another order than the writing was done."""
        if document == self._document and revision > self._revision:
            self._hold(document, revision, facts)
        else:
            self._tell()

    def removed(self, documents: list[str]) -> None:
        if self._document in documents:
            self._remembered.remember_robot(self._key(), None)
            self._remembered.keep_soon()
            self._forget()
        self._tell()

    async def _recall(self, document: str) -> None:
        try:
            facts, revision = await in_thread(lambda: self._read(document))
        except GatewayError as error:
            log.warning("robot not read", extra={"facts": {"detail": error.detail}})
            self._forget()
            self._tell()
        else:
            if self.facts is None:  # nobody has written it meanwhile
                self._hold(document, revision, facts)

    def _hold(self, document: str, revision: int, facts: RobotFacts) -> None:
        self._document, self._revision, self.facts = document, revision, facts
        self._limits.set(facts.limits)
        self._tell()

    def _tell(self) -> None:
        self._last_told = self.told()
        self._changed()

    def _forget(self) -> None:
        self._document, self._revision, self.facts = None, 0, None
        self._limits.clear()

    def _judge(self, document: str, instead_of: str | None) -> None:
        if self._document not in (document, instead_of):
            raise ConflictError("Another robot was put on this board meanwhile.")

    def _key(self) -> str:
        assert self._board
        return " ".join(self._board)
