"""The data folder in one file and back: as of one instant, nothing lost, nothing taken that is not ours."""

import json
import sqlite3
import stat
from contextlib import closing
from pathlib import Path
from zipfile import ZipFile

import pytest
from typer.testing import CliRunner, Result

from servodeck.access.audit_file import AuditFile, append
from servodeck.cli.main import app
from servodeck.files import write_whole
from servodeck.library.library import Library


def asked(*words: object) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """As a gateway leaves it."""
    made = tmp_path / "data"
    library = Library(made)
    library.write("wave", '{"frames":[]}', "{}", 0)
    library.close()
    write_whole(made / "remembered.json", '{"board":"xarm"}')
    write_whole(made / "epoch", "41")
    (made / "notes.txt").write_text("not ours")
    return made


@pytest.fixture
def saved(folder: Path, tmp_path: Path) -> Path:
    file = tmp_path / "servodeck.zip"
    assert asked("backup", file, "--data", folder).exit_code == 0
    return file


def test_a_backup_holds_what_is_ours_and_only_its_owner_reads_it(folder: Path, saved: Path) -> None:
    with ZipFile(saved) as archive:
        assert set(archive.namelist()) == {"servodeck-backup.json", "library.sqlite", "remembered.json"}
        manifest = json.loads(archive.read("servodeck-backup.json"))
    assert manifest["files"].keys() == {"library.sqlite", "remembered.json"}
    assert stat.S_IMODE(saved.stat().st_mode) == 0o600
    again = asked("backup", saved, "--data", folder)
    assert (again.exit_code, "--force" in again.stderr) == (2, True)
    assert asked("backup", saved, "--data", folder, "--force").exit_code == 0


