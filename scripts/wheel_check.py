"""Builds the wheel and looks whether the page is in it: without the page it would build all the same.

Needs the built page. Knows the packaging only.
"""

import subprocess
import sys
import tempfile
from pathlib import Path
from zipfile import ZipFile

NEEDED = ("servodeck/static/index.html", "servodeck/__main__.py")


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", folder]
        subprocess.run(build, check=True, stdout=subprocess.DEVNULL)
        (wheel,) = Path(folder).glob("*.whl")
        names = set(ZipFile(wheel).namelist())
    missing = [name for name in NEEDED if name not in names]
    for name in missing:
        print(f"{wheel.name} lacks {name}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
