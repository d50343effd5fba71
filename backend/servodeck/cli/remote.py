"""Requests to a gateway over HTTP, and the sentence about what a STOP could hold. Uses the standard library
alone: other HTTP clients take longer to load than a STOP takes to arrive.

Knows requests and answers; no other command and no terminal.
"""

import json
import math
from collections.abc import Iterator
from contextlib import closing, contextmanager
from http.client import HTTPConnection, HTTPException, HTTPResponse, HTTPSConnection
from typing import Any
from urllib.parse import urlsplit

HERE = "http://127.0.0.1:8300"
ANSWER_S = 10.0
# Servos of unknown position start a quarter of a second apart; an erase takes half a minute, and so does what
# others began before the port was opened.
LONG_WAIT_S = 90.0
OK, FAILED = 200, 400
CONNECTIONS = {"http": HTTPConnection, "https": HTTPSConnection}


class RefusedError(Exception):
    """The gateway says no, and why."""

    def __init__(self, code: str, detail: str) -> None:
        super().__init__(detail)
        self.code = code
        self.detail = detail


class UnreachableError(Exception):
    """Nothing answers there, or no gateway."""


class Remote:
    def __init__(self, url: str, token: str = "") -> None:
        """Raises ValueError for what is no address."""
        parts = urlsplit(url)
        if parts.scheme not in CONNECTIONS or not parts.hostname:
            raise ValueError(url)
        self.url = url.rstrip("/")
        self._parts = parts
        self._headers = {"Authorization": f"Bearer {token}"} if token else {}

    def request(self, method: str, path: str, body: object = None, wait_s: float = ANSWER_S) -> Any:
        """The body of the answer. Raises RefusedError or UnreachableError."""
        with self._answer_to(method, path, body, wait_s) as answer:
            return read(answer)

    def text(self, path: str) -> str:
        """The answer as it is. Raises as `request` does."""
        with self._answer_to("GET", path, None, ANSWER_S) as answer:
            if answer.status != OK:
                read(answer)
            return answer.read().decode()

    def events(self) -> Iterator[str]:
        """Each as JSON, for as long as the gateway sends them. Raises as `request` does."""
        with self._answer_to("GET", "/api/events", None, None) as answer:
            if answer.status != OK:
                read(answer)
            for line in answer:
                if line.startswith(b"data: "):
                    yield line.removeprefix(b"data: ").decode().rstrip("\n")

    @contextmanager
    def _answer_to(
        self, method: str, path: str, body: object, wait_s: float | None
    ) -> Iterator[HTTPResponse]:
        text = None if body is None else json.dumps(body)
        headers = self._headers | ({} if text is None else {"Content-Type": "application/json"})
        connection = CONNECTIONS[self._parts.scheme](self._parts.netloc.rpartition("@")[2], timeout=wait_s)
        with closing(connection):
            try:
                connection.request(method, self._parts.path.rstrip("/") + path, text, headers)
                yield connection.getresponse()
            except (OSError, HTTPException) as error:
                raise UnreachableError(str(error)) from error


def read(answer: HTTPResponse) -> Any:
    text = answer.read()
    try:
        body = json.loads(text or b"null")
        refusal = None if answer.status < FAILED else RefusedError(body["code"], body["detail"])
    except (ValueError, TypeError, KeyError) as error:
        raise UnreachableError("The server at this address is not a Servodeck gateway.") from error
    if refusal:
        raise refusal
    return body


RESUME = "servodeck resume allows motion again."


def stopped_words(stopped: dict[str, Any]) -> str:
    return f"{held_words(stopped['unheld'])} {RESUME}"


def held_words(unheld: dict[str, Any] | None) -> str:
    if unheld is None:
        return "Stopped."
    if unheld["forMs"] is None:
        return "Stopped, but the board may not have heard it. Switch the robot off if it moves."
    for_s = math.ceil(unheld["forMs"] / 100) / 10
    if unheld["servos"] is None:
        return f"Stopped, but a frame in progress cannot be held: servos may move for up to {for_s} s."
    named = ", ".join(map(str, unheld["servos"]))
    who, it = ("servo", "it") if len(unheld["servos"]) == 1 else ("servos", "they")
    return f"Stopped, but {who} {named} cannot be held: {it} may move for up to {for_s} s."
