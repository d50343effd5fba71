"""What one damaged byte costs, what garbage does, how a stream may be cut: F2, F3 and F4 of the fault table.

The same amounts and limits as in shared/src/robot/faults, for the gateway's own decoder.
"""

from collections.abc import Callable, Iterable, Sequence
from random import Random

import pytest

from servodeck.protocol.decoder import (
    COMMAND_SHAPES,
    REPORT_SHAPES,
    Decoder,
    DecoderEvent,
    PacketEvent,
    Shapes,
)
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import (
    Command,
    Download,
    Erase,
    Frame,
    Move,
    ReadBattery,
    Run,
    ServoTarget,
    Stop,
)
from tests.amount import named, replay, seeds

FILE = "test_damage.py"
CASES, CASES_TRIED = 20_000, 2_000
STREAMS, STREAMS_TRIED = 1_000, 100
PACKETS_PER_STREAM = 5
VARIETY = 2_000
DAMAGED_AND_NEIGHBOUR = 2
MOST_WRONG_SHARE = 0.01
# No multiple of the size in which noise is reported.
CHUNK_BYTES = 64 * 1024 - 1
MOST_PENDING_BYTES = 512
MOST_WORK_PER_BYTE = 2

Speaker = Callable[[Random], bytes]


def battery(random: Random) -> bytes:
    return bytes.fromhex("5555040f") + random.randint(5_000, 12_600).to_bytes(2, "little")


def ordinary_report(random: Random) -> bytes:
    """OpenArm and its relatives: either the battery or nothing but a number."""
    return random.choice((battery(random), bytes((0x55, 0x55, 2, random.choice((6, 7, 8, 25))))))


def naming_report(random: Random) -> bytes:
    """LSC and bus boards name the group they speak of."""
    group = bytes((random.randrange(230),)) + random.randrange(4).to_bytes(2, "little")
    positions = b"".join(
        bytes((servo,)) + random.randrange(1_001).to_bytes(2, "little") for servo in range(1, 7)
    )
    return random.choice(
        (
            battery(random),
            bytes.fromhex("55550506") + group,
            bytes.fromhex("55550508") + group,
            bytes.fromhex("55550207"),
            bytes.fromhex("5555151506") + positions,
        )
    )


def command(random: Random) -> bytes:
    targets = tuple(ServoTarget(n, random.randint(500, 2_500)) for n in range(1, random.randint(2, 7)))
    frame = Frame(random.randrange(3_000), targets)
    kinds: tuple[Command, ...] = (
        Move(frame.duration_ms, targets),
        Download(random.randrange(256), 20, random.randrange(20), frame),
        Run(random.randrange(256), random.randrange(10)),
        Stop(),
        Erase(),
        ReadBattery(),
    )
    return encode(random.choice(kinds), FAMILIES["doc"])


def pool(speaker: Speaker) -> Sequence[bytes]:
    """Made once: encoding takes longer than decoding."""
    random = Random(0)
    return [speaker(random) for _ in range(VARIETY)]


SPEAKERS: dict[str, tuple[Shapes, Sequence[bytes]]] = {
    "ordinary reports": (REPORT_SHAPES, pool(ordinary_report)),
    "naming reports": (REPORT_SHAPES, pool(naming_report)),
    "commands": (COMMAND_SHAPES, pool(command)),
}
each_speaker = pytest.mark.parametrize(("shapes", "packets"), SPEAKERS.values(), ids=SPEAKERS)


def drop(stream: bytes, at: int, _random: Random) -> bytes:
    return stream[:at] + stream[at + 1 :]


def double(stream: bytes, at: int, _random: Random) -> bytes:
    return stream[: at + 1] + stream[at:]


def insert(stream: bytes, at: int, random: Random) -> bytes:
    return stream[:at] + bytes((random.randrange(256),)) + stream[at:]


def flip(stream: bytes, at: int, random: Random) -> bytes:
    return stream[:at] + bytes((stream[at] ^ random.randint(1, 255),)) + stream[at + 1 :]


DAMAGES = (drop, double, insert, flip)


def decode(pieces: Iterable[bytes], shapes: Shapes) -> list[DecoderEvent]:
    events: list[DecoderEvent] = []
    decoder = Decoder(events.append, shapes)
    for piece in pieces:
        decoder.push(piece)
    decoder.idle()
    return events


def arrived(sent: Sequence[bytes], got: Sequence[bytes]) -> int:
    """How many of the sent packets came, in order: the longest common subsequence."""
    row = [0] * (len(got) + 1)
    for packet in sent:
        before, row = row, [0]
        for at, other in enumerate(got):
            row.append(before[at] + 1 if packet == other else max(before[at + 1], row[at]))
    return row[-1]


