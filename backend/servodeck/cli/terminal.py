"""Terminal output while the gateway runs: the addresses, the link for the first owner, and log lines, as text
or JSON, of this program and of its libraries.

The writer of a log line never waits: a terminal that is not read costs lines, not time, because STOP runs on
the same loop. Lines that any client on the network can cause are limited.

"""

import json
import logging
import os
import queue
import threading
import time
from collections.abc import Callable
from datetime import UTC, datetime

from servodeck.access.addresses import Access, drawn_for_terminal, pair_link
from servodeck.access.devices import is_owners
from servodeck.access.entrance import Entrance
from servodeck.access.guard import LOGGER as REFUSALS
from servodeck.callers import Rate
from servodeck.cli.options import Form, Level

STDERR = 2
LINES_WAITING = 1000
LAST_LINES_S = 0.2
# Of the same sentence, and at once: a megabyte a day at most.
SPARSE_RATE = (0.1, 5)
SPARSE_LOGGERS = frozenset({REFUSALS, "uvicorn.error"})
MAX_SENTENCES = 100


class PatientHandler(logging.Handler):
    """Hands each line to a thread that may have to wait; drops what comes while too many wait."""

    def __init__(self, descriptor: int) -> None:
        super().__init__()
        self._lines: queue.Queue[bytes | None] = queue.Queue(LINES_WAITING)
        # Past Python's own buffer: its lock, held by a thread that waits, would keep the process from ending.
        self._writer = threading.Thread(
            target=write_all, args=(self._lines.get, descriptor), name="log", daemon=True
        )
        self._writer.start()

    def emit(self, record: logging.LogRecord) -> None:
        self._put(f"{self.format(record)}\n".encode(errors="replace"))

    def close(self) -> None:
        """Waits a moment for the last lines."""
        self._put(None)
        self._writer.join(LAST_LINES_S)
        super().close()

    def _put(self, line: bytes | None) -> None:
        try:
            self._lines.put_nowait(line)
        except queue.Full:
            return


class SparseFilter(logging.Filter):
    """Lets few of the same sentence pass, of the loggers whose lines any client can cause; each that passes
    says how many did not.
    """

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._now = now
        self._rates: dict[str, Rate] = {}
        self._left_out: dict[str, int] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        if record.name not in SPARSE_LOGGERS:
            return True
        sentence = str(record.msg)
        if len(self._rates) >= MAX_SENTENCES:
            self._rates.clear()
            self._left_out.clear()
        rate = self._rates.setdefault(sentence, Rate(*SPARSE_RATE, self._now))
        if not rate.take():
            self._left_out[sentence] = self._left_out.get(sentence, 0) + 1
            return False
        record.facts = {**facts_of(record), "leftOut": self._left_out.pop(sentence, None)}
        return True


def write_all(take: Callable[[], bytes | None], descriptor: int) -> None:
    while line := take():
        try:
            while line:
                line = line[os.write(descriptor, line) :]
        except OSError:
            return  # there is no reader any more


def set_up_logs(level: Level, form: Form, descriptor: int = STDERR) -> logging.Handler:
    """For the whole process. The handler, to be closed at the end."""
    handler = PatientHandler(descriptor)
    handler.setFormatter(FORMATTERS[form]())
    handler.addFilter(SparseFilter())
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
    return handler


def facts_of(record: logging.LogRecord) -> dict[str, object]:
    """The values of `extra={"facts": …}`, without those that are None."""
    facts: dict[str, object] = getattr(record, "facts", {})
    return {name: value for name, value in facts.items() if value is not None}


class TextFormatter(logging.Formatter):
    def __init__(self) -> None:
        super().__init__("{asctime} {levelname:7} {message}", style="{")

    def formatMessage(self, record: logging.LogRecord) -> str:  # noqa: N802 (the library's name)
        facts = "".join(f"  {name}={json.dumps(value)}" for name, value in facts_of(record).items())
        return super().formatMessage(record) + facts


class JsonFormatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        line = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "event": record.getMessage(),
            **facts_of(record),
        }
        if record.exc_info:
            line["exception"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False)


FORMATTERS: dict[Form, Callable[[], logging.Formatter]] = {"text": TextFormatter, "json": JsonFormatter}


OVERHEARD = (
    "Others on this network can read plain http and could take the place of a paired device. On a network\n"
    "that is not yours use Tailscale or an SSH tunnel, or put Caddy with https in front of it\n"
    "and start with --public-url."
)


def greeting(entrance: Entrance, urls: list[str], *, invites: bool, only_here: str = "") -> str:
    """`urls` are the addresses for others, the best first; `invites` one more owner where there is one.

    `only_here` is what to listen on instead, where no other computer reaches it.
    """
    lines = [reached_at(urls, only_here)]
    if invites or needs_owner(entrance):
        lines += invitation(entrance, urls)
    if not entrance.access.is_secure:
        lines.append(OVERHEARD)
    return "\n".join(lines)


def reached_at(urls: list[str], only_here: str) -> str:
    if only_here:
        return f"Only this computer can reach it. For other devices use --listen {only_here}."
    return f"Other devices reach it at {' or '.join(urls)}"


def needs_owner(entrance: Entrance) -> bool:
    return not any(is_owners(one) for one in entrance.devices.all)


def invitation(entrance: Entrance, urls: list[str]) -> list[str]:
    invite = entrance.pairing.invite("owner", "")
    code = invite.code or ""
    begin = f"Within two minutes, type {code[:4]} {code[4:]} there, or open"
    link = pair_link(urls[0], invite.secret)
    return ["To pair as its owner:", f"{begin} {link}", drawn_for_terminal(link)]


def urls_for_others(access: Access, addresses: list[str], own_url: str) -> list[str]:
    if access.mode == "proxy":
        return [access.url_of(name) for name in access.names]
    return [access.url_of(address) for address in addresses] or [own_url]
