"""Board families as data: what a board of each kind takes and answers, as far as the gateway judges it.

The same rows as shared/src/protocol/families.ts; shared/vectors/families.json holds both to each other.
Sources: boards.md section 2, cited there row by row.
"""

from dataclasses import dataclass
from typing import Literal

CommandKind = Literal["move", "run", "stop", "erase", "readBattery", "download"]


@dataclass(frozen=True, slots=True)
class Range:
    min: int
    max: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    id: str
    name: str
    unit: Literal["us", "steps"]
    position: Range
    servo: Range
    servos_per_move: int
    servos_per_frame: int
    duration_ms: Range
    frames_per_group: int
    slot: Range
    run_times: Range
    # Largest LEN that is safe to send.
    max_length: int
    commands: tuple[CommandKind, ...]
    answers: tuple[CommandKind, ...]
    # 6 and 8 with LEN 5 tell slot and times, whoever asked for the run; otherwise they are empty.
    run_reports_name_slot: bool
    # What an empty packet 7 says: opposite things per family.
    empty_seven: Literal["runFinished", "runStopped", "unknown"]
    # Pause after the last byte has left the wire.
    service_gap_ms: int


PULSE_US = Range(500, 2500)
DURATION_MS = Range(0, 30_000)
RUN_TIMES = Range(0, 0xFFFF)

DOC = Family(
    id="doc",
    name="Generic board",
    unit="us",
    position=PULSE_US,
    servo=Range(1, 32),
    servos_per_move=32,
    servos_per_frame=32,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 255),
    run_times=RUN_TIMES,
    max_length=253,
    commands=("move", "run", "stop", "erase", "readBattery", "download"),
    answers=("run", "erase", "readBattery", "download"),
    run_reports_name_slot=False,
    empty_seven="runFinished",
    service_gap_ms=10,
)

OPENARM_NEW = Family(
    id="openarm-new",
    name="OpenArm, uHand 2.0",
    unit="us",
    position=PULSE_US,
    servo=Range(1, 6),
    servos_per_move=6,
    servos_per_frame=6,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 255),
    run_times=RUN_TIMES,
    max_length=253,
    commands=("move", "run", "stop", "erase", "download"),
    answers=("run", "erase", "download"),
    run_reports_name_slot=False,
    empty_seven="runFinished",
    service_gap_ms=10,
)

LSC_16 = Family(
    id="lsc-16",
    name="LSC-16",
    unit="us",
    position=PULSE_US,
    servo=Range(1, 16),
    servos_per_move=16,
    servos_per_frame=16,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 229),
    run_times=RUN_TIMES,
    max_length=62,
    commands=("move", "run", "stop", "readBattery"),
    answers=("readBattery",),
    run_reports_name_slot=True,
    empty_seven="runStopped",
    service_gap_ms=10,
)

BUS_CTRL = Family(
    id="bus-ctrl",
    name="Bus Servo Controller",
    unit="steps",
    position=Range(0, 1000),
    servo=Range(1, 253),
    servos_per_move=19,
    servos_per_frame=19,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 229),
    run_times=RUN_TIMES,
    max_length=62,
    commands=("move", "run", "stop", "readBattery"),
    answers=("readBattery",),
    run_reports_name_slot=True,
    empty_seven="runStopped",
    service_gap_ms=10,
)

FAMILIES: dict[str, Family] = {row.id: row for row in (DOC, OPENARM_NEW, LSC_16, BUS_CTRL)}
