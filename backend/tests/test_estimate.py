"""Where the gateway believes the servos to be: the same ways that the page's estimate knows of moves."""

from hypothesis import given
from hypothesis import strategies as st

from servodeck.protocol import timings
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.values import (
    Command,
    Download,
    Frame,
    Move,
    Positions,
    ReadBattery,
    ReadPositions,
    Release,
    Run,
    RunAccepted,
    RunFinished,
    RunStarted,
    RunStopped,
    ServoTarget,
    Stop,
)
from servodeck.robot.board.estimate import Estimate
from tests.samples import RUN, STOP, command_in, stored

DOC = FAMILIES["doc"]


def move(duration_ms: int, **positions: int) -> Command:
    return Move(duration_ms, tuple(ServoTarget(int(name[1:]), at) for name, at in positions.items()))


# With what the board says first.
END_GRACE_S = timings.RUN.end_grace_ms / 1000 + 0.01


def held(motion: Estimate, now: float) -> Command | None:
    return motion.halt_plan(now).hold


def estimate_after(*packets: tuple[float, Command], family: str = "doc") -> Estimate:
    motion = Estimate(FAMILIES[family])
    for at_s, command in packets:
        motion.left(command, at_s)
    return motion


def test_nothing_was_moved_so_nothing_is_held() -> None:
    assert held(estimate_after(), 1.0) is None


def test_a_first_move_is_held_only_once_it_has_ended() -> None:
    motion = estimate_after((0.0, move(1000, s1=2000)))
    assert motion.is_moving(0.5)
    assert held(motion, 0.5) is None
    assert held(motion, 1.0) == move(20, s1=2000)
    assert not motion.is_moving(1.0)


def test_a_new_target_takes_the_others_with_it_where_boards_share_the_time_and_only_there() -> None:
    ways = ((0.0, move(0, s1=1000, s2=1000)), (1.0, move(1000, s1=2000)), (1.5, move(1000, s2=2000)))
    anew = (2, 1000, 2000, 500, 1000)
    assert reported_ways(estimate_after(*ways), 2.0) == [(1, 1500, 2000, 500, 1000), anew]
    assert reported_ways(estimate_after(*ways, family="lsc-6"), 2.0) == [(1, 1000, 2000, 1000, 1000), anew]


def test_what_others_may_have_moved_before_the_port_was_opened_makes_no_hold_slow() -> None:
    steps = [(2.0 + number / 5, move(200, s1=1000 + 100 * number)) for number in range(5)]
    ways = ((1.0, move(1000, s1=1000)), *steps)
    motion = estimate_after()
    motion.opened(0.0)
    assert motion.halt_plan(0.0).unheld is not None
    for at_s, command in ways:
        motion.left(command, at_s)
    assert held_after(motion, 2.91) == held_after(estimate_after(*ways), 2.91)


def held_after(motion: Estimate, now: float) -> int:
    hold = held(motion, now)
    assert isinstance(hold, Move)
    return hold.duration_ms


def test_a_servo_let_go_is_not_held() -> None:
    motion = estimate_after((0.0, move(0, s1=500, s2=600)), (1.0, Release((1,))), family="bus-ctrl")
    assert held(motion, 1.5) == move(20, s2=600)


def test_a_servo_that_has_stood_for_long_is_left_alone() -> None:
    stands = (0.0, move(20, s1=600))
    assert held(estimate_after(stands), 1.9) == move(20, s1=600)
    assert held(estimate_after(stands), 2.1) is None


def test_a_group_is_over_when_the_board_says_so_but_not_by_the_word_about_the_one_before() -> None:
    motion = estimate_after()
    motion.left(command_in(RUN), 1.0)
    motion.heard(RunFinished(None), 1.4)
    assert motion.group_may_run(1000.0)
    motion.heard(RunAccepted(), 2.0)
    assert motion.group_may_run(1000.0)
    motion.heard(RunFinished(None), 3.0)
    assert not motion.group_may_run(3.0)


def test_what_was_moved_is_known_and_a_first_move_counts_down() -> None:
    motion = estimate_after((0.0, move(2000, s1=1000)))
    assert (motion.is_unknown(1, 1.0), motion.is_unknown(2, 1.0)) == (False, True)
    assert motion.first_moves_ms([1], 0.5) == motion.first_moves_ms([2], 0.5) == 1500
    assert motion.first_moves_ms([1], 2.0) == 0
    own_time = estimate_after((0.0, move(2000, s1=500)), family="bus-ctrl")
    assert (own_time.first_moves_ms([1], 0.5), own_time.first_moves_ms([2], 0.5)) == (1500, 0)


