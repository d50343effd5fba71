"""Serves the WebSocket by which a page drives one robot of the fleet: passes its wishes to a `DriveSession`,
and what that has to say to the page.

Knows a socket and who may use it; decides nothing about motion. Who is revoked or may not drive any more is
found at the next message.
"""

import asyncio
import contextlib
from typing import Annotated

from fastapi import APIRouter
from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from servodeck.access.connections import connection_of
from servodeck.api.fleet import OfFleet
from servodeck.api.intake import rate_of
from servodeck.api.routes import DRIVER, audit_in, entrance_in
from servodeck.api.websocket import CLOSE_WAIT_S, OUTDATED_PAGE, UNSUPPORTED_DATA, is_outdated
from servodeck.callers import Caller
from servodeck.errors import NotFoundError
from servodeck.events import encode
from servodeck.fleet.drive import DriveSession
from servodeck.fleet.drive_messages import drive_wish
from servodeck.robot.hub import AGAINST_THE_RULES, CloseReason

drive_socket = APIRouter()


@drive_socket.websocket("/api/fleet/robots/{robot}/drive")
async def drive(socket: WebSocket, robot: str, caller: Annotated[Caller, DRIVER], fleet: OfFleet) -> None:
    if robot not in fleet.view.robots():
        raise NotFoundError("There is no such robot.")
    await socket.accept()
    if is_outdated(socket):
        await close(socket, CloseReason(OUTDATED_PAGE, "The gateway has another version: reload the page."))
        return
    audit_in(socket).note("fleetAsked", caller.name, robot)
    session = fleet.drive(robot, caller.name)
    tasks = [
        asyncio.create_task(session.run()),
        asyncio.create_task(read_all(socket, session, caller)),
        asyncio.create_task(write_all(socket, session)),
    ]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        reason = next((found for task in done if (found := task.result())), None)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    await close(socket, reason)


async def close(socket: WebSocket, reason: CloseReason | None) -> None:
    with contextlib.suppress(TimeoutError, WebSocketDisconnect, RuntimeError):
        code, text = (reason.code, reason.reason) if reason else (1000, "")
        await asyncio.wait_for(socket.close(code, text), CLOSE_WAIT_S)


async def read_all(socket: WebSocket, session: DriveSession, caller: Caller) -> CloseReason | None:
    """Until the page leaves; or why it has to."""
    rate = rate_of(caller, asyncio.get_running_loop().time)
    if connection := connection_of(socket.scope):
        connection.limit_frames(rate.take)
    while (event := await socket.receive())["type"] != "websocket.disconnect":
        text = event.get("text")
        if text is None:
            return CloseReason(UNSUPPORTED_DATA, "Only text messages are accepted.")
        if not rate.take():
            return CloseReason(AGAINST_THE_RULES, "Too many messages.")
        if not entrance_in(socket).still_lets_in(caller):
            return CloseReason(AGAINST_THE_RULES, "This device may not drive any more.")
        try:
            session.take(drive_wish.validate_json(text))
        except ValidationError:
            return CloseReason(AGAINST_THE_RULES, "This message is none of ours.")
        await asyncio.sleep(0)  # messages that have come already are returned without a pause
    return None


async def write_all(socket: WebSocket, session: DriveSession) -> None:
    with contextlib.suppress(WebSocketDisconnect):
        while True:
            await socket.send_text(encode(await session.next()))
