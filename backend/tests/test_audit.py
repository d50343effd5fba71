"""The list of acts: each door that changes something leaves an entry, whoever comes through it, and a disk in
trouble prevents nothing.
"""

import asyncio
import csv
import io
import json
import sqlite3
from collections.abc import Callable
from contextlib import closing
from itertools import repeat
from pathlib import Path
from typing import Any, get_args

import pytest
from fastapi import FastAPI
from fastapi.routing import APIRoute

from servodeck.access import addresses
from servodeck.access.audit import MAX_ENTRIES, REPEAT_MS, WRITE_AFTER_S, Act, Audit, NoAuditStore
from servodeck.access.audit_file import FILE, AuditFile
from servodeck.access.devices import NoDeviceStore
from servodeck.access.guard import Guard
from servodeck.api import routes
from servodeck.api.websocket import ROLES as MESSAGES
from servodeck.api.websocket import take
from servodeck.errors import StorageError, StorageFullError
from servodeck.intents import (
    BoardMessage,
    CalibrateMessage,
    ContinueMessage,
    EraseMessage,
    FrameBody,
    GrantMessage,
    HeartbeatMessage,
    LeaseMessage,
    MoveMessage,
    PacketMessage,
    PlayMessage,
    ReadMessage,
    ReleaseMessage,
    ResumeMessage,
    RunMessage,
    SetSpeedMessage,
    StopGroupMessage,
    StopMessage,
    StopPlayingMessage,
    Target,
)
from servodeck.protocol.families import FAMILIES
from servodeck.protocol.packets import encode
from servodeck.protocol.values import Run
from servodeck.robot.acts import ACT_OF
from tests.client import ANNA, Client
from tests.downloading import AnsweringPort
from tests.knocking import app_at, roles_of_routes
from tests.running import PORT, entrance_to
from tests.scripted import script
from tests.test_people_api import Browser, lan
from tests.virtual_time import in_virtual_time, now

ROBOT = None
"""Noted where commands leave, not by the route."""
ACTS: dict[tuple[str, str], Act | None] = {
    ("PATCH", "/api/me"): "renamed",
    ("POST", "/api/pair"): "paired",
    ("POST", "/api/stop"): ROBOT,
    ("POST", "/api/resume"): ROBOT,
    ("POST", "/api/move"): ROBOT,
    ("POST", "/api/library/drafts"): "librarySaved",
    ("POST", "/api/fleet/stop"): "fleetStopped",
    ("POST", "/api/fleet/run"): "fleetAsked",
    ("POST", "/api/fleet/download"): "fleetAsked",
    ("POST", "/api/fleet/resume"): "fleetAsked",
    ("POST", "/api/fleet/tasks/{task}/retry"): "fleetAsked",
    ("POST", "/api/fleet/groups"): "fleetGrouped",
    ("PUT", "/api/fleet/cues"): "fleetGrouped",
    ("PUT", "/api/robot"): "robotChosen",
    ("PUT", "/api/board"): ROBOT,
    ("POST", "/api/poses/{pose}/apply"): ROBOT,
    ("POST", "/api/slots/{slot}/run"): ROBOT,
    ("POST", "/api/lease"): ROBOT,
    ("PUT", "/api/driver"): ROBOT,
    ("POST", "/api/erase"): ROBOT,
    ("POST", "/api/download"): ROBOT,
    ("DELETE", "/api/jobs/{job}"): ROBOT,
    ("POST", "/api/play"): ROBOT,
    ("DELETE", "/api/play"): ROBOT,
    ("POST", "/api/library/remove"): "libraryRemoved",
    ("POST", "/api/library/restore"): "libraryRestored",
    ("PUT", "/api/library/{document}"): "librarySaved",
    ("PUT", "/api/library/{document}/versions/{version}"): "librarySaved",
    ("DELETE", "/api/library/{document}/versions/{version}"): "librarySaved",
    ("PUT", "/api/port"): "portOpened",
    ("DELETE", "/api/port"): "portClosed",
    # It sends nothing, and opens again what it has closed.
    ("POST", "/api/port/listen"): None,
    ("PATCH", "/api/people/{person}"): "roleChanged",
    ("DELETE", "/api/people/{person}"): "revoked",
    ("POST", "/api/invites"): "invited",
    ("DELETE", "/api/invites/{invitation}"): "withdrew",
    ("POST", "/api/tokens"): "tokenMade",
    ("POST", "/api/stop-links"): "stopLinkMade",
}


