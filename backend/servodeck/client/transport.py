"""Carries bytes between a program and a gateway: HTTP by the standard library. direct.py has the other way.

Knows HTTP; no request of ours and no JSON.
"""

import contextlib
import math
import selectors
import socket
import time
from collections.abc import Callable, Mapping
from contextlib import closing
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from typing import Protocol
from urllib.parse import urlsplit

from servodeck.client.errors import UnreachableError
from servodeck.value import value

GATEWAY_PORT = 8300
CONNECTIONS = {"http": HTTPConnection, "https": HTTPSConnection}
Headers = Mapping[str, str]


class NotSentError(UnreachableError):
    """No connection: nothing has reached a gateway."""


@value
class Answer:
    status: int
    headers: Headers
    body: bytes


class Stream(Protocol):
    """Lines of an answer without an end. `close` may be called from another thread and ends `line`."""

    @property
    def status(self) -> int: ...

    def rest(self) -> bytes:
        """The whole body of a refusal."""

    def line(self, timeout_s: float) -> bytes:
        """Empty at the end. Raises UnreachableError, also where no line comes in that time."""

    def close(self) -> None: ...


class Transport(Protocol):
    """Calls come from several threads. Both requests raise UnreachableError."""

    def request(
        self,
        method: str,
        path: str,
        headers: Headers,
        body: bytes | None,
        timeout_s: float,
        look_s: float = ...,
        look: Callable[[], object] = ...,
    ) -> Answer:
        """`look` is called each `look_s` while no answer comes, and raises what ends the waiting."""

    def stream(self, path: str, headers: Headers, timeout_s: float) -> Stream: ...

    def mind_signals(self) -> None: ...

    def close(self) -> None: ...


class HttpTransport:
    def __init__(self, url: str) -> None:
        """Without a port, an http address gets the gateway's usual one. Raises ValueError for no address."""
        parts = urlsplit(url)
        if parts.scheme not in CONNECTIONS or not parts.hostname:
            raise ValueError(f"{url} is no address of a gateway, for example http://127.0.0.1:8300.")
        self._connection = CONNECTIONS[parts.scheme]
        self._host = parts.hostname
        self._port = parts.port or (GATEWAY_PORT if parts.scheme == "http" else None)
        self._path = parts.path.rstrip("/")

    def request(
        self,
        method: str,
        path: str,
        headers: Headers,
        body: bytes | None,
        timeout_s: float,
        look_s: float = math.inf,
        look: Callable[[], object] = lambda: None,
    ) -> Answer:
        until_s = time.monotonic() + timeout_s
        connection = self._connected(min(timeout_s, 2 * look_s))
        with closing(connection):
            try:
                connection.request(method, self._path + path, body, dict(headers))
                while not has_data(connection.sock, min(look_s, until_s - time.monotonic())):
                    if time.monotonic() >= until_s:
                        raise TimeoutError("timed out")
                    look()
                connection.sock.settimeout(max(0.001, until_s - time.monotonic()))
                answer = connection.getresponse()
                return Answer(answer.status, dict(answer.getheaders()), answer.read())
            except (OSError, HTTPException) as error:
                raise UnreachableError(f"The answer of the gateway was lost: {error}.") from error

    def stream(self, path: str, headers: Headers, timeout_s: float) -> "HttpStream":
        connection = self._connected(timeout_s)
        try:
            return HttpStream(connection, self._path + path, headers)
        except (OSError, HTTPException) as error:
            connection.close()
            raise UnreachableError(f"The gateway does not answer: {error}.") from error

    def mind_signals(self) -> None:
        """The gateway stops what moves when no heartbeat comes."""

    def close(self) -> None:
        """Each request has its own connection."""

    def _connected(self, timeout_s: float) -> HTTPConnection:
        connection: HTTPConnection = self._connection(self._host, self._port, timeout=timeout_s)
        try:
            connection.connect()
        except OSError as error:
            connection.close()
            raise NotSentError(f"No gateway answers at {self._host}: {error}.") from error
        return connection


def has_data(source: socket.socket, within_s: float) -> bool:
    """Whether something has come, also the end, in that time."""
    with selectors.DefaultSelector() as selector:
        selector.register(source, selectors.EVENT_READ)
        return bool(selector.select(max(0.0, within_s)))


class HttpStream:
    def __init__(self, connection: HTTPConnection, path: str, headers: Headers) -> None:
        self._connection = connection
        self._socket: socket.socket = connection.sock
        connection.request("GET", path, headers=dict(headers))
        self._answer = connection.getresponse()
        self.status = self._answer.status

    def rest(self) -> bytes:
        return self._answer.read()

    def line(self, timeout_s: float) -> bytes:
        try:
            self._socket.settimeout(timeout_s)
            return self._answer.readline()
        except (OSError, HTTPException, ValueError) as error:  # ValueError: closed meanwhile
            raise UnreachableError(f"The event stream was lost: {error}.") from error

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._connection.close()
