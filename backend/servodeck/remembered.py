"""What the gateway was told and goes by after its next start: which port it opens, and which robot stands on
which board.

Knows one small file and names; no port and no library. Which family a board is of is not among it: another
one may be on that cable by then, and a page asks it.
"""

from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from servodeck.messages import Message
from servodeck.small_file import FileBehind

FILE = "remembered.json"


class Memory(Message):
    port: Annotated[str, Field(max_length=256)] | None = None
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

    def robot_on(self, board: str) -> str | None:
        """The document in the library."""
        return self._memory.robots.get(board)

    def remember_robot(self, board: str, document: str | None) -> None:
        robots = {other: robot for other, robot in self._memory.robots.items() if other != board}
        if document is not None:
            robots[board] = document
        self._memory = self._memory.model_copy(update={"robots": robots})

    def _text(self) -> str:
        return self._memory.model_dump_json()


def read(file: Path) -> Memory:
    """What cannot be read was not written here."""
    try:
        return Memory.model_validate_json(file.read_text("utf-8"))
    except (OSError, ValueError, ValidationError):
        return Memory()
