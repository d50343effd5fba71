"""Serves one WebSocket client: its messages to `control`, its outbox to the socket. Knows no port and no
packet.

Closes a client that sends what is no text or does not read; what cannot be understood is refused, never
fatal.
"""

import asyncio
import contextlib
from collections.abc import Iterator

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from servodeck import metrics
from servodeck.callers import Caller
from servodeck.control import Control
from servodeck.errors import GatewayError, MalformedError
from servodeck.gate import judge_hold
from servodeck.hub import Seat
from servodeck.messages import (
    BoardMessage,
    CalibrateMessage,
    LimitsMessage,
    RefusedMessage,
    ResumeMessage,
    SendMessage,
    SentMessage,
    StopMessage,
    client_message,
    encode,
)
from servodeck.wire import Left

UNSUPPORTED_DATA, TRY_AGAIN_LATER = 1003, 1013
CLOSE_WAIT_S = 0.1


async def serve_client(socket: WebSocket, caller: Caller, control: Control) -> None:
    if control.hub.is_full:
        await socket.close(TRY_AGAIN_LATER)
        return
    await socket.accept()
    seat = Seat(caller)
    control.join(seat)
    await serve_seat(socket, seat, control)
    if seat.overflowed.is_set():
        with contextlib.suppress(TimeoutError, WebSocketDisconnect, RuntimeError):
            await asyncio.wait_for(socket.close(TRY_AGAIN_LATER, "This client does not read."), CLOSE_WAIT_S)


async def serve_seat(socket: WebSocket, seat: Seat, control: Control) -> None:
    """Until the client leaves, breaks the rules or stops reading."""
    tasks = [
        asyncio.create_task(read_all(socket, seat, control)),
        asyncio.create_task(write_all(socket, seat)),
        asyncio.create_task(seat.overflowed.wait()),
    ]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()
    finally:
        control.leave(seat)
        for task in tasks:
            task.cancel()


async def read_all(socket: WebSocket, seat: Seat, control: Control) -> None:
    while (event := await socket.receive())["type"] != "websocket.disconnect":
        text = event.get("text")
        if text is None:
            await socket.close(UNSUPPORTED_DATA, "Text only.")
            return
        take(text, seat, control)


async def write_all(socket: WebSocket, seat: Seat) -> None:
    with contextlib.suppress(WebSocketDisconnect):
        while True:
            await socket.send_text(await seat.next())


def take(text: str, seat: Seat, control: Control) -> None:
    """Acts on one message. Whatever it is, the worst outcome is a `refused`."""
    try:
        message = client_message.validate_json(text)
    except ValidationError as error:
        refuse(seat, None, MalformedError(first_problem(error)))
        return
    match message:
        case SendMessage():
            take_send(message, seat, control)
        case StopMessage():
            take_stop(message, seat, control)
        case ResumeMessage():
            with refusing(seat, None):
                control.resume()
        case BoardMessage():
            with refusing(seat, None):
                control.take_for(message.board)
        case LimitsMessage():
            control.limits.set(message.servos)
        case CalibrateMessage():
            control.limits.calibrate(seat, message.servo)


def take_send(message: SendMessage, seat: Seat, control: Control) -> None:
    with refusing(seat, message.id):
        left = control.send(seat, message.packet)
        left.add_done_callback(lambda left: answer(seat, message.id, left))


def take_stop(message: StopMessage, seat: Seat, control: Control) -> None:
    hold = None
    with refusing(seat, None):  # a bad pose is told, and the stop goes out all the same
        hold = judge_hold(message.hold, control.board)
    with refusing(seat, None):
        control.stop(hold)


def answer(seat: Seat, message_id: int, left: Left) -> None:
    if left.cancelled():
        return
    with refusing(seat, message_id):
        left.result()
        seat.put(encode(SentMessage(id=message_id)))


@contextlib.contextmanager
def refusing(seat: Seat, message_id: int | None) -> Iterator[None]:
    """Turns a GatewayError into a `refused` for that seat."""
    try:
        yield
    except GatewayError as error:
        refuse(seat, message_id, error)


def refuse(seat: Seat, message_id: int | None, error: GatewayError) -> None:
    metrics.refused.labels(error.code).inc()
    seat.put(encode(RefusedMessage(id=message_id, code=error.code, detail=error.detail)))


def first_problem(error: ValidationError) -> str:
    """One line: where and what; never the input itself."""
    problem = error.errors(include_url=False, include_context=False, include_input=False)[0]
    where = ".".join(str(part) for part in problem["loc"])
    return f"{where}: {problem['msg']}" if where else problem["msg"]
