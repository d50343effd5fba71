"""What the network hears, over real multicast on the loopback addresses; skipped where there is none."""

import os
import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest
from zeroconf import ServiceInfo, Zeroconf

from servodeck.access.addresses import SERVICE, Announcement

# A gateway that runs beside the tests has the real one, and several processes run tests.
NAME = f"servodeck-under-test-{os.getpid()}.local"
HERE, THERE = "127.0.0.1", "127.0.0.2"
LOOK_AGAIN_S = 0.05


def hears_itself() -> bool:
    service = ServiceInfo(
        "_probe._tcp.local.",
        f"probe-{os.getpid()}._probe._tcp.local.",
        port=1,
        addresses=[b"\x7f\0\0\x01"],
        server=f"probe-{os.getpid()}.local.",
    )
    try:
        with Zeroconf(interfaces=[HERE]) as asking, Zeroconf(interfaces=[HERE]) as announcing:
            announcing.register_service(service)
            return asking.get_service_info(service.type, service.name, 3000) is not None
    except OSError:
        return False


pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        sys.platform != "linux", reason="only Linux has a second loopback address without set-up"
    ),
]


@pytest.fixture(scope="module", autouse=True)
def _multicast() -> None:
    if not hears_itself():
        pytest.skip("this system has no multicast on its loopback")


@pytest.fixture(autouse=True)
def _name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("servodeck.access.addresses.MDNS_NAME", NAME)


@contextmanager
def announced(
    host: str, addresses: Callable[[], list[str]] = lambda: [HERE], port: int = 8300
) -> Iterator[Announcement]:
    made = Announcement(port, host, addresses, LOOK_AGAIN_S)
    made.start()
    try:
        yield made
    finally:
        made.end()


@contextmanager
def network() -> Iterator[Zeroconf]:
    with Zeroconf(interfaces=[HERE, THERE]) as made:
        yield made


def heard(by: Zeroconf, host: str, wait_ms: int = 8000) -> ServiceInfo | None:
    until = time.monotonic() + wait_ms / 1000
    while time.monotonic() < until:
        if found := by.get_service_info(SERVICE, f"Servodeck on {host}.{SERVICE}", 500):
            return found
    return None


def test_others_hear_the_name_the_port_and_the_address() -> None:
    with network() as others, announced("robot"):
        found = heard(others, "robot")
        assert found
        assert (found.server, found.port, found.parsed_addresses()) == (f"{NAME}.", 8300, [HERE])


@pytest.mark.exhaustive
def test_the_second_in_a_room_goes_by_its_computers_name() -> None:
    with network() as others, announced("first"):
        assert heard(others, "first")
        with announced("second", lambda: [THERE]):
            second = heard(others, "second")
            assert second
            assert second.server == "second.local."


@pytest.mark.exhaustive
def test_what_ends_is_taken_back() -> None:
    with network() as others:
        with announced("leaving"):
            assert heard(others, "leaving")
        others.cache.async_expire(time.monotonic() * 1000 + 10_000_000)
        assert heard(others, "leaving", 600) is None


@pytest.mark.exhaustive
def test_a_network_that_comes_later_is_used() -> None:
    addresses: list[str] = []
    with network() as others, announced("late", lambda: list(addresses)):
        assert heard(others, "late", 600) is None
        addresses.append(HERE)
        assert heard(others, "late")


@pytest.mark.exhaustive
def test_a_failure_is_logged_and_tried_again(caplog: pytest.LogCaptureFixture) -> None:
    asked = threading.Semaphore(0)

    def addresses() -> list[str]:
        asked.release()
        raise OSError("The network is down.")

    with announced("nowhere", addresses):
        assert asked.acquire(timeout=5)
        assert asked.acquire(timeout=5)
    assert "cannot be announced" in caplog.text


@pytest.mark.exhaustive
def test_a_long_computer_name_is_cut() -> None:
    with network() as others, announced("x" * 63):
        assert heard(others, "x" * 40)


@pytest.mark.exhaustive
def test_no_name_is_needed() -> None:
    with network() as others, announced(""):
        assert heard(others, socket.gethostname().partition(".")[0][:40])