def cost_of(
    packets: Sequence[bytes], shapes: Shapes, damage: Callable[[bytes, int, Random], bytes], seed: int
) -> tuple[int, int]:
    """Packets lost, the damaged one included, and packets believed that were not sent."""
    random = Random(seed)
    sent = random.choices(packets, k=PACKETS_PER_STREAM)
    stream = b"".join(sent)
    events = decode([damage(stream, random.randrange(len(stream)), random)], shapes)
    got = [event.bytes for event in events if isinstance(event, PacketEvent)]
    good = arrived(sent, got)
    return len(sent) - good, len(got) - good


@each_speaker
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_byte_costs_one_good_neighbour_at_most(
    shapes: Shapes, packets: Sequence[bytes], damage: Callable[[bytes, int, Random], bytes]
) -> None:
    wrong: list[int] = []
    for seed in seeds(CASES, CASES_TRIED):
        with named(FILE, seed, damage.__name__):
            lost, believed = cost_of(packets, shapes, damage, seed)
            # Only a wrong packet that is believed may swallow more than one good one.
            assert lost <= DAMAGED_AND_NEIGHBOUR or believed, f"{lost} packets lost"
        # A changed value shows nowhere: there is no checksum.
        if lost > DAMAGED_AND_NEIGHBOUR if damage is flip else believed:
            wrong.append(seed)
    assert len(wrong) <= MOST_WRONG_SHARE * len(seeds(CASES, CASES_TRIED)), replay(FILE, wrong[0])


def stream_of(packets: Sequence[bytes], seed: int) -> bytes:
    """Every second one is damaged somewhere: whole packets alone are too easy to cut."""
    random = Random(seed)
    stream = b"".join(random.choices(packets, k=PACKETS_PER_STREAM))
    return random.choice(DAMAGES)(stream, random.randrange(len(stream)), random) if seed % 2 else stream


@each_speaker
def test_a_stream_says_the_same_however_it_is_cut(shapes: Shapes, packets: Sequence[bytes]) -> None:
    for seed in seeds(STREAMS, STREAMS_TRIED):
        with named(FILE, seed, "cut"):
            stream = stream_of(packets, seed)
            whole = decode([stream], shapes)
            assert decode((stream[at : at + 1] for at in range(len(stream))), shapes) == whole
            for at in range(1, len(stream)):
                assert decode((stream[:at], stream[at:]), shapes) == whole, f"cut before byte {at}"


class Ear:
    """Counts the bytes of its events."""

    bytes_heard = 0

    def hear(self, event: DecoderEvent) -> None:
        self.bytes_heard += len(event.bytes)


class CountedShapes(Shapes):
    """The same shapes, and how often a header was looked up in them."""

    looked_up = 0

    def __contains__(self, shape: object) -> bool:
        self.looked_up += 1
        return super().__contains__(shape)


def heads(random: Random) -> bytes:
    """Of packets whose bodies never come."""
    return b"".join(
        bytes((0x55, 0x55, random.randrange(256), random.choice((3, 15, 21, 25)), random.randrange(83)))
        for _ in range(CHUNK_BYTES // 5)
    )


def no_packets(_random: Random) -> bytes:
    """The most laborious bytes: each header announces a long packet that turns out to be none."""
    return bytes.fromhex("5555ef034e") * (CHUNK_BYTES // 5)


GARBAGE = {
    "random": (161, lambda random: random.randbytes(CHUNK_BYTES)),
    "heads": (4, heads),
    "no packets": (2, no_packets),
}


@pytest.mark.parametrize("known", [REPORT_SHAPES, COMMAND_SHAPES], ids=["reports", "commands"])
@pytest.mark.parametrize(("chunks", "chunk"), GARBAGE.values(), ids=GARBAGE)
def test_garbage_is_reported_again_and_none_of_it_is_stored(
    known: Shapes, chunks: int, chunk: Callable[[Random], bytes]
) -> None:
    for seed in seeds(1):
        with named(FILE, seed, "garbage"):
            random, shapes = Random(seed), CountedShapes(known)
            fed, ear = 0, Ear()
            decoder = Decoder(ear.hear, shapes)
            for _ in range(chunks):
                garbage = chunk(random)
                decoder.push(garbage)
                fed += len(garbage)
                assert fed - ear.bytes_heard <= MOST_PENDING_BYTES
            decoder.idle()
            assert ear.bytes_heard == fed
            assert shapes.looked_up <= MOST_WORK_PER_BYTE * fed
