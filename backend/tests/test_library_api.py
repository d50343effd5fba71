"""The library over HTTP: shapes, codes and sizes."""

import json
import threading
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from httpx2 import AsyncClient

from servodeck.api.library import MAX_TEXT
from servodeck.errors import PortMissingError
from servodeck.library.library import Library
from tests.fake_port import FakePorts
from tests.running import http_to

NOWHERE = FakePorts(PortMissingError("There is no such port."))
FACTS = {
    "kind": "group",
    "name": "Wave",
    "robot": "Arm",
    "tags": ["greeting"],
    "updatedAtMs": 1_790_000_000_000,
    "frames": 2,
    "durationMs": 1500,
    "unit": "us",
    "pose": [{"servo": 1, "position": 1500}],
}


def body(text: str = "{}", expected: int = 0, **more: object) -> dict[str, Any]:
    return {"text": text, "facts": FACTS, "expected": expected, "isRemoved": False, **more}


@asynccontextmanager
async def client_of(folder: Path) -> AsyncIterator[AsyncClient]:
    library = Library(folder)
    async with http_to(NOWHERE, time.monotonic, device=None, library=library) as (client, _):
        yield client
    library.close()


async def test_a_document_is_stored_listed_and_read(tmp_path: Path) -> None:
    async with client_of(tmp_path) as client:
        assert (await client.put("/api/library/a", json=body('{"x": "é"}'))).json() == {"revision": 1}
        listed = {"id": "a", "revision": 1, "isRemoved": False, "facts": FACTS}
        assert (await client.get("/api/library")).json() == {
            "documents": [listed],
            "damagedFile": None,
            "changesLost": False,
        }
        assert (await client.get("/api/library/a")).json() == {"text": '{"x": "é"}', "revision": 1}


async def test_a_lost_update_is_412_and_says_so(tmp_path: Path) -> None:
    async with client_of(tmp_path) as client:
        await client.put("/api/library/a", json=body('{"x":1}'))
        await client.put("/api/library/a", json=body('{"x":2}', 1))
        refused = await client.put("/api/library/a", json=body('{"x":3}', 1))
        assert (refused.status_code, refused.json()["code"]) == (412, "conflict")
        assert (await client.get("/api/library/a")).json()["text"] == '{"x":2}'


@pytest.mark.parametrize(("size", "is_set_aside"), [(1_000, False), (1_000_000, True)])
async def test_a_large_text_is_parsed_where_no_stop_waits_for_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, size: int, is_set_aside: bool
) -> None:
    parse, threads = json.loads, []

    def loads(text: bytes, **how: Any) -> object:
        threads.append(threading.current_thread())
        return parse(text, **how)

    async with client_of(tmp_path) as client:
        monkeypatch.setattr(json, "loads", loads)
        answer = await client.put("/api/library/a", json=body(json.dumps({"x": "y" * size})))
        monkeypatch.undo()
        assert answer.status_code == 200
        assert (threads[0] is not threading.main_thread()) == is_set_aside


@pytest.mark.parametrize(
    ("sent", "status", "parsed"),
    [
        (json.dumps(body(json.dumps({"x": [[]] * 200_000}))), 200, 1),
        ('{"facts":[' + "[]," * 200_000 + "[]]}", 413, 0),
        ('{"facts":[' + "[]," * 200_000, 422, 0),
    ],
    ids=["a text of many values", "many values around it", "many values without an end"],
)
async def test_no_stop_waits_for_objects_made_of_many_values(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, sent: str, status: int, parsed: int
) -> None:
    """Python makes them without letting another thread in between."""
    parse, texts = json.loads, []

    def loads(text: str, **how: Any) -> object:
        texts.append(text)
        return parse(text, **how)

    async with client_of(tmp_path) as client:
        monkeypatch.setattr(json, "loads", loads)
        headers = {"Content-Type": "application/json"}
        answer = await client.put("/api/library/a", content=sent, headers=headers)
        monkeypatch.undo()
        assert (answer.status_code, len(texts)) == (status, parsed)


async def test_trash_and_versions(tmp_path: Path) -> None:
    async with client_of(tmp_path) as client:
        await client.put("/api/library/a", json=body(isRemoved=True))
        assert (await client.get("/api/library")).json()["documents"][0]["isRemoved"] is True
        assert (await client.post("/api/library/restore", json={"ids": ["a"]})).status_code == 204
        assert (await client.get("/api/library")).json()["documents"][0]["isRemoved"] is False
        assert (await client.post("/api/library/remove", json={"ids": ["b"]})).status_code == 404
        version = {"name": "First", "atMs": 7, "text": '{"old":true}'}
        assert (await client.put("/api/library/a/versions/v", json=version)).status_code == 204
        assert (await client.get("/api/library/a/versions")).json() == [
            {"id": "v", "name": "First", "atMs": 7}
        ]
        assert (await client.get("/api/library/a/versions/v")).json() == {"text": '{"old":true}'}
        assert (await client.put("/api/library/a/versions/w", json=version)).status_code == 204
        assert (await client.delete("/api/library/a/versions/v")).status_code == 204
        assert (await client.delete("/api/library/a/versions/v")).status_code == 404
        assert [one["id"] for one in (await client.get("/api/library/a/versions")).json()] == ["w"]


@pytest.mark.parametrize("text", ["", "nonsense", "[]", "7", "[" * 100_000])
async def test_only_a_json_object_is_a_document(tmp_path: Path, text: str) -> None:
    async with client_of(tmp_path) as client:
        for path in ("/api/library/a", "/api/library/a/versions/v"):
            sent = body(text) if path.endswith("a") else {"name": "", "atMs": 0, "text": text}
            refused = await client.put(path, json=sent)
            assert (refused.status_code, refused.json()["code"]) == (422, "malformed")
        assert (await client.get("/api/library")).json()["documents"] == []


@pytest.mark.parametrize(
    "wrong",
    [
        {"expected": -1},
        {"text": 5},
        {"more": True},
        {"facts": {**FACTS, "name": "x" * 65}},
        {"facts": {**FACTS, "name": "\ud83d"}},
        {"facts": {**FACTS, "extra": 1}},
    ],
)
async def test_a_body_of_another_shape_is_refused(tmp_path: Path, wrong: dict[str, Any]) -> None:
    async with client_of(tmp_path) as client:
        content = json.dumps(body(**wrong))
        headers = {"content-type": "application/json"}
        refused = await client.put("/api/library/a", content=content, headers=headers)
        assert (refused.status_code, refused.json()["code"]) == (422, "malformed")
        assert (await client.get("/api/library")).json()["documents"] == []


async def test_sizes(tmp_path: Path) -> None:
    async with client_of(tmp_path) as client:
        large = '{"x":"' + "y" * (MAX_TEXT - 8) + '"}'
        assert (await client.put("/api/library/a", json=body(large))).status_code == 200
        assert (await client.put("/api/library/b", json=body(large + " "))).status_code == 422
        huge = await client.put("/api/library/b", json=body(large + "y" * MAX_TEXT))
        assert (huge.status_code, huge.json()["code"]) == (413, "tooLarge")
        elsewhere = await client.put("/api/port", json={"device": large})
        assert elsewhere.status_code == 413
        assert (await client.put(f"/api/library/{'i' * 65}", json=body())).status_code == 422


async def test_a_disk_in_trouble_answers_with_a_code_and_the_rest_works(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    async with client_of(tmp_path / "file") as client:
        refused = await client.put("/api/library/a", json=body())
        assert (refused.status_code, refused.json()["code"]) == (503, "storageFailed")
        assert (await client.get("/api/status")).status_code == 200