def test_a_group_may_move_anything_until_it_is_stopped() -> None:
    motion = estimate_after((0.0, move(0, s1=1000)))
    motion.left(command_in(RUN), 1.0)
    assert motion.group_may_run(2.0)
    assert held(motion, 2.0) is None
    motion.left(move(1000, s1=1500), 3.0)
    assert held(motion, 5.0) is None
    motion.left(command_in(STOP), 6.0)
    assert not motion.group_may_run(6.0)
    motion.left(move(1000, s1=1500), 7.0)
    assert held(motion, 8.0) == move(20, s1=1500)


def reported_ways(motion: Estimate, now: float) -> list[tuple[int, float | None, int, float, float]]:
    """As a client gets them that joins now."""
    return [
        (way.servo, way.start, way.target, way.begun_ms_ago, way.duration_ms)
        for way in motion.snapshot(now).servos
    ]


def test_a_new_client_gets_each_move_with_its_start() -> None:
    motion = estimate_after(
        (0.0, move(0, s1=1000)), (1.0, move(1000, s1=2000)), (1.5, move(1500, s2=500)), family="lsc-6"
    )
    assert reported_ways(motion, 1.25) == [(1, 1000, 2000, 250, 1000), (2, None, 500, -250, 1500)]
    assert motion.snapshot(1.25).run_slot is None
    assert reported_ways(motion, 60.0) == [(1, 1000, 2000, 59_000, 1000), (2, None, 500, 58_500, 1500)]


def test_a_new_client_gets_the_released_servos() -> None:
    motion = estimate_after((0.0, move(0, s1=500, s2=600)), (1.0, Release((1,))), family="bus-ctrl")
    motion.heard(Positions((ServoTarget(1, 400),)), 2.0)
    assert motion.snapshot(2.0).released == [1]
    motion.left(command_in(RUN), 3.0)
    assert motion.snapshot(3.0).released == [1]
    motion.left(command_in(STOP), 4.0)
    motion.left(move(1500, s1=500), 5.0)
    assert motion.snapshot(60.0).released == []


def test_while_a_group_may_run_clients_get_no_position_but_the_run() -> None:
    motion = running((0.0, Run(8, 1)))
    assert (reported_ways(motion, 1.0), motion.snapshot(1.0).run_slot) == ([], 8)
    assert motion.snapshot(2.0 + END_GRACE_S).run_slot is None


def test_a_group_begun_at_the_board_makes_every_place_unknown_until_its_end() -> None:
    motion = estimate_after((0.0, move(0, s1=1000)), family="lsc-6")
    motion.heard(RunStarted(3, 1), 5.0)
    assert (motion.is_unknown(1, 6.0), motion.snapshot(6.0).run_slot) == (True, 3)
    motion.heard(RunFinished(3), 9.0)
    assert not motion.group_may_run(9.0)


def test_the_word_that_our_own_group_has_begun_starts_it_no_second_time() -> None:
    motion = estimate_after((1.0, Run(8, 1)), family="lsc-6")
    ours = motion.run
    motion.heard(RunStarted(8, 1), 1.1)
    assert motion.run is ours
    motion.left(command_in(STOP), 1.2)
    motion.heard(RunStarted(8, 1), 1.3)
    assert not motion.group_may_run(1.3)
    motion.heard(RunStarted(8, 1), 60.0)
    assert motion.group_may_run(60.0)


def test_a_stop_ends_the_moves_of_a_learm() -> None:
    packets = (0.0, move(0, s1=1000, s2=1000)), (1.0, move(1000, s1=1400)), (1.5, Stop())
    ways = reported_ways(estimate_after(*packets, family="learm-esp32"), 5.0)
    assert [way[2] for way in ways] == [
        1200,
        1000,
    ]
    assert [way[2] for way in reported_ways(estimate_after(*packets, family="lsc-6"), 5.0)] == [1400, 1000]


def running(*runs: tuple[float, Run], stored_ms: int = 500) -> Estimate:
    motion = Estimate(DOC)
    motion.stored(8, stored(8, *[stored_ms] * 4), 0.0)
    for at_s, run in runs:
        motion.left(run, at_s)
    return motion


def test_the_end_of_a_group_that_starts_the_next_one_says_nothing() -> None:
    motion = running((0.0, Run(100, 1)))
    motion.heard(RunFinished(None), 5.0)
    assert motion.group_may_run(6.0)
    motion.heard(RunStopped(), 7.0)
    assert not motion.group_may_run(8.0)


def test_the_end_is_that_of_the_only_group_that_can_run_also_where_its_run_may_have_come_late() -> None:
    motion = estimate_after((0.0, Download(5, 1, 0, Frame(300, ()))), (0.3, Run(5, 1)))
    assert motion.group_may_run(1.3)
    motion.heard(RunFinished(None), 1.3)
    assert not motion.group_may_run(1.5)
    assert motion.restless_for_s(1.5) == 0


