"""The HTTP interface for scripts: state, ports, stop, resume, battery, and what happens as a stream of
server-sent events: the messages that pages get. One error shape: `{code, detail}`.

Translates between HTTP and `control`; decides nothing. A client that does not read its events is sent away
like a page that does not.
"""

import asyncio
import contextlib
import itertools
import json
import secrets
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Literal

from fastapi import APIRouter, Header, Request, WebSocket
from pydantic import Field
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from servodeck import __version__
from servodeck.access.connections import connection_of
from servodeck.api.health import fleet_status
from servodeck.api.routes import (
    DRIVER,
    OWNER,
    SEEN_AT_ROBOT,
    STOPPER,
    VIEWER,
    Controlled,
    Note,
    leaves,
    named,
    routes,
)
from servodeck.api.websocket import serve_client
from servodeck.callers import Caller
from servodeck.errors import BusyError, OutOfRangeError
from servodeck.port.bluetooth import this_computer
from servodeck.port.ports import is_same_port, lasting_of, list_devices
from servodeck.protocol.families import FAMILIES
from servodeck.robot.control import Control
from servodeck.robot.driving import name_of
from servodeck.robot.hub import Session
from servodeck.robot.latch import Cause
from servodeck.schema import Message
from servodeck.snapshots import (
    FleetStatus,
    IdentityState,
    LinkState,
    PlayState,
    PortState,
    Running,
    UnattendedRun,
    UnheldServos,
)
from servodeck.threads import in_thread

if TYPE_CHECKING:
    from servodeck.notify.notifications import Notifications


class BatteryAge(Message):
    battery_mv: int
    age_ms: int


class NotificationReceiver(Message):
    """A receiver of notifications, and what became of the latest one; `detail` says why it was dropped."""

    kind: Literal["webhook", "ntfy"]
    host: str
    latest: Literal["unused", "sent", "dropped"]
    detail: str | None


class Status(Message):
    """`play`: what the gateway plays now, or played last. `fleet`: null where it is on no broker."""

    version: str
    board: str
    port: PortState
    link: LinkState
    identity: IdentityState
    latch: bool
    clients: int
    battery: BatteryAge | None
    driver: str | None
    running: Running | None
    play: PlayState | None
    unattended: UnattendedRun | None
    notifications: list[NotificationReceiver]
    fleet: FleetStatus | None


class Device(Message):
    """A serial port of this computer. `likely`: its USB chip is one that these boards and cables bear.
    `lasting`: a name that leads to it after every start and replug, where the system keeps one. `inUse`: it
    is the gateway's present one, open or waited for.
    """

    device: str
    description: str
    likely: bool
    lasting: str | None
    in_use: bool


class PortChoice(Message):
    device: Annotated[str, Field(min_length=1, max_length=256, pattern=r"^[^\x00-\x1f]+$")]
    board: str | None = None


class RateFound(Message):
    """The first other speed at which something that can be read arrives, and what; both null where there is
    none.
    """

    baud: int | None
    kind: Literal["packets", "text"] | None


class BoardChoice(Message):
    """A family of boards; `unknown`: identify it again."""

    board: Annotated[str, Field(max_length=64)]


class Battery(Message):
    battery_mv: int


class Stopped(Message):
    """`halted`: the stop sequence has left the wire. `unheld`: servos that may continue to move, because
    their position is unknown; null where all are held.

    """

    latch: bool
    halted: bool
    unheld: UnheldServos | None


api = routes("/api", "gateway")
socket = APIRouter()


@socket.websocket("/ws")
async def ws(websocket: WebSocket, caller: Annotated[Caller, VIEWER], control: Controlled) -> None:
    await serve_client(websocket, caller, control)


