"""Waiting times, limits and shares of behaviour, the same as the page's: shared/protocol/timings.json, which
says where each comes from. Knows nothing of what they are for.
"""

from collections.abc import Callable
from typing import Any, Final, NamedTuple, TypeVar

from servodeck.protocol import load_shared, snake

_TIMINGS: Final = load_shared("timings")
BITS_PER_BYTE: Final = 10  # 8N1: start bit, eight data bits, stop bit

Section = TypeVar("Section")


class Line(NamedTuple):
    baud: int
    pause_ms: int
    idle_ms: int
    filler_bytes: int
    other_rates: tuple[int, ...]
    listen_ms: int
    listened_within_ms: int
    reconnect_ms: tuple[int, ...]


class Hid(NamedTuple):
    report_bytes: int
    shortest_ms: int
    send_timeout_ms: int


class Decoding(NamedTuple):
    noise_bytes: int
    most_servos: int
    noise_share: float


class Stop(NamedTuple):
    gap_ms: int
    repeats: int
    repeat_every_ms: int
    stray_bytes: int
    hold_again_ms: int
    holds_again: int
    again_every_ms: int
    held_within_ms: int
    unknown_frame_ms: int
    rested_ms: int


class Move(NamedTuple):
    first_ms: int
    first_stagger_ms: int
    range_ms: int
    longest_ms: int
    expires_ms: int


class Parts(NamedTuple):
    rest_ms: int
    seam_ms: int
    seam_slack_ms: int
    grain_ms: float


class Estimate(NamedTuple):
    longest_deafness_ms: int
    last_ticks_ms: int
    end_reported_within_ms: int
    preemptive_slot: int
    poll_ms: int
    poll_step_ms: int
    spare_polls: int


class Run(NamedTuple):
    timeout_ms: int
    end_grace_ms: int
    as_stored_percent: int


class Play(NamedTuple):
    catch_up_share: float
    late_ms: int
    look_ms: int
    give_up_ms: int
    message_bytes: int


class Download(NamedTuple):
    edge_frame_timeout_ms: int
    middle_frame_timeout_ms: int
    restarts: int
    babble_limit: int
    portion_bytes: int


class Erase(NamedTuple):
    timeout_ms: int


class Battery(NamedTuple):
    timeout_ms: int
    silent_limit: int
    every_ms: int
    after_run_ms: int
    unsolicited_after_ms: int
    unsolicited_limit: int
    judged_within_ms: int
    hysteresis_mv: int


class Read(NamedTuple):
    position_ms: int
    margin_ms: int
    detail_timeout_ms: int


class Identify(NamedTuple):
    listen_ms: int
    boot_ms: int
    timeout_ms: int
    attempts: int


class Heartbeat(NamedTuple):
    every_ms: int
    stale_every_ms: int
    misses: int


class Lease(NamedTuple):
    beat_ms: int
    quiet_ms: int
    silent_ms: int
    gone_ms: int
    answer_ms: int


class Program(NamedTuple):
    move_ms: int
    look_ms: int
    unknown_end_ms: int
    after_end_ms: int
    late_ms: int
    identified_ms: int
    first_move_ms: int
    names_ms: int
    silence_ms: int


class Library(NamedTuple):
    trash_days: int


def _section(name: str, shape: Callable[..., Section]) -> Section:
    """A value that is missing or that has no name here is an error at once."""
    values: dict[str, Any] = {snake(key): value for key, value in _TIMINGS[name].items() if key != "why"}
    tuples = {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
    return shape(**tuples)


LINE: Final = _section("line", Line)
HID: Final = _section("hid", Hid)
DECODER: Final = _section("decoder", Decoding)
STOP: Final = _section("stop", Stop)
MOVE: Final = _section("move", Move)
PARTS: Final = _section("parts", Parts)
ESTIMATE: Final = _section("estimate", Estimate)
RUN: Final = _section("run", Run)
PLAY: Final = _section("play", Play)
DOWNLOAD: Final = _section("download", Download)
ERASE: Final = _section("erase", Erase)
BATTERY: Final = _section("battery", Battery)
READ: Final = _section("read", Read)
IDENTIFY: Final = _section("identify", Identify)
HEARTBEAT: Final = _section("heartbeat", Heartbeat)
LEASE: Final = _section("lease", Lease)
PROGRAM: Final = _section("program", Program)
LIBRARY: Final = _section("library", Library)


def wire_s(byte_count: int) -> float:
    """Seconds that many bytes spend on the wire."""
    return byte_count * BITS_PER_BYTE / LINE.baud


def wire_ms(byte_count: int) -> float:
    return byte_count * BITS_PER_BYTE * 1000 / LINE.baud
