"""How far this robot's servos may be turned, as its owner has described it: less than its board could do.

Knows commands and who sends them; no port and no client's socket. The page refuses the same things before
they come here; this holds for every program that moves the robot.
"""

from collections.abc import Iterable, Sequence

from servodeck.errors import MovingError, OutOfRangeError
from servodeck.port.wire import Owner
from servodeck.protocol.values import Command, Move, ServoTarget
from servodeck.told import ServoLimits


class RobotLimits:
    def __init__(self) -> None:
        self._limits: dict[int, ServoLimits] = {}
        self._calibrating: dict[Owner, int] = {}
        self._are_awaited = False

    def await_them(self) -> None:
        """There are some, and nobody knows them yet: until `set` or `clear` nothing moves."""
        self._are_awaited = True

    def set(self, servos: Iterable[ServoLimits]) -> None:
        """In place of all that was set before."""
        self._limits = {limits.servo: limits for limits in servos}
        self._are_awaited = False

    def name_of(self, servo: int) -> str:
        """As people are told of it."""
        limits = self._limits.get(servo)
        return f"{limits.name} (servo {servo})" if limits else f"servo {servo}"

    def calibrate(self, owner: Owner, servo: int | None) -> None:
        """Whoever looks for the limits of a servo may pass the old ones, with that servo alone and until
        `forget`.
        """
        if servo is None:
            self.forget(owner)
        else:
            self._calibrating[owner] = servo

    def forget(self, owner: Owner) -> None:
        self._calibrating.pop(owner, None)

    def clear(self) -> None:
        """Nobody has described this one."""
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
