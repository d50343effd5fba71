"""Robot documents: the text of a robot with what belongs to it, and its facts that the gateway needs. Reading
trusts nothing and says what is wrong. Twin of shared/src/profile (robot.ts, robotText.ts, pose.ts) and of
robotFactsOf in shared/src/files/facts.ts; both run shared/protocol/vectors/robots.json.

Buttons and pad are the page's alone: what their texts mean is not read. Knows no library and no client.
"""

import json
from collections.abc import Sequence
from typing import Annotated, Any, Final, Literal, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field, ValidationError

from servodeck.errors import MalformedError
from servodeck.protocol import load_shared
from servodeck.protocol.families import FAMILIES, UNKNOWN, Range
from servodeck.schema import Message, has_more_values, is_object, text_member
from servodeck.snapshots import MAX_SAFE, BatteryPolicy, NamedPose, PoseTarget, RobotFacts, ServoLimits

KIT_FORMAT: Final = "servodeck-robot-kit"
# More than a text of the library has room for, and few enough to parse without others waiting.
MAX_VALUES: Final = 250_000
# What JavaScript trims.
SPACES: Final = (
    "\t\n\v\f\r \u00a0\u1680\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a"
    "\u2028\u2029\u202f\u205f\u3000\ufeff"
)
_ROBOTS: Final = load_shared("robots")
NAME_LENGTH: Final[int] = _ROBOTS["nameLength"]
TRIM, BATTERY_MV, SUPPLY_MA = (Range(**_ROBOTS[name]) for name in ("trim", "batteryMv", "supplyMa"))

Found = TypeVar("Found", bound=Message)


class RobotFlawError(MalformedError):
    """`flaw`: its code, as robot.ts has it; of a servo `servo/…`, of the poses `poses/…`."""

    def __init__(self, flaw: str, detail: str) -> None:
        super().__init__(f"This robot cannot be stored: {detail}.")
        self.flaw = flaw


def as_whole(found: object) -> object:
    """JSON has one kind of number: 500.0 is as whole as 500, and `true` is none."""
    if isinstance(found, bool):
        return None
    return int(found) if isinstance(found, float) and found.is_integer() else found


def trimmed(text: str) -> str:
    return text.strip(SPACES)


def length_of(text: str) -> int:
    """As JavaScript counts it."""
    return len(text.encode("utf-16-le")) // 2


def within(shortest: int, longest: int) -> AfterValidator:
    def judged(text: str) -> str:
        if not shortest <= length_of(text) <= longest:
            raise ValueError(f"takes {shortest} to {longest} characters")
        return text

    return AfterValidator(judged)


def known_board(board: str) -> str:
    if board not in FAMILIES or board == UNKNOWN.id:
        raise ValueError("takes a known board")
    return board


WHOLE: Final = BeforeValidator(as_whole)
Name = Annotated[str, AfterValidator(trimmed), within(1, NAME_LENGTH)]
UrdfName = Annotated[str, within(1, 128)]
Position = Annotated[int, WHOLE, Field(ge=0, le=2500)]
Trim = Annotated[int, WHOLE, Field(ge=TRIM.min, le=TRIM.max)]
Millivolts = Annotated[int, WHOLE, Field(ge=BATTERY_MV.min, le=BATTERY_MV.max)]
Milliamperes = Annotated[int, WHOLE, Field(ge=SUPPLY_MA.min, le=SUPPLY_MA.max)]
AnyWhole = Annotated[int, WHOLE, Field(ge=-MAX_SAFE, le=MAX_SAFE)]
RunningId = Annotated[int, WHOLE, Field(ge=1, le=MAX_SAFE)]
ServoNumber = Annotated[int, WHOLE, Field(ge=1, le=253)]
Percent = Annotated[int, WHOLE, Field(ge=0, le=100)]
Version = Annotated[Literal[1], WHOLE]
# A key that may be missing, and takes no null.
MISSING: Final[Any] = Field(default=None)


class Joint(Message):
    name: UrdfName
    is_reversed: bool
    home_degrees: Annotated[float, Field(ge=-360, le=360)]


class Model(Message):
    id: Annotated[str, Field(pattern="^[0-9a-f]{16}$")]
    file_name: Annotated[str, within(1, 255)]
    end: UrdfName | None


class Place(Message):
    x: Percent
    y: Percent


class RoughServo(Message):
    """With any numbers for what its reach is made of: one out of range is a flaw that names the servo."""

    servo: ServoNumber
    name: Name
    group: Annotated[str, within(0, NAME_LENGTH)]
    min: AnyWhole
    max: AnyWhole
    home: AnyWhole
    is_reversed: bool
    trim: AnyWhole
    degrees_per_unit: Annotated[float, Field(gt=0, le=2)]
    mirror: ServoNumber | None
    place: Place
    joint: Joint = MISSING


class Servo(RoughServo):
    min: Position
    max: Position
    home: Position
    trim: Trim


class Thresholds(Message):
    warn_mv: Millivolts
    alarm_mv: Millivolts


