"""Who may ask and what may pass, as tables."""

from contextlib import AbstractContextManager, nullcontext

import pytest

from servodeck.access import addresses
from servodeck.access.guard import judge_handshake, judge_script
from servodeck.errors import ForbiddenError, LatchedError, MalformedError, NotSupportedError, OutOfRangeError
from servodeck.protocol.decoder import COMMAND_AT
from servodeck.robot.latch import judge_latch
from servodeck.robot.requests import judge_packet
from tests.samples import BATTERY, DOWNLOAD, ERASE, MOVE, RUN, STOP

PORT = 8300
HOSTS: list[str | None] = [
    "127.0.0.1:8300",
    "localhost:8300",
    "[::1]:8300",
    "127.0.0.1",
    "127.0.0.1:8301",
    "127.0.0.2:8300",
    "LOCALHOST:8300",
    "localhost.:8300",
    "evil.example",
    "evil.example:8300",
    "localhost:8300.evil.example",
    None,
]
ORIGINS: list[str | None] = [
    None,
    "http://127.0.0.1:8300",
    "http://localhost:8300",
    "http://[::1]:8300",
    "https://127.0.0.1:8300",
    "http://127.0.0.1:8301",
    "http://evil.example",
    "http://127.0.0.1:8300.evil.example",
    "null",
    "",
]
# A page may ask only at the very address it came from; programs have no Origin.
PASSING = {(host, origin) for host in HOSTS[:3] for origin in (None, f"http://{host}")}


def allowed(passes: bool) -> AbstractContextManager[object]:
    return nullcontext() if passes else pytest.raises(ForbiddenError)


def headers_of(host: str | None, origin: str | None) -> list[tuple[bytes, bytes]]:
    named = (("host", host), ("origin", origin))
    return [(name.encode(), value.encode()) for name, value in named if value is not None]


@pytest.mark.parametrize("host", HOSTS)
@pytest.mark.parametrize("origin", ORIGINS)
def test_only_the_own_address_and_its_own_page_pass(host: str | None, origin: str | None) -> None:
    with allowed((host, origin) in PASSING):
        assert judge_handshake(headers_of(host, origin), addresses.local(PORT), None) == host


def test_on_the_usual_port_a_browser_leaves_the_number_out() -> None:
    assert (
        judge_handshake(headers_of("localhost", "http://localhost"), addresses.local(80), None) == "localhost"
    )
    with pytest.raises(ForbiddenError):
        judge_handshake(headers_of("localhost", None), addresses.local(PORT), None)


@pytest.mark.parametrize("name", ["host", "origin"])
def test_a_header_that_comes_twice_is_refused(name: str) -> None:
    headers = headers_of("localhost:8300", "http://localhost:8300")
    twice = [*headers, *(header for header in headers if header[0] == name.encode())]
    with pytest.raises(ForbiddenError, match="more than once"):
        judge_handshake(twice, addresses.local(PORT), None)


@pytest.mark.parametrize(
    "name", ["forwarded", "via", "x-forwarded-for", "x-forwarded-host", "x-forwarded-anything", "x-real-ip"]
)
def test_what_a_proxy_passed_on_is_refused_with_an_explanation(name: str) -> None:
    headers = [*headers_of("localhost:8300", None), (name.encode(), b"10.0.0.1")]
    with pytest.raises(ForbiddenError, match="proxy"):
        judge_handshake(headers, addresses.local(PORT), None)


@pytest.mark.parametrize(
    ("site", "mode", "may_look", "may_act"),
    [
        (None, None, True, True),
        ("same-origin", "cors", True, True),
        ("none", "navigate", True, True),
        ("cross-site", "navigate", True, False),
        ("same-site", "navigate", True, False),
        ("cross-site", "no-cors", False, False),
        ("same-site", "no-cors", False, False),
        ("cross-site", "cors", False, False),
        ("cross-site", "websocket", False, False),
    ],
)
def test_another_site_may_link_to_the_page_and_nothing_else(
    site: str | None, mode: str | None, may_look: bool, may_act: bool
) -> None:
    named = ((b"sec-fetch-site", site), (b"sec-fetch-mode", mode))
    headers = headers_of("localhost:8300", None) + [(name, value.encode()) for name, value in named if value]
    with allowed(may_look):
        judge_handshake(headers, addresses.local(PORT), None)
    with allowed(may_act):
        judge_script(headers)


@pytest.mark.parametrize("packet", [MOVE, RUN, STOP, ERASE, BATTERY, DOWNLOAD])
def test_each_of_the_six_commands_passes(packet: bytes) -> None:
    assert judge_packet(packet.hex(), "doc").data == packet


@pytest.mark.parametrize(
    "text",
    [
        "",
        "zz",
        "555",
        "55550",
        "55 55 02",
        "55550307",
        "5555020755550207",
        "5555020f00",
        "55550263",
        "55550203",
        "aa550207",
        "5555ff" + "07" * 254,
    ],
)
def test_what_is_not_exactly_one_command_is_malformed(text: str) -> None:
    with pytest.raises(MalformedError):
        judge_packet(text, "doc")


@pytest.mark.parametrize(
    "text",
    [
        "5555080301e80301c509",  # 2501 µs
        "5555080301e80301f301",  # 499 µs
        "5555080301317501dc05",  # 30,001 ms
        "5555080301e80300dc05",  # servo 0
        "5555080301e80321dc05",  # servo 33
    ],
)
def test_what_the_board_cannot_take_is_out_of_range(text: str) -> None:
    with pytest.raises(OutOfRangeError):
        judge_packet(text, "doc")


def test_a_command_that_the_board_does_not_have_is_named_as_such() -> None:
    with pytest.raises(NotSupportedError):
        judge_packet(BATTERY.hex(), "openarm-new")


@pytest.mark.parametrize(
    ("packet", "passes"),
    [
        (MOVE, False),
        (RUN, False),
        (ERASE, False),
        (DOWNLOAD, False),
        (bytes.fromhex("5555050b083200"), False),  # speed
        (bytes.fromhex("555504140101"), False),  # release
        (STOP, True),
        (BATTERY, True),
        (bytes.fromhex("555504150101"), True),  # positions
        (bytes.fromhex("55550201"), True),  # version
        (bytes.fromhex("5555020d"), True),  # all positions
        (bytes.fromhex("55550202"), True),  # offsets
        (bytes.fromhex("5555040a0105"), False),  # setting an offset
        (bytes.fromhex("5555020b"), False),  # saving them
    ],
)
def test_the_latch_lets_only_stop_and_questions_through(packet: bytes, passes: bool) -> None:
    judge_latch(packet[COMMAND_AT], latch=False)
    if passes:
        judge_latch(packet[COMMAND_AT], latch=True)
    else:
        with pytest.raises(LatchedError):
            judge_latch(packet[COMMAND_AT], latch=True)
