"""The requests of one console and their answers: numbers each request, puts the newest nonce of its robot
into it, and gives every answer to who waits for it.

Knows topics and messages; not what is asked for, and not who drives. May be called from any thread.
"""

import secrets
import threading
from collections.abc import Callable, Collection
from typing import Any

from servodeck.callers import Role
from servodeck.fleet.broker import Outgoing
from servodeck.fleet.messages import REQUESTS, AnyAnswer, TimelyRequest, encode
from servodeck.fleet.topics import ALL, Site, Verb, is_gateway_name

EXPIRES_S = 1
QOS_0: Collection[Verb] = ("move", "beat", "sync")
# Of a request whose answers nobody waits for.
NOBODY = b""


class Exchange:
    def __init__(
        self,
        publish: Callable[[Outgoing], bool],
        site: Site,
        role: Role,
        user: str,
        reply_to: str,
        nonce_of: Callable[[str], str | None],
    ) -> None:
        self._publish = publish
        self._site = site
        self._role: Role = role
        self._user = user
        self._reply_to = reply_to
        self._nonce_of = nonce_of
        self._waiting: dict[bytes, Callable[[AnyAnswer], None]] = {}
        self._n = 0
        self._lock = threading.Lock()

    def expect(self, take: Callable[[AnyAnswer], None]) -> bytes:
        """The correlation for a request; `take` gets each answer, in the connection's thread, until
        `forget`.
        """
        correlation = secrets.token_bytes(8)
        self._waiting[correlation] = take
        return correlation

    def forget(self, correlation: bytes) -> None:
        self._waiting.pop(correlation, None)

    def answered(self, answer: AnyAnswer, correlation: bytes | None) -> None:
        take = self._waiting.get(correlation or NOBODY)
        if take:
            take(answer)

    def send(self, gateway: str, verb: Verb, fields: dict[str, Any], correlation: bytes) -> bool | None:
        """Whether it has left; None where it needs a nonce, and the robot has said none, or no robot has that
        name. Raises ValidationError.
        """
        if gateway != ALL and not is_gateway_name(gateway):
            return None
        if verb == "stop":  # has no number, and waits for no other request
            return self._leave(gateway, verb, b"", correlation)
        with self._lock:  # so that requests leave in the order of their numbers
            payload = self._payload(gateway, verb, fields)
            return None if payload is None else self._leave(gateway, verb, payload, correlation)

    def _payload(self, gateway: str, verb: Verb, fields: dict[str, Any]) -> bytes | None:
        self._n += 1
        numbered = {"n": self._n, **fields}
        model = REQUESTS[verb]
        if issubclass(model, TimelyRequest) and "nonce" not in numbered:
            nonce = self._nonce_of(gateway)
            if nonce is None:
                return None
            numbered["nonce"] = nonce
        return encode(model(**numbered))

    def _leave(self, gateway: str, verb: Verb, payload: bytes, correlation: bytes) -> bool:
        return self._publish(
            Outgoing(
                self._site.command(gateway, self._role, self._user, verb),
                payload,
                0 if verb in QOS_0 else 1,
                expires_s=None if verb == "stop" else EXPIRES_S,  # a late stop is better than none
                reply_to=self._reply_to,
                correlation=correlation,
            )
        )
