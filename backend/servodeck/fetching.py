"""A request to a server that nobody vouches for, such as a camera or a receiver of notices: the whole head of
its answer must come within a time, and any thread may give the request up.

Knows HTTP as a client, no meaning of an answer. Takes as long to load as all routes.
"""

import contextlib
import socket
import threading
from collections.abc import Iterator
from http.client import HTTPConnection, HTTPResponse, HTTPSConnection
from typing import Any
from urllib.request import BaseHandler, HTTPHandler, HTTPSHandler, Request, build_opener

Handler = BaseHandler | type[BaseHandler]


class Fetch:
    """One request, its redirections and its answer."""

    def __init__(self, limit_s: float, step_s: float | None = None) -> None:
        """`step_s`: for the connection alone, and for each read; otherwise as long as for all."""
        self._limit_s = limit_s
        self._step_s = step_s or limit_s
        self._sockets: list[socket.socket] = []
        self._is_aborted = False

    def open(self, request: Request, *handlers: Handler) -> Any:
        """Blocks until the head is there; the answer, of whose body each read may take as long. Raises
        OSError, HTTPException or ValueError; TimeoutError where it was given up.
        """
        with self._within_limit():
            answer = self._opened(request, handlers)
            if self._is_aborted:  # a head that was cut looks like a whole one
                answer.close()
            return answer

    def read(self, request: Request, most: int, *handlers: Handler) -> bytes:
        """Blocks until head and body are there; at most so many bytes of the body. Raises as `open`."""
        with self._within_limit(), self._opened(request, handlers) as answer:
            body: bytes = answer.read(most)
            return body

    def _opened(self, request: Request, handlers: tuple[Handler, ...]) -> Any:
        return build_opener(Http(self), Https(self), *handlers).open(request, timeout=self._step_s)

    @contextlib.contextmanager
    def _within_limit(self) -> Iterator[None]:
        timer = threading.Timer(self._limit_s, self.abort)
        timer.daemon = True
        timer.start()
        try:
            yield
        except Exception as error:
            if self._is_aborted:
                raise TimeoutError("timed out") from error
            raise
        finally:
            timer.cancel()
        if self._is_aborted:
            raise TimeoutError("timed out")

    def abort(self) -> None:
        """A thread that waits for the head or the body gets no more."""
        self._is_aborted = True
        for opened in self._sockets:
            # Not the method of a socket with TLS, which another thread may be reading.
            with contextlib.suppress(OSError):
                socket.socket.shutdown(opened, socket.SHUT_RDWR)

    def watch(self, opened: socket.socket) -> None:
        self._sockets.append(opened)
        if self._is_aborted:
            raise TimeoutError("timed out")


class Http(HTTPHandler):
    def __init__(self, fetch: Fetch) -> None:
        super().__init__()
        self._fetch = fetch

    def http_open(self, request: Request) -> HTTPResponse:
        fetch = self._fetch

        class Watched(HTTPConnection):
            def connect(self) -> None:
                super().connect()
                fetch.watch(self.sock)

        return self.do_open(Watched, request)


class Https(HTTPSHandler):
    def __init__(self, fetch: Fetch) -> None:
        super().__init__()
        self._fetch = fetch

    def https_open(self, request: Request) -> HTTPResponse:
        fetch = self._fetch

        class Watched(HTTPSConnection):
            def connect(self) -> None:
                super().connect()  # its handshake has a time limit as a whole
                fetch.watch(self.sock)

        return self.do_open(Watched, request)
