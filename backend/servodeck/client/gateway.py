"""Requests to a gateway as a program makes them: JSON, the token, errors as exceptions, and a second attempt
where an answer was lost and a repeat is safe.

Knows the shape of requests and answers; not their order, which is in vocabulary.py.
"""

import json
import math
import secrets
import time
from collections.abc import Generator, Iterator
from contextlib import closing
from typing import Any, TypeVar

from servodeck.client.errors import UnreachableError, error_of
from servodeck.client.transport import Answer, NotSentError, Stream, Transport
from servodeck.client.values import Event, Json
from servodeck.errors import TooManyError
from servodeck.protocol.timings import PROGRAM
from servodeck.value import value

T = TypeVar("T")
REFUSED = 400
OK = 200
SILENCE_S = PROGRAM.silence_ms / 1000
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.25, 5.0
NO_GATEWAY = "The server at this address is not a Servodeck gateway."


@value
class Call:
    """`is_keyed`: it moves the robot or stores, and its key lets the gateway recognise a repeat. `is_safe`: a
    repeat does no harm.
    """

    method: str
    path: str
    body: Json | None = None
    is_keyed: bool = False
    is_safe: bool = False
    more_s: float = 0.0
    """How much longer than other requests it may take."""
    most_s: float = math.inf
    """The program waits no longer for it."""


@value
class Pause:
    seconds: float


@value
class Welcome:
    """The whole state, as the first event has it."""


Step = Call | Pause | Welcome
Steps = Generator[Step, Any, T]


class Gateway:
    def __init__(self, transport: Transport, token: str, timeout_s: float) -> None:
        self._transport = transport
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}
        self.timeout_s = timeout_s
        self._was_reached = False

    def call(self, call: Call) -> Any:
        """The answer's body. Raises a GatewayError."""
        headers = dict(self._headers)
        body = None
        if call.body is not None:
            body, headers["Content-Type"] = json.dumps(call.body).encode(), "application/json"
        if call.is_keyed:
            headers["Idempotency-Key"] = secrets.token_hex(16)
        may_repeat = call.is_keyed or call.is_safe
        until_s = time.monotonic() + min(self.timeout_s + call.more_s, call.most_s)
        while True:
            answer = self._answer(call, headers, body, until_s, may_repeat=may_repeat)
            try:
                return read(answer)
            except TooManyError as error:
                # A motion waits for its program: it decides whether it is still wanted.
                wait_s = float(error.headers["Retry-After"])
                if not call.is_safe or time.monotonic() + wait_s >= until_s:
                    raise
            time.sleep(wait_s)

    def _answer(
        self, call: Call, headers: dict[str, str], body: bytes | None, until_s: float, *, may_repeat: bool
    ) -> Answer:
        """Again where its answer was lost, or where a gateway that was there before is not. One that was
        never there is an error at once, one that has gone after `timeout_s`.
        """
        pause_s, heard_s = FIRST_PAUSE_S, time.monotonic()

        def look() -> None:
            """Raises UnreachableError where the gateway, which is still at work, is not there any more."""
            nonlocal heard_s
            self._transport.request("GET", "/api/status", self._headers, None, self.timeout_s / 2)
            heard_s = time.monotonic()

        while True:
            left_s = max(0.001, until_s - time.monotonic())
            look_s = self.timeout_s / 2 if left_s > self.timeout_s else math.inf
            try:
                answer = self._transport.request(call.method, call.path, headers, body, left_s, look_s, look)
            except UnreachableError as error:
                until_s = min(until_s, heard_s + self.timeout_s)
                self._was_reached = self._was_reached or not isinstance(error, NotSentError)
                if not (may_repeat and self._was_reached) or time.monotonic() + pause_s >= until_s:
                    raise
            else:
                self._was_reached = True
                return answer
            time.sleep(pause_s)
            pause_s *= 2

    def welcome(self) -> Json:
        """Raises a GatewayError."""
        with closing(self._stream(None)) as stream:
            for _, message in messages_of(stream, self.timeout_s):
                return message
        raise UnreachableError(NO_GATEWAY)

    def events(self, last_id: str | None) -> "EventStream":
        return EventStream(self._stream(last_id), last_id)

    def mind_signals(self) -> None:
        """Where the port is this program's, a signal that ends the program stops the robot first. Called in
        the main thread.
        """
        self._transport.mind_signals()

    def close(self) -> None:
        self._transport.close()

    def _stream(self, last_id: str | None) -> Stream:
        headers = self._headers | ({} if last_id is None else {"Last-Event-ID": last_id})
        stream = self._transport.stream("/api/events", headers, self.timeout_s)
        if stream.status != OK:
            with closing(stream):
                read(Answer(stream.status, {}, stream.rest()))
        return stream


class EventStream:
    """One connection. `close` may be called from another thread."""

    def __init__(self, stream: Stream, last_id: str | None) -> None:
        self._stream = stream
        self.last_id = last_id

    def next(self, timeout_s: float) -> Event:
        """Raises UnreachableError where it has ended, or none comes in that time."""
        for number, message in messages_of(self._stream, timeout_s):
            self.last_id = number or self.last_id
            return Event(message["type"], message)
        raise UnreachableError("The event stream has ended.")

    def close(self) -> None:
        self._stream.close()


def messages_of(stream: Stream, timeout_s: float) -> Iterator[tuple[str | None, Json]]:
    """Each with its id, if it has one. Empty lines between them only say that the gateway is there."""
    until_s, number = time.monotonic() + timeout_s, None
    while line := stream.line(min(SILENCE_S, max(0.001, until_s - time.monotonic()))):
        if line.startswith(b"id: "):
            number = line.removeprefix(b"id: ").decode().strip()
        elif line.startswith(b"data: "):
            try:
                message = json.loads(line.removeprefix(b"data: "))
            except ValueError as error:
                raise UnreachableError(NO_GATEWAY) from error
            yield number, message


def read(answer: Answer) -> Any:
    """Raises the error that it holds."""
    try:
        body = json.loads(answer.body or b"null")
        if answer.status < REFUSED:
            return body
        code, detail, held_by = body["code"], body["detail"], tuple(body.get("heldBy") or ())
    except (ValueError, TypeError, KeyError) as error:
        raise UnreachableError(NO_GATEWAY) from error
    wait_s = float(answer.headers.get("Retry-After") or answer.headers.get("retry-after") or 1)
    raise error_of(code, detail, answer.status, wait_s=wait_s, held_by=held_by)
