"""Requests with an `Idempotency-Key`: a repeat of a key gets the first answer, and nothing is done again.

Knows keys, bodies and answers; not what a request does. Memory is bounded: keys beyond the bound are refused,
because a key that was forgotten too early would move the robot a second time.
"""

import asyncio
import json
from collections import Counter
from collections.abc import Awaitable, Callable, Coroutine
from hashlib import sha256
from itertools import takewhile
from typing import Annotated, Any

from fastapi import Depends, Header
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from servodeck.api.routes import ApiRoute, BodyRequest
from servodeck.errors import BusyError, GatewayError, MalformedError

KEY = "idempotency-key"
REMEMBERED_S = 600.0
# Sixty a second for ten minutes, twice what a token may send. 400 bytes each were measured.
MOST_OF_ONE = 40_000
MOST = 2 * MOST_OF_ONE
Key = Annotated[
    str | None,
    Header(
        min_length=1,
        max_length=64,
        pattern=r"^[A-Za-z0-9_-]+$",
        description="Of this request, by the client. A repeat within ten minutes gets the first answer.",
    ),
]
Answer = tuple[int, bytes]


async def keyed(idempotency_key: Key = None) -> None:
    """Marks a route whose requests may have a key."""


KEYED = Depends(keyed)


class Known:
    """A request with a key. `answer` is None until it has one; meanwhile it is wanted by `waiting`."""

    __slots__ = ("answer", "body", "ended", "until_s", "waiting")

    def __init__(self, body: bytes, until_s: float) -> None:
        self.body = body
        self.until_s = until_s
        self.answer: Answer | None = None
        self.waiting: list[Request] | None = []
        self.ended: asyncio.Event | None = asyncio.Event()

    def end(self, answer: Answer | None) -> None:
        self.answer, self.waiting = answer, None
        if self.ended:
            self.ended.set()
        self.ended = None


class SharedRequest(BodyRequest):
    """Connected for as long as one of those that wait for its answer is."""

    known: Known

    async def is_disconnected(self) -> bool:
        for request in self.known.waiting or ():
            if not await request.is_disconnected():
                return False
        return True


class Answers:
    """Of requests with a key, by caller and key, the oldest first."""

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._known: dict[tuple[str, str], Known] = {}
        self._counts: Counter[str] = Counter()

    async def answer(
        self,
        caller: str,
        key: str,
        request: Request,
        do: Callable[[Request], Awaitable[Response]],
    ) -> Response:
        """Raises MalformedError for a key that was used with another request, BusyError for too many keys."""
        text = f"{request.method} {request.url.path}\n".encode() + await request.body()
        body = sha256(text).digest()
        while known := self._find(caller, key):
            if known.body != body:
                raise MalformedError("This Idempotency-Key was used with another request: take a new one.")
            if known.ended and known.waiting is not None:
                known.waiting.append(request)
                await known.ended.wait()
            if known.answer:
                status, content = known.answer
                return Response(content, status, media_type="application/json")
        return await self._first(caller, key, body, request, do)

    async def _first(
        self,
        caller: str,
        key: str,
        body: bytes,
        request: Request,
        do: Callable[[Request], Awaitable[Response]],
    ) -> Response:
        self._judge(caller)
        known = self._known[caller, key] = Known(body, self._now() + REMEMBERED_S)
        self._counts[caller] += 1
        assert known.waiting is not None
        known.waiting.append(request)
        shared = SharedRequest(request.scope, request.receive)
        shared.known = known
        shared._body = await request.body()
        try:
            response = await do(shared)
        except (RequestValidationError, HTTPException):
            self._forget(caller, key)  # nothing was done, so the key is free
            known.end(None)
            raise
        except GatewayError as error:
            known.end(refused(error))
            raise
        except BaseException:
            known.end(refused(GatewayError("The gateway made a mistake; its log says more.")))
            raise
        known.end((response.status_code, bytes(response.body)))
        return response

    def _find(self, caller: str, key: str) -> Known | None:
        now = self._now()
        for oldest in [*takewhile(lambda each: self._known[each].until_s <= now, self._known)]:
            self._forget(*oldest)
        return self._known.get((caller, key))

    def _forget(self, caller: str, key: str) -> None:
        if self._known.pop((caller, key), None):
            self._counts[caller] -= 1
            if not self._counts[caller]:
                del self._counts[caller]

    def _judge(self, caller: str) -> None:
        if self._counts[caller] >= MOST_OF_ONE or len(self._known) >= MOST:
            raise BusyError("Too many requests with an Idempotency-Key in ten minutes: send fewer, or none.")


def refused(error: GatewayError) -> Answer:
    return error.status, json.dumps({"code": error.code, "detail": error.detail}).encode()


def answers_in(request: Request) -> Answers:
    """Those of this gateway."""
    state = request.app.state
    if not hasattr(state, "answers"):
        state.answers = Answers(state.control.now)
    found: Answers = state.answers
    return found


class KeyedRoute(ApiRoute):
    """Where the route is marked `KEYED` and the request has a key, a repeat gets the first answer."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        if not any(each.call is keyed for each in self.dependant.dependencies):
            return super().get_route_handler()
        handle = self.noting(APIRoute.get_route_handler(self))

        async def judge_and_answer(request: Request) -> Response:
            self.judge(request)
            body_request = BodyRequest(request.scope, request.receive)
            key = request.headers.get(KEY)
            if key is None:
                return await handle(body_request)
            answers = answers_in(request)
            return await answers.answer(request.state.caller.id, key, body_request, handle)

        return judge_and_answer
