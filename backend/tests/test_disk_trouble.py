"""F17: the real process on a disk that is full, cannot be written or fails. Control continues, stored
texts stay, and what cannot be stored is refused with its code.

The disks are real ones in a mount namespace of their own; skipped where the system allows none.
"""

import json
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx2
import pytest
from websockets.sync.client import connect

from servodeck.library.library import Library
from tests.client import lease_of
from tests.samples import MOVE
from tests.test_cli import Served
from tests.test_library_api import body
from tests.test_library_upgrade import FILES, content_of, lay_down

UNSHARE = ("unshare", "--map-root-user", "--mount", "sh", "-c")
SMALL, LARGE = json.dumps({"x": 1}), json.dumps({"x": "y" * 400_000})


def mounts() -> bool:
    if not shutil.which("unshare"):
        return False
    attempt = subprocess.run([*UNSHARE, "mount -t tmpfs none /mnt"], check=False, capture_output=True)
    return attempt.returncode == 0


pytestmark = pytest.mark.exhaustive


@pytest.fixture(scope="module", autouse=True)
def _mounts() -> None:
    if not mounts():
        pytest.skip("this system does not allow to mount a disk")


@contextmanager
def served_on(folder: Path, prepare: str) -> Iterator[Served]:
    """The gateway on `folder`, after the shell commands `prepare` in its own view of the disks."""
    served = Served("--data", str(folder), before=(*UNSHARE, f'{prepare} && exec "$@"', "sh"))
    try:
        yield served
    finally:
        served.end()


def write(served: Served, name: str, text: str, expected: int = 0) -> tuple[int, str | None]:
    """Status and code of the answer."""
    answer = httpx2.put(f"{served.url}/api/library/{name}", json=body(text, expected), timeout=10)
    return answer.status_code, answer.json().get("code")


def read(served: Served, name: str) -> object:
    return httpx2.get(f"{served.url}/api/library/{name}", timeout=10).json()


def assert_control_works(served: Served) -> None:
    with connect(f"ws{served.url.removeprefix('http')}/ws", close_timeout=0) as client:
        client.send(json.dumps({"type": "board", "id": 1, "board": "doc"}))
        nonce = lease_of(client)
        client.send(json.dumps({"type": "packet", "id": 1, "bytes": MOVE.hex(), "nonce": nonce}))
        while (message := json.loads(client.recv(5)))["type"] != "done":
            assert message["type"] != "refused", message
    stopped = httpx2.post(f"{served.url}/api/stop").json()
    assert (stopped["latch"], stopped["halted"]) == (True, True)
    httpx2.post(f"{served.url}/api/resume")


def troubles(served: Served) -> Sequence[str]:
    health = httpx2.get(f"{served.url}/api/health").json()
    return [trouble["part"] for trouble in health["troubles"]]


def acts_once_not_stored(served: Served) -> list[Any]:
    """The list, as soon as it says that it is not stored, some seconds after an act."""
    while (page := httpx2.get(f"{served.url}/api/audit").json())["problem"] is None:
        assert served.process.poll() is None
    entries: list[Any] = page["entries"]
    return entries


def test_a_full_disk_refuses_what_is_new_and_keeps_what_is_old(tmp_path: Path) -> None:
    with served_on(tmp_path, f"mount -t tmpfs -o size=400k none {tmp_path}") as served:
        assert write(served, "a", SMALL) == (200, None)
        assert write(served, "a", LARGE, 1) == (507, "storageFull")
        assert read(served, "a") == {"text": SMALL, "revision": 1}
        assert_control_works(served)
        assert "disk" in troubles(served)  # and perhaps a computer that is busy with other tests
        assert write(served, "a", json.dumps({"x": 2}), 1) == (200, None)


def test_a_disk_that_cannot_be_written_is_reported_and_changes_nothing(tmp_path: Path) -> None:
    library = Library(tmp_path)
    library.write("a", SMALL, json.dumps(body()["facts"]), 0)
    library.close()
    read_only = f"mount --bind {tmp_path} {tmp_path} && mount -o remount,ro,bind {tmp_path}"
    with served_on(tmp_path, read_only) as served:
        status, code = write(served, "a", LARGE, 1)
        assert (status, code) == (503, "storageFailed")
        assert_control_works(served)
        acts = acts_once_not_stored(served)
        assert [one["act"] for one in acts[:2]] == ["resumed", "stopped"]
        assert_control_works(served)
        assert "disk" in troubles(served)
    assert Library(tmp_path).read("a") == (SMALL, 1)


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_a_file_that_cannot_be_written_is_reported_and_opened_once_it_can(sql: Path, tmp_path: Path) -> None:
    """Of an old version, too: it is brought up to date then."""
    file = lay_down(sql, tmp_path)
    before = content_of(file)
    read_only = f"mount --bind {file} {file} && mount -o remount,ro,bind {file}"
    with served_on(tmp_path, read_only) as served:
        for answer in (
            httpx2.get(f"{served.url}/api/library"),
            httpx2.put(f"{served.url}/api/library/wave", json=body(SMALL, 2)),
        ):
            assert (answer.status_code, answer.json()["code"]) == (503, "storageFailed")
            assert answer.json()["detail"].startswith("library.sqlite in the data folder cannot be written")
        assert_control_works(served)
    assert content_of(file) == before
    with served_on(tmp_path, "true") as served:
        assert read(served, "wave") == {"text": '{"frames":[1]}', "revision": 2}
        assert write(served, "wave", SMALL, 2) == (200, None)


def test_an_error_of_the_disk_is_reported_and_changes_nothing(tmp_path: Path) -> None:
    # A limit on the size of files: each write beyond it fails, and SQLite tells that as it tells EIO.
    with served_on(tmp_path, "ulimit -f 192") as served:
        assert write(served, "a", SMALL) == (200, None)
        assert write(served, "a", LARGE, 1) == (503, "storageFailed")
        assert read(served, "a") == {"text": SMALL, "revision": 1}
        assert_control_works(served)
        assert write(served, "a", json.dumps({"x": 2}), 1) == (200, None)
