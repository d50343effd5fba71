"""Decides from samples of the robot's state which notifications are due, each once for each occurrence.

Knows time as a number and the state as values; no receiver, no network, no board.
"""

from collections.abc import Iterator
from typing import Literal

from servodeck.protocol.timings import BATTERY
from servodeck.snapshots import LatchedBy, LinkStatus
from servodeck.value import value

Event = Literal["batteryLow", "stopped", "linkLost", "linkBack", "test"]

# One reading may be bent by a load or by noise. Twin of shared/src/profile/battery.ts.
SETTLED_READINGS = 3
# A cable that is plugged in again at once is no news.
LOST_AFTER_S = 10.0
LOST: tuple[LinkStatus, ...] = ("lost", "stale")


@value
class Sample:
    """`battery`: the newest reading in mV and its time in s. `low_mv`: at or below, the robot's battery is
    low; None where no robot says so.
    """

    now_s: float
    link: LinkStatus
    latched_by: LatchedBy | None = None
    stopped_by: str | None = None
    battery: tuple[int, float] | None = None
    low_mv: int | None = None


@value
class Due:
    event: Event
    text: str


class Conditions:
    def __init__(self) -> None:
        self._low = LowBattery()
        self._was_latched = False
        self._lost_since_s: float | None = None
        self._lost_is_reported = False

    def after(self, sample: Sample) -> Iterator[Due]:
        """What has become due with this sample; at most one of each event."""
        if self._low.after(sample) and sample.battery:
            yield Due("batteryLow", f"The battery is low: {sample.battery[0] / 1000:.2f} V.")
        if sample.latched_by and not self._was_latched:
            yield Due("stopped", stopped_text(sample.latched_by, sample.stopped_by))
        self._was_latched = sample.latched_by is not None
        yield from self._link_after(sample)

    def _link_after(self, sample: Sample) -> Iterator[Due]:
        if sample.link in LOST:
            if self._lost_since_s is None:
                self._lost_since_s = sample.now_s
            if not self._lost_is_reported and sample.now_s - self._lost_since_s >= LOST_AFTER_S:
                self._lost_is_reported = True
                yield Due("linkLost", f"The link to the board has been lost for {LOST_AFTER_S:.0f} s.")
        elif sample.link in ("ready", "closed"):  # anything else is an attempt, which may fail
            if self._lost_is_reported and sample.link == "ready":
                yield Due("linkBack", "The link to the board is back.")
            self._lost_since_s, self._lost_is_reported = None, False


class LowBattery:
    def __init__(self) -> None:
        self._read_s: float | None = None
        self._low_readings = 0
        self._is_reported = False

    def after(self, sample: Sample) -> bool:
        """Whether it is low and that was not reported since it was last above."""
        if sample.battery is None or sample.low_mv is None:
            return False
        battery_mv, read_s = sample.battery
        if read_s == self._read_s or battery_mv == 0:  # S59: the board has no sample yet
            return False
        self._read_s = read_s
        if battery_mv > sample.low_mv + BATTERY.hysteresis_mv:
            self._is_reported = False
        self._low_readings = self._low_readings + 1 if battery_mv <= sample.low_mv else 0
        if self._is_reported or self._low_readings < SETTLED_READINGS:
            return False
        self._is_reported = True
        return True


def stopped_text(by: LatchedBy, name: str | None) -> str:
    match by:
        case "person":
            return f"{name} pressed STOP." if name else "STOP was pressed."
        case "battery":
            return "Stopped because the battery is low."
        case "silence":
            return "Stopped because its driver was not heard while it moved."
        case "loss":
            return "Stopped because the link to the board was lost."
