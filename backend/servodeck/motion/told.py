"""Where servos at rest stand by the board's own word, as long as nothing can have moved them since. It is no
track: nobody asked for that position, and a hold goes by the tracks. Twin of shared/src/motion/told.ts.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from servodeck.protocol.values import Command, Move, Release, Run, ServoTarget


@dataclass(frozen=True, slots=True)
class Reading:
    # None: the board has not said it since.
    position: int | None
    # It has no torque: hands may have turned it since, and its next move starts from anywhere.
    is_released: bool = False


Told = Mapping[int, Reading]

RELEASED = Reading(None, is_released=True)


def after_positions(told: Told, positions: Sequence[ServoTarget]) -> Told:
    new = {
        each.servo: Reading(each.position, each.servo in told and told[each.servo].is_released)
        for each in positions
    }
    return {**told, **new}


def after_order(told: Told, command: Command, *, is_heard: bool) -> Told:
    """After the command left the wire; `is_heard` False where the board may not have taken it up."""
    match command:
        case Release(servos):
            return {**told, **dict.fromkeys(servos, RELEASED)}
        case Run():
            return only_let_go(told)
        case Move(_, targets):
            moved = {target.servo for target in targets}
            still_free = moved & only_let_go(told).keys() if not is_heard else set[int]()
            rest = {servo: reading for servo, reading in told.items() if servo not in moved}
            return {**rest, **dict.fromkeys(still_free, RELEASED)}
    return told


def only_let_go(told: Told) -> dict[int, Reading]:
    """What the board said before is no longer so."""
    return {servo: RELEASED for servo, reading in told.items() if reading.is_released}


def held_at(told: Told, servo: int) -> int | None:
    """Where the board said that it stands; None where it has not, or where hands may have turned it since."""
    reading = told.get(servo)
    return None if reading is None or reading.is_released else reading.position
