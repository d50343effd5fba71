"""Serves one WebSocket client: passes its messages to `control`, and its outbox to the socket.

Closes a client that sends bytes or does not read. A message that cannot be parsed is refused, never fatal.
Knows no port and no packet.

"""

import asyncio
import contextlib
from collections.abc import Callable, Coroutine, Iterator, Sequence
from typing import Any

from pydantic import ValidationError
from starlette.websockets import WebSocket, WebSocketDisconnect

from servodeck import metrics
from servodeck.access.connections import connection_of
from servodeck.api.intake import Intake, merged, rate_of
from servodeck.callers import Caller, Role
from servodeck.errors import BusyError, GatewayError, MalformedError
from servodeck.events import PROTOCOL, DoneMessage, PlayedMessage, RefusedMessage, encode
from servodeck.intents import (
    AnyClientMessage,
    BoardMessage,
    CalibrateMessage,
    ContinueMessage,
    EraseMessage,
    GrantMessage,
    HeartbeatMessage,
    LeaseMessage,
    MoveMessage,
    PacketMessage,
    PlayIntent,
    PlayMessage,
    ReadMessage,
    ReleaseMessage,
    ResumeMessage,
    RunMessage,
    SetSpeedMessage,
    StopGroupMessage,
    StopMessage,
    StopPlayingMessage,
    Target,
    client_message,
)
from servodeck.port.wire import Left
from servodeck.protocol.values import Run, ServoTarget
from servodeck.robot.board.playing import FrameGroup
from servodeck.robot.control import Control
from servodeck.robot.hub import AGAINST_THE_RULES, Session
from servodeck.robot.latch import Cause
from servodeck.robot.operations import PageClaim, Ran
from servodeck.robot.requests import judge_packet
from servodeck.schema import first_problem
from servodeck.snapshots import Outcome, PlayState

UNSUPPORTED_DATA, OUTDATED_PAGE = 1003, 4001
CLOSE_WAIT_S = 0.1
# The least role for each message; others need an owner. A packet is judged by its command.
ROLES: dict[type[AnyClientMessage], Role] = {
    MoveMessage: "driver",
    PlayMessage: "driver",
    StopPlayingMessage: "driver",
    RunMessage: "driver",
    StopGroupMessage: "stopper",
    EraseMessage: "owner",
    SetSpeedMessage: "driver",
    ReleaseMessage: "driver",
    PacketMessage: "viewer",
    StopMessage: "stopper",
    ResumeMessage: "driver",
    BoardMessage: "driver",
    ReadMessage: "viewer",
    CalibrateMessage: "driver",
    LeaseMessage: "viewer",
    GrantMessage: "driver",
    ContinueMessage: "driver",
    HeartbeatMessage: "driver",
}


async def serve_client(socket: WebSocket, caller: Caller, control: Control) -> None:
    if is_outdated(socket):
        await socket.accept()
        await socket.close(
            OUTDATED_PAGE, "This page and the gateway have different versions: reload the page."
        )
        return
    if not control.hub.has_room_for(caller):
        raise BusyError("Too many clients are connected: close another window or event stream.")
    session = Session(caller)
    control.join(session)  # before anything is waited for: one that is revoked now is found
    try:
        await socket.accept()
        await serve_session(socket, session, control)
    finally:
        control.leave(session)
    if session.close_reason:
        with contextlib.suppress(TimeoutError, WebSocketDisconnect, RuntimeError):
            await asyncio.wait_for(
                socket.close(session.close_reason.code, session.close_reason.reason), CLOSE_WAIT_S
            )


def is_outdated(socket: WebSocket) -> bool:
    """A page that was loaded from another version of the gateway; programs have no Origin, and load no
    page.
    """
    return "origin" in socket.headers and socket.query_params.get("protocol") != str(PROTOCOL)


async def serve_session(socket: WebSocket, session: Session, control: Control) -> None:
    """Until the client leaves, breaks the rules, is disconnected or stops reading."""
    tasks = [
        asyncio.create_task(read_all(socket, session, control)),
        asyncio.create_task(write_all(socket, session)),
        asyncio.create_task(session.ended.wait()),
    ]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        for task in done:
            task.result()
    finally:
        for task in tasks:
            task.cancel()


