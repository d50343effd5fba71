"""Sends notices to one receiver, from a thread of its own: a receiver that hangs delays neither the robot nor
the other receivers. Of each event only the newest waits, so the queue never grows.

Knows HTTP as a client; no robot. Keeps nothing of an answer but its status.
"""

import logging
import threading
from collections.abc import Sequence
from http.client import HTTPException
from typing import Any, Literal

from servodeck import metrics
from servodeck.notify.conditions import Event
from servodeck.notify.receivers import Notice, Receiver, post_of
from servodeck.value import value

TIMEOUT_S = 5.0
PAUSES_S = (1.0, 5.0, 25.0)
"""Before the second attempt, the third and the last."""
# Of the refusals, these are for now; others would come again.
PASSING = (408, 425, 429)
log = logging.getLogger("servodeck.notify")
counting = threading.Lock()


@value
class Outcome:
    """`detail` says why the latest notice was dropped."""

    status: Literal["unused", "sent", "dropped"]
    detail: str | None = None


class FailedError(Exception):
    def __init__(self, detail: str, *, is_passing: bool) -> None:
        super().__init__(detail)
        self.is_passing = is_passing


class Sender:
    def __init__(
        self, receiver: Receiver, pauses_s: Sequence[float] = PAUSES_S, timeout_s: float = TIMEOUT_S
    ) -> None:
        self.receiver = receiver
        self.outcome = Outcome("unused")
        self._pauses_s = pauses_s
        self._timeout_s = timeout_s
        self._waiting: dict[Event, Notice] = {}
        self._changed = threading.Condition()
        self._has_ended = False
        self._thread: threading.Thread | None = None

    def put(self, notice: Notice) -> None:
        """Returns at once."""
        with self._changed:
            self._waiting[notice.event] = notice
            self._changed.notify()
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="notify", daemon=True)
                self._thread.start()

    def end(self) -> None:
        """What waits is not sent."""
        with self._changed:
            self._has_ended = True
            self._changed.notify()

    def deliver(self, notice: Notice) -> Outcome:
        """Blocks until it is sent or dropped; a newer one of the same event takes its place."""
        for pause_s in (*self._pauses_s, None):
            try:
                post(self.receiver, notice, self._timeout_s)
            except FailedError as error:
                if pause_s is None or not error.is_passing:
                    return Outcome("dropped", str(error))
                with self._changed:
                    self._changed.wait_for(lambda: self._is_replaced(notice), pause_s)
                    if self._is_replaced(notice):
                        return Outcome("dropped", str(error))
            else:
                return Outcome("sent")
        raise AssertionError("the last attempt returns")

    def _is_replaced(self, notice: Notice) -> bool:
        return self._has_ended or notice.event in self._waiting

    def _run(self) -> None:
        while (notice := self._next()) is not None:
            self.outcome = outcome = self.deliver(notice)
            with counting:
                metrics.notified[outcome.status] += 1
            facts = {"event": notice.event, "receiver": self.receiver.host, "detail": outcome.detail}
            if outcome.status == "sent":
                log.info("notification sent", extra={"facts": facts})
            else:
                log.warning("notification dropped", extra={"facts": facts})

    def _next(self) -> Notice | None:
        """The one that waits longest; None at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._has_ended)
            if self._has_ended:
                return None
            return self._waiting.pop(next(iter(self._waiting)))


def post(receiver: Receiver, notice: Notice, timeout_s: float) -> None:
    """Blocks. Raises FailedError. Follows no redirection: the secrets in a request are for that host."""
    # They take as long to load as all routes.
    from urllib.error import HTTPError
    from urllib.request import HTTPRedirectHandler, Request

    from servodeck.fetching import Fetch

    class Nowhere(HTTPRedirectHandler):
        def redirect_request(self, *_: Any) -> None:
            return None

    made = post_of(receiver, notice)
    request = Request(made.url, made.body, made.headers, method="POST")
    try:
        Fetch(timeout_s).open(request, Nowhere).close()
    except HTTPError as error:
        error.close()
        is_passing = error.code >= 500 or error.code in PASSING
        raise FailedError(f"It answers with status {error.code}.", is_passing=is_passing) from error
    except (OSError, HTTPException, ValueError) as error:
        raise FailedError(f"It does not answer: {reason_in(error)}.", is_passing=True) from error


def reason_in(error: Exception) -> str:
    """The system's words, which name no address."""
    cause = getattr(error, "reason", error)
    if isinstance(cause, TimeoutError):
        return "timed out"
    return str(getattr(cause, "strerror", None) or type(cause).__name__)
