"""The connection to a broker: MQTT 5 by paho, in a thread of its own, that comes back by itself. The same for
gateways and consoles.

Knows topics as text, payloads as bytes and credentials; no message of ours.
"""

import contextlib
import logging
import random
import socket
import ssl
import sys
import threading
from collections import deque
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any, Literal, Protocol
from urllib.parse import unquote, urlsplit

import paho.mqtt.client as mqtt
from paho.mqtt.enums import CallbackAPIVersion
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties
from paho.mqtt.reasoncodes import ReasonCode
from paho.mqtt.subscribeoptions import SubscribeOptions

from servodeck.fleet.rules import DOWNLOAD_BYTES, Received
from servodeck.value import value

KEEP_ALIVE_S = 5
# Each wait is a random part of a limit that doubles, so that many do not come back at the same moment.
FIRST_WAIT_S, LONGEST_WAIT_S = 0.25, 5.0
END_S = 0.5
TOPIC_BYTES = 4096
# To a broker that does not read; far more than is said to it in the 10 s in which it is found to be gone.
UNSENT_BYTES = 1024 * 1024
PORTS = {"mqtt": 1883, "mqtts": 8883, "ws": 80, "wss": 443}
log = logging.getLogger("servodeck.fleet")

Qos = Literal[0, 1]


@value
class Broker:
    """Its address, and how to get in. `path`: of a WebSocket; None: MQTT on the socket itself."""

    host: str
    port: int
    path: str | None
    user: str | None
    password: str | None
    encryption: ssl.SSLContext | None

    @property
    def can_be_overheard(self) -> bool:
        return self.encryption is None and self.host not in ("localhost", "127.0.0.1", "::1")

    @property
    def address(self) -> str:
        return f"{self.host}:{self.port}"


def parse_broker(
    url: str,
    password: str | None = None,
    ca: Path | None = None,
    certificate: Path | None = None,
    key: Path | None = None,
) -> Broker:
    """`ca` vouches for the broker; without it, the authorities of this computer do. Raises ValueError that
    says what is wrong with the address, OSError for certificates that cannot be used.
    """
    parts = urlsplit(url)
    if parts.scheme not in PORTS or not parts.hostname:
        raise ValueError("it begins with mqtt://, mqtts://, ws:// or wss:// and a host")
    if parts.password is not None:
        raise ValueError("others can see a password there: give it in a file or variable")
    is_encrypted = parts.scheme in ("mqtts", "wss")
    if not is_encrypted and (ca or certificate or key):
        raise ValueError("certificates need mqtts:// or wss://")
    path = (parts.path or "/mqtt") if parts.scheme in ("ws", "wss") else None
    user = None if parts.username is None else unquote(parts.username)
    port = parts.port or PORTS[parts.scheme]
    encryption = ssl.create_default_context(cafile=ca) if is_encrypted else None
    if encryption and certificate:
        encryption.load_cert_chain(certificate, key)
    return Broker(parts.hostname, port, path, user, password, encryption)


@value
class Outgoing:
    topic: str
    payload: bytes
    qos: Qos = 0
    is_retained: bool = False
    expires_s: int | None = None
    reply_to: str | None = None
    correlation: bytes | None = None


@value
class Interest:
    """`wants_retained`: what is retained comes at each subscription, too. `as_published`: a message that was
    published to be retained is marked as such; otherwise only one that had been retained before.
    """

    qos: Qos
    wants_retained: bool
    as_published: bool


class Events(Protocol):
    """Called in the connection's thread."""

    def connected(self) -> None: ...

    def lost(self) -> None: ...

    def received(self, received: Received) -> None: ...


