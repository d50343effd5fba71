"""STOP of robots whose broker is gone, or who do not answer there: straight at their own pages, and who was
not reached is said.
"""

import signal
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from typing import cast

import pytest

from servodeck.fleet import stopping
from servodeck.fleet.console import Console
from servodeck.fleet.heard import Robot
from servodeck.fleet.messages import About, State
from servodeck.fleet.outcomes import StopReport, report_of
from servodeck.fleet.reports import Page
from servodeck.fleet.stopping import stop_robots
from servodeck.snapshots import LinkState
from tests.fleet import WAIT_S, console_of, fleet_on
from tests.mosquitto import Mosquitto, free_port, needs_mosquitto
from tests.stubborn import WAYS, stubborn
from tests.test_cli import Served

pytestmark = [pytest.mark.slow, needs_mosquitto]
NAMES = ("arm-1", "arm-2")
TOKEN = "only.stops"


class Pages(HTTPServer):
    """The page of a gateway, as far as a STOP is concerned: which requests came."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Answering)
        self.requests: list[tuple[str, str | None]] = []
        self.answer = b'{"latch": true, "halted": true, "unheld": null}'

    @property
    def page(self) -> Page:
        return Page(f"http://127.0.0.1:{self.server_port}/", TOKEN)


class Answering(BaseHTTPRequestHandler):
    def do_POST(self) -> None:
        assert isinstance(self.server, Pages)
        said = self.headers["Authorization"]
        self.server.requests.append((self.path, said))
        self.send_response(200 if said == f"Bearer {TOKEN}" else 401)
        self.end_headers()
        self.wfile.write(self.server.answer)

    def log_message(self, *_: object) -> None:
        """The test looks at the requests."""


@contextmanager
def pages() -> Iterator[Pages]:
    with Pages() as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture
def mosquitto(tmp_path: Path) -> Iterator[Mosquitto]:
    with Mosquitto(tmp_path / "broker", NAMES) as made:
        yield made


def test_without_the_broker_those_with_a_page_are_stopped_there_and_the_others_named(
    mosquitto: Mosquitto,
) -> None:
    with pages() as server, fleet_on(mosquitto, ["arm-2"]) as (fleet, _):
        fleet.join("arm-1", mosquitto.broker_for("arm-1"), page=server.page)
        with console_of(mosquitto, "anna", *NAMES) as console:
            mosquitto.kill()
            assert console.until(lambda: console.problem is not None, WAIT_S)
            report = stop_robots(console)
            assert (report.stopped, report.refused, report.missing) == (("arm-1",), (), ("arm-2",))
            assert server.requests == [("/api/stop", f"Bearer {TOKEN}")]
            assert stop_robots(console, ["arm-2", "nobody"]).missing == ("arm-2", "nobody")


def test_where_the_broker_freezes_they_are_stopped_at_their_pages(mosquitto: Mosquitto) -> None:
    with pages() as server, fleet_on(mosquitto, ["arm-2"]) as (fleet, _):
        fleet.join("arm-1", mosquitto.broker_for("arm-1"), page=server.page)
        with console_of(mosquitto, "anna", *NAMES) as console:
            mosquitto.signal(signal.SIGSTOP)
            report = stop_robots(console)
            assert (report.stopped, report.missing) == (("arm-1",), ("arm-2",))


def test_a_broker_that_works_is_enough(mosquitto: Mosquitto) -> None:
    with pages() as server, fleet_on(mosquitto, ["arm-2"]) as (fleet, _):
        fleet.join("arm-1", mosquitto.broker_for("arm-1"), page=server.page)
        with console_of(mosquitto, "anna", *NAMES) as console:
            assert stop_robots(console).stopped == NAMES
            assert server.requests == []


def test_a_page_that_refuses_has_not_stopped(mosquitto: Mosquitto) -> None:
    with pages() as server, fleet_on(mosquitto, []) as (fleet, _):
        refused = Page(server.page.address, "of.another")
        fleet.join("arm-1", mosquitto.broker_for("arm-1"), page=refused)
        with console_of(mosquitto, "anna", "arm-1") as console:
            mosquitto.kill()
            assert console.until(lambda: console.problem is not None, WAIT_S)
            assert stop_robots(console).missing == ("arm-1",)
            assert len(server.requests) == 1


@pytest.mark.exhaustive
def test_a_real_gateway_takes_the_stop_at_its_page_and_nothing_else(
    mosquitto: Mosquitto, tmp_path: Path
) -> None:
    port = free_port()
    secret = mosquitto.folder / "secrets" / "arm-1"
    options = ["--mqtt", f"mqtt://arm-1@127.0.0.1:{mosquitto.port}", "--mqtt-site", "lab"]
    files = ["--mqtt-password-file", str(secret), "--data", str(tmp_path / "data")]
    served = Served(
        *options, *files, "--public-url", f"http://127.0.0.1:{port}", "--listen", f"127.0.0.1:{port}"
    )
    try:
        with console_of(mosquitto, "anna", "arm-1") as console:
            mosquitto.kill()
            assert console.until(lambda: console.problem is not None, WAIT_S)
            assert stop_robots(console).stopped == ("arm-1",)
            served.read_until_stops(3)
    finally:
        served.end()


class Nobody:
    """A console whose broker lets nothing through, and that has heard these robots."""

    def __init__(self, *robots: Robot) -> None:
        self._robots = list(robots)

    def robots(self) -> list[Robot]:
        return self._robots

    def stop_all(self) -> StopReport:
        threading.Event().wait(0.4)
        return report_of((), {}, [one.name for one in self._robots])


def robot_at(name: str, page: Page, *, latch: bool = False) -> Robot:
    about = About.model_construct(page=page.address, stop_token=page.stop_token)
    state = State.model_construct(latch=latch, link=LinkState(status="ready"))
    return Robot(name, "present", about, state, None)


def test_one_that_was_stopped_before_is_stopped_again() -> None:
    """It may have been resumed meanwhile, and the broker does not say so."""
    with pages() as server:
        console = Nobody(robot_at("arm-1", server.page, latch=True))
        assert stop_robots(cast("Console", console)).stopped == ("arm-1",)
        assert len(server.requests) == 1


def test_many_that_are_switched_off_hold_up_no_stop_of_the_others() -> None:
    with pages() as server, socket.create_server(("127.0.0.1", 0)) as silent:
        off = Page(f"http://127.0.0.1:{silent.getsockname()[1]}", TOKEN)
        robots = [*(robot_at(f"arm-{number}", off) for number in range(80)), robot_at("z", server.page)]
        assert stop_robots(cast("Console", Nobody(*robots))).stopped == ("z",)


def test_whatever_answers_at_an_address_that_was_a_robots_has_not_stopped_it() -> None:
    with pages() as server:
        server.answer = b"<html>Welcome</html>"
        console = Nobody(robot_at("arm-1", server.page))
        assert stop_robots(cast("Console", console)).missing == ("arm-1",)
        assert len(server.requests) == 1


@pytest.mark.slow
@pytest.mark.parametrize("how", WAYS)
def test_one_that_never_ends_its_answer_is_missing_and_holds_up_no_other(
    how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stopping, "STRAIGHT_S", 0.3)
    monkeypatch.setattr(stopping, "WHOLE_S", 0.3)
    with pages() as server, stubborn(how) as endless:
        robots = [robot_at("a", Page(endless.address, TOKEN)), robot_at("z", server.page)]
        report = stop_robots(cast("Console", Nobody(*robots)))
        assert (report.stopped, report.missing) == (("z",), ("a",))
        assert endless.ended.acquire(timeout=2)
