"""The assembled gateway: who gets in on every route, headers, the page, the documentation, errors."""

import gc
import gzip
import os
import re
import time
import weakref
from pathlib import Path
from typing import Any

import pytest
from opentelemetry import trace
from opentelemetry.trace import NoOpTracer, Tracer, TracerProvider
from starlette.types import ASGIApp

from servodeck.api.app import create_app
from servodeck.errors import PortMissingError
from servodeck.robot.control import Control
from tests.fake_port import FakePorts
from tests.knocking import knock, roles_of_routes, scope_of
from tests.running import NO_LIBRARY, PORT, entrance_to, http_to
from tests.test_gate import headers_of

NOWHERE = FakePorts(PortMissingError("There is no such port."))
SCRIPT = "export const answer = 42;\n" * 200
AS_GZIP = gzip.compress(SCRIPT.encode())
AS_BROTLI = b"any bytes: the gateway reads none of them"


@pytest.fixture(scope="module")
def app() -> ASGIApp:
    return create_app(Control(NOWHERE, time.monotonic, "doc"), NO_LIBRARY, entrance_to())


@pytest.mark.parametrize(
    ("method", "path"),
    [
        (method, path)
        for method, path, _ in roles_of_routes()
        if path.startswith("/api/") and method != "WS"  # a link leads to no socket
    ],
)
async def test_a_link_of_another_site_reaches_no_route_that_acts(
    app: ASGIApp, method: str, path: str
) -> None:
    followed = [(b"sec-fetch-site", b"cross-site"), (b"sec-fetch-mode", b"navigate")]
    headers = headers_of(f"127.0.0.1:{PORT}", None) + followed
    assert await knock(app, scope_of("http", method, path, headers)) == 403
    assert await knock(app, scope_of("http", "GET", "/docs", headers)) == 200


def test_a_gateway_without_references_is_freed() -> None:
    control = Control(NOWHERE, time.monotonic, "doc")
    create_app(control, NO_LIBRARY, entrance_to())
    gone = weakref.ref(control)
    del control
    gc.collect()
    assert gone() is None


async def test_every_answer_carries_the_security_headers() -> None:
    async with http_to(NOWHERE, time.monotonic, device=None) as (client, _):
        for path in ("/", "/docs", "/api/health", "/unknown"):
            headers = (await client.get(path)).headers
            policy = headers["content-security-policy"]
            assert policy.startswith(
                "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
            )
            assert f"connect-src 'self' ws://127.0.0.1:{PORT};" in policy
            assert "frame-ancestors 'none'" in policy
            assert "unsafe" not in policy.replace("'wasm-unsafe-eval'", "")
            assert headers["x-content-type-options"] == "nosniff"
            assert headers["referrer-policy"] == "no-referrer"
            assert headers["cross-origin-opener-policy"] == "same-origin"
            assert headers["cross-origin-resource-policy"] == "same-origin"
            assert headers["permissions-policy"] == "serial=(self), hid=(self), camera=(self)"
        refused = await client.get("/api/health", headers={"host": "evil.example"})
        assert refused.status_code == 403
        assert refused.json()["code"] == "forbidden"
        assert "evil" not in refused.headers["content-security-policy"]


@pytest.mark.parametrize(
    ("method", "path", "kwargs", "status", "code"),
    [
        ("GET", "/api/nothing", {}, 404, "notFound"),
        ("GET", "/nothing.js", {}, 404, "notFound"),
        ("PATCH", "/api/port", {}, 405, "methodNotAllowed"),
        ("PUT", "/api/port", {"json": {}}, 422, "malformed"),
        ("PUT", "/api/port", {"json": {"device": "/dev/x", "more": 1}}, 422, "malformed"),
        ("PUT", "/api/port", {"json": {"device": 5}}, 422, "malformed"),
        ("PUT", "/api/port", {"json": {"device": "/dev/x", "board": "toaster"}}, 422, "outOfRange"),
        ("PUT", "/api/port", {"json": {"device": "/dev/\nx"}}, 422, "malformed"),
        (
            "PUT",
            "/api/port",
            {"content": b"{", "headers": {"content-type": "application/json"}},
            422,
            "malformed",
        ),
        ("PUT", "/api/port", {"content": b'{"device": "/dev/x"}'}, 415, "wrongType"),
        ("PUT", "/api/port", {"json": {"device": "x" * 20_000}}, 413, "tooLarge"),
        ("PUT", "/api/port", {"json": {"device": "/dev/x"}}, 503, "portMissing"),
        ("POST", "/api/stop", {}, 409, "closed"),
    ],
)
async def test_every_error_has_one_shape(
    method: str, path: str, kwargs: dict[str, Any], status: int, code: str
) -> None:
    async with http_to(NOWHERE, time.monotonic, device=None) as (client, control):
        answer = await client.request(method, path, **kwargs)
        assert answer.status_code == status
        assert answer.json()["code"] == code
        assert set(answer.json()) == {"code", "detail"}
        await control.board.link.close()


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("PATCH", "/api/port", "DELETE, PUT"),
        ("POST", "/api/library/a", "GET, PUT"),
        ("POST", "/api/library/a/versions/b", "DELETE, GET, PUT"),
        ("GET", "/api/stop", "POST"),
        ("POST", "/docs", "GET"),
        ("POST", "/index.html", "GET, HEAD"),
    ],
)
async def test_a_refused_method_gets_all_allowed_ones(method: str, path: str, allowed: str) -> None:
    async with http_to(NOWHERE, time.monotonic, device=None) as (client, _):
        answer = await client.request(method, path)
        assert (answer.status_code, answer.headers["allow"]) == (405, allowed)