@api.get("/status", dependencies=[VIEWER])
async def status(request: Request, control: Controlled) -> Status:
    """The state of gateway, port, board and robot."""
    return Status(
        version=__version__,
        board=control.board.family_id,
        port=control.board.port,
        link=control.board.link_state,
        identity=control.board.identity,
        latch=control.latch,
        clients=len(control.hub),
        battery=age_of(control),
        driver=name_of(control.driving.driver),
        running=control.board.activity.running(),
        play=control.board.plays.latest,
        unattended=control.board.unattended.snapshot(),
        notifications=notified_by(request),
        fleet=fleet_status(request),
    )


def notified_by(request: Request) -> list[NotificationReceiver]:
    notifications: Notifications | None = request.app.state.notifications
    return [
        NotificationReceiver(
            kind=sender.receiver.kind,
            host=sender.receiver.host,
            latest=sender.outcome.status,
            detail=sender.outcome.detail,
        )
        for sender in (notifications.senders if notifications else ())
    ]


def age_of(control: Control) -> BatteryAge | None:
    reading = control.board.battery.newest
    if reading is None:
        return None
    return BatteryAge(battery_mv=reading.battery_mv, age_ms=round((control.now() - reading.at_s) * 1000))


@api.get("/ports", dependencies=[OWNER])
def ports(control: Controlled, bluetooth: bool = False) -> list[Device]:
    """The ports of this computer, serial and HID, and the one in use, the likely ones first. `bluetooth`:
    also the modules that are heard within a few seconds.
    """
    present = control.board.link.state.device
    heard = this_computer().scan() if bluetooth else []
    known = {port.device for port in heard}
    found = [
        *heard,
        *(port for port in list_devices(control.named_device, present) if port.device not in known),
    ]
    return [
        Device(**asdict(port), in_use=present is not None and is_same_port(port.device, present))
        for port in found
    ]


@api.put("/port", dependencies=[OWNER])
async def use_port(
    choice: PortChoice, control: Controlled, note: Annotated[Note, leaves("portOpened")]
) -> PortState:
    """Opens that port instead of the present one. After a failure it is tried again and again, as `status`
    tells. One that opened is opened again at the next start, unless `--serial` names one.
    """
    if choice.board is not None and choice.board not in FAMILIES:
        raise OutOfRangeError(f"board is {choice.board}, allowed: {', '.join(FAMILIES)}")
    note.about = choice.device
    await control.use_port(choice.device, choice.board)
    found = await in_thread(list_devices)
    control.remembered.remember_port(lasting_of(choice.device, found))
    await control.remembered.saved()
    return control.board.port


@api.delete("/port", dependencies=[OWNER, leaves("portClosed")])
async def close_port(control: Controlled) -> PortState:
    """Closes the port and leaves it closed, also after the next start."""
    await control.close_port()
    control.remembered.remember_port(None)
    await control.remembered.saved()
    return control.board.port


@api.post("/port/listen", dependencies=[leaves(None)])
async def listen(request: Request, control: Controlled, caller: Annotated[Caller, OWNER]) -> RateFound:
    """Gives up the serial port for some seconds, listens on it at other speeds than the boards', and opens it
    again. For a board from which nothing that can be read arrives. Sends nothing; refused while the robot may
    move, and while another client drives.
    """
    found = await control.find_rate(named(request, caller))
    if found is None:
        return RateFound(baud=None, kind=None)
    baud, heard = found
    return RateFound(baud=baud, kind="packets" if heard.packets else "text")


@api.put("/board", dependencies=[SEEN_AT_ROBOT])
async def name_board(
    choice: BoardChoice, request: Request, control: Controlled, caller: Annotated[Caller, DRIVER]
) -> Status:
    """Says of which family the board is. It is driven as one once its answers do not contradict that; `link`
    tells, and `identity` what it answered. Remembered for its port.
    """
    control.name_board(named(request, caller), choice.board)
    return await status(request, control)


