"""Notifications: when they are due, and a gateway that sends them to real receivers, which answer, refuse,
hang, lead elsewhere or are gone.
"""

import asyncio
import contextlib
import json
import queue
import socket
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from httpx2 import AsyncClient
from typer.testing import CliRunner

from servodeck.cli.main import app
from servodeck.notify.conditions import LOST_AFTER_S, Conditions, Due, Sample
from servodeck.notify.notifications import Notifications, notice_of
from servodeck.notify.receivers import parse_receiver, receivers_from
from servodeck.notify.sender import Outcome, Sender
from servodeck.protocol.timings import BATTERY
from tests.fake_port import FakePort, FakePorts
from tests.running import server_on
from tests.stubborn import WAYS, stubborn

LOW_MV = 7000


def events_of(samples: Sequence[Sample]) -> list[list[str]]:
    """What is due with each of them."""
    conditions = Conditions()
    return [[due.event for due in conditions.after(sample)] for sample in samples]


def battery_events(*readings_mv: int, low_mv: int | None = LOW_MV) -> list[int]:
    """The numbers of the readings with which the battery is reported as low."""
    samples = [
        Sample(at, "ready", battery=(battery_mv, at), low_mv=low_mv)
        for at, battery_mv in enumerate(readings_mv)
    ]
    return [index for index, events in enumerate(events_of(samples)) if events == ["batteryLow"]]


def test_a_low_battery_is_reported_once_until_it_was_well_above_the_limit() -> None:
    low, back = LOW_MV, LOW_MV + BATTERY.hysteresis_mv + 1
    assert battery_events(low, low, low, low, low) == [2]
    assert battery_events(low, low, low, low + BATTERY.hysteresis_mv, low, low, low) == [2]
    assert battery_events(low, low, low, back, low, low, low) == [2, 6]


def test_single_readings_and_boards_without_a_sample_or_a_limit_report_nothing() -> None:
    assert battery_events(LOW_MV, LOW_MV, 7500, LOW_MV, LOW_MV) == []
    assert battery_events(0, 0, 0, 0) == []
    assert battery_events(100, 100, 100, low_mv=None) == []


def test_a_reading_that_is_seen_twice_counts_once() -> None:
    same = Sample(1, "ready", battery=(LOW_MV, 1.0), low_mv=LOW_MV)
    assert events_of([same] * 5) == [[]] * 5


def test_a_stop_says_who_once() -> None:
    pressed = Sample(0, "ready", "person", "Anna")
    conditions = Conditions()
    assert list(conditions.after(pressed)) == [Due("stopped", "Anna pressed STOP.")]
    assert list(conditions.after(pressed)) == []
    assert list(conditions.after(Sample(1, "ready"))) == []
    assert list(conditions.after(Sample(2, "ready", "silence"))) == [
        Due("stopped", "Stopped because its driver was not heard while it moved.")
    ]


def test_a_link_is_reported_when_it_stays_lost_and_when_it_is_back() -> None:
    def at(seconds: float, link: Any) -> Sample:
        return Sample(seconds, link)

    late = LOST_AFTER_S
    assert events_of([at(0, "ready"), at(1, "lost"), at(late, "ready"), at(late + 1, "lost")]) == [[]] * 4
    # Attempts between do not count as its return.
    tried = [at(0, "lost"), at(late - 1, "opening"), at(late, "lost"), at(late + 9, "lost")]
    assert events_of([*tried, at(30, "identifying"), at(31, "ready"), at(32, "ready")]) == [
        *([], [], ["linkLost"], []),
        *([], ["linkBack"], []),
    ]
    assert events_of([at(0, "stale"), at(late, "stale"), at(20, "closed"), at(21, "ready")]) == [
        *([], ["linkLost"], [], []),
    ]


@pytest.mark.parametrize(
    ("text", "kind", "url", "authorization", "topic"),
    [
        ("https://a.example/hook?k=1", "webhook", "https://a.example/hook?k=1", None, ""),
        ("http://u:p%40@a:81/", "webhook", "http://a:81/", "Basic dTpwQA==", ""),
        ("ntfy://ntfy.example/robots", "ntfy", "https://ntfy.example/", None, "robots"),
        ("ntfy://tk_1@ntfy.example/robots", "ntfy", "https://ntfy.example/", "Bearer tk_1", "robots"),
        ("ntfy+http://pi.local:81/sub/robots/", "ntfy", "http://pi.local:81/sub/", None, "robots"),
    ],
)
def test_an_address_is_a_receiver(
    text: str, kind: str, url: str, authorization: str | None, topic: str
) -> None:
    found = parse_receiver(text)
    assert (found.kind, found.url, found.authorization, found.topic) == (kind, url, authorization, topic)


