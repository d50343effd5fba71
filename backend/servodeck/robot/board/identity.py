"""The family of the board: the questions, in the order of boards.md 2.5, and what the answers mean, by
the family table. Twin of shared/src/robot/identify.ts and identity.ts.

The questions move nothing and store nothing on any board; on a LeArm any question ends a running group (L8).
Answers never name one family for certain, so a person chooses among those that fit.
"""

import asyncio
from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Literal

from servodeck.packet_models import BatteryReport, PositionsReport, ServoPosition, VersionReport
from servodeck.protocol.families import FAMILIES, UNKNOWN, Family, Question
from servodeck.protocol.packets import CommandPacket, encoded
from servodeck.protocol.timings import IDENTIFY
from servodeck.protocol.values import (
    Battery,
    Positions,
    ReadBattery,
    ReadPositions,
    ReadVersion,
    Report,
    Version,
)
from servodeck.snapshots import (
    AnsweredEvidence,
    EchoedEvidence,
    EvidenceState,
    IdentityState,
    NoiseEvidence,
    SilentEvidence,
)
from servodeck.value import value


@value
class Answered:
    question: Question
    report: Report


@value
class Silent:
    question: Question


@value
class Echoed:
    """The question itself came back: the line is looped, or something else listens there (S14)."""


@value
class Noise:
    """Bytes that are no packets: a board that starts, another speed, a broken line."""

    byte_count: int


Evidence = Answered | Silent | Echoed | Noise

Fit = Literal["fits", "silent", "contradicts"]
"""`silent`: such a board answers something that this one did not; it may be off. `contradicts`: it never
answers so.
"""


def candidates_of(evidence: Sequence[Evidence]) -> list[str]:
    """Families that answer like this; none where it was not queried."""
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


def identity_state(evidence: Sequence[Evidence]) -> IdentityState:
    """For clients."""
    return IdentityState(
        evidence=[evidence_state(one) for one in evidence], candidates=candidates_of(evidence)
    )


def evidence_state(evidence: Evidence) -> EvidenceState:
    match evidence:
        case Answered(question, report):
            return AnsweredEvidence(question=question, report=report_state(report))
        case Silent(question):
            return SilentEvidence(question=question)
        case Echoed():
            return EchoedEvidence()
        case Noise(byte_count):
            return NoiseEvidence(byte_count=byte_count)


def report_state(report: Report) -> BatteryReport | VersionReport | PositionsReport:
    match report:
        case Battery(battery_mv):
            return BatteryReport(battery_mv=battery_mv)
        case Version(unit, version):
            return VersionReport(unit=unit, version=version)
        case Positions(positions):
            return PositionsReport(
                positions=tuple(ServoPosition(servo=one.servo, position=one.position) for one in positions)
            )
        case _:
            raise AssertionError(f"{report} answers no question.")


@value
class QuestionPacket:
    """A question as a packet, and what answers it."""

    packet: CommandPacket
    answer: type[Report]


QUESTIONS: Mapping[Question, QuestionPacket] = {
    "readBattery": QuestionPacket(encoded(ReadBattery(), UNKNOWN), Battery),
    "readVersion": QuestionPacket(encoded(ReadVersion(), UNKNOWN), Version),
    # One servo's is enough: bus boards answer, the others do not know the question.
    "readPositions": QuestionPacket(encoded(ReadPositions((1,)), UNKNOWN), Positions),
}

SendQuestion = Callable[[Question], Awaitable[Report | None]]
"""Puts it to the board once. None where no answer came; raises if it cannot be sent."""


async def identify(
    send_question: SendQuestion,
    noise_bytes: Callable[[], int],
    echoes: Callable[[], int],
    stops: asyncio.Task[None] | None = None,
) -> Sequence[Evidence]:
    """`noise_bytes`: heard so far that were no packets; `echoes`: packets heard so far that were our own
    question. `stops` leave before the first question. Raises when the link goes meanwhile.
    """
    noise_before, echoes_before = noise_bytes(), echoes()

    async def ask(question: Question) -> Evidence:
        for _ in range(IDENTIFY.attempts):
            if report := await send_question(question):
                return Answered(question, report)
        return Silent(question)

    async def ask_all() -> list[Evidence]:
        battery = await ask("readBattery")
        return [battery, await ask("readPositions" if isinstance(battery, Answered) else "readVersion")]

    await asyncio.sleep(IDENTIFY.listen_ms / 1000)
    if stops:
        await asyncio.shield(stops)
    answers = await ask_all()
    # Text lines come from a LeArm that has just restarted and is deaf for a while (L1).
    is_starting = noise_bytes() > noise_before and echoes() == echoes_before
    if is_starting and all(isinstance(answer, Silent) for answer in answers):
        await asyncio.sleep(IDENTIFY.boot_ms / 1000)
        answers = await ask_all()
    if echoes() > echoes_before:
        answers.append(Echoed())
    if (byte_count := noise_bytes() - noise_before) > 0:
        answers.append(Noise(byte_count))
    return answers


def is_echo(data: bytes) -> bool:
    """The received bytes contain one of our own questions."""
    return any(query.packet.data in data for query in QUESTIONS.values())
