"""Who gets in: every route times Hosts, Origins, credentials and modes, against a rule written a second time,
and the table of who may do what. A route that is added has to be added here.
"""

from itertools import product

import pytest
from fastapi import FastAPI

from servodeck.access import addresses
from servodeck.access.addresses import Access, Mode
from servodeck.access.entrance import PAGE_BURST, Entrance
from servodeck.api import routes
from servodeck.callers import RANKS, Role
from tests.knocking import all_routes, app_at, knock, roles_of_routes, scope_of
from tests.running import PORT, entrance_to
from tests.test_gate import headers_of

PUBLIC = None
ROLES: dict[tuple[str, str], Role | None] = {
    ("GET", "/docs"): PUBLIC,
    ("GET", "/docs.css"): PUBLIC,
    ("GET", "/openapi.json"): PUBLIC,
    ("GET", "/api/health"): PUBLIC,
    ("GET", "/api/me"): PUBLIC,
    ("POST", "/api/pair"): PUBLIC,
    ("PATCH", "/api/me"): "viewer",
    ("POST", "/api/stop"): "stopper",
    ("WS", "/ws"): "viewer",
    ("GET", "/metrics"): "viewer",
    ("GET", "/api/status"): "viewer",
    ("GET", "/api/battery"): "viewer",
    ("GET", "/api/cameras"): "viewer",
    ("GET", "/api/cameras/{camera_id}/stream"): "viewer",
    ("GET", "/api/poses"): "viewer",
    ("GET", "/api/events"): "viewer",
    ("GET", "/api/library"): "viewer",
    ("GET", "/api/library/{document}"): "viewer",
    ("GET", "/api/library/{document}/versions"): "viewer",
    ("GET", "/api/library/{document}/versions/{version}"): "viewer",
    ("DELETE", "/api/library/{document}/versions/{version}"): "driver",
    ("PUT", "/api/library/{document}"): "driver",
    ("PUT", "/api/library/{document}/versions/{version}"): "driver",
    ("POST", "/api/library/drafts"): "viewer",
    ("GET", "/api/fleet"): "viewer",
    ("WS", "/api/fleet/robots/{robot}/drive"): "driver",
    ("POST", "/api/fleet/stop"): "stopper",
    ("POST", "/api/fleet/run"): "driver",
    ("POST", "/api/fleet/download"): "driver",
    ("POST", "/api/fleet/resume"): "driver",
    ("POST", "/api/fleet/tasks/{task}/retry"): "driver",
    ("POST", "/api/fleet/groups"): "driver",
    ("PUT", "/api/fleet/cues"): "driver",
    ("POST", "/api/library/restore"): "driver",
    ("POST", "/api/resume"): "driver",
    ("POST", "/api/move"): "driver",
    ("PUT", "/api/robot"): "driver",
    ("PUT", "/api/board"): "driver",
    ("POST", "/api/poses/{pose}/apply"): "driver",
    ("POST", "/api/slots/{slot}/run"): "driver",
    ("POST", "/api/lease"): "driver",
    ("PUT", "/api/driver"): "driver",
    ("POST", "/api/erase"): "owner",
    ("POST", "/api/download"): "driver",
    ("POST", "/api/play"): "driver",
    ("DELETE", "/api/play"): "driver",
    ("GET", "/api/jobs/{job}"): "viewer",
    ("DELETE", "/api/jobs/{job}"): "driver",
    ("POST", "/api/library/remove"): "owner",
    ("GET", "/api/ports"): "owner",
    ("PUT", "/api/port"): "owner",
    ("DELETE", "/api/port"): "owner",
    ("POST", "/api/port/listen"): "owner",
    ("GET", "/api/people"): "owner",
    ("GET", "/api/audit"): "owner",
    ("GET", "/api/audit/file"): "owner",
    ("PATCH", "/api/people/{person}"): "owner",
    ("DELETE", "/api/people/{person}"): "owner",
    ("POST", "/api/invites"): "owner",
    ("DELETE", "/api/invites/{invitation}"): "owner",
    ("POST", "/api/tokens"): "owner",
    ("POST", "/api/stop-links"): "owner",
}

# A program has no cookie to be given, and its token a name already.
FOR_BROWSERS = {("POST", "/api/pair"), ("PATCH", "/api/me")}

