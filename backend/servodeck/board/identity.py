"""Which board answers like that: what was heard, weighed against the family table (boards.md 2.5). Answers
never name one family for certain, so a person chooses among those that fit. Twin of
shared/src/session/identity.ts.

Pure. Knows no link and no time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from servodeck.protocol.families import FAMILIES, UNKNOWN, Family, Question
from servodeck.protocol.values import Battery, Positions, Report, Version
from servodeck.told import (
    AnsweredTold,
    BatteryReport,
    EchoedTold,
    EvidenceTold,
    IdentityTold,
    NoiseTold,
    PositionsReport,
    ServoPosition,
    SilentTold,
    VersionReport,
)


@dataclass(frozen=True, slots=True)
class Answered:
    question: Question
    report: Report


@dataclass(frozen=True, slots=True)
class Silent:
    question: Question


@dataclass(frozen=True, slots=True)
class Echoed:
    """The question itself came back: the line is looped, or something else listens there (S14)."""


@dataclass(frozen=True, slots=True)
class Noise:
    """Bytes that are no packets: a board that starts, another speed, a broken line."""

    byte_count: int


Evidence = Answered | Silent | Echoed | Noise

Fit = Literal["fits", "silent", "contradicts"]
"""`silent`: such a board answers something that this one did not; it may be off. `contradicts`: it never
answers so.
"""


def candidates_of(evidence: Sequence[Evidence]) -> list[str]:
    """Families that answer like this; none where nobody asked."""
    if not evidence:
        return []
    return [
        family.id
        for family in FAMILIES.values()
        if family is not UNKNOWN and fit_of(family, evidence) == "fits"
    ]


def fit_of(family: Family, evidence: Sequence[Evidence]) -> Fit:
    if any(contradicts(family, one) for one in evidence):
        return "contradicts"
    return "silent" if any(is_missing(family, one) for one in evidence) else "fits"


def contradicts(family: Family, evidence: Evidence) -> bool:
    match evidence:
        case Echoed():
            return True
        case Answered(question, report):
            is_other_unit = isinstance(report, Version) and report.unit != family.unit
            return question not in family.answers or is_other_unit
        case _:
            return False


def is_missing(family: Family, evidence: Evidence) -> bool:
    return isinstance(evidence, Silent) and evidence.question in family.certain_answers


def told_identity(evidence: Sequence[Evidence]) -> IdentityTold:
    """As clients are told."""
    return IdentityTold(evidence=[told_evidence(one) for one in evidence], candidates=candidates_of(evidence))


def told_evidence(evidence: Evidence) -> EvidenceTold:
    match evidence:
        case Answered(question, report):
            return AnsweredTold(question=question, report=told_answer(report))
        case Silent(question):
            return SilentTold(question=question)
        case Echoed():
            return EchoedTold()
        case Noise(byte_count):
            return NoiseTold(byte_count=byte_count)


def told_answer(report: Report) -> BatteryReport | VersionReport | PositionsReport:
    match report:
        case Battery(battery_mv):
            return BatteryReport(battery_mv=battery_mv)
        case Version(unit, version):
            return VersionReport(unit=unit, version=version)
        case Positions(positions):
            return PositionsReport(
                positions=[ServoPosition(servo=one.servo, position=one.position) for one in positions]
            )
        case _:
            raise AssertionError(f"{report} answers no question.")
