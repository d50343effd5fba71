"""Asks a board who it is, by questions that move nothing and store nothing on any board, in the order of
boards.md 2.5. On a LeArm any question ends a running group (L8). Twin of shared/src/session/identify.ts.

Knows how to ask and how long to wait; what the answers mean is identity.py.
"""

import asyncio
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass

from servodeck.board.identity import Answered, Echoed, Evidence, Noise, Silent
from servodeck.protocol.families import UNKNOWN, Question
from servodeck.protocol.packets import encode
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


@dataclass(frozen=True, slots=True)
class Asked:
    """A question as a packet, and what answers it."""

    packet: bytes
    answer: type[Report]


QUESTIONS: Mapping[Question, Asked] = {
    "readBattery": Asked(encode(ReadBattery(), UNKNOWN), Battery),
    "readVersion": Asked(encode(ReadVersion(), UNKNOWN), Version),
    # One servo's is enough: bus boards answer, the others do not know the question.
    "readPositions": Asked(encode(ReadPositions((1,)), UNKNOWN), Positions),
}

Ask = Callable[[Question], Awaitable[Report | None]]
"""Puts it to the board once. None where no answer came; raises where it could not be asked."""


async def identify(
    ask_once: Ask, noise_bytes: Callable[[], int], echoes: Callable[[], int]
) -> Sequence[Evidence]:
    """`noise_bytes`: heard so far that were no packets; `echoes`: packets heard so far that were our own
    question. Raises when the link goes meanwhile.
    """
    noise_before, echoes_before = noise_bytes(), echoes()

    async def ask(question: Question) -> Evidence:
        for _ in range(IDENTIFY.attempts):
            if report := await ask_once(question):
                return Answered(question, report)
        return Silent(question)

    async def ask_all() -> list[Evidence]:
        battery = await ask("readBattery")
        return [battery, await ask("readPositions" if isinstance(battery, Answered) else "readVersion")]

    await asyncio.sleep(IDENTIFY.listen_ms / 1000)
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
    """What came in holds one of our own questions."""
    return any(asked.packet in data for asked in QUESTIONS.values())
