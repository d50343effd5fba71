"""The library on a real SQLite file: what is stored and refused, and what trouble on the disk does to it."""

import json
import os
import sqlite3
import tempfile
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path
from random import Random
from shutil import copytree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import Bundle, RuleBasedStateMachine, initialize, invariant, rule

from servodeck.errors import (
    ConflictError,
    DamagedTextError,
    NotFoundError,
    OutOfRangeError,
    StorageBusyError,
    StorageError,
    StorageFullError,
)
from servodeck.library.library import MAX_VERSIONS, TRASH_MS, Library, Listed, Version
from servodeck.library.library_file import FILE, STEPS
from tests.amount import TIMES

PAGE_BYTES = 4096
# Where a write costs nothing, for a property that asks what is read and never pulls the plug.
MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
DAY_MS = 24 * 3600 * 1000


@pytest.fixture
def library(tmp_path: Path) -> Library:
    return Library(tmp_path)


def reopened(folder: Path) -> Library:
    return Library(folder)


def test_what_was_written_is_there_after_a_restart(library: Library, tmp_path: Path) -> None:
    assert library.write("a", "{}", "facts", 0) == 1
    assert library.write("a", '{"x":1}', "newer", 1) == 2
    library.keep_version("a", Version("v", "First", 5), "{}")
    library.close()
    again = reopened(tmp_path)
    assert again.list() == [Listed("a", 2, False, "newer")]
    assert again.read("a") == ('{"x":1}', 2)
    assert again.versions("a") == [Version("v", "First", 5)]
    assert again.read_version("a", "v") == "{}"


def test_a_confirmed_write_survives_a_sudden_end(library: Library, tmp_path: Path) -> None:
    library.write("a", "{}", "facts", 0)
    assert reopened(tmp_path).read("a") == ("{}", 1)  # the first is still open


def test_a_write_at_an_old_revision_changes_nothing(library: Library) -> None:
    library.write("a", "one", "f", 0)
    library.write("a", "two", "f", 1)
    with pytest.raises(ConflictError):
        library.write("a", "three", "f", 1)
    assert library.read("a") == ("two", 2)


def test_the_same_write_sent_again_is_no_conflict(library: Library) -> None:
    assert library.write("a", "one", "f", 0) == 1
    assert library.write("a", "one", "f", 0) == 1
    assert library.write("a", "two", "f", 1) == 2
    assert library.write("a", "two", "f", 1) == 2


def test_a_document_that_was_read_elsewhere_is_taken_in(library: Library) -> None:
    assert library.write("a", "one", "f", 7) == 8


def test_removed_documents_come_back_with_restore_or_a_write(library: Library) -> None:
    for document in ("a", "b"):
        library.write(document, "text", "f", 0)
    library.remove(["a", "b"])
    assert all(one.is_removed for one in library.list())
    library.restore(["a"])
    library.write("b", "more", "f", 1)
    assert not any(one.is_removed for one in library.list())


def test_removing_and_restoring_is_all_or_nothing(library: Library) -> None:
    library.write("a", "text", "f", 0)
    with pytest.raises(NotFoundError):
        library.remove(["a", "missing"])
    assert library.list() == [Listed("a", 1, False, "f")]
    library.write("b", "text", "f", 0, is_removed=True)
    with pytest.raises(NotFoundError):
        library.restore(["b", "missing"])
    assert library.list()[1].is_removed


def test_the_trash_is_emptied_after_a_month(tmp_path: Path) -> None:
    library = Library(tmp_path, now_ms=lambda: DAY_MS)
    for document in ("a", "b"):
        library.write(document, "text", "f", 0)
    library.keep_version("b", Version("v", "Kept", 1), "{}")
    library.remove(["b"])
    library.close()
    assert len(Library(tmp_path, now_ms=lambda: DAY_MS + TRASH_MS).list()) == 2
    late = Library(tmp_path, now_ms=lambda: DAY_MS + TRASH_MS + 1)
    assert [one.id for one in late.list()] == ["a"]
    assert late.versions("b") == []


