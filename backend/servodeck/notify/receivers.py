"""The receivers of notifications, from addresses as people write them, and the request that each takes: JSON
to a webhook, or ntfy's own. Knows HTTP as values; sends nothing. No part of an address but its host is for
logs: paths, topics, names and passwords may be secrets.
"""

import base64
import json
from collections.abc import Sequence
from dataclasses import field
from pathlib import Path
from typing import Any, Literal
from urllib.parse import unquote, urlsplit, urlunsplit

from servodeck.notify.conditions import Event
from servodeck.value import value

# `ntfy` is over TLS, as in the links of ntfy itself.
SCHEMES: dict[str, tuple[Literal["webhook", "ntfy"], str]] = {
    "https": ("webhook", "https"),
    "http": ("webhook", "http"),
    "ntfy": ("ntfy", "https"),
    "ntfy+http": ("ntfy", "http"),
}
TITLES: dict[Event, str] = {
    "batteryLow": "Battery low",
    "stopped": "Stopped",
    "linkLost": "Link lost",
    "linkBack": "Link is back",
    "test": "Test",
}
# Of ntfy: 3 is usual, 4 high. Tags with an emoji's name are shown as that emoji.
PRIORITIES: dict[Event, int] = {"batteryLow": 4, "stopped": 4, "linkLost": 4}
USUAL_PRIORITY = 3
TAGS: dict[Event, str] = {
    "batteryLow": "battery",
    "stopped": "octagonal_sign",
    "linkLost": "electric_plug",
    "linkBack": "white_check_mark",
    "test": "wave",
}


@value
class Notice:
    """`id` stays the same when it is sent again. `at`: ISO 8601, UTC. `page`: an address for people, or
    empty.
    """

    id: str
    event: Event
    text: str
    robot: str
    board: str
    at: str
    page: str = ""


@value
class Receiver:
    """`url` has neither name nor password; `authorization` is made of them. `topic`: of ntfy."""

    kind: Literal["webhook", "ntfy"]
    host: str
    url: str
    authorization: str | None = None
    topic: str = ""


@value
class Post:
    url: str
    body: bytes
    headers: dict[str, str] = field(default_factory=dict)


def parse_receiver(text: str) -> Receiver:
    """Raises ValueError with the reason, which repeats nothing of the address."""
    parts = urlsplit(text.strip())
    if parts.scheme not in SCHEMES or not parts.hostname:
        raise ValueError(f"an address begins with one of {', '.join(f'{one}://' for one in SCHEMES)}")
    kind, scheme = SCHEMES[parts.scheme]
    host = parts.netloc.rpartition("@")[2]
    authorization = authorization_of(parts.username, parts.password)
    if kind == "webhook":
        url = urlunsplit(parts._replace(netloc=host, fragment=""))
        return Receiver(kind, host, url, authorization)
    base, _, topic = parts.path.rstrip("/").rpartition("/")
    if not topic or parts.query:
        raise ValueError("ntfy takes HOST/TOPIC")
    return Receiver(kind, host, f"{scheme}://{host}{base}/", authorization, unquote(topic))


def authorization_of(name: str | None, password: str | None) -> str | None:
    """A name alone is an access token."""
    if not name:
        return None
    if password is None:
        return f"Bearer {unquote(name)}"
    pair = f"{unquote(name)}:{unquote(password)}"
    return "Basic " + base64.b64encode(pair.encode()).decode()


def receivers_from(texts: Sequence[str], file: Path | None) -> list[Receiver]:
    """Of the file, each line that is neither empty nor a comment. Raises OSError, or ValueError."""
    lines = file.read_text("utf-8").splitlines() if file else []
    written = [line for line in map(str.strip, lines) if line and not line.startswith("#")]
    return [parse_receiver(text) for text in (*texts, *written)]


def post_of(receiver: Receiver, notice: Notice) -> Post:
    headers = {
        "Content-Type": "application/json",
        "User-Agent": "Servodeck",
        "Idempotency-Key": notice.id,
    }
    if receiver.authorization:
        headers["Authorization"] = receiver.authorization
    body = webhook_body(notice) if receiver.kind == "webhook" else ntfy_body(notice, receiver.topic)
    return Post(receiver.url, json.dumps(body).encode(), headers)


def webhook_body(notice: Notice) -> dict[str, Any]:
    return {
        "id": notice.id,
        "event": notice.event,
        "text": notice.text,
        "robot": notice.robot,
        "board": notice.board,
        "at": notice.at,
        "page": notice.page,
    }


def ntfy_body(notice: Notice, topic: str) -> dict[str, Any]:
    """As JSON: headers could not carry every robot's name."""
    title = TITLES[notice.event]
    return {
        "topic": topic,
        "title": f"{notice.robot}: {title}" if notice.robot else title,
        "message": notice.text,
        "priority": PRIORITIES.get(notice.event, USUAL_PRIORITY),
        "tags": [TAGS[notice.event]],
        **({"click": notice.page} if notice.page else {}),
    }