@pytest.mark.parametrize("text", ["", "secret", "ftp://secret/x", "ntfy://host", "https:///secret"])
def test_what_is_no_address_is_refused_without_repeating_it(text: str) -> None:
    with pytest.raises(ValueError, match=r"begins with|takes HOST/TOPIC") as refused:
        parse_receiver(text)
    assert "secret" not in str(refused.value)


def test_a_file_has_an_address_in_each_line(tmp_path: Path) -> None:
    file = tmp_path / "receivers"
    file.write_text("# ours\nntfy://a.example/robots\n\n  https://b.example/\n")
    hosts = [one.host for one in receivers_from(["https://c.example/"], file)]
    assert hosts == ["c.example", "a.example", "b.example"]


# Real receivers


@dataclass
class Heard:
    path: str
    headers: dict[str, str]
    body: Any


@dataclass
class Playing:
    """A receiver. `statuses`: of the next answers, then 200. `/hang` answers when it `may_answer`."""

    port: int = 0
    statuses: list[int] = field(default_factory=list)
    heard: "queue.Queue[Heard]" = field(default_factory=queue.Queue)
    may_answer: threading.Event = field(default_factory=threading.Event)

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.port}"


@pytest.fixture
def playing() -> Iterator[Playing]:
    made = Playing()

    class Receiving(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            made.heard.put(Heard(self.path, dict(self.headers), body))
            if self.path == "/hang":
                made.may_answer.wait()
            with contextlib.suppress(OSError):  # the other side may have gone
                self.send_response(made.statuses.pop(0) if made.statuses else 200)
                self.send_header("Location", f"http://localhost:{made.port}/elsewhere")
                self.send_header("Content-Length", "0")
                self.end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Receiving)
    made.port = server.server_address[1]
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield made
    made.may_answer.set()
    server.shutdown()
    server.server_close()


def sender_to(address: str, *, attempts: int = 4, timeout_s: float = 5.0) -> Sender:
    return Sender(parse_receiver(address), (0.0,) * (attempts - 1), timeout_s)


TEST = notice_of(Due("test", "Grüße"), "Ärmchen", "doc", "https://robot.example")


@pytest.mark.slow
def test_a_webhook_gets_json_with_a_key_and_ntfy_its_own_form(playing: Playing) -> None:
    assert sender_to(f"http://user:pass@{playing.host}/hook").deliver(TEST) == Outcome("sent")
    hook = playing.heard.get_nowait()
    assert hook.path == "/hook"
    assert hook.headers["Idempotency-Key"] == hook.body["id"] == TEST.id
    assert hook.headers["Authorization"] == "Basic dXNlcjpwYXNz"
    named = {name: hook.body[name] for name in ("event", "text", "robot", "board", "page")}
    assert list(named.values()) == ["test", "Grüße", "Ärmchen", "doc", "https://robot.example"]
    assert hook.body["at"].endswith("+00:00")
    assert sender_to(f"ntfy+http://{playing.host}/robots").deliver(TEST) == Outcome("sent")
    ntfy = playing.heard.get_nowait()
    assert (ntfy.path, ntfy.body["topic"], ntfy.body["message"]) == ("/", "robots", "Grüße")
    assert (ntfy.body["title"], ntfy.body["click"]) == ("Ärmchen: Test", "https://robot.example")


@pytest.mark.slow
def test_an_overloaded_receiver_is_tried_again_with_the_same_key(playing: Playing) -> None:
    playing.statuses = [503, 429, 200]
    assert sender_to(f"http://{playing.host}/").deliver(TEST) == Outcome("sent")
    keys = {playing.heard.get_nowait().headers["Idempotency-Key"] for _ in range(3)}
    assert keys == {TEST.id}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("statuses", "attempts", "detail"),
    [
        ([403, 200], 1, "It answers with status 403."),
        ([307, 200], 1, "It answers with status 307."),
        ([302, 200], 1, "It answers with status 302."),
        ([500] * 5, 4, "It answers with status 500."),
    ],
)
def test_a_refusal_a_redirection_and_the_last_failure_drop_it(
    playing: Playing, statuses: list[int], attempts: int, detail: str
) -> None:
    playing.statuses = statuses
    assert sender_to(f"http://{playing.host}/").deliver(TEST) == Outcome("dropped", detail)
    assert playing.heard.qsize() == attempts


