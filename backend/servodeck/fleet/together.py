"""Starts a group on several robots at the same time (docs/adr/0049): measures their clocks, has each prepare
the run for its own time, and commits once all are ready. Otherwise nothing starts.

Knows the console; no topic and no payload.
"""

import secrets
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait

from servodeck.fleet.clocks import Offset, offset_of
from servodeck.fleet.console import Console
from servodeck.fleet.outcomes import FleetError, NoAnswerError

# A clock is asked until it is sure, and so often at most.
ROUNDS, SURE_MS = 20, 1.0
# So many clocks; with more the answers would wait for each other here.
AT_ONCE = 8
UNCERTAIN_MS = 20.0
# From the last measured clock to the start; and before it so long all have to have committed.
LEAD_S, DECIDED_S = 1.0, 0.2
BEAT_S = 0.25


class UncertainError(FleetError):
    """The clock of a gateway is not known well enough over this network."""


def start_together(
    console: Console,
    gateways: Collection[str],
    slot: int | Mapping[str, int],
    times: int = 1,
    versions: Mapping[str, str] | None = None,
    lead_s: float = LEAD_S,
    name: str = "",
    judge_wanted: Callable[[], None] = lambda: None,
    *,
    anyway: bool = False,
) -> float:
    """On robots of which the console has the lease. `slot`: the same one of all, or one of each. `versions`:
    by gateway, what its slot has to hold. `name` is what gateways call this start in their state.
    `judge_wanted` raises a FleetError once it is not wanted any more: then nothing is asked for, and what was
    promised is cancelled.
    Returns at the start, with its time by the console's clock; raises a FleetError where nothing starts,
    unless a gateway that had committed cannot be reached any more.
    """
    offsets = offsets_of(console, gateways, judge_wanted)
    name, start_s = name or new_name(), console.now_s + lead_s
    console.beat(gateways)
    try:
        prepared = {
            gateway: console.request(
                gateway,
                "prepare",
                name=name,
                slot=slot if isinstance(slot, int) else slot[gateway],
                times=times,
                anyway=anyway,
                version=(versions or {}).get(gateway),
                start_ms=start_s * 1000 + offset.ahead_ms,
                uncertainty_ms=offset.uncertainty_ms,
            )
            for gateway, offset in offsets.items()
        }
        for gateway, answered in prepared.items():
            console.result_of(gateway, answered, start_s - DECIDED_S - console.now_s)
        judge_wanted()
        console.beat(gateways)
        committed = console.commit(name, gateways, start_s - DECIDED_S - console.now_s)
        if missing := set(gateways) - committed:
            raise NoAnswerError(f"{', '.join(sorted(missing))}: not ready in time, so none is started.")
        while (left_s := start_s - console.now_s) > 0:
            judge_wanted()
            console.beat(gateways)
            console.until(lambda: False, min(left_s, BEAT_S))
    except FleetError:
        console.cancel(name, gateways, DECIDED_S)
        raise
    return start_s


def new_name() -> str:
    return secrets.token_hex(8)


def spread_ms(console: Console, gateways: Collection[str], name: str) -> float | None:
    """Between the first and the last of them that has reported that start; None where fewer than two have."""
    robots = [console.robot(gateway) for gateway in gateways]
    started = [robot.state.started for robot in robots if robot and robot.state and robot.state.started]
    late_ms = [one.late_ms for one in started if one.name == name]
    return max(late_ms) - min(late_ms) if len(late_ms) > 1 else None


def offsets_of(
    console: Console, gateways: Collection[str], judge_wanted: Callable[[], None]
) -> dict[str, Offset]:
    """Of all their clocks. Meanwhile the gateways hear beats."""
    with ThreadPoolExecutor(AT_ONCE) as pool:
        measuring = {gateway: pool.submit(measured_offset, console, gateway) for gateway in gateways}
        left = {*measuring.values()}
        try:
            while left:
                judge_wanted()
                console.beat(gateways)
                done, left = wait(left, BEAT_S, FIRST_EXCEPTION)
                for one in done:
                    one.result()
        finally:
            pool.shutdown(cancel_futures=True)
    judge_wanted()
    return {gateway: one.result() for gateway, one in measuring.items()}


def measured_offset(console: Console, gateway: str) -> Offset:
    readings = [console.clock(gateway)]
    while (offset := offset_of(readings)).uncertainty_ms > SURE_MS and len(readings) < ROUNDS:
        readings.append(console.clock(gateway))
    if offset.uncertainty_ms > UNCERTAIN_MS:
        raise UncertainError(f"The clock of {gateway} is known to {offset.uncertainty_ms:.0f} ms only.")
    return offset
