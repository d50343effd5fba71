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
        self.is_wanted = is_wanted

    def port_opened(self, board: Board) -> None:
        known = self._remembered.board_at(board.link.place)
        if self.is_wanted and board.identification.claim is UNKNOWN and known in FAMILIES:
            board.recall(known)

    def said(self, board: Board) -> None:
        """Somebody has. What the board's answers contradict is not kept; a simulated one is what its starter
        says, each time anew.
        """
        family, status = board.identification.claim, board.identification.state.status
        is_contradicted = status == "refused" and family is not UNKNOWN
        if board.port.status in ("open", "lost") and not board.port.simulated and not is_contradicted:
            self._remembered.remember_board(board.link.place, None if family is UNKNOWN else family.id)
            self._remembered.keep_soon()