def test_a_known_group_is_over_after_its_time_unless_it_has_no_end_or_another_one_ran() -> None:
    once = running((1.0, Run(8, 2)))
    assert once.group_may_run(1.0 + 2 * 2.0)
    assert not once.group_may_run(1.0 + 2 * 2.0 + END_GRACE_S)
    assert running((1.0, Run(8, 0))).group_may_run(1000.0)
    assert running((1.0, Run(7, 0)), (2.0, Run(8, 1))).group_may_run(1000.0)
    assert not running((1.0, Run(8, 1)), (9.0, Run(8, 1))).group_may_run(9.0 + 2.0 + END_GRACE_S)
    once.left(command_in(stored(8, 500)[0]), 20.0)
    once.left(Run(8, 1), 23.0)
    assert once.group_may_run(1000.0)


ways = st.lists(
    st.tuples(
        st.floats(0, 2),
        st.builds(
            lambda duration_ms, targets: Move(
                duration_ms, tuple(ServoTarget(servo, at) for servo, at in targets.items())
            ),
            st.integers(0, 3000),
            st.dictionaries(st.integers(1, 6), st.integers(500, 2500), min_size=1),
        ),
    ),
    max_size=8,
)


@given(ways, st.floats(0, 5), st.sampled_from(["doc", "lsc-6"]))
def test_a_hold_is_a_move_that_the_board_can_take_and_freezes_what_rests(
    pauses: list[tuple[float, Move]], wait_s: float, family: str
) -> None:
    at_s, timed = 0.0, []
    for pause_s, command in pauses:
        at_s += pause_s
        timed.append((at_s, command))
    motion = estimate_after(*timed, family=family)
    hold = held(motion, at_s + wait_s)
    if not pauses:
        assert hold is None
        return
    last = {target.servo: target.position for _, command in timed for target in command.targets}
    rest = held(motion, at_s + motion.moves_for_s(at_s))
    assert isinstance(rest, Move)
    assert {target.servo: target.position for target in rest.targets}.items() <= last.items()
    assert held(motion, at_s + 12.1) is None
    if hold is not None:
        assert isinstance(hold, Move)
        assert 20 <= hold.duration_ms <= 3000
        assert all(500 <= target.position <= 2500 for target in hold.targets)


ASK, ANSWER = ReadPositions((1,)), Positions((ServoTarget(1, 400),))
STAND = (9.5, move(20, s1=400, s2=400))


def bus_board(*packets: tuple[float, Command]) -> Estimate:
    return estimate_after(STAND, *packets, family="bus-ctrl")


def test_a_move_that_a_bus_board_may_not_have_heard_leaves_its_servos_unknown() -> None:
    motion = bus_board((10.0, ASK), (10.1, move(500, s1=600)))
    assert motion.is_unknown(1, 11.0)
    assert not motion.is_unknown(2, 11.0)
    assert held(motion, 11.0) == move(20, s2=400)
    assert motion.is_moving(12.9)
    assert not motion.is_moving(13.1)


def test_behind_its_answer_a_bus_board_hears_again() -> None:
    motion = bus_board((10.0, ASK))
    motion.heard(ANSWER, 10.4)
    motion.left(move(500, s1=600), 10.41)
    assert held(motion, 11.0) == move(20, s1=600, s2=400)


def test_behind_what_it_may_hold_the_next_one_may_be_dropped_for_a_gap() -> None:
    motion = bus_board((10.0, ASK), (10.1, move(500, s1=400)))
    motion.heard(ANSWER, 10.4)
    family = FAMILIES["bus-ctrl"]
    motion.left(move(20, s2=700), 10.4 + family.service_gap_ms / 2000)
    assert motion.is_unknown(2, 11.0)
    motion.left(move(20, s1=700), 11.0)
    assert held(motion, 12.0) == move(20, s1=700)


def test_without_an_answer_it_hears_again_after_a_while() -> None:
    assert held(bus_board((10.0, ASK), (12.6, move(20, s1=600))), 14.0) == move(20, s1=600)


def test_what_moves_while_it_becomes_deaf_is_held_only_once_it_has_arrived() -> None:
    motion = bus_board((10.0, move(1000, s1=600)), (10.5, ASK))
    assert held(motion, 10.6) == move(20, s2=400)
    assert motion.is_moving(12.9)
    assert held(motion, 13.1) == move(20, s1=600)


def test_a_stop_or_a_run_that_it_may_not_have_heard_may_have_been_heard() -> None:
    running = bus_board((10.0, Run(3, 1)), (10.5, ASK), (10.6, Stop()))
    assert running.group_may_run(11.0)
    assert bus_board((10.0, ASK), (10.1, Run(3, 1))).group_may_run(11.0)
    assert not bus_board((10.0, Run(3, 1)), (10.5, ASK), (13.1, Stop())).group_may_run(14.0)


def test_a_battery_report_comes_at_once_and_makes_the_board_not_deaf() -> None:
    assert held(bus_board((10.0, ReadBattery()), (10.1, move(20, s1=600))), 11.0) == move(20, s1=600, s2=400)
