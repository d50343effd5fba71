"""The commands that copy the gateway's data folder into one file and back: library, paired devices, tokens
and what it remembers.

A backup is taken while the gateway runs. It is put back while none runs, and the former files are moved
into a folder beside it.
Knows files and databases by their names, no document.
"""

import hashlib
import json
import re
import sqlite3
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from pathlib import Path
from typing import Annotated, Any
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile

import typer

from servodeck import __version__
from servodeck.cli.options import USAGE, data_folder, fail
from servodeck.errors import StorageError

FORMAT, VERSION = "servodeck-backup", 1
MANIFEST = "servodeck-backup.json"
# These stay with their folder: leases of earlier starts must never be valid again, and a list of acts that
# an older one could replace would prove nothing.
STAYS = re.compile(r"(epoch|audit\.sqlite.*)")
NAME = re.compile(r"[a-z][a-z0-9-]*\.(sqlite|json)")
MOST_BYTES = 2**30

Data = Annotated[
    Path | None,
    typer.Option(
        envvar="SERVODECK_DATA", help="Folder of the library and settings. Default: the user's own."
    ),
]


class BackupError(Exception):
    """In words for the person who asked."""


def backup(
    file: Annotated[Path, typer.Argument(help="The file to write, for example servodeck.zip.")],
    data: Data = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
) -> None:
    """Copy the library, the paired devices and the settings into one file, while the gateway runs."""
    folder = data or data_folder()
    if file.exists() and not force:
        fail(f"{file} is there already. Choose another name, or add --force.", USAGE)
    try:
        names = write_backup(folder, file)
    except (BackupError, OSError, sqlite3.Error) as error:
        fail(f"No backup was written: {error}.")
    print(f"{file} holds {', '.join(names)} of {folder}.")
    print("Keep it to yourself: who has it can drive the robot as the devices in it can.")


def restore(
    file: Annotated[Path, typer.Argument(help="A file that `servodeck backup` has written.")],
    data: Data = None,
) -> None:
    """Put a backup back, while no gateway uses the folder. The former files are moved, not deleted."""
    folder = data or data_folder()
    try:
        names, former = read_backup(file, folder)
    except (BackupError, OSError, sqlite3.Error) as error:
        fail(f"Nothing was changed: {error}.")
    print(f"{', '.join(names)} of {file} are in {folder}.")
    note_restored(file.name, folder)
    if former is not None:
        print(f"The former files are in {former}.")


def note_restored(name: str, folder: Path) -> None:
    """In the list of acts; where that cannot be written, the files are back all the same."""
    from servodeck.access.audit_file import append

    with suppress(StorageError):
        append(folder, "restored", name, time.time_ns() // 1_000_000)


def is_backed_up(name: str) -> bool:
    return bool(NAME.fullmatch(name)) and not STAYS.fullmatch(name)


def write_backup(folder: Path, file: Path) -> list[str]:
    """The names of what it holds. Raises a BackupError, OSError or sqlite3.Error; an older file stays."""
    found = sorted(path for path in folder.glob("*") if is_backed_up(path.name) and path.is_file())
    if not found:
        raise BackupError(f"{folder} holds nothing of Servodeck's")
    with tempfile.TemporaryDirectory() as scratch:
        copies = [copied(path, Path(scratch) / path.name) for path in found]
        fresh = file.with_name(f"{file.name}.new")
        fresh.touch(0o600)
        fresh.chmod(0o600)
        try:
            with ZipFile(fresh, "w", ZIP_DEFLATED) as archive:
                archive.writestr(MANIFEST, json.dumps(manifest_of(copies), indent=2))
                for copy in copies:
                    archive.write(copy, copy.name)
            fresh.replace(file)
        except BaseException:
            fresh.unlink(missing_ok=True)
            raise
    return [path.name for path in found]


def copied(path: Path, to: Path) -> Path:
    """A database as of one instant, even while a gateway writes into it."""
    if path.suffix != ".sqlite":
        to.write_bytes(path.read_bytes())
        return to
    address = f"{path.resolve().as_uri()}?mode=ro"
    with closing(sqlite3.connect(address, uri=True)) as db, closing(sqlite3.connect(to)) as copy:
        db.backup(copy)
        copy.execute("PRAGMA journal_mode = DELETE")
    return to


def manifest_of(copies: list[Path]) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "version": VERSION,
        "servodeck": __version__,
        "made": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "files": {copy.name: hashlib.sha256(copy.read_bytes()).hexdigest() for copy in copies},
    }


