"""Where the data is that both languages are tested with: shared/protocol."""

import json
from pathlib import Path
from typing import Any, Final

SHARED: Final = Path(__file__).parents[2] / "shared" / "protocol"


def load_vectors(name: str) -> Any:
    return json.loads((SHARED / "vectors" / f"{name}.json").read_text("utf-8"))


def load_scenarios() -> list[dict[str, Any]]:
    """Each with the `part` that it is about."""
    return [
        {**scenario, "part": file.stem}
        for file in sorted((SHARED / "scenarios").glob("*.json"))
        for scenario in json.loads(file.read_text("utf-8"))
    ]
