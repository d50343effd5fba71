"""Which start of the gateway this is, counted on disk: no lease of an earlier one is taken for one of now.

Knows one small file and no lease. It is written once, before anybody is served, so that no grant ever waits
for a disk.
"""

import contextlib
from pathlib import Path

from servodeck.files.small_file import write_whole

GRANTS_PER_START = 2**32


def first_epoch(folder: Path) -> int:
    """What the leases of this start count on from. Where nothing can be written it goes on all the same."""
    file = folder / "epoch"
    start = read_start(file) + 1
    with contextlib.suppress(OSError):
        write_whole(file, str(start))
    return start * GRANTS_PER_START


def read_start(file: Path) -> int:
    try:
        return max(0, int(file.read_text("ascii")))
    except (OSError, ValueError):
        return 0