def audit_of(app: object) -> Audit:
    assert isinstance(app, Guard)
    assert isinstance(app.app, FastAPI)
    audit = app.app.state.audit
    assert isinstance(audit, Audit)
    return audit


def acts_of(audit: Audit) -> list[tuple[Act, str | None, str, str, int]]:
    """Act, who, whom, about and count, the oldest first."""
    found = [(one.act, one.who, one.whom, one.about, one.count) for one in audit.find()]
    return found[::-1]


def test_every_route_that_changes_something_names_the_act_of_the_table() -> None:
    app = app_at()
    list(roles_of_routes())
    assert isinstance(app.app, FastAPI)
    app.app.load_all()  # type: ignore[attr-defined]
    found = {
        (method, route.path): [each.act for each in routes.leaves_of(route.dependant)]
        for route in app.app.routes
        if isinstance(route, APIRoute)
        for method in route.methods or ()
        if method not in routes.READING
    }
    assert found == {key: [act] for key, act in ACTS.items()}


def test_a_route_that_changes_something_and_names_no_act_keeps_the_gateway_from_starting() -> None:
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.router.route_class = routes.JudgingRoute
    app.get("/read", dependencies=[routes.PUBLIC])(lambda: None)
    app.post("/noted", dependencies=[routes.PUBLIC, routes.leaves("revoked")])(lambda: None)
    routes.require_roles(app.routes)
    app.post("/forgotten", dependencies=[routes.PUBLIC])(lambda: None)
    with pytest.raises(TypeError, match="/forgotten"):
        routes.require_roles(app.routes)


FRAMES = [FrameBody(duration_ms=1500, positions={"1": 1500})] * 2
RUN_PACKET = encode(Run(3, 1), FAMILIES["doc"]).hex()
Make = Callable[[str], Any]
# What each message leaves, of those that take effect at once on a board that is open and at rest.
MESSAGE_ACTS: dict[type, tuple[Make, list[str]]] = {
    MoveMessage: (
        lambda nonce: MoveMessage(
            type="move", id=1, targets=[Target(servo=1, position=1500)], duration_ms=1500, nonce=nonce
        ),
        ["moved"],
    ),
    PlayMessage: (
        lambda nonce: PlayMessage(type="play", id=1, frames=FRAMES, times=1, loop_from=0, nonce=nonce),
        ["played"],
    ),
    RunMessage: (lambda nonce: RunMessage(type="run", id=1, slot=3, times=1, nonce=nonce), ["ran"]),
    StopGroupMessage: (lambda _: StopGroupMessage(type="stopGroup", id=1), ["endedGroup"]),
    PacketMessage: (lambda nonce: PacketMessage(type="packet", id=1, bytes=RUN_PACKET, nonce=nonce), ["ran"]),
    StopMessage: (lambda _: StopMessage(type="stop"), ["stopped"]),
    EraseMessage: (lambda nonce: EraseMessage(type="erase", id=1, nonce=nonce), ["erased"]),
    SetSpeedMessage: (
        lambda nonce: SetSpeedMessage(type="setSpeed", id=1, slot=3, percent=50, nonce=nonce),
        ["setSpeed"],
    ),
    ReleaseMessage: (
        lambda nonce: ReleaseMessage(type="release", id=1, servos=[1], nonce=nonce),
        ["unpowered"],
    ),
    BoardMessage: (lambda _: BoardMessage(type="board", id=1, board="lsc-16"), ["boardChosen"]),
    CalibrateMessage: (lambda _: CalibrateMessage(type="calibrate", servo=1), ["calibrated"]),
    LeaseMessage: (lambda _: LeaseMessage(type="lease", action="release"), ["leftLease"]),
}
# They need another state before, and are tried below; or change nothing.
OTHERWISE = {
    ResumeMessage,
    GrantMessage,
    ContinueMessage,
    StopPlayingMessage,
}
CHANGES_NOTHING = {ReadMessage, HeartbeatMessage}


