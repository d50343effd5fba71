"""The family that the board at each port is taken for when the port is opened: what was named for that port,
by the program's start or by a person, else what is remembered for its place.

Knows ports by name and place; no board and no client.
"""

from servodeck.files import Remembered
from servodeck.protocol.families import FAMILIES, UNKNOWN, Family


class PortFamilies:
    def __init__(
        self, remembered: Remembered, started_as: Family | None, simulated_device: str | None = None
    ) -> None:
        """`started_as`: the family that the program's start names; None where it names none. It is that of
        the port that is used first. `simulated_device`: the port of a simulated board.
        """
        self._remembered = remembered
        self._simulated_device = simulated_device
        self._simulated_as = started_as if simulated_device else None
        self._next = started_as
        self._named: dict[str, Family] = {}

    def is_simulated(self, device: str | None) -> bool:
        return device is not None and device == self._simulated_device

    def is_vouched(self, device: str | None, family: Family) -> bool:
        """Whether the starter of a simulated board names that family: such a board is not asked."""
        return self.is_simulated(device) and family is self._simulated_as

    def use(self, device: str, family: Family | None) -> None:
        """That port is opened from now on; a person has named its family, or None."""
        named, self._next = family or self._next, None
        if named:
            self._named[device] = named

    def at(self, device: str, place: str) -> Family:
        """`UNKNOWN` where nobody has named the board there."""
        if named := self._named.get(device):
            return named
        return FAMILIES.get(self._remembered.board_at(place) or "", UNKNOWN)

    def chosen(self, family: Family, device: str | None, place: str) -> None:
        """A person has named the board at that port; without a port, at the next one. A simulated board is
        what its starter names at the next start, so that is not stored.
        """
        if device is None:
            self._next = family
            return
        self._named[device] = family
        if not self.is_simulated(device):
            self._remembered.remember_board(place, None if family is UNKNOWN else family.id)
            self._remembered.save_soon()