async def test_no_telemetry_leaves_even_if_the_environment_requests_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The framework would send its measurements to the address in a variable."""
    monkeypatch.setenv("FASTAPI_OTEL_AUTO_CONFIGURE", "true")
    monkeypatch.setenv("OTEL_EXPORTER_OTLP_ENDPOINT", "http://127.0.0.1:9")
    measured = []

    class Provider(TracerProvider):
        def get_tracer(self, *_args: object, **_more: object) -> Tracer:
            measured.append(1)
            return NoOpTracer()

    monkeypatch.setattr(trace, "get_tracer_provider", Provider)
    async with http_to(NOWHERE, time.monotonic, device=None) as (client, _):
        assert (await client.get("/api/health")).status_code == 200
    assert measured == []


@pytest.fixture
def built(tmp_path: Path) -> Path:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<!doctype html><title>Servodeck</title>")
    script = tmp_path / "assets" / "page-1a2b3c.js"
    script.write_text(SCRIPT)
    script.with_name("page-1a2b3c.js.gz").write_bytes(AS_GZIP)
    script.with_name("page-1a2b3c.js.br").write_bytes(AS_BROTLI)
    (tmp_path / "sw.js").write_text("self.x = 1;")
    return tmp_path


async def test_the_page_is_revalidated_and_hashed_files_are_cached(built: Path) -> None:
    async with http_to(NOWHERE, time.monotonic, device=None, static=built) as (client, _):
        page = await client.get("/")
        assert page.text.startswith("<!doctype html>")
        assert page.headers["content-type"].startswith("text/html")
        assert page.headers["cache-control"] == "no-cache"
        again = await client.get("/", headers={"if-none-match": page.headers["etag"]})
        assert again.status_code == 304
        script = await client.get("/assets/page-1a2b3c.js")
        assert script.headers["cache-control"] == "public, max-age=31536000, immutable"
        assert script.headers["content-type"].startswith("text/javascript")
        assert (await client.get("/sw.js")).headers["cache-control"] == "no-cache"
        assert (await client.get("/../pyproject.toml")).status_code == 404
        assert (await client.get("/%2e%2e/%2e%2e/pyproject.toml")).status_code == 404


@pytest.mark.parametrize(
    ("accepts", "encoding"),
    [
        ("gzip, deflate, br, zstd", "br"),
        ("gzip, deflate", "gzip"),
        ("GZIP;q=0.5, br;q=0", "gzip"),
        ("br;q=0, *;q=0.1", "gzip"),
        ("*", "br"),
        ("identity", None),
        ("gzip;q=0, br;q=none", None),
        ("", None),
    ],
)
async def test_a_script_comes_as_the_browser_takes_it(
    built: Path, accepts: str, encoding: str | None
) -> None:
    path = "/assets/page-1a2b3c.js"
    async with http_to(NOWHERE, time.monotonic, device=None, static=built) as (client, _):
        asked = {"accept-encoding": accepts}
        async with client.stream("GET", path, headers=asked) as answer:
            raw = b"".join([part async for part in answer.aiter_raw()])
        assert answer.headers.get("content-encoding") == encoding
        assert raw == {"br": AS_BROTLI, "gzip": AS_GZIP, None: SCRIPT.encode()}[encoding]
        assert answer.headers["content-length"] == str(len(raw))
        assert answer.headers["content-type"].startswith("text/javascript")
        assert answer.headers["vary"] == "Accept-Encoding"
        assert answer.headers["cache-control"] == "public, max-age=31536000, immutable"
        head = await client.head(path, headers=asked)
        assert (head.content, dict(head.headers)) == (b"", dict(answer.headers))
        known = {**asked, "if-none-match": answer.headers["etag"]}
        again = await client.get(path, headers=known)
        assert (again.status_code, again.headers["vary"]) == (304, "Accept-Encoding")
        other = {**known, "accept-encoding": "gzip" if encoding != "gzip" else "br"}
        assert (await client.head(path, headers=other)).status_code == 200


async def test_a_new_page_of_the_same_size_and_time_is_not_taken_for_the_old_one(built: Path) -> None:
    index = built / "index.html"
    async with http_to(NOWHERE, time.monotonic, device=None, static=built) as (client, _):
        old = await client.get("/")
        was = index.stat()
        index.write_text(old.text.replace("Servodeck", "Newerdeck"))
        os.utime(index, ns=(was.st_atime_ns, was.st_mtime_ns))
        new = await client.get("/", headers={"if-none-match": old.headers["etag"]})
        assert (new.status_code, "Newerdeck" in new.text) == (200, True)
        same = await client.get("/", headers={"if-none-match": new.headers["etag"]})
        assert same.status_code == 304


async def test_an_unbuilt_page_says_how_to_build_it(tmp_path: Path) -> None:
    async with http_to(NOWHERE, time.monotonic, device=None, static=tmp_path / "none") as (client, _):
        answer = await client.get("/")
        assert answer.status_code == 503
        assert "npm run build" in answer.text
        assert (await client.get("/other")).status_code == 404


async def test_the_documentation_needs_no_script_and_no_other_host() -> None:
    async with http_to(NOWHERE, time.monotonic, device=None) as (client, _):
        page = (await client.get("/docs")).text
        assert "<script" not in page
        assert re.findall(r'(?:href|src)="([^#"][^"]*)"', page) == ["docs.css", "openapi.json"]
        assert 'style="' not in page
        described = (await client.get("/openapi.json")).json()
        for path in described["paths"]:
            assert path in page
        assert (await client.get("/docs.css")).headers["content-type"].startswith("text/css")
        for methods in described["paths"].values():
            for operation in methods.values():
                assert operation["description"]
