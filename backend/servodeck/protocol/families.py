"""Board families as data: what a board of each kind takes and answers, as far as the gateway judges it.

The same rows as shared/src/protocol/families.ts; shared/protocol/vectors/families.json holds both to
each other.
Sources: boards.md section 2, cited there row by row.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Final, Literal

CommandKind = Literal[
    "move",
    "run",
    "stop",
    "erase",
    "readBattery",
    "download",
    "setSpeed",
    "release",
    "readPositions",
    "readVersion",
    "readAllPositions",
    "readOffsets",
]


@dataclass(frozen=True, slots=True)
class Range:
    min: int
    max: int


@dataclass(frozen=True, slots=True)
class MotionTraits:
    """How a board turns its servos and plays its groups: what the motion estimate has to know of it."""

    tick_ms: int
    # The longest that its loop is busy without being deaf to us: with what it says (S21), a pad's poll (S52),
    # entries handed on to bus servos (S31). Its servos wait that long, and what came meanwhile is late (S29).
    talk_ms: float
    # `shared`: any new target re-times every servo (S26). `perServo`: one that starts leaves the others
    # alone.
    timing: Literal["shared", "perServo"]
    # `deadlines`: a frame takes its time, to the millisecond (S42). `polled`: the next begins some time
    # behind it (L7).
    groups: Literal["deadlines", "polled"]
    # A stop halts these where they are; the others go on to the end of their frame (S50, L9).
    halted_by_stop: tuple[int, ...] = ()
    # When the group in this slot ends by itself, the next one is played once (S49).
    chained_slot: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Family:
    id: str
    name: str
    unit: Literal["us", "steps"]
    position: Range
    # Servos that may turn less far than `position` says.
    servo_position: Mapping[int, Range] = field(default_factory=dict)
    servo: Range
    usual_servo_count: int
    servos_per_move: int
    servos_per_frame: int
    duration_ms: Range
    shortest_move_ms: int = 20
    frames_per_group: int
    slot: Range
    run_times: Range
    # Where the group speed cannot be set, it is what it is.
    speed_percent: Range = Range(100, 100)
    # Largest LEN that is safe to send.
    max_length: int
    commands: tuple[CommandKind, ...]
    # LEN of the erase command: with a reserved byte or without.
    erase_length: Literal[2, 3] = 3
    answers: tuple[CommandKind, ...]
    # 6 and 8 with LEN 5 tell slot and times, whoever asked for the run; otherwise they are empty.
    run_reports_name_slot: bool
    # What an empty packet 7 says: opposite things per family.
    empty_seven: Literal["runFinished", "runStopped", "unknown"]
    # What ends a packet that was cut, on a board that bears it; None: nothing may be sent for that.
    resync_filler: int | None
    # Pause after the last byte has left the wire.
    service_gap_ms: int
    motion: MotionTraits

    def position_of(self, servo: int) -> Range:
        return self.servo_position.get(servo, self.position)


PULSE_US = Range(500, 2500)
DURATION_MS = Range(0, 30_000)
RUN_TIMES = Range(0, 0xFFFF)
# The longest packet that fits one HID report.
HID_LENGTH = 62

SHARED_TIME = MotionTraits(tick_ms=20, talk_ms=0, timing="shared", groups="deadlines")
OPEN_FIRMWARE = replace(SHARED_TIME, talk_ms=4.2, chained_slot=100)

DOC = Family(
    id="doc",
    name="Generic board",
    unit="us",
    position=PULSE_US,
    servo=Range(1, 32),
    usual_servo_count=6,
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
    resync_filler=0xFD,
    service_gap_ms=10,
    motion=replace(OPEN_FIRMWARE, talk_ms=20),
)

OPENARM_NEW = replace(
    DOC,
    id="openarm-new",
    name="uHand 2.0 / OpenArm",
    servo=Range(1, 6),
    servos_per_move=6,
    servos_per_frame=6,
    commands=("move", "run", "stop", "erase", "download"),
    answers=("run", "erase", "download"),
    motion=replace(OPEN_FIRMWARE, talk_ms=23),
)

OPENARM_OLD = replace(
    OPENARM_NEW,
    id="openarm-old",
    name="uHand 2.0 / OpenArm, old build",
    answers=("erase", "download"),
    empty_seven="unknown",
    motion=replace(SHARED_TIME, talk_ms=16.5),
)

BUS_CTRL = Family(
    id="bus-ctrl",
    name="Bus Servo Controller",
    unit="steps",
    position=Range(0, 1000),
    servo=Range(1, 253),
    usual_servo_count=6,
    servos_per_move=19,
    servos_per_frame=19,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 229),
    run_times=RUN_TIMES,
    speed_percent=Range(1, 300),
    max_length=HID_LENGTH,
    commands=("move", "run", "stop", "readBattery", "setSpeed", "release", "readPositions"),
    answers=("readBattery", "readPositions"),
    run_reports_name_slot=True,
    empty_seven="runStopped",
    resync_filler=None,
    service_gap_ms=10,
    motion=replace(SHARED_TIME, talk_ms=7.3, timing="perServo"),
)

XARM = replace(
    BUS_CTRL,
    id="xarm",
    name="xArm",
    servo=Range(1, 6),
    servos_per_move=6,
    servos_per_frame=6,
    duration_ms=Range(0, 3000),
)


def lsc(outputs: int) -> Family:
    """One move may name every output, also where that is more than a HID report holds."""
    return replace(
        BUS_CTRL,
        id=f"lsc-{outputs}",
        name=f"LSC-{outputs}",
        unit="us",
        position=PULSE_US,
        servo=Range(1, outputs),
        usual_servo_count=outputs,
        servos_per_move=outputs,
        servos_per_frame=outputs,
        max_length=max(HID_LENGTH, 3 * outputs + 5),
        commands=("move", "run", "stop", "readBattery", "setSpeed"),
        answers=("readBattery",),
    )


LEARM_ESP32 = Family(
    id="learm-esp32",
    name="LeArm AI",
    unit="us",
    position=PULSE_US,
    servo_position={1: Range(500, 1500)},
    servo=Range(1, 6),
    usual_servo_count=6,
    servos_per_move=6,
    servos_per_frame=6,
    duration_ms=DURATION_MS,
    frames_per_group=255,
    slot=Range(0, 254),
    run_times=Range(1, 255),
    max_length=62,
    commands=(
        "move",
        "run",
        "stop",
        "erase",
        "download",
        "readVersion",
        "readAllPositions",
        "readOffsets",
    ),
    erase_length=2,
    answers=("erase", "download", "readVersion", "readAllPositions", "readOffsets"),
    run_reports_name_slot=False,
    empty_seven="unknown",
    resync_filler=None,
    service_gap_ms=10,
    motion=MotionTraits(
        tick_ms=10, talk_ms=0, timing="perServo", groups="polled", halted_by_stop=(1, 2, 3, 4, 5)
    ),
)

LEARM_ESP32_BUS = replace(
    LEARM_ESP32,
    id="learm-esp32-bus",
    name="LeArm AI, bus servos",
    unit="steps",
    position=Range(125, 875),
    servo_position={1: Range(200, 700)},
)

# A board nobody has identified yet: harmless questions and the stop, nothing that moves or stores.
UNKNOWN = replace(
    DOC,
    id="unknown",
    name="Unknown board",
    servo=Range(1, 1),
    usual_servo_count=0,
    servos_per_move=1,
    servos_per_frame=0,
    max_length=6,
    commands=("stop", "readBattery", "readVersion", "readPositions"),
    answers=("readBattery", "readVersion", "readPositions"),
    empty_seven="unknown",
    resync_filler=None,
    motion=OPEN_FIRMWARE,
)

ROWS: Final = (
    DOC,
    OPENARM_OLD,
    OPENARM_NEW,
    *(lsc(outputs) for outputs in (6, 16, 24, 32)),
    BUS_CTRL,
    XARM,
    LEARM_ESP32,
    LEARM_ESP32_BUS,
    UNKNOWN,
)
FAMILIES: dict[str, Family] = {row.id: row for row in ROWS}
