"""The name of a gateway that no person has named: made at its first start, and kept as long as it runs on the
same hardware. A copy of its memory card in another computer gets a name of its own.
"""

import contextlib
import hashlib
import secrets
import uuid
from pathlib import Path

from pydantic import ValidationError

from servodeck.files import write_whole
from servodeck.schema import Message

FILE = "fleet.json"
SERIAL_NUMBER = Path("/sys/firmware/devicetree/base/serial-number")
# Of a random number that stands in for the address of a network adapter.
MADE_UP = 1 << 40


class Identity(Message):
    name: str
    hardware: str


def own_name(folder: Path, hardware: str) -> str:
    """A folder that cannot be written is no error: then the name is another one at the next start."""
    file = folder / FILE
    with contextlib.suppress(OSError, ValidationError, ValueError):
        known = Identity.model_validate_json(file.read_text("utf-8"))
        if known.hardware == hardware:
            return known.name
    made = Identity(name=f"robot-{secrets.token_hex(3)}", hardware=hardware)
    with contextlib.suppress(OSError):
        write_whole(file, made.model_dump_json())
    return made.name


def this_hardware() -> str:
    """Empty where nothing tells this computer from others."""
    with contextlib.suppress(OSError):
        return digest(SERIAL_NUMBER.read_bytes())
    node = uuid.getnode()
    return "" if node & MADE_UP else digest(node.to_bytes(6, "big"))


def digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]
