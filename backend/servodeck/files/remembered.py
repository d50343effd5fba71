"""What the gateway was told and goes by after its next start: which port it opens, of which family the
board at each place is, and which robot stands on which board.

Knows one small file and names; no port and no library.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from servodeck.files.small_file import FileBehind
from servodeck.schema import Message

FILE = "remembered.json"


class Memory(Message):
    port: Annotated[str, Field(max_length=256)] | None = None
    boards: dict[str, str] = Field(default_factory=dict)
    robots: dict[str, str] = Field(default_factory=dict)


class Remembered:
    def __init__(self, folder: Path | None = None) -> None:
        """Without a folder it is forgotten with the gateway. Whoever says something has it kept."""
        file = folder / FILE if folder else None
        self._memory = read(file) if file else Memory()
        behind = FileBehind(file, self._text)
        self.kept = behind.kept
        self.keep_soon = behind.keep_soon

    @property
    def port(self) -> str | None:
        """The one that somebody chose, by a name that lasts where the system keeps one."""
        return self._memory.port

    def remember_port(self, device: str | None) -> None:
        self._memory = self._memory.model_copy(update={"port": device})

    def board_at(self, place: str) -> str | None:
        """The family that somebody said."""
        return self._memory.boards.get(place)

    def remember_board(self, place: str, family: str | None) -> None:
        self._memory = self._memory.model_copy(
            update={"boards": with_entry(self._memory.boards, place, family)}
        )

    def robot_on(self, board: str) -> str | None:
        """The document in the library."""
        return self._memory.robots.get(board)

    def remember_robot(self, board: str, document: str | None) -> None:
        self._memory = self._memory.model_copy(
            update={"robots": with_entry(self._memory.robots, board, document)}
        )

    def _text(self) -> str:
        return self._memory.model_dump_json()


def with_entry(entries: Mapping[str, str], key: str, value: str | None) -> dict[str, str]:
    """None takes it out."""
    others = {other: there for other, there in entries.items() if other != key}
    return others if value is None else others | {key: value}


def read(file: Path) -> Memory:
    """What cannot be read was not written here."""
    try:
        return Memory.model_validate_json(file.read_text("utf-8"))
    except (OSError, ValueError, ValidationError):
        return Memory()
