"""The robot's limits hold for every client, and nothing keeps a stop from holding the robot where it is."""

import json

import pytest

from servodeck.callers import Caller
from servodeck.clients import hear, intake_of
from servodeck.control import Control
from servodeck.errors import OutOfRangeError
from servodeck.hub import Seat
from servodeck.jobs import Group
from servodeck.messages import ServoLimits
from servodeck.values import Frame, ServoTarget
from tests.client import Client, gateway_on
from tests.fake_port import FakePort
from tests.samples import MOVE, MOVE_ELSEWHERE, RUN, STOP
from tests.virtual_time import in_virtual_time

# MOVE takes servo 1 to 2000, DOWNLOAD and MOVE_ELSEWHERE to 1500.
ELBOW = ServoLimits(servo=1, name="Elbow", min=600, max=1800)
PUPIL, OTHER_PUPIL = Caller("anna", "Anna", "driver"), Caller("bert", "Bert", "driver")
REFUSAL = "Elbow (servo 1): position is 2000, allowed 600..1800"


def say(control: Control, seat: Seat, **message: object) -> None:
    hear(json.dumps(message), seat, intake_of(seat, control))


@in_virtual_time
async def test_a_limit_that_one_client_tells_holds_for_all_even_after_it_left() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        say(control, anna, type="limits", servos=[ELBOW.model_dump()])
        await bert.heard()
        for owner in (anna, bert):
            with pytest.raises(OutOfRangeError, match=r"^Elbow \(servo 1\): position is 2000, allowed 600"):
                owner.send(MOVE)
        control.leave(anna)
        await bert.heard()
        say(control, bert, type="send", id=7, packet=MOVE.hex(), nonce=bert.nonce)
        assert await bert.heard() == [{"type": "refused", "id": 7, "code": "outOfRange", "detail": REFUSAL}]
        await bert.send(MOVE_ELSEWHERE)
        await bert.send(RUN)
        assert port.packets() == [STOP, MOVE_ELSEWHERE, RUN]


@in_virtual_time
async def test_limits_are_told_to_the_others_to_whoever_joins_and_when_they_are_gone() -> None:
    told = [ELBOW.model_dump()]
    async with gateway_on() as control:
        anna, bert = Client(control), Client(control)
        await anna.heard()
        await bert.heard()
        say(control, anna, type="limits", servos=told)
        assert await anna.heard() == []
        assert await bert.heard() == [{"type": "limits", "servos": told}]
        cora = Client(control)
        welcome, *_ = await cora.heard()
        assert welcome["limits"] == told
        await bert.heard()
        control.take_for("lsc-6")
        assert {"type": "limits", "servos": []} in await bert.heard()


@pytest.mark.parametrize(("position", "passes"), [(1500, True), (1400, True), (1399, False), (1501, False)])
@in_virtual_time
async def test_both_ends_are_within_and_downloads_are_judged_as_moves_are(
    position: int, passes: bool
) -> None:
    async with gateway_on() as control:
        control.limits.set([ServoLimits(servo=1, name="Elbow", min=1400, max=1500)])
        group = Group(10, "Wave", [Frame(1000, (ServoTarget(1, position),))])
        if passes:
            control.download(group, "Anna", lambda: None)
        else:
            with pytest.raises(OutOfRangeError, match="Elbow"):
                control.download(group, "Anna", lambda: None)


@in_virtual_time
async def test_a_stop_holds_the_robot_wherever_it_is() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        control.limits.set([ELBOW])
        await control.stop(MOVE)
        assert port.packets()[-1] == MOVE


@in_virtual_time
async def test_who_calibrates_a_servo_may_pass_its_limits_alone_and_until_the_end() -> None:
    wrist = ServoLimits(servo=2, name="Wrist", min=600, max=1800)
    other_servo = MOVE[:7] + b"\x02" + MOVE[8:]
    async with gateway_on() as control:
        anna, bert = Client(control), Client(control)
        control.limits.set([ELBOW, wrist])
        say(control, anna, type="calibrate", servo=1)
        await anna.send(MOVE)
        for owner, packet in ((bert, MOVE), (anna, other_servo)):
            with pytest.raises(OutOfRangeError):
                owner.send(packet)
        say(control, anna, type="calibrate", servo=None)
        with pytest.raises(OutOfRangeError):
            anna.send(MOVE)
        say(control, anna, type="calibrate", servo=1)
        control.leave(anna)
        with pytest.raises(OutOfRangeError):
            anna.send(MOVE)


@in_virtual_time
async def test_limits_end_with_their_board_or_by_word() -> None:
    async with gateway_on(FakePort(), FakePort()) as control:
        anna = Client(control)
        control.limits.set([ELBOW])
        control.take_for("doc")  # nothing new
        with pytest.raises(OutOfRangeError):
            anna.send(MOVE)
        control.take_for("lsc-6")
        await anna.send(MOVE)
        control.limits.set([ELBOW])
        await control.use_port("/dev/other")
        await anna.heard()
        await anna.send(MOVE)
        control.limits.set([ELBOW])
        say(control, anna, type="limits", servos=[])
        await anna.send(MOVE)


@in_virtual_time
async def test_who_does_not_drive_changes_no_rules_for_whoever_does() -> None:
    async with gateway_on() as control:
        anna, bert, owner = Client(control, PUPIL), Client(control, OTHER_PUPIL), Client(control)
        say(control, bert, type="limits", servos=[ELBOW.model_dump()])
        control.driving.act(anna, "request")
        await bert.heard()
        say(control, bert, type="limits", servos=[])
        say(control, bert, type="board", board="lsc-6")
        assert (control.board.taken_for, control.limits.told()) == ("doc", [ELBOW])
        told = await bert.heard()
        assert {"type": "limits", "servos": [ELBOW.model_dump()]} in told
        assert [message["code"] for message in told if message["type"] == "refused"] == ["notDriving"]
        say(control, bert, type="board", board="doc")  # what it is taken for already
        assert [message["type"] for message in await bert.heard()] == ["state"]
        say(control, owner, type="limits", servos=[])
        say(control, anna, type="board", board="lsc-6")
        assert (control.board.taken_for, control.limits.told()) == ("lsc-6", [])
