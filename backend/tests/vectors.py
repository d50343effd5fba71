"""Where the data is that both languages are tested with: shared/protocol."""

import json
from pathlib import Path
from typing import Any, Final

VECTORS: Final = Path(__file__).parents[2] / "shared" / "protocol" / "vectors"


def load_vectors(name: str) -> Any:
    return json.loads((VECTORS / f"{name}.json").read_text("utf-8"))
