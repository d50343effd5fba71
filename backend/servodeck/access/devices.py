"""Paired devices, script tokens and stop-only links, in memory and in a SQLite file of their own, which is
written after the answer. Makes and compares their secrets, of which only the SHA-256 is stored.

A look-up waits for no disk. The file is written as a whole, because it is short and seldom changes. Knows no
request and no invitation.

"""

import hashlib
import hmac
import itertools
import secrets
import sqlite3
import threading
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Literal, Protocol

from servodeck.callers import LOCAL_NAMES, Caller, Role
from servodeck.errors import (
    ForbiddenError,
    NotFoundError,
    OutOfRangeError,
    StorageError,
    TokenExpiredError,
)
from servodeck.files import storage_error
from servodeck.threads import in_thread
from servodeck.value import fields_of, value

Kind = Literal["device", "token", "stopLink"]
MAX_DEVICES = 500
MAX_NAME = 64
SECRET_BYTES = 24
EXPIRED = "This token has expired. An owner makes a new one on the page, under People."


@value
class Device:
    """`last_seen_ms` is None until its first request, `expires_at_ms` where it is valid until it is revoked.
    `expired_at_ms`: when it was found to have expired, from then on whatever the clock says.
    """

    id: str
    kind: Kind
    name: str
    role: Role
    digest: bytes
    paired_at_ms: int
    last_seen_ms: int | None = None
    expires_at_ms: int | None = None
    expired_at_ms: int | None = None

    @property
    def caller(self) -> Caller:
        return Caller(self.id, self.name, self.role)


class DeviceStore(Protocol):
    def load(self) -> list[Device]: ...

    def save(self, devices: Callable[[], list[Device]]) -> None:
        """In place of what was there. May be called from any thread. Raises a StorageError."""


class NoDeviceStore:
    """Where no device needs to be paired."""

    def load(self) -> list[Device]:
        return []

    def save(self, devices: Callable[[], list[Device]]) -> None:
        """Nothing is stored."""


class Devices:
    def __init__(self, store: DeviceStore, now_ms: Callable[[], int]) -> None:
        """Raises a StorageError where the file cannot be read: an old list must admit no device."""
        self._store = store
        self.now_ms = now_ms
        self._devices = {one.id: one for one in store.load()}

    @property
    def all(self) -> list[Device]:
        return list(self._devices.values())

    def admit(self, kind: Kind, name: str, role: Role, valid_ms: int | None = None) -> tuple[Device, str]:
        """A new one and its credential, which is not stored. `valid_ms` None: until it is revoked."""
        if len(self._devices) >= MAX_DEVICES:
            raise OutOfRangeError(f"{MAX_DEVICES} devices are paired, which is the limit. Revoke one first.")
        secret = make_secret()
        made_ms = self.now_ms()
        expires_at_ms = None if valid_ms is None else made_ms + valid_ms
        own_name, digest = self._unique_name(name), digest_of(secret)
        device = Device(make_id(), kind, own_name, role, digest, made_ms, expires_at_ms=expires_at_ms)
        self._put(device)
        return device, f"{device.id}.{secret}"

    def admit_again(self, kind: Kind, name: str, role: Role) -> tuple[Device, str]:
        """As `admit`, in place of those of that kind and name."""
        self._devices = {one.id: one for one in self.all if (one.kind, one.name) != (kind, name)}
        return self.admit(kind, name, role)

    def find(self, credential: str) -> Device | None:
        """The device of that credential, which counts as seen now. Raises TokenExpiredError."""
        name, _, secret = credential.partition(".")
        device = self._devices.get(name)
        if device is None or not matches(secret, device.digest):
            return None
        if self.expires_in_ms(device) == 0:
            raise TokenExpiredError(EXPIRED)
        seen = replace(device, last_seen_ms=self.now_ms())
        self._devices[name] = seen
        return seen

    def change(self, device: str, name: str | None, role: Role | None) -> Device:
        present = self.get(device)
        if role not in (None, present.role):
            if present.kind == "stopLink":
                raise ForbiddenError("A stop-only link can only stop.")
            self._keep_an_owner(present)
        own = self._unique_name(name, present) if name else present.name
        changed = replace(present, name=own, role=role or present.role)
        self._put(changed)
        return changed

    def revoke(self, device: str) -> None:
        present = self.get(device)
        self._keep_an_owner(present)
        self._devices = {one.id: one for one in self.all if one.id != device}

    async def save(self) -> None:
        """Writes the present state. Raises a StorageError; the change in memory stays."""
        await in_thread(lambda: self._store.save(lambda: self.all))

    def close(self) -> None:
        """Writes when each was last seen. Raises a StorageError."""
        self._store.save(lambda: self.all)

    def get(self, device: str) -> Device:
        found = self._devices.get(device)
        if found is None:
            raise NotFoundError("No such device is paired.")
        return found

    def role_of(self, device: str) -> Role | None:
        """None where it is not paired any more, or has expired."""
        found = self._devices.get(device)
        return None if found is None or self.expires_in_ms(found) == 0 else found.role

    def expires_in_ms(self, device: Device) -> int | None:
        """0 where it has expired; None where it never does."""
        if device.expired_at_ms is not None:
            return 0
        return None if device.expires_at_ms is None else max(0, device.expires_at_ms - self.now_ms())

    def expire(self) -> list[Device]:
        """Those that have expired since the last call; they stay in the list."""
        now_ms = self.now_ms()
        over = [one for one in self.all if one.expired_at_ms is None and self.expires_in_ms(one) == 0]
        for one in over:
            self._put(replace(one, expired_at_ms=now_ms))
        return over

    @property
    def next_expiry_ms(self) -> int | None:
        """From now until the next one expires."""
        waiting = (one for one in self.all if one.expired_at_ms is None)
        return min((left for one in waiting if (left := self.expires_in_ms(one)) is not None), default=None)

    def _unique_name(self, name: str, but: Device | None = None) -> str:
        """With a number behind it where the name is taken: a class has more than one Android. The name of the
        gateway's own computer is always taken.
        """
        taken = {one.name for one in self.all if one is not but} | LOCAL_NAMES
        names = (name if count == 1 else f"{name[: MAX_NAME - 4]} {count}" for count in itertools.count(1))
        return next(one for one in names if one not in taken)

    def _put(self, device: Device) -> None:
        # Another dictionary each time: a thread that writes may be going through the one before.
        self._devices = {**self._devices, device.id: device}

    def _keep_an_owner(self, leaving: Device) -> None:
        others = [one for one in self.all if is_owners(one) and one.id != leaving.id]
        if is_owners(leaving) and not others:
            raise ForbiddenError("This is the last owner. Make another device an owner first.")


