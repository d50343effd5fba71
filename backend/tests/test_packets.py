"""The gateway's codec against the shared vectors, and what holds for all commands."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.errors import GatewayError, MalformedError, NotSupportedError, OutOfRangeError
from servodeck.protocol import snake
from servodeck.protocol.decoder import Decoder, DecoderEvent, Packet, PacketEvent
from servodeck.protocol.families import FAMILIES, Family, MotionTraits, Range
from servodeck.protocol.packets import check_command, encode, parse_command, parse_report
from servodeck.protocol.values import (
    AllPositions,
    Battery,
    Command,
    Download,
    Erase,
    Erased,
    Frame,
    FrameStored,
    Move,
    Offsets,
    Positions,
    ReadAllPositions,
    ReadBattery,
    ReadOffsets,
    ReadPositions,
    ReadVersion,
    Release,
    Report,
    Run,
    RunAccepted,
    RunFinished,
    RunStarted,
    RunStopped,
    ServoOffset,
    ServoTarget,
    SetSpeed,
    Stop,
    UnknownReport,
    Version,
)
from tests.vectors import load_vectors

DOC = FAMILIES["doc"]


def load(name: str) -> list[Any]:
    return [pytest.param(vector, id=vector["name"]) for vector in load_vectors(name)]


def frame_of(value: Any) -> Frame:
    targets = (ServoTarget(target["servo"], target["position"]) for target in value["targets"])
    return Frame(value["durationMs"], tuple(targets))


def command_of(value: Any) -> Command:
    match value["kind"]:
        case "move":
            frame = frame_of(value)
            return Move(frame.duration_ms, frame.targets)
        case "run":
            return Run(value["slot"], value["times"])
        case "download":
            return Download(value["slot"], value["frameCount"], value["frameIndex"], frame_of(value["frame"]))
        case "setSpeed":
            return SetSpeed(value["slot"], value["percent"])
        case "release":
            return Release(tuple(value["servos"]))
        case "readPositions":
            return ReadPositions(tuple(value["servos"]))
    plain: dict[str, Command] = {
        "stop": Stop(),
        "erase": Erase(),
        "readBattery": ReadBattery(),
        "readVersion": ReadVersion(),
        "readAllPositions": ReadAllPositions(),
        "readOffsets": ReadOffsets(),
    }
    return plain[value["kind"]]


def positions_of(value: Any) -> tuple[ServoTarget, ...]:
    return tuple(ServoTarget(at["servo"], at["position"]) for at in value["positions"])


def report_of(value: Any) -> Report:
    match value["kind"]:
        case "runStarted":
            return RunStarted(value["slot"], value["times"])
        case "runFinished":
            return RunFinished(value["slot"])
        case "battery":
            return Battery(value["batteryMv"])
        case "positions":
            return Positions(positions_of(value))
        case "allPositions":
            return AllPositions(positions_of(value))
        case "offsets":
            return Offsets(tuple(ServoOffset(one["servo"], one["offset"]) for one in value["offsets"]))
        case "version":
            return Version(value["unit"], value["version"])
        case "unknown":
            return UnknownReport(value["command"], bytes.fromhex(value["params"]))
    plain: dict[str, Report] = {
        "runAccepted": RunAccepted(),
        "runStopped": RunStopped(),
        "erased": Erased(),
        "frameStored": FrameStored(),
    }
    return plain[value["kind"]]


@pytest.mark.parametrize("vector", load("commands"))
def test_commands_are_these_bytes_and_back(vector: Any) -> None:
    packet, command = bytes.fromhex(vector["hex"]), command_of(vector["command"])
    assert encode(command, FAMILIES[vector["family"]]) == packet
    assert parse_command(packet) == command
    assert check_command(packet, FAMILIES[vector["family"]]) == command


@pytest.mark.parametrize("vector", load("reports"))
def test_reports_mean_this_in_this_family(vector: Any) -> None:
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append)
    decoder.push(bytes.fromhex(vector["hex"]))
    decoder.idle()
    (event,) = events
    assert isinstance(event, PacketEvent)
    assert parse_report(event.packet, FAMILIES[vector["family"]]) == report_of(vector["report"])


@pytest.mark.parametrize("vector", load("refusals"))
def test_what_a_board_cannot_take_is_refused_by_name_value_and_range(vector: Any) -> None:
    with pytest.raises((OutOfRangeError, NotSupportedError)) as caught:
        encode(command_of(vector["command"]), FAMILIES[vector["family"]])
    refusal, field = caught.value, vector["field"]
    code = "notSupported" if field == "command" else "outOfRange"
    assert (refusal.code, refusal.detail) == (code, vector["message"])
    assert refusal.detail.startswith(field)


def test_the_family_table_is_read_as_the_page_reads_it() -> None:
    read = [
        {name: plain(getattr(row, name)) for name in Family.__dataclass_fields__} for row in FAMILIES.values()
    ]
    assert read == [snakes(row) for row in load_vectors("families")]


def snakes(row: Any) -> Any:
    return {snake(name): snakes(value) if name == "motion" else value for name, value in row.items()}


def plain(value: object) -> object:
    if isinstance(value, Range | MotionTraits):
        return {name: plain(getattr(value, name)) for name in value.__dataclass_fields__}
    if isinstance(value, Mapping):
        return {str(servo): plain(span) for servo, span in value.items()}
    return list(value) if isinstance(value, tuple) else value


def whole(allowed: Range) -> st.SearchStrategy[int]:
    return st.integers(allowed.min, allowed.max)


@st.composite
def frames(draw: st.DrawFn, family: Family, least: int, most: int) -> Frame:
    servos = draw(st.lists(whole(family.servo), min_size=least, max_size=most, unique=True))
    targets = tuple(ServoTarget(servo, draw(whole(family.position_of(servo)))) for servo in servos)
    return Frame(draw(whole(family.duration_ms)), targets)


@st.composite
def downloads(draw: st.DrawFn, family: Family) -> Download:
    count = draw(st.integers(1, family.frames_per_group))
    index = draw(st.integers(0, count - 1))
    return Download(draw(whole(family.slot)), count, index, draw(frames(family, 0, family.servos_per_frame)))


def servos(family: Family) -> st.SearchStrategy[tuple[int, ...]]:
    numbers = st.lists(whole(family.servo), min_size=1, max_size=family.servos_per_move, unique=True)
    return numbers.map(tuple)


def commands(family: Family) -> st.SearchStrategy[Command]:
    by_kind: dict[str, st.SearchStrategy[Command]] = {
        "move": frames(family, 1, family.servos_per_move).map(lambda f: Move(f.duration_ms, f.targets)),
        "run": st.builds(Run, whole(family.slot), whole(family.run_times)),
        "stop": st.just(Stop()),
        "erase": st.just(Erase()),
        "readBattery": st.just(ReadBattery()),
        "download": downloads(family),
        "setSpeed": st.builds(SetSpeed, st.none() | whole(family.slot), whole(family.speed_percent)),
        "release": servos(family).map(Release),
        "readPositions": servos(family).map(ReadPositions),
        "readVersion": st.just(ReadVersion()),
        "readAllPositions": st.just(ReadAllPositions()),
        "readOffsets": st.just(ReadOffsets()),
    }
    return st.one_of([by_kind[kind] for kind in family.commands])


@pytest.mark.parametrize("family", FAMILIES.values(), ids=FAMILIES)
@given(data=st.data())
def test_every_command_of_a_family_comes_back_as_it_went_out(family: Family, data: st.DataObject) -> None:
    command = data.draw(commands(family))
    packet = encode(command, family)
    assert packet[2] <= family.max_length
    assert check_command(packet, family) == command


# Right in header and LEN, so that many get past the shape.
plausible = st.builds(
    lambda command, params: bytes((0x55, 0x55, len(params) + 2, command)) + params,
    st.sampled_from([1, 2, 3, 6, 7, 8, 11, 13, 15, 20, 21, 25]),
    st.one_of(st.binary(max_size=251), st.binary(max_size=12)),
)


@given(st.one_of(st.binary(max_size=300), plausible))
def test_any_bytes_are_either_refused_or_a_command_that_means_them(packet: bytes) -> None:
    try:
        command = check_command(packet, DOC)
    except GatewayError:
        return
    reserved = 1 if isinstance(command, Erase) else 0
    assert encode(command, DOC)[: len(packet) - reserved] == packet[: len(packet) - reserved]


@pytest.mark.parametrize(
    "packet",
    [
        "",
        "55",
        "55 55 02",
        "55 55 01 07",
        "55 54 02 07",
        "55 55 02 07 07",
        "55 55 02 07 55 55 02 07",
        "55 55 03 07 00",
        "55 55 02 08",
        "55 55 02 06",
        "55 55 04 0F 4C 1D",
        "55 55 02 63",
        "55 55 04 0B 08 32",
        "55 55 04 14 02 01",
        "55 55 02 15",
        "55 55 03 01 00",
        "55 55 03 0D 00",
        "55 55 03 02 00",
        "55 55 02 03",
        "55 55 08 03 02 E8 03 01 D0 07",
        "55 55 0B 19 0A 01 00 02 E8 03 01 DC 05",
        "55 55 06 19 05 02 00 00",
    ],
)
def test_bytes_that_are_not_exactly_one_command_are_malformed(packet: str) -> None:
    with pytest.raises(MalformedError) as caught:
        check_command(bytes.fromhex(packet), DOC)
    assert caught.value.code == "malformed"


def test_values_on_the_wire_are_judged_too() -> None:
    with pytest.raises(
        OutOfRangeError, match=r"position of servo 1 is 3000, allowed 500\.\.2500 µs"
    ) as caught:
        check_command(bytes.fromhex("5555080301e80301b80b"), DOC)
    assert caught.value.code == "outOfRange"


def test_a_packet_longer_than_a_board_can_take_is_refused() -> None:
    two = Move(100, (ServoTarget(1, 1500), ServoTarget(2, 1500)))
    with pytest.raises(OutOfRangeError, match=r"length is 11, allowed 2\.\.10"):
        encode(two, replace(DOC, max_length=10))


def test_an_empty_seven_stays_unknown_where_its_meaning_is() -> None:
    family = replace(DOC, empty_seven="unknown")
    assert parse_report(Packet(7, b""), family) == UnknownReport(7, b"")
