"""Which robot of the library stands on the board, over HTTP. Translates for `control`; decides nothing."""

from typing import Annotated

from servodeck.access.roles import DRIVER
from servodeck.callers import Caller
from servodeck.errors import NotDrivingError
from servodeck.library.library_messages import Id
from servodeck.schema import Message
from servodeck.web.api import Controlled, routes


class RobotChoice(Message):
    """`insteadOf`: the one that whoever asks knows to stand there."""

    id: Id
    instead_of: Id | None = None


robots_api = routes("/api", "robots")


@robots_api.put("/robot", status_code=204)
async def put_on_board(choice: RobotChoice, control: Controlled, caller: Annotated[Caller, DRIVER]) -> None:
    """That robot of the library stands on this board, for everybody and from now on. 412 where another one
    stands there than either.
    """
    if not control.driving.may_rule(caller):
        raise NotDrivingError("Somebody else drives: which robot it is changes only under their hands.")
    await control.robot.put(choice.id, choice.instead_of)