def test_every_message_is_tried() -> None:
    assert MESSAGE_ACTS.keys() | OTHERWISE | CHANGES_NOTHING == MESSAGES.keys()
    assert set(ACT_OF.values()) <= set(get_args(get_args(Act)[0]) or get_args(Act))


@pytest.mark.parametrize("kind", MESSAGE_ACTS, ids=lambda kind: kind.__name__)
@in_virtual_time
async def test_every_message_leaves_its_act_in_the_name_of_its_sender(kind: type) -> None:
    board = "bus-ctrl" if kind is ReleaseMessage else "lsc-16" if kind is SetSpeedMessage else "doc"
    async with script(board=board) as here:
        page = Client(here.control)
        take(LeaseMessage(type="lease", action="request"), page, here.control)
        make, expected = MESSAGE_ACTS[kind]
        before = len(acts_of(audit_of(here.app)))
        take(make(str(page.nonce)), page, here.control)
        await asyncio.sleep(0.5)
        found = acts_of(audit_of(here.app))[before:]
        assert [(act, who) for act, who, *_ in found] == [(act, "This computer") for act in expected]


@in_virtual_time
async def test_the_messages_that_need_something_before_them() -> None:
    async with script() as here:
        page, anna = Client(here.control), Client(here.control, ANNA)
        take(LeaseMessage(type="lease", action="request"), page, here.control)
        take(RunMessage(type="run", id=1, slot=3, times=0, nonce=str(page.nonce)), page, here.control)
        await asyncio.sleep(0.5)
        take(ContinueMessage(type="continue", for_ms=60_000), page, here.control)
        take(StopMessage(type="stop"), page, here.control)
        await asyncio.sleep(0.5)
        take(ResumeMessage(type="resume"), page, here.control)
        await asyncio.sleep(2)
        play = PlayMessage(type="play", id=3, frames=FRAMES, times=0, loop_from=0, nonce=str(page.nonce))
        take(play, page, here.control)
        await asyncio.sleep(0.1)
        take(StopPlayingMessage(type="stopPlaying"), anna, here.control)
        take(GrantMessage(type="grant", to=ANNA.id), page, here.control)
        assert [(act, who, about) for act, who, _, about, _ in acts_of(audit_of(here.app))] == [
            ("tookLease", "This computer", ""),
            ("ran", "This computer", "3"),
            ("allowedUnattended", "This computer", ""),
            ("stopped", "This computer", ""),
            ("resumed", "This computer", ""),
            ("played", "This computer", ""),
            ("endedGroup", "Anna", ""),
            ("leftLease", "This computer", ""),
            ("tookLease", "Anna", ""),
        ]


@in_virtual_time
async def test_a_span_of_driving_is_one_entry_with_a_count_and_a_download_one_at_its_end() -> None:
    async with script(behind=AnsweringPort(repeat([46]))) as here:
        for duration_ms, position in ((1500, 1000), (900, 1100), (900, 1200)):
            await here.move(duration_ms, s1=position)
            await asyncio.sleep(1.6)
        await asyncio.sleep(5)
        await here.download(5, 6)
        await asyncio.sleep(20)
        found = acts_of(audit_of(here.app))
        assert [(act, who, about, count) for act, who, _, about, count in found][:2] == [
            ("tookLease", "Dance", "", 2),
            ("moved", "Dance", "", 3),
        ]
        assert ("downloaded", "Dance", "", "5, 6", 1) in found
        page = Client(here.control, ANNA)
        take(LeaseMessage(type="lease", action="request"), page, here.control)
        take(LeaseMessage(type="lease", action="release"), page, here.control)
        await here.move(1500, s1=1300)
        assert [one for one in acts_of(audit_of(here.app)) if one[0] == "moved"] == [
            ("moved", "Dance", "", "", 3),
            ("moved", "Dance", "", "", 1),
        ]


@in_virtual_time
async def test_a_stop_that_no_person_pressed_says_why() -> None:
    async with script() as here:
        page = Client(here.control)
        await page.send(encode(Run(3, 0), FAMILIES["doc"]))
        page.beats = False
        await asyncio.sleep(30)
        assert ("stopped", None, "", "silence", 1) in acts_of(audit_of(here.app))


