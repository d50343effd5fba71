"""What an assistant asks of a gateway beside driving: who it is there, the robot, the library, a draft.

Knows routes and bodies; no tool. Waits in threads.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Literal
from urllib.parse import quote

from servodeck.assistant.bodies import Body, body_in, usual_body
from servodeck.callers import THIS_COMPUTER
from servodeck.client.gateway import Call, Gateway
from servodeck.client.values import Json, robot_in
from servodeck.errors import DamagedTextError
from servodeck.threads import in_thread
from servodeck.value import value


@value
class Me:
    """`is_owner_here`: a program on the gateway's computer without a token, which may do everything there."""

    role: Literal["stopper", "viewer", "driver", "owner"]
    is_owner_here: bool


@value
class ListedGroup:
    id: str
    name: str
    tags: Sequence[str]
    seconds: float
    frames: int


class Requests:
    def __init__(self, gateway: Gateway) -> None:
        self._gateway = gateway

    async def me(self) -> Me:
        """Raises a GatewayError where it is not let in."""
        answer = await self._get("/api/me")
        you = answer["you"] or {"id": "", "role": "stopper"}
        return Me(you["role"], you["id"] == THIS_COMPUTER.id)

    async def body(self) -> Body:
        """The robot on the board; the usual one of such boards where none is described."""
        welcome = await in_thread(self._gateway.welcome)
        robot = welcome["robot"]
        if robot is None:
            return usual_body(welcome["board"])
        return body_in(robot_in((await self._get(f"/api/library/{robot['id']}"))["text"]))

    async def groups(self) -> list[ListedGroup]:
        listing = await self._get("/api/library")
        return [
            ListedGroup(one["id"], facts["name"], facts["tags"], facts["durationMs"] / 1000, facts["frames"])
            for one in listing["documents"]
            if (facts := one["facts"])["kind"] == "group" and not one["isRemoved"]
        ]

    async def group(self, group_id: str) -> Json:
        """Its content. Raises NotFoundError, and DamagedTextError for what is no group."""
        text = (await self._get(f"/api/library/{quote(group_id, safe='')}"))["text"]
        try:
            content: Json = json.loads(text)["content"]
        except (ValueError, KeyError, TypeError):
            raise DamagedTextError("This document is no action group.") from None
        return content

    async def propose(self, text: str, facts: Mapping[str, Any]) -> str:
        """Adds a draft; its id in the library."""
        body = {"text": text, "facts": facts}
        answer = await in_thread(lambda: self._gateway.call(Call("POST", "/api/library/drafts", body)))
        draft: str = answer["id"]
        return draft

    async def _get(self, path: str) -> Any:
        return await in_thread(lambda: self._gateway.call(Call("GET", path, is_safe=True)))
