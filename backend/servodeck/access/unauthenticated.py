"""The connections on which nobody has proved yet who they are: few, so that they never take the descriptors
that STOP needs. Where there are too many, the one that was used longest ago ends.

Knows addresses and order; no byte and no request.
"""

from typing import Protocol

# Beside 216 seats and what files and the port take, far below the 1,024 descriptors that the process has.
MOST = 256
# A class behind one router loads the page at once: 6 connections of each of 20 browsers.
MOST_OF_ONE = 128


class Connection(Protocol):
    def abort(self) -> None: ...


class Unauthenticated:
    def __init__(self) -> None:
        # The one that was used longest ago comes first.
        self._sources: dict[Connection, str] = {}

    def add(self, connection: Connection, source: str) -> None:
        """One that was just opened from the address `source`."""
        self._sources[connection] = source
        of_source = [each for each, address in self._sources.items() if address == source]
        if len(of_source) > MOST_OF_ONE:
            self._end(of_source[0])
        elif len(self._sources) > MOST:
            self._end(next(iter(self._sources)))

    def use(self, connection: Connection) -> None:
        """Something was asked or answered on it."""
        if connection in self._sources:
            self._sources[connection] = self._sources.pop(connection)

    def remove(self, connection: Connection) -> None:
        """Somebody has proved who they are, or it was closed."""
        self._sources.pop(connection, None)

    def _end(self, connection: Connection) -> None:
        self.remove(connection)
        connection.abort()
