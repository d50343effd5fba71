"""Whether motion is refused, why, and by whose hand. Knows no board; who may resume is for others to say."""

import logging
from collections.abc import Callable
from dataclasses import dataclass

from servodeck.told import LatchedBy

log = logging.getLogger("servodeck.robot")


@dataclass(frozen=True, slots=True)
class Cause:
    """`name` is for people: who pressed STOP, or whose page did it for the battery."""

    by: LatchedBy
    name: str | None = None


class Latch:
    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.cause: Cause | None = None

    @property
    def by(self) -> LatchedBy | None:
        return self.cause.by if self.cause else None

    @property
    def name(self) -> str | None:
        return self.cause.name if self.cause else None

    def close(self, cause: Cause) -> None:
        """Who latched first is told."""
        if self.cause is None:
            self.cause = cause
            log.info("stopped")
            self._changed()

    def open(self) -> bool:
        """Whether it was closed."""
        if self.cause is None:
            return False
        self.cause = None
        log.info("resumed")
        self._changed()
        return True
