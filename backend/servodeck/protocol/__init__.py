"""Bytes and what they mean. Knows no time, no port and no client.

Here: the data that both languages read, beside this file in a wheel, in a checkout in shared/protocol.
"""

import json
import re
from pathlib import Path
from typing import Any, Final

_HERE: Final = Path(__file__).parent
_CHECKOUT: Final = _HERE.parents[2] / "shared" / "protocol"


def load_shared(name: str) -> dict[str, Any]:
    file = _HERE / f"{name}.json"
    text = (file if file.exists() else _CHECKOUT / file.name).read_text("utf-8")
    data: dict[str, Any] = json.loads(text)
    return data


def snake(name: str) -> str:
    """`durationMs` as Python writes it."""
    return re.sub("[A-Z]", lambda capital: f"_{capital[0].lower()}", name)
