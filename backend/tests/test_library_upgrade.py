"""Library files of every version there has been: each is brought up to date, none is ever lost."""

import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

import pytest

from servodeck.errors import StorageError
from servodeck.library.library import Library, Listed, Version
from servodeck.library.library_file import FILE, STEPS

FILES = sorted((Path(__file__).parent / "library_files").glob("version-*.sql"))
LATER: Sequence[Sequence[str]] = [
    *STEPS,
    ["CREATE TABLE later (id TEXT)"],
    ["INSERT INTO later VALUES ('x')"],
]
BACKUP = f"library-before-version-{len(LATER)}.sqlite"
BEFORE_EVERYTHING_MS = 0
WAVE_FACTS, POSE_FACTS = '{"name":"Wave","kind":"group"}', '{"name":"Posé","kind":"group"}'


def test_every_version_has_its_file() -> None:
    assert [file.stem for file in FILES] == [f"version-{number}" for number in range(1, len(STEPS) + 1)]


def lay_down(sql: Path, folder: Path) -> Path:
    """The file as that version left it."""
    with closing(sqlite3.connect(folder / FILE)) as db:
        db.executescript(sql.read_text())
    return folder / FILE


def opened(folder: Path, steps: Sequence[Sequence[str]] = LATER) -> Library:
    return Library(folder, now_ms=lambda: BEFORE_EVERYTHING_MS, steps=steps)


def assert_holds_everything(library: Library) -> None:
    assert library.list() == [
        Listed("wave", 2, False, WAVE_FACTS),
        Listed("old-pose", 1, True, POSE_FACTS),
    ]
    assert library.facts_of("wave", "group") == (WAVE_FACTS, 2)
    assert library.read("wave") == ('{"frames":[1]}', 2)
    assert library.versions("wave") == [Version("v1", "First try", 1_700_000_000_000)]
    assert library.read_version("wave", "v1") == '{"frames":[]}'


def content_of(path: Path) -> list[str]:
    with closing(sqlite3.connect(path)) as db:
        return [*db.iterdump(), str(db.execute("PRAGMA user_version").fetchone())]


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_a_file_is_brought_up_to_date_with_a_copy_of_before_beside_it(sql: Path, tmp_path: Path) -> None:
    before = content_of(lay_down(sql, tmp_path))
    library = opened(tmp_path)
    assert_holds_everything(library)
    assert library.write("new", "{}", "f", 0) == 1
    library.close()
    assert content_of(tmp_path / BACKUP) == before
    assert_holds_everything(restored(tmp_path))


def restored(folder: Path) -> Library:
    """What a person does who goes back to the version of before."""
    for part in folder.glob(f"{FILE}*"):
        part.unlink()
    (folder / BACKUP).rename(folder / FILE)
    return opened(folder, STEPS)


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
@pytest.mark.parametrize("failing", ["NO SUCH STATEMENT", "INSERT INTO document VALUES (1)"])
def test_an_upgrade_that_fails_leaves_everything_as_it_was(sql: Path, failing: str, tmp_path: Path) -> None:
    before = content_of(lay_down(sql, tmp_path))
    with pytest.raises(StorageError):
        opened(tmp_path, [*LATER, [failing]]).list()
    assert content_of(tmp_path / FILE) == before
    assert_holds_everything(opened(tmp_path))


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_without_a_copy_nothing_is_changed(sql: Path, tmp_path: Path) -> None:
    before = content_of(lay_down(sql, tmp_path))
    (tmp_path / BACKUP).mkdir()  # in the way of the copy
    with pytest.raises(StorageError):
        opened(tmp_path).list()
    assert content_of(tmp_path / FILE) == before
    assert sorted(one.name for one in tmp_path.glob("*.part")) == []
    (tmp_path / BACKUP).rmdir()
    assert_holds_everything(opened(tmp_path))


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_a_file_of_a_newer_version_is_refused_and_left_alone(sql: Path, tmp_path: Path) -> None:
    lay_down(sql, tmp_path)
    opened(tmp_path).list()
    newer = content_of(tmp_path / FILE)
    for _ in range(2):
        with pytest.raises(StorageError, match="written by a newer Servodeck"):
            opened(tmp_path, STEPS).list()
    assert content_of(tmp_path / FILE) == newer