def read_backup(file: Path, folder: Path) -> tuple[list[str], Path | None]:
    """What was put back, and where the former files are now. Raises as `write_backup`, before it changes
    anything."""
    with tempfile.TemporaryDirectory() as scratch:
        copies = unpacked(file, Path(scratch))
        for copy in copies:
            check(copy)
        folder.mkdir(parents=True, exist_ok=True)
        for path in folder.glob("*.sqlite"):
            refuse_if_used(path)
        former = move_former(folder)
        for copy in copies:
            target = folder / copy.name
            target.touch(0o600)
            target.write_bytes(copy.read_bytes())
    return [copy.name for copy in copies], former


def unpacked(file: Path, scratch: Path) -> list[Path]:
    try:
        with ZipFile(file) as archive:
            files = files_in(archive)
            return [written(archive, name, digest, scratch) for name, digest in files.items()]
    except (BadZipFile, KeyError, ValueError) as error:
        raise BackupError(f"{file} is no backup of Servodeck's, or it is damaged") from error


def files_in(archive: ZipFile) -> Mapping[str, str]:
    """Names with their hashes. Raises KeyError or ValueError where it is none of ours."""
    manifest = json.loads(archive.read(MANIFEST))
    if not isinstance(manifest, dict) or manifest.get("format") != FORMAT:
        raise ValueError("another format")
    if manifest.get("version") != VERSION:
        raise BackupError("it was written by a newer Servodeck")
    files = manifest["files"]
    if not isinstance(files, dict) or not all(is_backed_up(str(name)) for name in files):
        raise ValueError("names that no backup has")
    if sum(archive.getinfo(name).file_size for name in files) > MOST_BYTES:
        raise BackupError("it is larger than any library")
    return files


def written(archive: ZipFile, name: str, digest: str, scratch: Path) -> Path:
    content = archive.read(name)
    if hashlib.sha256(content).hexdigest() != digest:
        raise ValueError(f"{name} is damaged")
    copy = scratch / name
    copy.write_bytes(content)
    return copy


def check(copy: Path) -> None:
    if copy.suffix != ".sqlite":
        json.loads(copy.read_text("utf-8"))
        return
    with closing(sqlite3.connect(copy)) as db:
        if db.execute("PRAGMA integrity_check(1)").fetchone()[0] != "ok":
            raise BackupError(f"{copy.name} in it is damaged")


def refuse_if_used(path: Path) -> None:
    """A gateway keeps its databases open as long as it runs."""
    with closing(sqlite3.connect(path, timeout=0, isolation_level=None)) as db:
        try:
            db.execute("PRAGMA locking_mode = EXCLUSIVE")
            db.execute("BEGIN EXCLUSIVE")
            db.execute("ROLLBACK")
        except sqlite3.OperationalError as error:
            raise BackupError(f"a gateway uses {path}; end it first") from error
        except sqlite3.DatabaseError:
            return  # it is damaged, and moved as it is


def move_former(folder: Path) -> Path | None:
    """Where the files of the folder are now; None where it has none."""
    found = list(files_of(folder))
    if not found:
        return None
    former = folder / f"before-restore-{time.strftime('%Y%m%d-%H%M%S')}"
    former.mkdir()
    for path in found:
        path.rename(former / path.name)
    return former


def files_of(folder: Path) -> Iterator[Path]:
    """With the journals of databases."""
    for path in folder.iterdir():
        if path.is_file() and not STAYS.fullmatch(path.name) and NAME.match(path.name):
            yield path