@in_virtual_time
async def test_what_owners_do_is_noted_with_names_of_that_time_and_no_secret() -> None:
    entrance = entrance_to(addresses.lan(PORT, "robot"), now)
    async with script() as here:
        owner = here.owner
        ask = here.client.request
        made = (await here.post("tokens", owner=True, name="Fair", role="driver")).json()
        person = f"/api/people/{made['id']}"
        await ask("PATCH", person, json={"role": "viewer"}, headers=owner)
        await ask("PATCH", person, json={"name": "Show"}, headers=owner)
        await ask("DELETE", person, headers=owner)
        await ask("DELETE", person, headers=owner)
        invited = (await here.post("invites", owner=True, role="driver", name="Ben")).json()
        await ask("DELETE", f"/api/invites/{invited['id']}", headers=owner)
        link = (await here.post("stop-links", owner=True, name="On the robot")).json()
        assert acts_of(audit_of(here.app)) == [
            ("tokenMade", "Olga", "Fair", "driver", 1),
            ("roleChanged", "Olga", "Fair", "viewer", 1),
            ("renamed", "Olga", "Fair", "Show", 1),
            ("revoked", "Olga", "Show", "", 1),
            ("invited", "Olga", "Ben", "driver", 1),
            ("withdrew", "Olga", "", "", 1),
            ("stopLinkMade", "Olga", "On the robot", "", 1),
        ]
        text = (await here.client.get("/api/audit/file?format=jsonl", headers=owner)).text
        for secret in (made["token"], invited["code"], invited["link"], link["link"], "127.0.0.1"):
            assert secret not in text
    assert entrance.pairing.open == []


@in_virtual_time
async def test_a_revocation_that_cannot_be_stored_has_taken_effect_and_is_noted() -> None:
    class Full(NoDeviceStore):
        def save(self, devices: object) -> None:
            raise StorageFullError("The disk of the data folder is full.")

    async with script(store=Full()) as here:
        answer = await here.client.delete(f"/api/people/{here.token_id}", headers=here.owner)
        assert answer.status_code == 507
        assert (await here.client.get("/api/status")).status_code == 401
        assert acts_of(audit_of(here.app)) == [("revoked", "Olga", "Dance", "", 1)]


@in_virtual_time
async def test_who_is_let_in_and_guessed_codes_which_are_one_entry() -> None:
    async with lan() as (_, client, owner):
        made = await owner.invite("viewer", "Ben")
        await Browser(client).pair(secret=made["link"].partition("=")[2])
        await owner.invite("driver")
        for guess in range(50):
            await Browser(client).pair(code=f"{guess:08}")
            await asyncio.sleep(30)
        found = (await owner.ask("GET", "/api/audit")).json()
    acts = [(one["act"], one["who"], one["about"], one["count"]) for one in found["entries"]]
    assert acts == [
        ("pairRefused", None, "", 50),
        ("invited", "Anna", "driver", 1),
        ("paired", "Ben", "viewer", 1),
        ("invited", "Anna", "viewer", 1),
        ("paired", "Anna", "owner", 1),
    ]


@in_virtual_time
async def test_pages_and_filters() -> None:
    async with script() as here:
        audit = audit_of(here.app)
        for number in range(7):
            audit.note("ran", "Ben" if number % 2 else "Cleo", str(number))

        async def page(**query: str | int) -> tuple[list[str], bool]:
            answer = await here.client.get("/api/audit", params=query, headers=here.owner)
            assert answer.status_code == 200, answer.text
            read = answer.json()
            assert read["names"] == ["Ben", "Cleo"]
            return [one["about"] for one in read["entries"]], read["more"]

        assert await page(limit=3) == (["6", "5", "4"], True)
        assert await page(limit=3, before=5) == (["3", "2", "1"], True)
        assert await page(limit=3, before=2) == (["0"], False)
        assert await page(who="Ben") == (["5", "3", "1"], False)
        assert await page(act="stopped") == ([], False)
        assert (await here.client.get("/api/audit")).status_code == 403
        assert (await here.client.get("/api/audit?act=x", headers=here.owner)).status_code == 422


