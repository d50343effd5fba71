from dataclasses import replace

from servodeck.value import value


@value
class Target:
    servo: int
    position: int = 1500


@value
class Reading:
    servo: int
    position: int


def test_values_of_one_class_are_equal_by_their_fields_and_stand_for_each_other_in_a_set() -> None:
    assert Target(1, 900) == Target(servo=1, position=900)
    assert Target(1) != Target(2)
    assert {Target(1), Target(1), Target(2)} == {Target(2), Target(1)}
    assert replace(Target(1), position=2000) == Target(1, 2000)


def test_a_value_of_another_class_is_another_value() -> None:
    unlike: object = Reading(1, 900)
    assert Target(1, 900) != unlike


def test_a_value_shows_its_fields() -> None:
    assert repr(Target(1)) == "Target(servo=1, position=1500)"
