"""Whether something new may begin to run, by the battery's last reading at rest. Pure. Twin of
shared/src/robot/batteryRule.ts; both run shared/protocol/vectors/batteryRule.json.
"""

from typing import Literal

from servodeck.protocol.timings import BATTERY
from servodeck.value import value

Verdict = Literal["runs", "low", "unknown"]


@value
class RunLimit:
    """New runs are refused at or below `alarm_mv`. Above `ceiling_mv` the board measures nothing (S60)."""

    alarm_mv: int
    ceiling_mv: int | None


def verdict(limit: RunLimit | None, battery_mv: int | None, age_ms: float) -> Verdict:
    """`battery_mv`: the last reading at rest, `age_ms` old; None where there was none."""
    if limit is None:
        return "runs"
    if battery_mv is None or age_ms > BATTERY.judged_within_ms or not is_measured(battery_mv, limit):
        return "unknown"
    return "low" if battery_mv <= limit.alarm_mv else "runs"


def is_measured(battery_mv: int, limit: RunLimit) -> bool:
    """0: the board has no sample yet (S59)."""
    return battery_mv > 0 and (limit.ceiling_mv is None or battery_mv <= limit.ceiling_mv)
