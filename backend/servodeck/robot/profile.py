"""The robot on the board, the same for all clients: its family and its profile from the library, as they were
last chosen for this board, and with the profile its limits and poses.

Knows the facts of robots in the library, no document; no client and no role.
"""

import asyncio
import logging
from collections.abc import Callable, Iterable, Sequence

from servodeck.errors import ConflictError, GatewayError, MovingError, NotFoundError, OutOfRangeError
from servodeck.files import Remembered
from servodeck.port.wire import Owner
from servodeck.protocol.families import UNITS, Family
from servodeck.protocol.values import Command, Move, ServoTarget
from servodeck.snapshots import NamedPose, RobotFacts, RobotState, ServoLimits
from servodeck.threads import in_thread


class RobotLimits:
    def __init__(self) -> None:
        self._limits: dict[int, ServoLimits] = {}
        self._calibrating: dict[Owner, int] = {}
        self._are_awaited = False

    def await_them(self) -> None:
        """The limits are being read: until `set` or `clear` nothing moves."""
        self._are_awaited = True

    def set(self, servos: Iterable[ServoLimits]) -> None:
        """Replaces all limits."""
        self._limits = {limits.servo: limits for limits in servos}
        self._are_awaited = False

    def name_of(self, servo: int) -> str:
        """For clients."""
        limits = self._limits.get(servo)
        return f"{limits.name} (servo {servo})" if limits else f"servo {servo}"

    def calibrate(self, owner: Owner, servo: int | None) -> None:
        """A client that calibrates a servo may move it beyond its limits, until `forget`."""
        if servo is None:
            self.forget(owner)
        else:
            self._calibrating[owner] = servo

    def forget(self, owner: Owner) -> None:
        self._calibrating.pop(owner, None)

    def clear(self) -> None:
        """The robot has no limits."""
        self._limits.clear()
        self._calibrating.clear()
        self._are_awaited = False

    def judge(self, command: Command | None, owner: Owner) -> None:
        """Raises OutOfRangeError that names the servo and its range, or MovingError."""
        self.judge_targets(targets_of(command), self._calibrating.get(owner))

    def judge_targets(self, targets: Sequence[ServoTarget], free: int | None = None) -> None:
        """As `judge`; that servo is `free` of its limits."""
        if targets and self._are_awaited:
            raise MovingError("The limits of this robot are still being read: try again.")
        for target in targets:
            limits = self._limits.get(target.servo)
            if limits and target.servo != free and not limits.min <= target.position <= limits.max:
                raise OutOfRangeError(
                    f"{self.name_of(target.servo)}: position is {target.position}, "
                    f"allowed {limits.min}..{limits.max}"
                )


def targets_of(command: Command | None) -> tuple[ServoTarget, ...]:
    return command.targets if isinstance(command, Move) else ()


ReadFacts = Callable[[str], tuple[RobotFacts, int]]
"""Of a robot outside the trash, with its revision. Blocks; raises a GatewayError."""
log = logging.getLogger("servodeck.robot")


def no_robot(_document: str) -> tuple[RobotFacts, int]:
    """A library that holds none."""
    raise NotFoundError("The library has no such document.")


