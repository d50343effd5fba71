"""What a console has heard of each gateway, and whether it is still there. A gateway is there while its last
state is fresh: `online` is retained, and outlives its gateway and its broker.

Knows reports and time; no request and no broker.
"""

import threading
from collections.abc import Callable
from math import inf
from typing import Literal

from servodeck.fleet.messages import About, Live, Online, State
from servodeck.value import value

# A state this old shows no living gateway any more, and one that the broker had retained never does.
FRESH_S = 3.0

Presence = Literal["present", "silent", "cloned"]


@value
class Robot:
    """As it was heard last. `silent`: without a fresh state; `about` and `state` may be what was retained.
    `live`: of one that is watched. `stops`: how often it was heard to have been stopped.
    """

    name: str
    presence: Presence
    about: About | None
    state: State | None
    live: Live | None
    stops: int = 0


class Seen:
    """One gateway. `nonce`: its newest. `instances`: when each was heard last; of a clone there are two."""

    def __init__(self) -> None:
        self.about: About | None = None
        self.state: State | None = None
        self.live: Live | None = None
        self.nonce: str | None = None
        self.stops = 0
        self.heard_s = -inf
        self.instances: dict[str, float] = {}

    def presence(self, now_s: float) -> Presence:
        self.instances = {one: at_s for one, at_s in self.instances.items() if now_s - at_s <= FRESH_S}
        if now_s - self.heard_s > FRESH_S:
            return "silent"
        is_cloned = len(self.instances) > 1 or (self.state is not None and self.state.is_cloned)
        return "cloned" if is_cloned else "present"


class Heard:
    """Of all gateways; from any thread."""

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._lock = threading.Lock()
        self._seen: dict[str, Seen] = {}

    def robots(self) -> list[Robot]:
        """By name."""
        with self._lock:
            return [self._robot(name, seen) for name, seen in sorted(self._seen.items())]

    def robot(self, name: str) -> Robot | None:
        with self._lock:
            seen = self._seen.get(name)
            return self._robot(name, seen) if seen else None

    def nonce_of(self, name: str) -> str | None:
        with self._lock:
            seen = self._seen.get(name)
            return seen.nonce if seen else None

    def nonce(self, name: str, nonce: str) -> None:
        with self._lock:
            self._of(name).nonce = nonce

    def about(self, name: str, about: About) -> None:
        with self._lock:
            self._of(name).about = about

    def removed(self, name: str) -> None:
        """The broker keeps nothing of it any more."""
        with self._lock:
            seen = self._seen.get(name)
            if seen and seen.presence(self._now()) == "silent":
                del self._seen[name]

    def live(self, name: str, live: Live) -> None:
        with self._lock:
            seen = self._of(name)
            seen.live, seen.nonce = live, live.nonce

    def state(self, name: str, state: State, heard_s: float | None) -> None:
        """`heard_s` is None for one that the broker had retained."""
        with self._lock:
            seen = self._of(name)
            if state.latch and not (seen.state and seen.state.latch):
                seen.stops += 1
            seen.state = state
            if heard_s is not None:
                seen.nonce, seen.heard_s = state.nonce, heard_s
                seen.instances[state.instance] = heard_s

    def online(self, name: str, online: Online) -> None:
        """After the last will, or the farewell, of an instance it is not waited for."""
        if online.is_online:
            return
        with self._lock:
            seen = self._of(name)
            seen.instances.pop(online.instance, None)
            if seen.state and seen.state.instance == online.instance:
                seen.heard_s = -inf

    def _of(self, name: str) -> Seen:
        return self._seen.setdefault(name, Seen())

    def _robot(self, name: str, seen: Seen) -> Robot:
        return Robot(name, seen.presence(self._now()), seen.about, seen.state, seen.live, seen.stops)
