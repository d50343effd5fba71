"""Of which family the board at hand is, after a start at which nobody said so: as somebody said it last.

Knows the board and what is remembered; not who may say what.
"""

from servodeck.board.board import Board
from servodeck.files.remembered import Remembered
from servodeck.protocol.families import FAMILIES, UNKNOWN


class RecalledBoard:
    def __init__(self, remembered: Remembered, *, is_wanted: bool) -> None:
        """Not wanted where an option has said it."""
        self._remembered = remembered
        self._is_wanted = is_wanted

    def port_opened(self, board: Board) -> None:
        known = self._remembered.board_at(board.link.place)
        if self._is_wanted and board.taken_for == UNKNOWN.id and known in FAMILIES:
            board.take_for(known)

    def said(self, board: Board) -> None:
        """Somebody has. A simulated one is what its starter says, each time anew."""
        if board.port.status in ("open", "lost") and not board.port.simulated:
            family = None if board.taken_for == UNKNOWN.id else board.taken_for
            self._remembered.remember_board(board.link.place, family)
            self._remembered.keep_soon()