OWN_ADDRESS = "192.168.1.5"
MODES: dict[Mode, Access] = {
    "local": addresses.local(PORT),
    "lan": addresses.lan(PORT, "Robot"),
    "proxy": addresses.behind_proxy("https://robot.example"),
}
GOOD: dict[Mode, set[str]] = {
    "local": {f"127.0.0.1:{PORT}", f"localhost:{PORT}", f"[::1]:{PORT}"},
    "lan": {f"{name}:{PORT}" for name in ("127.0.0.1", "localhost", "[::1]", OWN_ADDRESS, "robot.local")},
    "proxy": {"robot.example"},
}
HOSTS: list[str | None] = [
    f"127.0.0.1:{PORT}",
    f"localhost:{PORT}",
    f"[::1]:{PORT}",
    f"{OWN_ADDRESS}:{PORT}",
    f"192.168.1.6:{PORT}",
    f"robot.local:{PORT}",
    "robot.example",
    f"robot.example:{PORT}",
    f"LOCALHOST:{PORT}",
    "evil.example",
    f"localhost:{PORT}.evil.example",
    None,
]
# {host} is the value of the Host header.
ORIGINS: list[str | None] = [
    None,
    "http://{host}",
    "https://{host}",
    "http://evil.example",
    "https://robot.example.evil.example",
    "http://{host}.evil.example",
    f"http://{OWN_ADDRESS}:9000",
    "null",
    "",
    "{host}",
]
CREDENTIALS = ("none", "cookie", "bearer", "forged")


def may_pass(mode: Mode, host: str | None, origin: str | None, credential: str, role: Role | None) -> int:
    """The rule, written again: 0 for welcome, else the refusal's status."""
    own = ("https://" if mode == "proxy" else "http://") + (host or "")
    if host not in GOOD[mode] or origin not in (None, own):
        return 403
    proved = credential == ("bearer" if origin is None else "cookie")
    return 0 if mode == "local" or role is PUBLIC or proved else 401


def credentials_of(entrance: Entrance) -> dict[str, list[tuple[bytes, bytes]]]:
    _, owner = entrance.devices.admit("device", "Anna", "owner")
    cookie = f"{entrance.access.cookie}=".encode()
    return {
        "none": [],
        "cookie": [(b"cookie", b"other=1; " + cookie + owner.encode())],
        "bearer": [(b"authorization", b"Bearer " + owner.encode())],
        "forged": [
            (b"cookie", cookie + owner[:-1].encode() + b"~"),
            (b"authorization", b"Bearer " + owner.partition(".")[0].encode() + b"."),
        ],
    }


def test_every_route_names_the_role_of_the_table() -> None:
    assert {(method, path): named for method, path, named in roles_of_routes()} == {
        key: [role] for key, role in ROLES.items()
    }


@pytest.mark.parametrize(("kind", "method", "path"), list(all_routes()))
@pytest.mark.parametrize("mode", MODES)
async def test_every_handshake_ends_as_the_rule_says(mode: Mode, kind: str, method: str, path: str) -> None:
    entrance = entrance_to(MODES[mode])
    app, brought = app_at(entrance), credentials_of(entrance)
    role = ROLES.get(("WS" if kind == "websocket" else method, path))
    for host, pattern, credential in product(HOSTS, ORIGINS, CREDENTIALS):
        origin = pattern if pattern is None else pattern.replace("{host}", host or "")
        headers = headers_of(host, origin) + brought[credential]
        expected = may_pass(mode, host, origin, credential, role)
        if (method, path) in FOR_BROWSERS and origin is None:
            expected = expected or 403
        status = await knock(app, scope_of(kind, method, path, headers, OWN_ADDRESS))
        case = (host, origin, credential, status)
        assert status == expected if expected else status not in (401, 403), case


@pytest.mark.parametrize("mode", MODES)
async def test_an_address_with_its_version_is_the_same_one(mode: Mode) -> None:
    entrance = entrance_to(MODES[mode])
    brought = credentials_of(entrance)
    app = app_at(entrance)
    host = next(iter(GOOD[mode]))
    for kind, method, path in all_routes():
        if not path.startswith("/api/"):
            continue
        versioned = path.replace("/api/", "/api/v1/", 1)
        for credential in ("none", "bearer"):
            headers = headers_of(host, None) + brought[credential]
            plain, named = [
                await knock(app, scope_of(kind, method, one, headers, OWN_ADDRESS))
                for one in (path, versioned)
            ]
            assert named == plain, (method, path, credential)
    for unknown in ("/api/v1", "/api/v2/status", "/api/v1/v1/status", "/v1/status"):
        headers = headers_of(host, None) + brought["bearer"]
        assert await knock(app, scope_of("http", "GET", unknown, headers, OWN_ADDRESS)) == 404, unknown


@pytest.mark.parametrize("role", RANKS)
async def test_each_role_reaches_what_it_may_and_nothing_above(role: Role) -> None:
    entrance = entrance_to(MODES["lan"])
    _, token = entrance.devices.admit("token", "Script", role)
    app = app_at(entrance)
    for (method, path), needed in ROLES.items():
        if (method, path) in FOR_BROWSERS:
            continue
        kind, verb = ("websocket", "GET") if method == "WS" else ("http", method)
        headers = [*headers_of(f"localhost:{PORT}", None), (b"authorization", f"Bearer {token}".encode())]
        status = await knock(app, scope_of(kind, verb, path, headers))
        is_enough = needed is PUBLIC or RANKS[role] >= RANKS[needed]
        assert (status != 403) == is_enough, (method, path, status)


WITH_ROLE = [(method, path) for (method, path), role in ROLES.items() if role and method != "WS"]


