"""Where each system wants a program to keep a user's data. Knows names of folders and touches none."""

import os
import sys
from pathlib import Path


def data_folder() -> Path:
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local") / "Servodeck"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "Servodeck"
    return Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share") / "servodeck"
