"""The HTTP interface of what the gateway plays: begin it, look how far it is, end it. Translates between HTTP
and `control`; decides nothing.
"""

from typing import Annotated

from servodeck.access.roles import DRIVER
from servodeck.board.playing import FrameGroup
from servodeck.callers import Caller
from servodeck.errors import MalformedError
from servodeck.intents import PlayIntent
from servodeck.messages import ContinueMs, MessageId, Nonce
from servodeck.told import PlayState
from servodeck.web.api import Controlled, routes
from servodeck.web.clients import play as play_for_page
from servodeck.web.jobs_api import frames_of
from servodeck.web.motion_api import Scripted, Take


class PlayWish(PlayIntent):
    """`id` and `nonce`: of the page that drives, which hears `played` with that id on its WebSocket. A
    program needs neither. `continueForMs`: it goes on without a `beat`, for so long at most.
    """

    id: MessageId | None = None
    nonce: Nonce | None = None
    continue_for_ms: ContinueMs | None = None
    take: Take = False


play_api = routes("/api", "play")


@play_api.post("/play", status_code=202)
async def play(
    wish: PlayWish, caller: Annotated[Caller, DRIVER], control: Controlled, scripts: Scripted
) -> PlayState:
    """Plays frames by the gateway's clock, gently to the first one. Answers when the first one has begun. It
    is stopped 2 s after the last `beat`, unless it may continue; one of a page ends with its page.
    """
    group = FrameGroup(await frames_of(wish.frames), wish.times, wish.loop_from)
    if wish.nonce is None:
        return await scripts.play(caller, group, take=wish.take, continue_ms=wish.continue_for_ms)
    if wish.id is None:
        raise MalformedError("id: a page needs one beside its nonce")
    return play_for_page(group, wish.id, wish.nonce, control.driving.driving_page(caller), control)


@play_api.delete("/play", dependencies=[DRIVER])
async def stop_playing(control: Controlled) -> PlayState | None:
    """Ends it with its frame in progress, whoever began it; how the latest one ended."""
    control.stop_playing()
    return control.board.plays.latest