class Connection:
    def __init__(
        self,
        broker: Broker,
        client_id: str,
        interests: Mapping[str, Interest],
        events: Events,
        now: Callable[[], float],
        will: Outgoing | None = None,
    ) -> None:
        """`interests` by filter."""
        self.broker = broker
        self.is_connected = False
        self.problem: str | None = "It has not been reached yet."
        """Why it is not connected; for people."""
        self.was_denied = False
        """The broker has not let something through that was published with QoS 1."""
        self._interests = dict(interests)
        self._events = events
        self._now = now
        self._failures = 0
        self._is_refused = False
        self._ended = threading.Event()
        self._unsent: deque[tuple[mqtt.MQTTMessageInfo, int]] = deque()
        self._publishing = threading.Lock()
        client = mqtt.Client(
            CallbackAPIVersion.VERSION2,
            client_id,
            protocol=mqtt.MQTTv5,
            transport="tcp" if broker.path is None else "websockets",
        )
        if broker.path is not None:
            client.ws_set_options(broker.path)
        if broker.user is not None:
            client.username_pw_set(broker.user, broker.password)
        if broker.encryption:
            client.tls_set_context(broker.encryption)
        if will:
            client.will_set(will.topic, will.payload, will.qos, will.is_retained)
        client.on_socket_open = send_at_once
        client.on_connect = self._on_connect
        client.on_connect_fail = self._on_connect_fail
        client.on_disconnect = self._on_disconnect
        client.on_message = self._on_message
        client.on_publish = self._on_publish
        self._client = client

    def start(self) -> None:
        if self.broker.can_be_overheard:
            log.warning("others on the network can read all of this, a password too: use mqtts://")
        properties = properties_for(PacketTypes.CONNECT)
        properties.MaximumPacketSize = DOWNLOAD_BYTES + TOPIC_BYTES
        self._plan_next()
        # Nothing waits at the broker for one that is away: the session ends with its connection.
        self._client.connect_async(
            self.broker.host, self.broker.port, KEEP_ALIVE_S, clean_start=True, properties=properties
        )
        self._client.loop_start()

    def publish(self, outgoing: Outgoing) -> bool:
        """From any thread, without waiting. False while there is no connection, or while the broker does not
        read: it is not sent later.
        """
        with self._publishing:
            if not self.is_connected or not self._has_room_for(outgoing):
                return False
            info = self._client.publish(
                outgoing.topic, outgoing.payload, outgoing.qos, outgoing.is_retained, properties_of(outgoing)
            )
            if info.rc != mqtt.MQTT_ERR_SUCCESS:
                return False
            self._unsent.append((info, len(outgoing.payload)))
            return True

    def _has_room_for(self, outgoing: Outgoing) -> bool:
        """A STOP, whose payload is empty, always finds room."""
        unsent = self._unsent
        while unsent and has_been_sent(unsent[0][0]):
            unsent.popleft()
        waiting_bytes = sum(size for _, size in unsent)
        return not outgoing.payload or waiting_bytes < UNSENT_BYTES

    def subscribe(self, topic: str, interest: Interest) -> None:
        """Also behind the next connections, until `unsubscribe`."""
        self._interests[topic] = interest
        if self.is_connected:
            self._client.subscribe([(topic, options_of(interest))])

    def unsubscribe(self, topic: str) -> None:
        self._interests.pop(topic, None)
        if self.is_connected:
            self._client.unsubscribe(topic)

    def end(self, last: Outgoing | None = None) -> bool:
        """`last` is sent before; whether the broker has answered to it within a moment."""
        self._ended.set()
        is_answered = False
        if last and self.is_connected:
            info = self._client.publish(last.topic, last.payload, 1, last.is_retained)
            with contextlib.suppress(RuntimeError):  # the connection has just been lost
                info.wait_for_publish(END_S)
                is_answered = info.is_published()
        self._client.disconnect()
        return is_answered

    # In its thread

    def _on_connect(
        self, client: mqtt.Client, _data: Any, _flags: Any, reason: ReasonCode, _properties: Any
    ) -> None:
        if reason.is_failure:
            self._is_refused = True
            self._failed(f"The broker refuses: {reason}.")
            return
        self._unsent = deque()  # what an earlier connection has not sent is gone
        self._failures, self.problem, self.is_connected = 0, None, True
        self._plan_next()
        if self._interests:
            client.subscribe([(topic, options_of(one)) for topic, one in [*self._interests.items()]])
        log.info("connected", extra={"facts": {"broker": self.broker.address}})
        self._events.connected()

    def _on_connect_fail(self, _client: mqtt.Client, _data: Any) -> None:
        error = sys.exc_info()[1]  # it calls this where it handles that
        self._failed(f"The broker cannot be reached: {error}." if error else "The broker cannot be reached.")

    def _on_disconnect(
        self, _client: mqtt.Client, _data: Any, _flags: Any, reason: ReasonCode, _properties: Any
    ) -> None:
        was_refused, self._is_refused = self._is_refused, False
        if was_refused:  # the reason is known
            return
        was_connected, self.is_connected = self.is_connected, False
        self._failed(f"The connection was {'lost' if was_connected else 'closed by the broker'}: {reason}.")
        if was_connected:
            self._events.lost()

    def _on_publish(
        self, _client: mqtt.Client, _data: Any, _mid: int, reason: ReasonCode, _properties: Any
    ) -> None:
        self.was_denied = self.was_denied or reason.is_failure

    def _on_message(self, _client: mqtt.Client, _data: Any, message: mqtt.MQTTMessage) -> None:
        properties = message.properties
        try:
            self._events.received(
                Received(
                    message.topic,
                    bytes(message.payload),
                    message.retain,
                    self._now(),
                    getattr(properties, "ResponseTopic", None),
                    getattr(properties, "CorrelationData", None),
                )
            )
        except Exception:  # a defect of ours: the thread would end, and no STOP would be heard any more
            log.exception("a message was not understood")

    def _failed(self, problem: str) -> None:
        if problem != self.problem and not self._ended.is_set():
            log.warning("not connected", extra={"facts": {"broker": self.broker.address, "why": problem}})
        self.problem = problem
        self._failures += 1
        self._plan_next()

    def _plan_next(self) -> None:
        limit_s = min(LONGEST_WAIT_S, FIRST_WAIT_S * 2 ** min(self._failures, 10))
        wait_s = random.uniform(0.0, limit_s)
        self._client.reconnect_delay_set(wait_s, wait_s)  # type: ignore[arg-type]  # it takes fractions, too