@pytest.mark.parametrize(("method", "path"), WITH_ROLE)
async def test_a_refusal_comes_before_a_byte_of_the_body_is_read(method: str, path: str) -> None:
    entrance = entrance_to(MODES["lan"], lambda: 0.0)
    app, host = app_at(entrance), f"localhost:{PORT}"
    body = [(b"content-type", b"application/json"), (b"content-length", b"9")]
    headers = [*headers_of(host, f"http://{host}"), *body]
    assert await knock(app, scope_of("http", method, path, headers), may_read=False) == 401
    from_elsewhere = [*headers, (b"sec-fetch-site", b"cross-site"), (b"sec-fetch-mode", b"navigate")]
    assert await knock(app, scope_of("http", method, path, from_elsewhere), may_read=False) == 403
    headers += credentials_of(entrance)["cookie"]
    too_large = [header for header in headers if header[0] != b"content-length"]
    too_large.append((b"content-length", b"%d" % (4 * 1024 * 1024)))
    assert await knock(app, scope_of("http", method, path, too_large), may_read=False) == 413
    if path not in ("/api/stop", "/api/fleet/stop"):
        for _ in range(PAGE_BURST):
            entrance.count(entrance.judge(headers, "viewer"))
        assert await knock(app, scope_of("http", method, path, headers), may_read=False) == 429


@pytest.mark.parametrize("mode", ["lan", "proxy"])
@pytest.mark.parametrize("name", [b"x-forwarded-for", b"forwarded", b"x-real-ip"])
async def test_what_a_proxy_adds_is_refused_unless_one_was_named_and_never_believed(
    mode: Mode, name: bytes
) -> None:
    host = "robot.example" if mode == "proxy" else f"localhost:{PORT}"
    headers = [*headers_of(host, None), (name, b"127.0.0.1")]
    app = app_at(entrance_to(MODES[mode]))
    assert await knock(app, scope_of("http", "GET", "/api/health", headers)) == (
        200 if mode == "proxy" else 403
    )
    assert await knock(app, scope_of("http", "GET", "/api/status", headers)) == (
        401 if mode == "proxy" else 403
    )


@pytest.mark.parametrize("name", [b"cookie", b"authorization", b"origin", b"host"])
async def test_a_doubled_header_authenticates_no_caller(name: bytes) -> None:
    entrance = entrance_to(MODES["lan"])
    brought = credentials_of(entrance)
    host = f"localhost:{PORT}"
    origin = None if name == b"authorization" else f"http://{host}"
    headers = headers_of(host, origin) + brought["bearer" if origin is None else "cookie"]
    app = app_at(entrance)
    assert await knock(app, scope_of("http", "GET", "/api/people", headers)) == 200
    twice = [*headers, *(header for header in headers if header[0] == name)]
    assert await knock(app, scope_of("http", "GET", "/api/people", twice)) == 403


async def test_a_doubled_cookie_authenticates_no_caller() -> None:
    entrance = entrance_to(MODES["lan"])
    cookie = credentials_of(entrance)["cookie"][0][1]
    host = f"localhost:{PORT}"
    headers = [*headers_of(host, f"http://{host}"), (b"cookie", cookie + b"; " + cookie)]
    assert await knock(app_at(entrance), scope_of("http", "GET", "/api/people", headers)) == 401


async def test_a_get_of_our_own_page_which_has_no_origin_says_so_in_a_header() -> None:
    entrance = entrance_to(MODES["lan"])
    headers = headers_of(f"localhost:{PORT}", None) + credentials_of(entrance)["cookie"]
    app = app_at(entrance)
    assert await knock(app, scope_of("http", "GET", "/api/people", headers)) == 401
    headers.append((b"x-servodeck-page", b"1"))
    assert await knock(app, scope_of("http", "GET", "/api/people", headers)) == 200


async def test_the_session_of_another_gateway_on_this_host_is_none_of_ours() -> None:
    entrance = entrance_to(MODES["lan"])
    [(name, cookie)] = credentials_of(entrance)["cookie"]
    host = f"localhost:{PORT}"
    other = cookie.replace(f"servodeck_{PORT}".encode(), b"servodeck_8301")
    headers = [*headers_of(host, f"http://{host}"), (name, other)]
    assert await knock(app_at(entrance), scope_of("http", "GET", "/api/people", headers)) == 401


def test_a_route_without_a_role_keeps_the_gateway_from_starting() -> None:
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.router.route_class = routes.JudgingRoute
    app.get("/named", dependencies=[routes.PUBLIC])(lambda: None)
    routes.require_roles(app.routes)
    app.get("/forgotten")(lambda: None)
    with pytest.raises(TypeError, match="/forgotten"):
        routes.require_roles(app.routes)


def test_a_route_that_judges_the_caller_after_the_body_keeps_the_gateway_from_starting() -> None:
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.get("/late", dependencies=[routes.VIEWER])(lambda: None)
    with pytest.raises(TypeError, match="/late"):
        routes.require_roles(app.routes)