def test_it_comes_back_on_another_computer(saved: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "new" / "data"
    result = asked("restore", saved, "--data", elsewhere)
    assert result.exit_code == 0, result.output
    assert Library(elsewhere).read("wave") == ('{"frames":[]}', 1)
    assert json.loads((elsewhere / "remembered.json").read_text()) == {"board": "xarm"}
    assert not (elsewhere / "epoch").exists()


def test_the_former_files_are_moved_and_the_count_of_starts_stays(folder: Path, saved: Path) -> None:
    library = Library(folder)
    library.write("wave", '{"newer":1}', "{}", 1)
    library.close()
    result = asked("restore", saved, "--data", folder)
    assert result.exit_code == 0, result.output
    assert Library(folder).read("wave") == ('{"frames":[]}', 1)
    (former,) = folder.glob("before-restore-*")
    assert Library(former).read("wave") == ('{"newer":1}', 2)
    assert str(former) in result.output.replace("\n", "")
    assert (folder / "epoch").read_text() == "41"
    assert (folder / "notes.txt").read_text() == "not ours"


def test_what_is_written_while_a_gateway_runs_is_in_the_backup(folder: Path, tmp_path: Path) -> None:
    library = Library(folder)
    library.write("bow", '{"frames":[1]}', "{}", 0)  # in the journal alone
    file = tmp_path / "running.zip"
    assert asked("backup", file, "--data", folder).exit_code == 0
    elsewhere = tmp_path / "elsewhere"
    assert asked("restore", file, "--data", elsewhere).exit_code == 0
    assert Library(elsewhere).read("bow") == ('{"frames":[1]}', 1)
    library.close()


def test_nothing_is_restored_under_a_running_gateway(folder: Path, saved: Path) -> None:
    library = Library(folder)
    library.write("wave", '{"newer":1}', "{}", 1)
    result = asked("restore", saved, "--data", folder)
    assert result.exit_code == 1
    assert "a gateway uses" in result.stderr
    assert library.read("wave") == ('{"newer":1}', 2)
    assert list(folder.glob("before-restore-*")) == []
    library.close()
    assert asked("restore", saved, "--data", folder).exit_code == 0


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda parts: parts.pop("servodeck-backup.json"), "no backup"),
        (lambda parts: parts.pop("library.sqlite"), "no backup"),
        (lambda parts: parts.update({"remembered.json": b'{"board":"other"}'}), "no backup"),
        (lambda parts: rewritten(parts, "format", "else"), "no backup"),
        (lambda parts: rewritten(parts, "version", 2), "newer Servodeck"),
        (lambda parts: rewritten(parts, "files", {"../evil.json": ""}), "no backup"),
        (lambda parts: rewritten(parts, "files", {"epoch": ""}), "no backup"),
        (lambda parts: rewritten(parts, "files", []), "no backup"),
    ],
)
def test_a_file_that_is_none_or_is_damaged_changes_nothing(
    folder: Path, saved: Path, change: object, says: str
) -> None:
    with ZipFile(saved) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    assert callable(change)
    change(parts)
    with ZipFile(saved, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    result = asked("restore", saved, "--data", folder)
    assert result.exit_code == 1
    assert says in result.stderr
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def rewritten(parts: dict[str, bytes], name: str, value: object) -> None:
    parts["servodeck-backup.json"] = json.dumps(
        {**json.loads(parts["servodeck-backup.json"]), name: value}
    ).encode()


@pytest.mark.parametrize("content", [b"", b"PK", b"no zip at all" * 100])
def test_so_does_one_that_is_no_archive(folder: Path, tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "other.zip"
    file.write_bytes(content)
    result = asked("restore", file, "--data", folder)
    assert (result.exit_code, "no backup of Servodeck's" in result.stderr) == (1, True)
    assert asked("restore", tmp_path / "missing.zip", "--data", folder).exit_code == 1


def test_the_list_of_acts_stays_with_its_folder_and_says_what_was_put_back(
    folder: Path, tmp_path: Path
) -> None:
    append(folder, "gatewayStarted", "", 1)
    file = tmp_path / "with-audit.zip"
    assert asked("backup", file, "--data", folder).exit_code == 0
    with ZipFile(file) as archive:
        assert "audit.sqlite" not in archive.namelist()
    append(folder, "gatewayEnded", "", 2)
    assert asked("restore", file, "--data", folder).exit_code == 0
    found = AuditFile(folder).load()
    assert [(one.act, one.about) for one in found] == [
        ("gatewayStarted", ""),
        ("gatewayEnded", ""),
        ("restored", "with-audit.zip"),
    ]


def test_a_damaged_library_is_moved_too(folder: Path, saved: Path) -> None:
    (folder / "library.sqlite").write_bytes(b"not a database" * 500)
    assert asked("restore", saved, "--data", folder).exit_code == 0
    assert Library(folder).read("wave") == ('{"frames":[]}', 1)
    (former,) = folder.glob("before-restore-*")
    assert (former / "library.sqlite").read_bytes().startswith(b"not a database")


def test_folders_may_be_named_from_here(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder.parent)
    assert asked("backup", "here.zip", "--data", folder.name).exit_code == 0
    assert asked("restore", "here.zip", "--data", "other").exit_code == 0
    assert Library(Path("other")).read("wave") == ('{"frames":[]}', 1)


def test_an_empty_folder_has_no_backup(tmp_path: Path) -> None:
    result = asked("backup", tmp_path / "x.zip", "--data", tmp_path / "none")
    assert result.exit_code == 1
    assert "nothing of Servodeck's" in result.stderr
    assert not (tmp_path / "x.zip").exists()


def test_a_backup_is_whole_or_not_there(folder: Path, tmp_path: Path) -> None:
    (folder / "library.sqlite").write_bytes(b"damaged" * 1000)
    file = tmp_path / "old.zip"
    file.write_bytes(b"the one of last week")
    result = asked("backup", file, "--data", folder, "--force")
    assert result.exit_code == 1
    assert file.read_bytes() == b"the one of last week"
    assert [path.name for path in tmp_path.glob("*.new")] == []
    with pytest.raises(sqlite3.DatabaseError), closing(sqlite3.connect(folder / "library.sqlite")) as db:
        db.execute("SELECT * FROM document")
