"""A server that never ends the head of its answer."""

import contextlib
import socket
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field

WAYS = {
    "more to come for ever": (b"", b"HTTP/1.1 100 Continue\r\n\r\n"),
    "a header that drips": (b"HTTP/1.1 200 OK\r\nX: ", b"x"),
    "a first line that drips": (b"", b"H"),
    "nothing": (b"", b""),
}
DRIP_S = 0.01


@dataclass
class Stubborn:
    """`begun` and `ended` count connections."""

    address: str
    begun: threading.Semaphore = field(default_factory=lambda: threading.Semaphore(0))
    ended: threading.Semaphore = field(default_factory=lambda: threading.Semaphore(0))


@contextlib.contextmanager
def stubborn(way: str) -> Iterator[Stubborn]:
    begin, again = WAYS[way]
    has_ended = threading.Event()
    listener = socket.create_server(("127.0.0.1", 0))
    made = Stubborn(f"http://127.0.0.1:{listener.getsockname()[1]}/")

    def serve(client: socket.socket) -> None:
        with client, contextlib.suppress(OSError):
            client.settimeout(DRIP_S)
            made.begun.release()
            client.sendall(begin)
            is_there = True
            while is_there and not has_ended.is_set():
                client.sendall(again)
                with contextlib.suppress(TimeoutError):
                    is_there = client.recv(4096) != b""
        made.ended.release()

    def accept() -> None:
        with contextlib.suppress(OSError):
            while True:
                threading.Thread(target=serve, args=(listener.accept()[0],), daemon=True).start()

    accepting = threading.Thread(target=accept, daemon=True)
    accepting.start()
    try:
        yield made
    finally:
        has_ended.set()
        listener.shutdown(socket.SHUT_RDWR)
        accepting.join()
        listener.close()
