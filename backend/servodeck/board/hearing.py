"""Whether the board takes up what leaves now: flash work and slow talk with its servos keep it from that
until it has answered. As the page's estimate has it (shared/src/motion/motion.ts).

Knows commands, reports and time; not what moves.
"""

from math import inf

from servodeck.protocol.families import Family
from servodeck.protocol.values import (
    AllPositions,
    Battery,
    Command,
    Download,
    Erase,
    Erased,
    FrameStored,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Report,
    Run,
    RunAccepted,
    Version,
)

ANSWERS: dict[type[Command], type[Report]] = {
    Download: FrameStored,
    Erase: Erased,
    ReadPositions: Positions,
    ReadAllPositions: AllPositions,
    ReadVersion: Version,
    ReadOffsets: Offsets,
    ReadBattery: Battery,
    Run: RunAccepted,
}
# S41, X7, L13; the others are answered at once.
DEAFENING = frozenset(ANSWERS) - {ReadBattery, Run}
# The worst of them: four sectors and the count table (S33, S34), with a margin.
LONGEST_S = 2.5


class Hearing:
    def __init__(self, family: Family) -> None:
        self._family = family
        self.deaf_until_s = -inf
        self._owed: list[type[Report]] = []
        self._may_hold_packet = False

    def left(self, command: Command, at_s: float) -> bool:
        """Its last bit leaves then; False where the board may not take it up, or late."""
        answer = ANSWERS.get(type(command))
        if at_s >= self.deaf_until_s:
            if type(command) in DEAFENING and answer:
                self.deaf_until_s, self._owed, self._may_hold_packet = at_s + LONGEST_S, [answer], False
            return True
        self._may_hold_packet = True
        if answer and command.kind in self._family.answers:
            self.deaf_until_s = at_s + LONGEST_S
            self._owed.append(answer)
        return False

    def heard(self, report: Report, at_s: float) -> None:
        """What came while it was deaf it takes up only now: the next packet may still be dropped (S9)."""
        if type(report) not in self._owed:
            return
        self._owed.remove(type(report))
        if not self._owed:
            gap_s = self._family.service_gap_ms / 1000
            self.deaf_until_s = at_s + gap_s if self._may_hold_packet else -inf
            self._may_hold_packet = False
