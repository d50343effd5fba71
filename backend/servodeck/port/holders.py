"""Which programs have a device of this computer open. Linux tells by /proc, of the programs of this account,
or of all where it is root; other systems do not tell. Opens nothing.
"""

import os
from pathlib import Path

PROCESSES = Path("/proc")


def holders_of(device: str) -> list[str]:
    """ "name (process number)" of each but this one; empty where the system does not tell."""
    real = os.path.realpath(device)
    return [
        f"{name_of(process)} ({process.name})"
        for process in PROCESSES.glob("[0-9]*")
        if process.name != str(os.getpid()) and has_open(process, real)
    ]


def busy(name: str, device: str, likely: str) -> str:
    """The sentence about a device that another program has; `likely`: what that may be where nobody tells."""
    holders = holders_of(device)
    if holders:
        return f"{name} is open in {', '.join(holders)}. Close it there."
    return f"Another program uses {name}. Close it: {likely}."


def has_open(process: Path, real: str) -> bool:
    try:
        return any(os.path.realpath(link) == real for link in (process / "fd").iterdir())
    except OSError:  # another account's, or gone by now
        return False


def name_of(process: Path) -> str:
    try:
        return (process / "comm").read_text().strip()
    except OSError:
        return "a program"
