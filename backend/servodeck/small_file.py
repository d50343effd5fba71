"""Writes a small file whole or not at all, whatever ends the process meanwhile. Knows no content."""

import os
from pathlib import Path


def write_whole(file: Path, text: str) -> None:
    """Raises OSError; what was there before is unharmed then."""
    file.parent.mkdir(parents=True, exist_ok=True)
    fresh = file.with_name(f"{file.name}.new")
    with fresh.open("w", encoding="utf-8") as opened:
        opened.write(text)
        opened.flush()
        os.fsync(opened.fileno())
    fresh.replace(file)