@pytest.mark.slow
def test_a_receiver_that_is_gone_or_hangs_or_speaks_no_tls_drops_it(playing: Playing) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        gone = free.getsockname()[1]
    outcomes = [
        sender_to(f"http://127.0.0.1:{gone}/secret").deliver(TEST),
        sender_to(f"http://{playing.host}/hang", attempts=2, timeout_s=0.1).deliver(TEST),
        sender_to(f"ntfy://{playing.host}/secret").deliver(TEST),
    ]
    details = [outcome.detail or "" for outcome in outcomes]
    assert details[:2] == ["It does not answer: Connection refused.", "It does not answer: timed out."]
    assert details[2].startswith("It does not answer")
    assert not any("secret" in detail for detail in details)


@pytest.mark.slow
@pytest.mark.parametrize("how", WAYS)
def test_a_receiver_that_never_ends_its_head_drops_it(how: str) -> None:
    with stubborn(how) as receiver:
        outcome = sender_to(receiver.address, attempts=1, timeout_s=0.2).deliver(TEST)
        assert outcome == Outcome("dropped", "It does not answer: timed out.")
        assert receiver.ended.acquire(timeout=2)


@pytest.mark.slow
def test_of_each_event_the_newest_waits(playing: Playing) -> None:
    sender = sender_to(f"http://{playing.host}/hang")
    sender.put(notice_of(Due("stopped", "first")))
    assert playing.heard.get(timeout=10).body["text"] == "first"
    for text in ("second", "third"):
        sender.put(notice_of(Due("stopped", text)))
    sender.put(notice_of(Due("linkLost", "lost")))
    playing.may_answer.set()
    assert [playing.heard.get(timeout=10).body["text"] for _ in range(2)] == ["third", "lost"]
    sender.end()


@pytest.mark.slow
async def test_a_receiver_that_hangs_delays_neither_stop_nor_the_other(playing: Playing) -> None:
    port = FakePort()
    hanging, other = (
        sender_to(f"http://{playing.host}/hang"),
        sender_to(f"ntfy+http://{playing.host}/robots"),
    )
    async with (
        server_on(FakePorts(port), notifications=Notifications([hanging, other])) as running,
        AsyncClient(base_url=f"http://{running.host}") as client,
        asyncio.timeout(20),
    ):
        assert (await client.post("/api/stop")).json()["halted"]
        heard = [await asyncio.to_thread(playing.heard.get, timeout=10) for _ in range(2)]
        assert {one.path for one in heard} == {"/hang", "/"}
        assert {one.body.get("event") for one in heard} == {"stopped", None}
        await client.post("/api/resume")
        assert (await client.post("/api/stop")).json()["halted"]
        while (await sent_by(client)) != ["unused", "sent"]:  # noqa: ASYNC110 (the thread has no event)
            await asyncio.sleep(0.01)


async def sent_by(client: AsyncClient) -> list[str]:
    status = (await client.get("/api/status")).json()
    return [receiver["latest"] for receiver in status["notifications"]]


@pytest.mark.slow
def test_a_test_notification_goes_where_serve_would_send(playing: Playing, tmp_path: Path) -> None:
    def run(*options: str) -> tuple[int, str]:
        result = CliRunner().invoke(app, ["notify-test", *options])
        return result.exit_code, result.output

    file = tmp_path / "receivers"
    file.write_text(f"http://{playing.host}/token\n")
    assert run("--notify-file", str(file)) == (0, f"webhook at {playing.host}: sent\n")
    assert playing.heard.get_nowait().body["event"] == "test"
    playing.statuses = [401]
    code, output = run("--notify", f"ntfy+http://{playing.host}/topic")
    assert (code, output) == (1, f"ntfy at {playing.host}: It answers with status 401.\n")
    assert run()[0] == 2
    code, output = run("--notify", "nfty://secret")
    assert code == 2
    assert "secret" not in output
