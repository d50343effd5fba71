"""When a board that has answered before counts as silent."""

from servodeck.robot.board.activity import Silence

BATTERY, POSITIONS = 15, 21


def silence(*asked_s: float, answered: int = BATTERY) -> Silence:
    watch = Silence()
    watch.heard(answered)
    for at_s in asked_s:
        watch.query_left(BATTERY, at_s)
    return watch


def test_two_questions_without_an_answer_make_it_silent_one_does_not() -> None:
    assert not silence(1.0).is_silent(100.0)
    assert not silence(1.0, 6.0).is_silent(6.4)
    assert silence(1.0, 6.0).is_silent(6.5)


def test_a_board_that_never_answered_that_question_is_not_missed() -> None:
    assert not silence(1.0, 6.0, answered=POSITIONS).is_silent(100.0)


def test_any_report_ends_the_silence() -> None:
    watch = silence(1.0, 6.0)
    watch.heard(POSITIONS)
    assert not watch.is_silent(100.0)
    watch.query_left(BATTERY, 101.0)
    assert not watch.is_silent(102.0)


def test_many_who_ask_at_once_are_one_miss_and_put_off_none() -> None:
    assert not silence(1.0, 1.1, 1.2).is_silent(100.0)
    assert silence(*(1.0 + index * 0.4 for index in range(4))).is_silent(2.4)