@api.post("/stop", dependencies=[SEEN_AT_ROBOT])
async def stop(request: Request, control: Controlled, caller: Annotated[Caller, STOPPER]) -> Stopped:
    """STOP: drops all that waits, sends stop three times, holds each servo whose place is known, and refuses
    motion until resume. Latches even without a port.
    """
    await asyncio.shield(control.stop(Cause("person", named(request, caller).name)))
    return Stopped(latch=control.latch, halted=True, unheld=control.unheld)


@api.post("/resume", dependencies=[SEEN_AT_ROBOT])
async def resume(request: Request, control: Controlled, caller: Annotated[Caller, DRIVER]) -> Status:
    """Allows motion again. Moves nothing. While a client drives, only that client or an owner may."""
    control.resume(named(request, caller))
    return await status(request, control)


@api.get("/battery", dependencies=[VIEWER])
async def battery(control: Controlled) -> Battery:
    """Queries the board now; 504 where it does not answer."""
    return Battery(battery_mv=await control.board.battery.read())


# A line that says nothing: a client that is gone is noticed, and nothing between closes a stream for its
# silence.
SILENCE_S = 15.0
CLOSE_WAIT_S = 0.1
MAX_ID = 64
HEADERS = [(b"content-type", b"text/event-stream; charset=utf-8"), (b"x-accel-buffering", b"no")]
EXAMPLE = 'id: 5f0c1a2b-7\ndata: {"type": "state", "board": "doc", "latch": true, "clients": 2}\n\n'

events_api = routes("/api", "events")


class EventStream(Response):
    media_type = "text/event-stream"

    def __init__(self, caller: Caller, control: Control, last_id: str | None) -> None:
        """`last_id` is what was heard last on a stream before this one."""
        super().__init__()
        self._name = secrets.token_hex(4)
        self._last_id = last_id
        self._session = Session(caller, answers=False)
        self._control = control

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        self._control.join(self._session)
        tasks = [
            asyncio.create_task(self._write_all(send)),
            asyncio.create_task(until_gone(receive)),
            asyncio.create_task(self._session.ended.wait()),
        ]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        finally:
            self._control.leave(self._session)
            for task in tasks:
                task.cancel()
        if self._session.close_reason:
            await end(scope, send)

    async def _write_all(self, send: Send) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": HEADERS})
        if self._last_id is not None:
            gap = json.dumps({"type": "gap", "after": self._last_id})
            await send({"type": "http.response.body", "body": f"data: {gap}\n\n".encode(), "more_body": True})
        for number in itertools.count(1):
            while (text := await self._next()) is None:
                await send({"type": "http.response.body", "body": b":\n\n", "more_body": True})
            line = f"id: {self._name}-{number}\ndata: {text}\n\n"
            await send({"type": "http.response.body", "body": line.encode(), "more_body": True})

    async def _next(self) -> str | None:
        """None where nothing happens for a while."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(SILENCE_S):
                return await self._session.next()
        return None


async def until_gone(receive: Receive) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass


async def end(scope: Scope, send: Send) -> None:
    """With a last message where the client reads."""
    try:
        async with asyncio.timeout(CLOSE_WAIT_S):
            await send({"type": "http.response.body", "body": b"", "more_body": False})
    except TimeoutError:
        if connection := connection_of(scope):
            connection.abort()
        await asyncio.sleep(0)  # so that the server notices it before this ends


@events_api.get(
    "/events",
    status_code=200,
    response_class=EventStream,
    responses={200: {"content": {"text/event-stream": {"example": EXAMPLE}}}},
)
async def events(
    caller: Annotated[Caller, VIEWER],
    control: Controlled,
    last_event_id: Annotated[str | None, Header(max_length=MAX_ID)] = None,
) -> EventStream:
    """Messages from now on, as server-sent events with an id: the same as on `/ws`. The first is a `welcome`
    with the whole state. With Last-Event-ID a `gap` comes before it, because the messages since that event
    are not repeated.

    """
    if not control.hub.has_room_for(caller):
        raise BusyError("Too many clients are connected: close another window or event stream.")
    return EventStream(caller, control, last_event_id)
