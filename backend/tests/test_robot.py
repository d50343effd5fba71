"""The robot's limits hold for every client, and nothing keeps a stop from holding the robot where it is."""

import asyncio
import json

import pytest

from servodeck.api.websocket import intake_of, take_text
from servodeck.callers import Caller
from servodeck.errors import OutOfRangeError
from servodeck.protocol.packets import parse_command
from servodeck.protocol.values import Frame, ServoTarget
from servodeck.robot.board.download import Group
from servodeck.robot.control import Control
from servodeck.robot.hub import Session
from servodeck.snapshots import ServoLimits
from tests.client import Client, gateway_on
from tests.downloading import begin
from tests.fake_port import FakePort
from tests.samples import MOVE, MOVE_ELSEWHERE, MOVE_S, RUN, STOP, hold_at
from tests.virtual_time import in_virtual_time

# MOVE takes servo 1 to 2000, DOWNLOAD and MOVE_ELSEWHERE to 1500.
ELBOW = ServoLimits(servo=1, name="Elbow", min=600, max=1800)
PUPIL, OTHER_PUPIL = Caller("anna", "Anna", "driver"), Caller("bert", "Bert", "driver")
REFUSAL = "Elbow (servo 1): position is 2000, allowed 600..1800"


def say(control: Control, session: Session, **message: object) -> None:
    take_text(json.dumps(message), session, intake_of(session, control))


@in_virtual_time
async def test_a_limit_holds_for_all() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        anna, bert = Client(control), Client(control)
        control.limits.set([ELBOW])
        for owner in (anna, bert):
            with pytest.raises(OutOfRangeError, match=r"^Elbow \(servo 1\): position is 2000, allowed 600"):
                owner.send(MOVE)
        control.leave(anna)
        await bert.heard()
        say(control, bert, type="packet", id=7, bytes=MOVE.hex(), nonce=bert.nonce)
        assert await bert.heard() == [{"type": "refused", "id": 7, "code": "outOfRange", "detail": REFUSAL}]
        await bert.send(MOVE_ELSEWHERE)
        await asyncio.sleep(MOVE_S)
        await bert.send(RUN)
        assert port.packets() == [STOP, MOVE_ELSEWHERE, RUN]


@pytest.mark.parametrize(("position", "passes"), [(1500, True), (1400, True), (1399, False), (1501, False)])
@in_virtual_time
async def test_both_ends_are_within_and_downloads_are_judged_as_moves_are(
    position: int, passes: bool
) -> None:
    async with gateway_on() as control:
        control.limits.set([ServoLimits(servo=1, name="Elbow", min=1400, max=1500)])
        group = Group(10, "Wave", [Frame(1000, (ServoTarget(1, position),))])
        if passes:
            begin(control, group)
        else:
            with pytest.raises(OutOfRangeError, match="Elbow"):
                begin(control, group)


@in_virtual_time
async def test_a_stop_holds_the_robot_wherever_it_is() -> None:
    port = FakePort()
    async with gateway_on(port) as control:
        await Client(control).send(MOVE)
        await asyncio.sleep(MOVE_S + 0.1)
        control.limits.set([ELBOW])
        await control.stop()
        assert port.packets()[-1] == hold_at(2000)


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
            control.limits.judge(parse_command(MOVE), anna)


@in_virtual_time
async def test_a_client_that_does_not_drive_names_no_board_for_the_driver() -> None:
    async with gateway_on() as control:
        anna, bert = Client(control, PUPIL), Client(control, OTHER_PUPIL)
        control.driving.act(anna, "request")
        await bert.heard()
        say(control, bert, type="board", id=1, board="lsc-6")
        messages = await bert.heard()
        assert control.board.family_id == "doc"
        assert [message["code"] for message in messages if message["type"] == "refused"] == ["notDriving"]
        say(control, bert, type="board", id=1, board="doc")  # what it is taken for already
        assert "done" in [message["type"] for message in await bert.heard()]
        say(control, anna, type="board", id=1, board="lsc-6")
        assert control.board.family_id == "lsc-6"
