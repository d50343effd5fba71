"""The gateway's estimate against shared/protocol/vectors/halts.json: what a STOP holds and what not, in
histories of a simulated board. The page's session (shared/src/robot/halts.test.ts) runs the same file.
"""

from dataclasses import replace
from typing import Any

import pytest

from servodeck.protocol.decoder import Packet
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode, parse_command, parse_report
from servodeck.protocol.values import Download, Frame, Move, ServoTarget
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.motion.halt_plan import HaltPlan, Unheld
from tests.samples import command_in
from tests.vectors import load_vectors

HISTORIES = load_vectors("halts")


def replay(estimate: Estimate, event: dict[str, Any]) -> None:
    at_s = event["atMs"] / 1000
    match event:
        case {"left": packet}:
            estimate.left(command_in(bytes.fromhex(packet)), at_s)
        case {"heard": packet}:
            data = bytes.fromhex(packet)
            estimate.heard(parse_report(Packet(data[3], data[4:]), estimate.family), at_s)
        case {"stored": {"slot": slot, "frames": frames}}:
            packets = [
                encode(Download(slot, len(frames), index, frame_of(frame)), estimate.family)
                for index, frame in enumerate(frames)
            ]
            estimate.stored(slot, packets, at_s)
        case {"lost": True}:
            estimate.lost(at_s)


def frame_of(frame: dict[str, Any]) -> Frame:
    targets = (ServoTarget(one["servo"], one["position"]) for one in frame["targets"])
    return Frame(frame["durationMs"], tuple(targets))


def expected(halt: dict[str, Any]) -> HaltPlan:
    hold = parse_command(bytes.fromhex(halt["hold"])) if halt["hold"] else None
    assert isinstance(hold, Move | None)
    unheld = halt["unheld"]
    servos = unheld and (None if unheld["servos"] is None else tuple(unheld["servos"]))
    return HaltPlan(hold, unheld and Unheld(servos, unheld["for_ms"]))


def times_of(plan: HaltPlan) -> tuple[int, float]:
    return plan.hold.duration_ms if plan.hold else 0, plan.unheld.for_ms if plan.unheld else 0


def without_times(plan: HaltPlan) -> HaltPlan:
    return HaltPlan(
        plan.hold and replace(plan.hold, duration_ms=0), plan.unheld and replace(plan.unheld, for_ms=0)
    )


@pytest.mark.parametrize("number", range(len(HISTORIES)))
def test_what_a_stop_does_is_what_the_page_says_in_history(number: int) -> None:
    history = HISTORIES[number]
    estimate = Estimate(FAMILIES[history["family"]])
    for event in history["events"]:
        if "halt" not in event:
            replay(estimate, event)
            continue
        plan, theirs = estimate.halt_plan(event["atMs"] / 1000), expected(event["halt"])
        assert without_times(plan) == without_times(theirs), event["atMs"]
        # The page rounds up to a whole millisecond.
        assert times_of(plan) == pytest.approx(times_of(theirs), abs=1.001), event["atMs"]