@pytest.mark.parametrize(
    "ask",
    [
        lambda library: library.read("x"),
        lambda library: library.remove(["x"]),
        lambda library: library.read_version("x", "v"),
        lambda library: library.keep_version("x", Version("v", "", 0), ""),
        lambda library: library.remove_version("x", "v"),
    ],
)
def test_what_is_not_there_is_not_found(library: Library, ask: Callable[[Library], object]) -> None:
    with pytest.raises(NotFoundError):
        ask(library)


def test_a_document_takes_so_many_versions_and_no_more(library: Library) -> None:
    library.write("a", "text", "f", 0)
    for number in range(MAX_VERSIONS):
        library.keep_version("a", Version(str(number), "", number), "{}")
    with pytest.raises(OutOfRangeError):
        library.keep_version("a", Version("more", "", 0), "{}")
    library.keep_version("a", Version("0", "Renamed", 0), "{}")
    assert library.versions("a")[0] == Version("0", "Renamed", 0)
    assert len(library.versions("a")) == MAX_VERSIONS


def test_a_full_disk_refuses_and_keeps_what_was_there(tmp_path: Path) -> None:
    library = Library(tmp_path)
    library.write("a", "small", "f", 0)
    database = library._db
    assert database
    pages = database.execute("PRAGMA page_count").fetchone()[0]
    database.execute(f"PRAGMA max_page_count = {pages + 1}")
    with pytest.raises(StorageFullError) as refused:
        library.write("a", "x" * 1_000_000, "f", 1)
    assert (refused.value.code, refused.value.status) == ("storageFull", 507)
    assert library.read("a") == ("small", 1)
    database.execute("PRAGMA max_page_count = 100000")
    assert library.write("a", "x" * 1_000_000, "f", 1) == 2