class BatteryCare(Message):
    policy: BatteryPolicy
    thresholds: Thresholds | None
    supply_ma: Milliamperes = MISSING


class RoughRobot(Message):
    name: Name
    board: Annotated[str, AfterValidator(known_board)]
    body: Literal["arm", "hand", "humanoid", "hexapod", "plain"]
    battery: Literal["adapter", "2s", "3s"]
    battery_care: BatteryCare
    servos: Sequence[RoughServo]
    model: Model = MISSING


class Robot(RoughRobot):
    servos: Annotated[list[Servo], Field(min_length=1, max_length=253)]


class RoughRobotFile(Message):
    format: Literal["servodeck-robot"]
    version: Version
    robot: RoughRobot


class RobotFile(RoughRobotFile):
    robot: Robot


class DocumentTarget(Message):
    servo: Annotated[int, WHOLE, Field(ge=0, le=0xFF)]
    position: Annotated[int, WHOLE, Field(ge=0, le=0xFFFF)]


class Pose(Message):
    id: RunningId
    name: Name
    unit: Literal["us", "steps"]
    targets: Annotated[list[DocumentTarget], Field(min_length=1, max_length=253)]


class PoseBook(Message):
    poses: Annotated[list[Pose], Field(max_length=1000)]
    rest_id: RunningId | None
    applied: Literal["home", "rest"] | RunningId | None
    next_id: RunningId


class PoseFile(Message):
    format: Literal["servodeck-poses"]
    version: Version
    content: PoseBook


class Kit(Message):
    """The texts of its parts; None: as it comes with every robot."""

    robot: str
    poses: str | None
    buttons: str | None
    pad: str | None


class KitFile(Message):
    format: Literal["servodeck-robot-kit"]
    version: Version
    kit: Kit


def is_kit(text: str) -> bool:
    """Whether it says of itself that it is a robot."""
    return text_member(text, "format") == KIT_FORMAT


def robot_facts(text: str, updated_at_ms: int) -> RobotFacts:
    """The facts of a robot document. Raises RobotFlawError. Takes a while: not on the loop."""
    kit = kit_of(text)
    robot = robot_of(kit.robot)
    board = FAMILIES[robot.board]
    trims = {servo.servo: servo.trim for servo in robot.servos}
    home = sorted((servo.servo, servo.home) for servo in robot.servos)
    poses = [pose_on_board(0, "home", board.unit, home, trims)]
    for pose in poses_of(kit.poses):
        targets = [(target.servo, target.position) for target in pose.targets]
        poses.append(pose_on_board(pose.id, pose.name, pose.unit, targets, trims))
    supply = usual_supply(robot)
    thresholds = robot.battery_care.thresholds
    return RobotFacts(
        kind="robot",
        name=robot.name,
        board=robot.board,
        updated_at_ms=updated_at_ms,
        limits=[
            ServoLimits(
                servo=servo.servo,
                name=servo.name,
                min=servo.min + servo.trim,
                max=servo.max + servo.trim,
                trim=servo.trim,
            )
            for servo in robot.servos
        ],
        poses=[pose for pose in poses if pose is not None],
        low_battery_mv=thresholds.warn_mv if thresholds else supply["warnMv"],
        battery_policy=robot.battery_care.policy,
        alarm_mv=thresholds.alarm_mv if thresholds else supply["alarmMv"],
    )


def pose_on_board(
    number: int,
    name: str,
    unit: Literal["us", "steps"],
    targets: Sequence[tuple[int, int]],
    trims: dict[int, int],
) -> NamedPose | None:
    """As the board counts. None where a trim takes it out of what can be sent."""
    on_board = [(servo, position + trims.get(servo, 0)) for servo, position in targets]
    if any(not 0 <= position <= 0xFFFF for _, position in on_board):
        return None
    sent = [PoseTarget(servo=servo, position=position) for servo, position in on_board]
    return NamedPose(id=number, name=name, unit=unit, targets=sent)


def usual_supply(robot: RoughRobot) -> dict[str, int]:
    """The thresholds that are usual for what feeds it. Twin of usualSupply in battery.ts."""
    cells = _ROBOTS["cells"][robot.battery]
    if cells:
        return {name: mv * cells for name, mv in _ROBOTS["cell"].items()}
    usual: dict[str, int] = _ROBOTS["adapterUs" if FAMILIES[robot.board].unit == "us" else "adapterSteps"]
    return usual


def kit_of(text: str) -> Kit:
    try:
        return KitFile.model_validate(parsed(text)).kit
    except ValidationError:
        raise RobotFlawError("kit", "it is no servodeck-robot-kit of version 1") from None


def robot_of(text: str) -> Robot:
    found = parsed(text)
    try:
        robot = RobotFile.model_validate(found).robot
    except ValidationError as error:
        judge_roughly(found)
        raise flaw_in(error, found) from None
    judge(robot)
    return robot


def judge_roughly(found: object) -> None:
    """Raises the flaw that names the servo whose number is out of range."""
    try:
        robot = RoughRobotFile.model_validate(found).robot
    except ValidationError:
        return
    judge(robot)


