"""Library files of every version there has been: each is brought up to date, none is ever lost."""

import json
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest

from servodeck.errors import StorageError, StorageFullError
from servodeck.library.library import Library, Listed, Version
from servodeck.library.library_file import FILE, STEPS, sum_of, version_of

FILES = sorted((Path(__file__).parent / "library_files").glob("version-*.sql"))
COUNT = 500
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


class Stored(NamedTuple):
    """A document of an old file."""

    text: str
    facts: str
    revision: int
    removed_at_ms: int | None
    versions: tuple[str, ...]


def fill(path: Path) -> dict[str, Stored]:
    """Puts many documents into a file of that version, each another one; what is in them by now."""
    random, stored = Random(path.stat().st_size), dict[str, Stored]()
    for number in range(COUNT):
        frames = [random.randint(500, 2500) for _ in range(random.randint(0, 200))]
        stored[f"group-{number}"] = Stored(
            text=json.dumps({"name": f"群 {number} \U0001f916", "frames": frames}, ensure_ascii=False),
            facts=f'{{"name":"群 {number}","kind":"group"}}',
            revision=random.randint(1, 90),
            removed_at_ms=random.choice([None, None, None, 4_102_444_800_000]),
            versions=tuple(json.dumps({"frames": frames[:count]}) for count in range(random.randint(0, 3))),
        )
    with closing(sqlite3.connect(path)) as db, db:
        db.create_function("sum_of", -1, sum_of, deterministic=True)
        has_sums = version_of(db) > 2
        for id_, one in stored.items():
            document = (id_, one.revision, one.removed_at_ms, one.facts, one.text)
            columns = "(id, revision, removed_at_ms, facts, text)"
            db.execute(f"INSERT INTO document {columns} VALUES (?, ?, ?, ?, ?)", document)
            for number, text in enumerate(one.versions):
                version = (id_, f"v{number}", f"Try {number}", number, text)
                db.execute(
                    "INSERT INTO version (document, id, name, at_ms, text) VALUES (?, ?, ?, ?, ?)", version
                )
        if has_sums:  # the last two statements of the step that brought them
            for statement in STEPS[2][-2:]:
                db.execute(statement)
    return stored


def assert_holds(library: Library, stored: dict[str, Stored]) -> None:
    found = {one.id: one for one in library.list()}
    assert found.keys() == stored.keys() | {"wave", "old-pose"}
    for id_, one in stored.items():
        is_removed = one.removed_at_ms is not None
        assert found[id_] == Listed(id_, one.revision, is_removed, one.facts, "group")
        assert library.read(id_) == (one.text, one.revision)
        names = [version.id for version in library.versions(id_)]
        assert [library.read_version(id_, name) for name in names] == list(one.versions)


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_of_many_documents_each_is_there_and_whole_behind_it(sql: Path, tmp_path: Path) -> None:
    stored = fill(lay_down(sql, tmp_path))
    before = content_of(tmp_path / FILE)
    library = opened(tmp_path)
    assert_holds(library, stored)
    assert (library.damaged_file, library.changes_lost) == (None, False)
    library.close()
    assert content_of(tmp_path / BACKUP) == before
    assert_holds(restored(tmp_path), stored)


@pytest.mark.parametrize("sql", FILES, ids=lambda sql: sql.stem)
def test_a_disk_that_is_full_amid_the_upgrade_of_many_loses_none(sql: Path, tmp_path: Path) -> None:
    stored = fill(lay_down(sql, tmp_path))
    before = content_of(tmp_path / FILE)
    small, grow = "PRAGMA max_page_count = 4000", "INSERT INTO later SELECT zeroblob(9000000) FROM document"
    with pytest.raises(StorageFullError):
        opened(tmp_path, [*STEPS, ["CREATE TABLE later (text)", small, grow]]).list()
    assert content_of(tmp_path / FILE) == before
    assert_holds(opened(tmp_path), stored)


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