def test_a_name_becomes_no_formula_in_a_spreadsheet() -> None:
    from servodeck.access.audit_file import as_csv, as_json_lines

    audit = Audit(NoAuditStore(), lambda: 1_795_284_000_000)
    for name in ('=HYPERLINK("x")', "+1", "-1", "@x", "\tx", 'An"na, B', "Anna"):
        audit.note("stopped", name)
    rows = list(csv.DictReader(io.StringIO(as_csv(audit.find()))))
    assert [row["who"] for row in rows][::-1] == [
        *('\'=HYPERLINK("x")', "'+1", "'-1", "'@x", "'\tx", 'An"na, B', "Anna")
    ]
    assert rows[0]["at"] == "2026-11-21T18:00:00.000+00:00"
    lines = [json.loads(line) for line in as_json_lines(audit.find()).splitlines()]
    assert lines[-1]["who"] == '=HYPERLINK("x")'


async def test_ten_thousand_stay_also_after_a_restart(tmp_path: Path) -> None:
    audit = Audit(AuditFile(tmp_path), lambda: 5)
    for number in range(MAX_ENTRIES + 50):
        audit.note("ran", "Anna", str(number))
    audit.close()
    for found in (audit, Audit(AuditFile(tmp_path), lambda: 6)):
        kept = [one.about for one in found.find()]
        assert (len(kept), kept[0], kept[-1]) == (MAX_ENTRIES, str(MAX_ENTRIES + 49), "50")
    assert (tmp_path / FILE).stat().st_mode & 0o077 == 0
    with closing(sqlite3.connect(tmp_path / FILE)) as db:
        assert db.execute("SELECT COUNT(*), MIN(id) FROM entry").fetchone() == (MAX_ENTRIES, 51)


@in_virtual_time
async def test_it_is_written_a_while_later_and_only_what_changed(tmp_path: Path) -> None:
    written: list[list[str]] = []

    class Watched(AuditFile):
        def save(self, changed: Any, oldest_id: int) -> None:
            written.append([one.about for one in changed])
            super().save(changed, oldest_id)

    audit = Audit(Watched(tmp_path), lambda: round(now() * 1000))
    audit.note("ran", "Anna", "1")
    audit.note("ran", "Anna", "2")
    assert not written
    await asyncio.sleep(WRITE_AFTER_S + 0.1)
    audit.note("ran", "Anna", "2")
    await asyncio.sleep(WRITE_AFTER_S + 0.1)
    assert written == [["1", "2"], ["2"]]
    assert [one.count for one in Audit(AuditFile(tmp_path), lambda: 0).find()] == [2, 1]
    await asyncio.sleep(REPEAT_MS / 1000 + 1)
    audit.note("ran", "Anna", "2")
    assert [one.count for one in audit.find()] == [1, 2, 1]
    audit.close()


@in_virtual_time
async def test_a_disk_in_trouble_delays_nothing_and_the_list_says_so(tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    folder.write_text("in the way")
    audit = Audit(AuditFile(folder), lambda: round(now() * 1000))
    audit.note("stopped", "Anna")
    await asyncio.sleep(WRITE_AFTER_S + 0.1)
    assert audit.problem
    assert [one.who for one in audit.find()] == ["Anna"]
    folder.unlink()
    audit.note("resumed", "Ben")
    await asyncio.sleep(WRITE_AFTER_S + 0.1)
    assert audit.problem is None
    assert [one.who for one in Audit(AuditFile(folder), lambda: 0).find()] == ["Ben", "Anna"]
    audit.close()


@pytest.mark.parametrize("trouble", ["damaged", "newer"])
async def test_a_file_that_cannot_be_read_is_left_alone(tmp_path: Path, trouble: str) -> None:
    path = tmp_path / FILE
    if trouble == "damaged":
        path.write_bytes(b"no database" * 500)
    else:
        with closing(sqlite3.connect(path)) as db:
            db.execute("PRAGMA user_version = 99")
    before = path.read_bytes()
    with pytest.raises(StorageError, match=FILE):
        AuditFile(tmp_path).load()
    audit = Audit(AuditFile(tmp_path), lambda: 0)
    audit.note("stopped", "Anna")
    assert audit.problem
    audit.close()
    assert path.read_bytes() == before
    assert [one.who for one in audit.find()] == ["Anna"]
