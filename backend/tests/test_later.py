"""Routes that a start does not wait for: who asks gets them all the same, and no other rule for them."""

import time

import pytest
from fastapi import APIRouter

from servodeck.api import app as app_module
from servodeck.api.app import PARTS, LaterApp, Part
from servodeck.api.routes import JudgingRoute
from tests.fake_port import FakePort, FakePorts
from tests.knocking import app_at, knock, scope_of
from tests.running import PORT, http_to
from tests.test_gate import headers_of

HEADERS = headers_of(f"127.0.0.1:{PORT}", None)


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.load.__name__)
def test_each_address_is_where_it_is_looked_for(part: Part) -> None:
    paths = [route.path for router in part.load() for route in router.routes]  # type: ignore[attr-defined]
    assert {path.removeprefix("/api").split("/")[1] for path in paths} == part.names


async def test_the_first_request_loads_its_part_and_no_other() -> None:
    guard = app_at()
    assert isinstance(guard.app, LaterApp)
    before = len(guard.app.routes)
    assert await knock(guard, scope_of("http", "GET", "/api/poses", HEADERS)) == 200
    paths = {getattr(route, "path", "") for route in guard.app.routes}
    assert len(paths) > before
    assert "/api/move" in paths
    assert "/api/library" not in paths


async def test_a_method_that_an_address_does_not_have_is_known_before_it_is_loaded() -> None:
    async with http_to(FakePorts(FakePort()), time.monotonic) as (client, _):
        answer = await client.delete("/api/library")
        assert (answer.status_code, answer.headers["allow"]) == (405, "GET")


async def test_a_part_that_names_no_role_is_not_served(monkeypatch: pytest.MonkeyPatch) -> None:
    open_to_all = APIRouter(route_class=JudgingRoute)
    open_to_all.add_api_route("/api/open", lambda: None)
    monkeypatch.setattr(app_module, "PARTS", (Part(lambda: (open_to_all,), frozenset({"open"})),))
    guard = app_at()
    for _ in range(2):
        with pytest.raises(TypeError, match="has to name one role"):
            await knock(guard, scope_of("http", "GET", "/api/open", HEADERS))