def is_owners(device: Device) -> bool:
    return device.kind == "device" and device.role == "owner"


FILE = "devices.sqlite"
BUSY_S = 2.0
# Version 1 has no columns of expiry. It is read as it is, and replaced as a whole by the next write.
VERSION = 2
TABLE = (
    "CREATE TABLE IF NOT EXISTS device (id TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, "
    "role TEXT NOT NULL, digest BLOB NOT NULL, paired_at_ms INTEGER NOT NULL, last_seen_ms INTEGER, "
    "expires_at_ms INTEGER, expired_at_ms INTEGER)"
)


class DeviceFile:
    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        self._lock = threading.Lock()

    def load(self) -> list[Device]:
        """Raises a StorageError for a file that is damaged or of a newer Servodeck."""
        if not self._path.exists():
            return []
        try:
            with closing(self._open()) as db:
                return [Device(*row) for row in db.execute("SELECT * FROM device ORDER BY paired_at_ms, id")]
        except (sqlite3.Error, OSError) as error:
            raise self._unusable(error) from error

    def save(self, devices: Callable[[], list[Device]]) -> None:
        with self._lock:  # and read within it, so that an older list never overwrites a newer one
            try:
                self._path.parent.mkdir(parents=True, exist_ok=True)
                with closing(self._open()) as db:
                    write(db, devices())
            except sqlite3.Error as error:
                raise storage_error(error, FILE) from error
            except OSError as error:
                raise self._unusable(error) from error

    def _open(self) -> sqlite3.Connection:
        # No other account of this computer needs to read who is paired.
        self._path.touch(mode=0o600, exist_ok=True)
        db = sqlite3.connect(self._path, timeout=BUSY_S, isolation_level=None)
        try:
            if db.execute("PRAGMA user_version").fetchone()[0] > VERSION:
                raise StorageError(f"{self._path} was written by a newer Servodeck.")  # noqa: TRY301
            db.execute("PRAGMA synchronous = FULL")
            db.execute(TABLE)
        except BaseException:
            db.close()
            raise
        return db

    def _unusable(self, error: Exception) -> StorageError:
        return StorageError(
            f"{self._path} cannot be used: {error}. "
            "Move it away to start with an empty list of paired devices."
        )


def write(db: sqlite3.Connection, devices: list[Device]) -> None:
    db.execute("BEGIN IMMEDIATE")
    try:
        db.execute("DROP TABLE device")
        db.execute(TABLE)
        db.executemany("INSERT INTO device VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", map(fields_of, devices))
        db.execute(f"PRAGMA user_version = {VERSION}")
        db.execute("COMMIT")
    finally:
        if db.in_transaction:
            db.execute("ROLLBACK")


def make_secret() -> str:
    return secrets.token_urlsafe(SECRET_BYTES)


def make_id() -> str:
    return secrets.token_hex(8)


def digest_of(secret: str) -> bytes:
    """The stored form of a secret. A fast hash is enough, because the secret is random and long."""
    return hashlib.sha256(secret.encode()).digest()


def matches(secret: str, digest: bytes) -> bool:
    return hmac.compare_digest(digest_of(secret), digest)


def same(one: str, other: str) -> bool:
    return hmac.compare_digest(one.encode(), other.encode())