class RobotOfBoard:
    def __init__(
        self, limits: RobotLimits, read: ReadFacts, remembered: Remembered, changed: Callable[[], None]
    ) -> None:
        """`changed` is called when the robot on the board or any robot of the library has changed."""
        self._limits = limits
        self._read = read
        self._remembered = remembered
        self._changed = changed
        self._board: tuple[str, str] | None = None
        self._document: str | None = None
        self._revision = 0
        self._last_published: RobotState | None = None
        self._reading: asyncio.Task[None] | None = None
        self.facts: RobotFacts | None = None

    def snapshot(self) -> RobotState | None:
        return RobotState(id=self._document, revision=self._revision) if self._document else None

    def pose(self, wanted: str, family: Family) -> NamedPose:
        """By its number or its name. Raises NotFoundError, or OutOfRangeError where a name is not enough, or
        where the pose is in another unit than such a board uses.
        """
        poses = self.facts.poses if self.facts else []
        found = [pose for pose in poses if wanted in (str(pose.id), pose.name)]
        exact = [pose for pose in found if str(pose.id) == wanted] or found
        if not exact:
            raise NotFoundError(f"No pose is called {wanted}. GET /api/poses lists them.")
        if len(exact) > 1:
            numbers = ", ".join(str(pose.id) for pose in exact)
            raise OutOfRangeError(f"Several poses are called {wanted}: use a number instead, {numbers}.")
        [pose] = exact
        if pose.unit != family.unit:
            raise OutOfRangeError(
                f"{pose.name} is in {UNITS[pose.unit]}; a {family.name} uses {UNITS[family.unit]}."
            )
        return pose

    def use_board(self, family: str, place: str) -> None:
        """That board is connected: its remembered robot is on it from now on. Nothing moves until its limits
        are read.
        """
        if (family, place) == self._board:
            return
        self.leave()
        self._board = family, place
        self._document = self._remembered.robot_on(self._key())
        if self._document:
            self._limits.await_them()
            self._reading = asyncio.create_task(self._recall(self._document))
        if self.snapshot() != self._last_published:
            self._publish()

    def leave(self) -> None:
        """No board is connected. Clients see it in the state of the port."""
        if self._reading:
            self._reading.cancel()
        self._board = self._reading = None
        self._forget()

    @property
    def is_being_read(self) -> bool:
        return self._reading is not None and not self._reading.done()

    async def until_read(self) -> None:
        """Returns when the robot of the board is known as far as it can be."""
        if self._reading:
            await asyncio.wait({self._reading})

    async def put(self, document: str, instead_of: str | None) -> None:
        """For all clients, and remembered. Raises a ConflictError where a third one is on the board,
        NotFoundError, or OutOfRangeError for one that is built on another board.
        """
        board = self._board
        self._judge(document, instead_of)
        facts, revision = await in_thread(lambda: self._read(document))
        if board is None or self._board != board:
            raise ConflictError("That board is no longer connected.")
        self._judge(document, instead_of)
        if facts.board != board[0]:
            raise OutOfRangeError(f"{facts.name} is made for a {facts.board} board, not {board[0]}.")
        self._remembered.remember_robot(self._key(), document)
        self._hold(document, revision, facts)
        await self._remembered.saved()

    def changes_limits(self, document: str, facts: RobotFacts) -> bool:
        """Whether it has other limits than the robot on the board."""
        known = self.facts
        return document == self._document and (known is None or known.limits != facts.limits)

    def written(self, document: str, revision: int, facts: RobotFacts) -> None:
        """Answers may come in another order than the writes."""
        if document == self._document and revision > self._revision:
            self._hold(document, revision, facts)
        else:
            self._publish()

    def removed(self, documents: list[str]) -> None:
        if self._document in documents:
            self._remembered.remember_robot(self._key(), None)
            self._remembered.save_soon()
            self._forget()
        self._publish()

    async def _recall(self, document: str) -> None:
        try:
            facts, revision = await in_thread(lambda: self._read(document))
        except GatewayError as error:
            log.warning("robot not read", extra={"facts": {"detail": error.detail}})
            self._forget()
            self._publish()
        else:
            if self.facts is None:  # it was not written meanwhile
                self._hold(document, revision, facts)

    def _hold(self, document: str, revision: int, facts: RobotFacts) -> None:
        self._document, self._revision, self.facts = document, revision, facts
        self._limits.set(facts.limits)
        self._publish()

    def _publish(self) -> None:
        self._last_published = self.snapshot()
        self._changed()

    def _forget(self) -> None:
        self._document, self._revision, self.facts = None, 0, None
        self._limits.clear()

    def _judge(self, document: str, instead_of: str | None) -> None:
        if self._document not in (document, instead_of):
            raise ConflictError("Another robot was chosen for this board in the meantime.")

    def _key(self) -> str:
        assert self._board
        return " ".join(self._board)
