"""A script's move as packets: every servo once, none faster than it may, the unknown one after another."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.errors import NotSupportedError, OutOfRangeError
from servodeck.protocol.families import FAMILIES, Family
from servodeck.protocol.values import Move, ServoTarget
from servodeck.robot.board.estimate import Estimate
from servodeck.robot.board.move_buffer import FIRST_MOVE_MS, FIRST_MOVE_STAGGER_S
from servodeck.robot.scripts import MovePlan, plan_move

BUS = FAMILIES["bus-ctrl"]
DOC = FAMILIES["doc"]
MOVERS = [family for family in FAMILIES.values() if "move" in family.commands]


def moved(family: Family, *servos: int, duration_ms: int = 20) -> Estimate:
    """A robot whose servos went somewhere, long ago where they did so at once."""
    motion = Estimate(family)
    for servo in servos:
        target = ServoTarget(servo, family.position_of(servo).min)
        motion.left(Move(duration_ms, (target,)), 0.0)
    return motion


def plan(
    positions: dict[int, int], duration_ms: int, motion: Estimate, family: Family, at_s: float
) -> MovePlan:
    return plan_move(duration_ms, positions, family, motion, at_s, lambda servo: f"servo {servo}")


def commands_of(made: MovePlan) -> list[Move]:
    return [step.move for step in made.steps]


def test_servos_that_were_moved_before_go_together_and_at_once() -> None:
    made = plan({2: 1200, 1: 2000}, 300, moved(DOC, 1, 2), DOC, 1.0)
    assert commands_of(made) == [Move(300, (ServoTarget(1, 2000), ServoTarget(2, 1200)))]
    assert made.first_moves == ()


def test_servos_of_unknown_place_start_one_after_another_behind_the_known_ones() -> None:
    made = plan({1: 1000, 2: 1000, 3: 1000}, 1500, moved(DOC, 2), DOC, 1.0)
    assert [[target.servo for target in each.targets] for each in commands_of(made)] == [[2], [1], [3]]
    assert [step.after_s for step in made.steps] == [0.0, 0.0, FIRST_MOVE_STAGGER_S]
    assert made.first_moves == (1, 3)


def test_a_first_move_is_never_fast_and_nothing_is_made_slower_unsaid() -> None:
    with pytest.raises(OutOfRangeError, match=r"timeMs is 1499, allowed 1500\.\.30000: .*servo 3"):
        plan({3: 1500}, 1499, moved(DOC), DOC, 1.0)


def test_a_first_move_in_progress_is_never_made_faster_where_boards_share_the_time() -> None:
    beginning = moved(DOC, 1, 2, duration_ms=1500)
    with pytest.raises(OutOfRangeError, match=r"allowed 1000\.\."):
        plan({2: 1500}, 999, beginning, DOC, 0.5)
    assert len(plan({2: 1500}, 1000, beginning, DOC, 0.5).steps) == 1
    own_time = moved(BUS, 1, duration_ms=1500)
    own_time.left(Move(0, (ServoTarget(2, 500),)), 0.0)
    assert len(plan({2: 600}, 20, own_time, BUS, 0.5).steps) == 1


def test_more_servos_than_a_packet_takes_make_more_packets() -> None:
    servos = range(1, 41)
    made = plan(dict.fromkeys(servos, 500), 100, moved(BUS, *servos), BUS, 1.0)
    assert [len(each.targets) for each in commands_of(made)] == [19, 19, 2]
    assert {step.after_s for step in made.steps} == {0.0}


def test_what_the_board_cannot_take_is_named() -> None:
    with pytest.raises(OutOfRangeError, match=r"position of servo 3 is 2600, allowed 500\.\.2500"):
        plan({3: 2600}, 1500, moved(DOC), DOC, 0.0)
    with pytest.raises(NotSupportedError):
        plan({3: 1500}, 1500, moved(FAMILIES["unknown"]), FAMILIES["unknown"], 0.0)


@given(data=st.data())
def test_every_servo_is_sent_there_once_and_the_unknown_ones_alone(data: st.DataObject) -> None:
    family = data.draw(st.sampled_from(MOVERS))
    servos = st.integers(family.servo.min, family.servo.max)
    known = data.draw(st.sets(servos, max_size=30))
    asked = {
        servo: data.draw(st.integers(family.position_of(servo).min, family.position_of(servo).max))
        for servo in data.draw(st.sets(servos, min_size=1, max_size=40))
    }
    made = plan(asked, FIRST_MOVE_MS, moved(family, *known), family, 1.0)
    targets = [target for each in commands_of(made) for target in each.targets]
    assert {target.servo: target.position for target in targets} == asked
    assert len(targets) == len(asked)
    assert set(made.first_moves) == set(asked) - known
    for each in commands_of(made):
        unknown = [target for target in each.targets if target.servo not in known]
        assert len(unknown) in (0, len(each.targets))
        assert len(unknown) <= 1
