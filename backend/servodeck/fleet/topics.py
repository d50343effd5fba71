"""The names of topics, built and parsed (docs/fleet-protocol.md). The broker's access list lets each user
write only below the roles that it gives, so role and user of a topic are the broker's word.

Knows text; no payload and no broker.
"""

import re
from typing import Literal, get_args

from servodeck.callers import Role
from servodeck.value import value

ROOT = "sd/1"
ALL, REPLY = "all", "reply"
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._@-]{0,63}")
"""Of a site, a gateway, a user and a session."""

Kind = Literal["about", "state", "online", "live"]
Verb = Literal[
    "stop",
    "report",
    "ask",
    "beat",
    "move",
    "run",
    "press",
    "resume",
    "download",
    "erase",
    "sync",
    "prepare",
    "commit",
    "cancel",
]
VERBS: frozenset[Verb] = frozenset(get_args(Verb))
VERBS_FOR_ALL: frozenset[Verb] = frozenset({"stop", "report", "beat", "commit", "cancel"})


@value
class Published:
    """What a gateway says of itself."""

    gateway: str
    kind: Kind


@value
class Command:
    """A request to one gateway, or to `all`. Role and verb are as the topic has them, known or not."""

    gateway: str
    role: str
    user: str
    verb: str


@value
class Hold:
    """Retained: gateways that connect from now on stop, too."""

    role: str
    user: str


@value
class Reply:
    user: str
    session: str


Topic = Published | Command | Hold | Reply


def is_name(text: str) -> bool:
    """Whether a site, user or session may be called that."""
    return NAME.fullmatch(text) is not None


def is_gateway_name(text: str) -> bool:
    return is_name(text) and text not in (ALL, REPLY)


class Site:
    """The topics of one site."""

    def __init__(self, name: str) -> None:
        """Raises ValueError for what cannot be part of a topic."""
        if not is_name(name):
            raise ValueError(f"{name} is no name of a site: letters, digits and . _ @ - are allowed")
        self.name = name
        self._prefix = f"{ROOT}/{name}/"

    def published(self, gateway: str, kind: Kind) -> str:
        """`gateway` may be `+`: of all of them."""
        return f"{self._prefix}{gateway}/{kind}"

    def command(self, gateway: str, role: Role, user: str, verb: Verb) -> str:
        return f"{self._prefix}{gateway}/do/{role}/{user}/{verb}"

    def hold(self, role: Role, user: str) -> str:
        return f"{self._prefix}{ALL}/hold/{role}/{user}"

    def reply(self, user: str, session: str) -> str:
        return f"{self._prefix}{REPLY}/{user}/{session}"

    def commands_to(self, gateway: str) -> str:
        """The filter of all requests to that gateway, or to `all`."""
        return f"{self._prefix}{gateway}/do/+/+/+"

    def holds(self) -> str:
        return f"{self._prefix}{ALL}/hold/+/+"

    def parse(self, topic: str) -> Topic | None:
        """None for a topic of another site, or of none of these forms."""
        if not topic.startswith(self._prefix):
            return None
        match topic.removeprefix(self._prefix).split("/"):
            case [gateway, ("about" | "state" | "online" | "live") as kind] if is_gateway_name(gateway):
                return Published(gateway, kind)
            case ["all", "hold", role, user]:
                return Hold(role, user)
            case [gateway, "do", role, user, verb] if gateway != REPLY:
                return Command(gateway, role, user, verb)
            case ["reply", user, session]:
                return Reply(user, session)
        return None