def has_been_sent(info: mqtt.MQTTMessageInfo) -> bool:
    """Or never will be, by this connection."""
    try:
        return info.is_published()
    except (RuntimeError, ValueError):
        return True


def send_at_once(_client: mqtt.Client, _data: Any, opened: Any) -> None:
    """The system would hold a small packet back until the one before is acknowledged: 40 ms on Linux."""
    with socket.fromfd(opened.fileno(), socket.AF_INET, socket.SOCK_STREAM) as same:
        same.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)


def options_of(interest: Interest) -> SubscribeOptions:
    handling = (
        SubscribeOptions.RETAIN_SEND_ON_SUBSCRIBE
        if interest.wants_retained
        else SubscribeOptions.RETAIN_DO_NOT_SEND
    )
    return SubscribeOptions(interest.qos, retainAsPublished=interest.as_published, retainHandling=handling)


def properties_for(packet: int) -> Properties:
    return Properties(packet)  # type: ignore[no-untyped-call]


def properties_of(outgoing: Outgoing) -> Properties:
    if outgoing.reply_to is None and outgoing.correlation is None:
        return expiring(outgoing.expires_s)
    properties = new_expiring(outgoing.expires_s)
    if outgoing.reply_to is not None:
        properties.ResponseTopic = outgoing.reply_to
    if outgoing.correlation is not None:
        properties.CorrelationData = outgoing.correlation
    return properties


def new_expiring(expires_s: int | None) -> Properties:
    properties = properties_for(PacketTypes.PUBLISH)
    if expires_s is not None:
        properties.MessageExpiryInterval = expires_s
    return properties


# Those of states and most other messages: the library takes longer to make them than to send the message.
expiring = cache(new_expiring)
