"""A download that may not begin yet says how long that lasts, in a first move and behind its STOP."""

import asyncio

import pytest

from servodeck.errors import MovingError
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Frame, Move, ServoTarget
from servodeck.robot.board.download import Group, made_of, packets_of
from tests.client import ANNA, driven
from tests.virtual_time import in_virtual_time

GROUP = Group(5, "", [Frame(500, (ServoTarget(1, 1500),))])


@pytest.mark.parametrize("is_stopped", [False, True])
@in_virtual_time
async def test_it_says_how_long_the_robot_still_moves(*, is_stopped: bool) -> None:
    async with driven() as (control, _, driver):
        await driver.send(encode(Move(3000, (ServoTarget(3, 2000),)), control.board.family))
        await asyncio.sleep(0.5)
        if is_stopped:
            await control.stop()
            control.resume(driver.caller)
        with pytest.raises(MovingError, match=r"moves for up to 2\.[345] s more: wait until then"):
            control.requests.download(
                [made_of(GROUP, list(packets_of(GROUP, "doc")), "doc")], ANNA, lambda: None
            )