async def read_all(socket: WebSocket, session: Session, control: Control) -> None:
    intake = intake_of(session, control)
    if connection := connection_of(socket.scope):
        connection.limit_frames(lambda: intake.count() or not session.ended.is_set())
    try:
        while (event := await socket.receive())[
            "type"
        ] != "websocket.disconnect" and not session.ended.is_set():
            text = event.get("text")
            if text is None:
                await socket.close(UNSUPPORTED_DATA, "Only text messages are accepted.")
                return
            take_text(text, session, intake)
            # `receive` returns messages that have come already without a pause; others may have sent a STOP.
            await asyncio.sleep(0)
    finally:
        intake.close()


def intake_of(session: Session, control: Control) -> Intake:
    return Intake(
        rate_of(session.caller, control.now),
        take=lambda message: take(message, session, control),
        merged=merged,
        replaced=lambda message: refuse(
            session, id_of(message), BusyError("A newer message replaced this one.")
        ),
        overrun=lambda: session.end(AGAINST_THE_RULES, "Too many messages."),
    )


def take_text(text: str, session: Session, intake: Intake) -> None:
    """Any text is answered by a `refused` at worst, and too many by the end of the session."""
    try:
        message = client_message.validate_json(text)
    except ValidationError as error:
        if intake.count():
            refuse(session, None, MalformedError(first_problem(error)))
        return
    if isinstance(message, StopMessage):
        intake.take_at_once(message)
    else:
        intake.offer(message)


def id_of(message: AnyClientMessage) -> int | None:
    """Of a request; messages about the lease and stops have none."""
    number = getattr(message, "id", None)
    return number if isinstance(number, int) else None


async def write_all(socket: WebSocket, session: Session) -> None:
    with contextlib.suppress(WebSocketDisconnect):
        while True:
            await socket.send_text(await session.next())


def take(message: AnyClientMessage, session: Session, control: Control) -> None:
    """Acts on one message, if its session is connected and has the role for it. A stop is always taken."""
    if session.ended.is_set() and not isinstance(message, StopMessage):
        return
    with refusing(session, id_of(message)):
        session.caller.require(ROLES.get(type(message), "owner"))
        ACTS[type(message)](message, session, control)


def take_move(message: MoveMessage, session: Session, control: Control) -> None:
    with refusing(session, message.id):
        left = control.requests.move(session, targets_of(message.targets), message.duration_ms, message.nonce)
        left.add_done_callback(lambda left: answer_move(session, message.id, left))


def targets_of(targets: Sequence[Target]) -> list[ServoTarget]:
    return [ServoTarget(target.servo, target.position) for target in targets]


def answer_move(session: Session, message_id: int, left: Left) -> None:
    """Clients see in `left` what has left."""
    with refusing(session, message_id):
        left.result()


def take_play(message: PlayMessage, session: Session, control: Control) -> None:
    frames = [body.frame() for body in message.frames]
    group = FrameGroup(frames, message.times, message.loop_from)

    async def begun() -> None:
        with refusing(session, message.id):
            await play(group, message, message.id, message.nonce, session, control)

    session.begin(begun())


async def play(
    group: FrameGroup, wish: PlayIntent, message_id: int, nonce: str, session: Session, control: Control
) -> PlayState:
    """Raises what prevents it from beginning. The client is notified of its end."""
    claim = PageClaim(control, session, nonce)

    def ended(state: PlayState) -> None:
        session.put(encode(PlayedMessage(id=message_id, play=state)))

    return await control.operations.play(claim, group, ended, anyway=wish.anyway)


def take_packet(message: PacketMessage, session: Session, control: Control) -> None:
    with refusing(session, message.id):
        command = judge_packet(message.bytes, control.board.family_id).command
        if isinstance(command, Run):  # which ends first what moves
            claim = PageClaim(control, session, message.nonce)
            perform_run(session, message.id, control.operations.run(claim, command.slot, command.times))
            return
        left = control.requests.send(session, message.bytes, message.nonce)
        left.add_done_callback(lambda left: answer(session, message.id, left))


def take_run(message: RunMessage, session: Session, control: Control) -> None:
    claim = PageClaim(control, session, message.nonce)
    run = control.operations.run(claim, message.slot, message.times, anyway=message.anyway)
    perform_run(session, message.id, run)


