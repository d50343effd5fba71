"""The poses that a page has handed to scripts: those of one robot, as its board counts, kept on disk.

Knows one small file; no board and no route. May be called from any thread; blocks.
"""

from pathlib import Path
from typing import Annotated

from pydantic import Field, ValidationError

from servodeck.errors import NotFoundError, OutOfRangeError, StorageError
from servodeck.library_messages import Name, NamedPose
from servodeck.messages import Message
from servodeck.small_file import write_whole

FILE = "poses.json"


class Poses(Message):
    """Of that robot, and nothing of those before."""

    robot: Name
    poses: Annotated[list[NamedPose], Field(max_length=1000)]


NONE = Poses(robot="", poses=[])


class PoseShelf:
    def __init__(self, folder: Path) -> None:
        self._file = folder / FILE

    def read(self) -> Poses:
        try:
            return Poses.model_validate_json(self._file.read_text("utf-8"))
        except (OSError, ValidationError):  # nobody has handed any over, or not this way
            return NONE

    def write(self, poses: Poses) -> None:
        """Raises a StorageError."""
        try:
            write_whole(self._file, poses.model_dump_json())
        except OSError as error:
            raise StorageError(f"The poses are not kept: {error.strerror}.") from error

    def find(self, wanted: str) -> NamedPose:
        """By its number or its name. Raises NotFoundError, or OutOfRangeError where a name is not enough."""
        found = [pose for pose in self.read().poses if wanted in (str(pose.id), pose.name)]
        exact = [pose for pose in found if str(pose.id) == wanted] or found
        if not exact:
            raise NotFoundError(f"No pose is called {wanted}. GET /api/poses lists them.")
        if len(exact) > 1:
            numbers = ", ".join(str(pose.id) for pose in exact)
            raise OutOfRangeError(f"Several poses are called {wanted}: take one of the numbers {numbers}.")
        return exact[0]
