"""The list of who may come in, in memory and in its file."""

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from servodeck.access.devices import FILE, MAX_DEVICES, DeviceFile, Devices, NoDeviceStore
from servodeck.callers import THIS_COMPUTER, as_script
from servodeck.errors import ForbiddenError, NotFoundError, OutOfRangeError, StorageError


def devices_in(folder: Path) -> Devices:
    return Devices(DeviceFile(folder), lambda: 7)


async def test_who_was_paired_is_known_after_a_restart_and_the_file_holds_no_secret(tmp_path: Path) -> None:
    devices = devices_in(tmp_path)
    anna, credential = devices.admit("device", "Anna", "owner")
    await devices.save()
    again = devices_in(tmp_path)
    found = again.find(credential)
    assert found
    assert found.caller == anna.caller
    assert credential.partition(".")[2].encode() not in (tmp_path / FILE).read_bytes()
    assert (tmp_path / FILE).stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("change", [lambda c: c[:-1], lambda c: c + "x", lambda c: c.partition(".")[0] + "."])
def test_only_the_whole_credential_counts(change: object) -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    _, credential = devices.admit("device", "Anna", "owner")
    assert callable(change)
    assert devices.find(change(credential)) is None
    for nothing in ("", ".", "x.y", "é"):
        assert devices.find(nothing) is None
    found = devices.find(credential)
    assert found
    assert found.last_seen_ms == 7


async def test_a_revoked_device_stays_out_after_a_restart(tmp_path: Path) -> None:
    devices = devices_in(tmp_path)
    devices.admit("device", "Anna", "owner")
    ben, credential = devices.admit("device", "Ben", "driver")
    await devices.save()
    devices.revoke(ben.id)
    assert devices.find(credential) is None
    await devices.save()
    assert devices_in(tmp_path).find(credential) is None
    with pytest.raises(NotFoundError):
        devices.revoke(ben.id)


def test_the_last_owner_can_neither_go_nor_step_down_and_a_token_is_no_owner() -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    anna, _ = devices.admit("device", "Anna", "owner")
    devices.admit("token", "Script", "owner")
    for act in (lambda: devices.revoke(anna.id), lambda: devices.change(anna.id, None, "viewer")):
        with pytest.raises(ForbiddenError, match="last owner"):
            act()
    assert devices.change(anna.id, "Anne", "owner").name == "Anne"
    ben, _ = devices.admit("device", "Ben", "viewer")
    devices.change(ben.id, None, "owner")
    devices.revoke(anna.id)


def test_a_stop_only_link_stays_one() -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    link, _ = devices.admit("stopLink", "On the robot", "stopper")
    with pytest.raises(ForbiddenError):
        devices.change(link.id, None, "driver")
    assert devices.change(link.id, "On the arm", None).role == "stopper"


def test_there_is_an_end_to_how_many() -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    for number in range(MAX_DEVICES):
        devices.admit("device", str(number), "viewer")
    with pytest.raises(OutOfRangeError):
        devices.admit("device", "one more", "viewer")


async def test_a_disk_in_trouble_keeps_no_device_out_that_is_in_memory(tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    devices = devices_in(folder)
    _, credential = devices.admit("device", "Anna", "owner")
    folder.write_text("in the way")
    with pytest.raises(StorageError):
        await devices.save()
    assert devices.find(credential)


@pytest.mark.parametrize("trouble", ["damaged", "newer"])
def test_an_unreadable_file_admits_no_device_and_is_left_alone(tmp_path: Path, trouble: str) -> None:
    path = tmp_path / FILE
    if trouble == "damaged":
        path.write_bytes(b"no database" * 500)
    else:
        with closing(sqlite3.connect(path)) as db:
            db.execute("PRAGMA user_version = 99")
    before = path.read_bytes()
    with pytest.raises(StorageError, match=FILE):
        devices_in(tmp_path)
    assert path.read_bytes() == before


def test_a_taken_name_gets_a_number() -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    long = "x" * 64
    names = [devices.admit("device", name, "viewer")[0].name for name in ("Android", "Android", long, long)]
    assert names == ["Android", "Android 2", long, "x" * 60 + " 2"]
    first, second, *_ = devices.all
    assert devices.change(second.id, "Ben", None).name == "Ben"
    assert devices.change(second.id, "Ben", None).name == "Ben"
    assert devices.change(first.id, "Ben", None).name == "Ben 2"


def test_no_device_gets_the_name_of_the_gateways_computer() -> None:
    devices = Devices(NoDeviceStore(), lambda: 7)
    local = (THIS_COMPUTER.name, as_script(THIS_COMPUTER).name)
    assert [devices.admit("device", name, "viewer")[0].name for name in local] == [
        "This computer 2",
        "A script on this computer 2",
    ]