def perform_run(session: Session, message_id: int, work: Coroutine[Any, Any, Ran]) -> None:
    async def answered() -> None:
        with refusing(session, message_id):
            ran = await work
            done = DoneMessage(id=message_id, outcome=ran.outcome, battery_unknown=ran.is_battery_unknown)
            session.put(encode(done))

    session.begin(answered())


def take_erase(message: EraseMessage, session: Session, control: Control) -> None:
    perform(session, message.id, control.operations.erase(PageClaim(control, session, message.nonce)))


def take_set_speed(message: SetSpeedMessage, session: Session, control: Control) -> None:
    claim = PageClaim(control, session, message.nonce)
    perform(session, message.id, control.operations.set_speed(claim, message.slot, message.percent))


def take_release(message: ReleaseMessage, session: Session, control: Control) -> None:
    claim = PageClaim(control, session, message.nonce)
    perform(session, message.id, control.operations.release(claim, message.servos))


def perform(session: Session, message_id: int, work: Coroutine[Any, Any, Outcome]) -> None:
    async def answered() -> None:
        with refusing(session, message_id):
            session.put(encode(DoneMessage(id=message_id, outcome=await work)))

    session.begin(answered())


@contextlib.contextmanager
def answering_with_lease(session: Session, control: Control) -> Iterator[None]:
    """The state of the lease says why it was refused; a `refused` without an id belongs to a stop."""
    try:
        yield
    except GatewayError:
        control.driving.send_state(session)


def take_stop(message: StopMessage, session: Session, control: Control) -> None:
    with refusing(session, None):
        control.stop(Cause(message.reason, session.caller.name))


def allow_unattended(message: ContinueMessage, session: Session, control: Control) -> None:
    with contextlib.suppress(GatewayError):  # the state says so: a `refused` without id belongs to a stop
        control.allow_unattended(session, message.for_ms)


def act_on_lease(message: LeaseMessage, session: Session, control: Control) -> None:
    with answering_with_lease(session, control):
        control.driving.act(session, message.action)


def grant(message: GrantMessage, session: Session, control: Control) -> None:
    with answering_with_lease(session, control):
        control.driving.give(session, message.to)


def name_board(message: BoardMessage, session: Session, control: Control) -> None:
    control.name_board(session.caller, message.board)
    session.put(encode(DoneMessage(id=message.id)))


def read(message: ReadMessage, session: Session, control: Control) -> None:
    async def answered() -> None:
        with refusing(session, message.id):
            if message.what == "battery":
                await control.board.battery.read()
            else:
                await control.board.readings.read(message.what, message.servos)
            session.put(encode(DoneMessage(id=message.id)))

    session.begin(answered())


ACTS: dict[type[AnyClientMessage], Callable[[Any, Session, Control], None]] = {
    MoveMessage: take_move,
    PlayMessage: take_play,
    StopPlayingMessage: lambda _, session, control: control.stop_playing(session.caller),
    RunMessage: take_run,
    StopGroupMessage: lambda message, session, control: perform(
        session, message.id, control.operations.end_group(session)
    ),
    EraseMessage: take_erase,
    SetSpeedMessage: take_set_speed,
    ReleaseMessage: take_release,
    PacketMessage: take_packet,
    StopMessage: take_stop,
    ResumeMessage: lambda _, session, control: control.resume(session.caller, session),
    BoardMessage: name_board,
    ReadMessage: read,
    CalibrateMessage: lambda message, session, control: control.calibrate(session, message.servo),
    LeaseMessage: act_on_lease,
    GrantMessage: grant,
    ContinueMessage: allow_unattended,
    HeartbeatMessage: lambda message, session, control: control.driving.lease.heartbeat(
        session, message.nonce
    ),
}


def answer(session: Session, message_id: int, left: Left) -> None:
    with refusing(session, message_id):
        left.result()
        session.put(encode(DoneMessage(id=message_id, outcome="sent")))


@contextlib.contextmanager
def refusing(session: Session, message_id: int | None) -> Iterator[None]:
    """Turns a GatewayError into a `refused` for that session."""
    try:
        yield
    except GatewayError as error:
        refuse(session, message_id, error)


def refuse(session: Session, message_id: int | None, error: GatewayError) -> None:
    metrics.refused[error.code] += 1
    session.put(encode(RefusedMessage(id=message_id, code=error.code, detail=error.detail)))