def judge(robot: RoughRobot) -> None:
    """What no schema can. Raises RobotFlawError. Twin of flawOf in robot.ts."""
    numbers = [servo.servo for servo in robot.servos]
    for index, servo_number in enumerate(numbers):
        if servo_number in numbers[:index]:
            raise RobotFlawError("servoTwice", f"servo {servo_number} appears twice")
    thresholds = robot.battery_care.thresholds
    if thresholds and thresholds.alarm_mv >= thresholds.warn_mv:
        raise RobotFlawError(
            "alarmNotBelow",
            f"its battery alarm {thresholds.alarm_mv} mV is not below its warning {thresholds.warn_mv} mV",
        )
    for servo in robot.servos:
        judge_servo(servo, robot)


def judge_servo(servo: RoughServo, robot: RoughRobot) -> None:
    family = FAMILIES[robot.board]
    board, allowed = family.position_of(servo.servo), Range(servo.min, servo.max)

    def flaw(code: str, detail: str) -> RobotFlawError:
        return RobotFlawError(f"servo/{code}", f"{servo.name} (servo {servo.servo}): {detail}")

    if not is_in(servo.servo, family.servo):
        raise flaw("number", f"its board takes servos {said(family.servo)}")
    if servo.min >= servo.max:
        raise flaw("minNotBelowMax", f"its lowest position {servo.min} is not below its highest {servo.max}")
    if not is_in(servo.home, allowed):
        raise flaw("home", f"its home {servo.home} is outside {said(allowed)}")
    if not is_in(servo.trim, TRIM):
        raise flaw("trim", f"its trim {servo.trim} is outside {said(TRIM)}")
    if servo.min + servo.trim < board.min or servo.max + servo.trim > board.max:
        raise flaw("beyondBoard", f"with its trim it exceeds the range of the board, {said(board)}")
    if servo.mirror is not None and all(servo.mirror != other.servo for other in robot.servos):
        raise flaw("noMirror", f"its mirror, servo {servo.mirror}, does not exist")


def is_in(found: int, allowed: Range) -> bool:
    return allowed.min <= found <= allowed.max


def said(allowed: Range) -> str:
    return f"{allowed.min}..{allowed.max}"


def poses_of(text: str | None) -> list[Pose]:
    if text is None:
        return []
    try:
        book = PoseFile.model_validate(parsed(text)).content
    except ValidationError as error:
        code = file_flaw(error)
        raise RobotFlawError(f"poses/{code or 'badValue'}", f"in its poses, {described(error)}") from None
    ids = [pose.id for pose in book.poses]
    if len(set(ids)) < len(ids) or any(one >= book.next_id for one in ids):
        raise RobotFlawError("poses/sameNumber", "two of its poses have the same number")
    named = (book.rest_id, book.applied if isinstance(book.applied, int) else None)
    if any(one is not None and one not in ids for one in named):
        raise RobotFlawError("poses/poseMissing", "its poses refer to one that they do not contain")
    for pose in book.poses:
        if len({target.servo for target in pose.targets}) < len(pose.targets):
            raise RobotFlawError("poses/servoTwice", f"{pose.name}: a servo appears twice")
    return book.poses


def flaw_in(error: ValidationError, found: object) -> RobotFlawError:
    """Twin of problemOf in robotText.ts."""
    code = file_flaw(error)
    if code == "otherVersion":
        return RobotFlawError(code, "it was written by another version of Servodeck")
    if code == "notOurs" or not (isinstance(found, dict) and "robot" in found):
        return RobotFlawError("notOurs", "it is no servodeck-robot")
    first = error.errors(include_url=False, include_input=False)[0]
    return RobotFlawError("strangeField" if first["type"] == "extra_forbidden" else "field", described(error))


def file_flaw(error: ValidationError) -> Literal["notOurs", "otherVersion"] | None:
    """Whether it is another file altogether."""
    first = error.errors(include_url=False, include_input=False)[0]
    place = first["loc"][:-1] if first["type"] == "extra_forbidden" else first["loc"]
    if not place or place[0] == "format":
        return "notOurs"
    return "otherVersion" if place[0] == "version" else None


def described(error: ValidationError) -> str:
    """Where and what; never what stands there."""
    first = error.errors(include_url=False, include_context=False, include_input=False)[0]
    where = ".".join(str(part) for part in first["loc"])
    return f"{where}: {first['msg']}" if where else first["msg"]


def parsed(text: str) -> object:
    """None where it is no JSON object, or more than any document is."""
    try:
        if not is_object(text) or has_more_values(text, MAX_VALUES):
            return None
        return json.loads(text, object_pairs_hook=well_formed)
    except (ValueError, RecursionError):
        return None


def well_formed(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Half a character, cut off at the limit of a name, could not be sent."""
    return {mended(name): mended(found) if isinstance(found, str) else found for name, found in pairs}


def mended(text: str) -> str:
    if text.isascii():
        return text
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")