def test_a_file_that_another_program_holds_is_busy_and_free_again(
    library: Library, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("servodeck.library.library_file.BUSY_S", 0.0)
    library.write("a", "one", "f", 0)
    with closing(sqlite3.connect(tmp_path / FILE, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(StorageBusyError):
            library.write("a", "two", "f", 1)
        assert library.read("a") == ("one", 1)
        other.execute("ROLLBACK")
    assert library.write("a", "two", "f", 1) == 2


def test_a_damaged_file_is_set_aside_and_reported(library: Library, tmp_path: Path) -> None:
    library.write("a", "x" * 100_000, "f", 0)
    library.close()
    damaged = (tmp_path / FILE).read_bytes()[:5000] + b"\xa5" * 40_000
    (tmp_path / FILE).write_bytes(damaged)
    again = reopened(tmp_path)
    assert again.list() == []
    assert again.damaged_file
    assert (tmp_path / again.damaged_file).read_bytes() == damaged
    assert again.write("b", "text", "f", 0) == 1


def test_a_damaged_journal_takes_the_last_few_at_most(library: Library, tmp_path: Path) -> None:
    """SQLite takes what stands behind a damaged page of it for never written; that some was, we tell."""
    for number in range(100):
        library.write(f"a{number}", "x" * 1000, "f", 0)
    (tmp_path / "later").mkdir()
    journal = (tmp_path / f"{FILE}-wal").read_bytes()
    (tmp_path / "later" / FILE).write_bytes((tmp_path / FILE).read_bytes())
    (tmp_path / "later" / f"{FILE}-wal").write_bytes(b"\xa5" * len(journal))
    later = reopened(tmp_path / "later")
    found = {one.id for one in later.list()}
    assert found >= {f"a{number}" for number in range(90)}
    assert later.changes_lost
    assert not any(one.changes_lost for one in (library, reopened(tmp_path)))


@given(seed=st.integers(0, 2**32), part=st.sampled_from(["", "-wal"]), ends=st.booleans())
@settings(max_examples=20 * TIMES, deadline=None)
def test_with_any_damage_no_document_is_another_and_only_known_errors_are_raised(
    seed: int, part: str, ends: bool
) -> None:
    """A page of noise, or an end in the middle."""
    chance = Random(seed)
    with tempfile.TemporaryDirectory() as name:
        before, after = Path(name, "before"), Path(name, "after")
        library = Library(before)
        texts = {f"a{number}": str(number) * 700 for number in range(30)}
        for document, text in texts.items():
            library.write(document, text, "f", 0)
        copytree(before, after)  # as a sudden end leaves it
        library.close()
        path = after / f"{FILE}{part}"
        content = path.read_bytes()
        at = chance.randrange(len(content)) // PAGE_BYTES * PAGE_BYTES
        noise = b"" if ends else chance.randbytes(PAGE_BYTES) + content[at + PAGE_BYTES :]
        path.write_bytes(content[:at] + noise)
        damaged = Library(after)
        with suppress(StorageError):
            for one in damaged.list():
                assert damaged.read(one.id) == (texts[one.id], 1)
        damaged.close()


@given(seed=st.integers(0, 2**32), part=st.sampled_from(["", "-wal"]))
@settings(max_examples=30 * TIMES, deadline=None)
def test_whichever_bit_is_flipped_all_is_as_it_was_or_said_to_be_damaged(seed: int, part: str) -> None:
    chance = Random(seed)
    with tempfile.TemporaryDirectory() as name:
        before, after = Path(name, "before"), Path(name, "after")
        library = Library(before)
        fill(library)
        copytree(before, after)
        expected = content_of(library)
        library.close()
        path = after / f"{FILE}{part}"
        content = bytearray(path.read_bytes())
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
        path.write_bytes(content)
        damaged = Library(after)
        with suppress(StorageError, DamagedTextError):
            found = content_of(damaged)
            assert found == expected or damaged.damaged_file or damaged.changes_lost
        damaged.close()


def fill(library: Library) -> None:
    for number in range(20):
        library.write(f"a{number}", str(number) * 700, json.dumps({"name": f"Group {number}"}), 0)
        library.keep_version(f"a{number}", Version("v", "First try", number), str(number) * 300)
    library.remove(["a3", "a5"])


def content_of(library: Library) -> object:
    """All that it holds. Raises a DamagedTextError."""
    listed = library.list()
    if any(one.facts is None for one in listed):
        raise DamagedTextError("in the list")
    return [
        (
            one,
            library.read(one.id),
            [(version, library.read_version(one.id, version.id)) for version in library.versions(one.id)],
        )
        for one in listed
    ]


def flip(folder: Path, text: str) -> None:
    """A bit of that text where the file holds it."""
    content = (folder / FILE).read_bytes()
    assert content.count(text.encode()) == 1
    changed = bytes((text.encode()[0] ^ 1,)) + text.encode()[1:]
    (folder / FILE).write_bytes(content.replace(text.encode(), changed))


def test_a_damaged_document_is_named_with_its_way_back_and_nothing_is_deleted(
    library: Library, tmp_path: Path
) -> None:
    library.write("a", '{"now": 1}', '{"name": "Wave"}', 0)
    library.keep_version("a", Version("v", "First try", 1), '{"then": 1}')
    library.keep_version("a", Version("w", "Second try", 2), '{"later": 1}')
    library.write("b", "{}", '{"name": "Nod"}', 0)
    library.close()
    flip(tmp_path, '{"now": 1}')
    flip(tmp_path, '{"later": 1}')
    again = reopened(tmp_path)
    with pytest.raises(DamagedTextError, match=r"Wave is damaged.* whole: First try"):
        again.read("a")
    with pytest.raises(DamagedTextError, match="Second try is damaged"):
        again.read_version("a", "w")
    assert again.read_version("a", "v") == '{"then": 1}'
    assert [one.id for one in again.list()] == ["a", "b"]
    assert again.read("b") == ("{}", 1)
    assert again.write("a", '{"then": 1}', '{"name": "Wave"}', 1) == 2
    assert again.read("a") == ('{"then": 1}', 2)


def test_what_a_list_says_of_a_document_is_not_believed_where_it_is_damaged(
    library: Library, tmp_path: Path
) -> None:
    """The limits of a robot are among it."""
    library.write("arm", "{}", '{"name": "Arm"}', 0, kind="robot")
    library.close()
    flip(tmp_path, '{"name": "Arm"}')
    again = reopened(tmp_path)
    assert again.list() == [Listed("arm", 1, False, None, "robot")]
    assert again.read("arm") == ("{}", 1)
    with pytest.raises(DamagedTextError):
        again.facts_of("arm", "robot")


def test_a_document_stays_of_its_kind_and_is_requested_by_it(library: Library) -> None:
    library.write("arm", "{}", "limits", 0, kind="robot")
    assert library.facts_of("arm", "robot") == ("limits", 1)
    with pytest.raises(ConflictError):
        library.write("arm", "{}", "limits", 1, kind="group")
    with pytest.raises(NotFoundError):
        library.facts_of("arm", "group")
    library.remove(["arm"])
    with pytest.raises(NotFoundError):
        library.facts_of("arm", "robot")


def test_a_file_that_is_no_database_is_set_aside(tmp_path: Path) -> None:
    (tmp_path / FILE).write_text("not a database at all " * 100)
    library = Library(tmp_path)
    assert library.list() == []
    assert library.damaged_file


def test_an_upgrade_keeps_a_copy_from_before(library: Library, tmp_path: Path) -> None:
    library.write("a", "text", "f", 0)
    library.close()
    newer = Library(tmp_path, steps=[*STEPS, ["ALTER TABLE document ADD COLUMN note TEXT"]])
    with pytest.raises(StorageError):  # this version writes six columns
        newer.write("b", "text", "f", 0)
    assert newer.read("a") == ("text", 1)
    with closing(sqlite3.connect(tmp_path / f"library-before-version-{len(STEPS) + 1}.sqlite")) as copy:
        assert copy.execute("SELECT id, text FROM document").fetchall() == [("a", "text")]
    newer.close()
    with pytest.raises(StorageError, match="newer Servodeck"):
        library.list()


def test_an_upgrade_that_fails_leaves_the_old_file_as_it_was(library: Library, tmp_path: Path) -> None:
    library.write("a", "text", "f", 0)
    library.close()
    steps = [*STEPS, ["ALTER TABLE document ADD COLUMN note TEXT", "NO SUCH STATEMENT"]]
    with pytest.raises(StorageError):
        Library(tmp_path, steps=steps).list()
    assert library.read("a") == ("text", 1)


def test_a_folder_that_cannot_be_is_an_error_until_it_can(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    library = Library(tmp_path / "file")
    with pytest.raises(StorageError):
        library.list()
    (tmp_path / "file").unlink()
    assert library.list() == []


class AgainstADict(RuleBasedStateMachine):
    """Any order of calls leaves the library saying what a dict would say, across restarts."""

    documents = Bundle("documents")
    texts = st.sampled_from(["one", "two", "three"])

    @initialize()
    def begin(self) -> None:
        self.folder = tempfile.TemporaryDirectory(dir=MEMORY)
        self.library = Library(Path(self.folder.name))
        self.model: dict[str, tuple[int, str, bool]] = {}

    @rule(target=documents, name=st.sampled_from("abc"), text=texts)
    def create(self, name: str, text: str) -> str:
        if name not in self.model:
            assert self.library.write(name, text, text, 0) == 1
            self.model[name] = (1, text, False)
        return name

    @rule(name=documents, text=texts, behind=st.integers(0, 2))
    def write(self, name: str, text: str, behind: int) -> None:
        revision, present, _ = self.model[name]
        expected = max(0, revision - behind)
        if text == present:
            assert self.library.write(name, text, text, expected) == revision
            self.model[name] = (revision, text, False)
        elif expected == revision:
            assert self.library.write(name, text, text, expected) == revision + 1
            self.model[name] = (revision + 1, text, False)
        else:
            with pytest.raises(ConflictError):
                self.library.write(name, text, text, expected)

    @rule(name=documents, is_removed=st.booleans())
    def mark(self, name: str, is_removed: bool) -> None:
        (self.library.remove if is_removed else self.library.restore)([name])
        revision, text, _ = self.model[name]
        self.model[name] = (revision, text, is_removed)

    @rule()
    def restart(self) -> None:
        self.library.close()
        self.library = Library(Path(self.folder.name))

    @invariant()
    def says_the_same(self) -> None:
        listed = {one.id: one for one in self.library.list()}
        assert listed.keys() == self.model.keys()
        for name, (revision, text, is_removed) in self.model.items():
            assert listed[name] == Listed(name, revision, is_removed, text)
            assert self.library.read(name) == (text, revision)

    def teardown(self) -> None:
        self.library.close()
        self.folder.cleanup()


TestAgainstADict = AgainstADict.TestCase
TestAgainstADict.settings = settings(max_examples=25 * TIMES, deadline=None)
