"""How many descriptors the gateway may have: more than the system gives at first, for a stop needs one where
many are connected; no number that pyserial's select() does not take.
"""

import subprocess
import sys
from pathlib import Path

import pytest

from servodeck.api.health import WANTED
from tests.test_cli import Served

SHOWN = "import resource; print(*resource.getrlimit(resource.RLIMIT_NOFILE))"
ALLOW = f"from servodeck.api.health import allow_descriptors; allow_descriptors(); {SHOWN}"

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not Path("/bin/sh").exists(), reason="the limits are set by a shell"),
]


@pytest.mark.parametrize(
    ("limits", "allowed"),
    [
        ("ulimit -Sn 64", WANTED),
        ("ulimit -Sn 64; ulimit -Hn 200", 200),
        (f"ulimit -Sn {WANTED + 100}", WANTED),
    ],
)
def test_it_takes_as_many_as_it_wants_or_may(limits: str, allowed: int) -> None:
    command = ["sh", "-c", f'{limits} && exec "$@"', "sh", sys.executable, "-c", ALLOW]
    soft, _ = subprocess.check_output(command, text=True).split()
    assert int(soft) == allowed


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="the limits are read from /proc")
def test_the_gateway_takes_them_before_it_serves() -> None:
    served = Served("--board", "doc", before=("sh", "-c", 'ulimit -Sn 64; exec "$@"', "sh"))
    try:
        limits = Path(f"/proc/{served.process.pid}/limits").read_text()
    finally:
        served.end()
    [line] = [line for line in limits.splitlines() if line.startswith("Max open files")]
    assert int(line.split()[3]) == WANTED
