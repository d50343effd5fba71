"""Under which names the gateway answers in each mode."""

import pytest

from servodeck.access import addresses
from servodeck.access.addresses import bracketed, lan_addresses


def test_one_computer_on_its_own_answers_to_loopback_names_only() -> None:
    assert addresses.local(8300).hosts_at("127.0.0.1") == {
        b"127.0.0.1:8300",
        b"localhost:8300",
        b"[::1]:8300",
    }
    assert addresses.local(8300).hosts_at("192.168.1.5") == addresses.local(8300).hosts_at(None)
    assert b"localhost" in addresses.local(80).hosts_at(None)
    assert b"localhost:80" in addresses.local(80).hosts_at(None)


def test_on_a_lan_it_answers_to_its_names_and_the_address_a_connection_came_in_at() -> None:
    lan = addresses.lan(8300, "Robot.fritz.box")
    names = {b"robot.fritz.box:8300", b"robot.local:8300", b"servodeck.local:8300"}
    assert lan.hosts_at(None) == addresses.local(8300).hosts_at(None) | names
    assert lan.hosts_at("10.0.0.7") == lan.hosts_at(None) | {b"10.0.0.7:8300"}
    assert b"[fe80::1]:8300" in lan.hosts_at("fe80::1%eth0")


@pytest.mark.parametrize("name", ["*", "bad name", "-", "", "robot:80", "röbot"])
def test_a_host_name_that_is_none_is_left_out(name: str) -> None:
    assert not any(
        name.encode() + b":8300" == host for host in addresses.lan(8300, name).hosts_at(None) if name
    )
    assert b"*" not in b"".join(addresses.lan(8300, name).hosts_at(None))


@pytest.mark.parametrize(
    ("url", "hosts", "is_secure"),
    [
        ("https://robot.example", {b"robot.example", b"robot.example:443"}, True),
        ("https://Robot.Example/", {b"robot.example", b"robot.example:443"}, True),
        ("https://robot.example:8443", {b"robot.example:8443"}, True),
        ("http://10.0.0.2", {b"10.0.0.2", b"10.0.0.2:80"}, False),
        ("https://[fd00::1]", {b"[fd00::1]", b"[fd00::1]:443"}, True),
    ],
)
def test_behind_a_proxy_its_address_is_the_only_one(url: str, hosts: set[bytes], is_secure: bool) -> None:
    proxied = addresses.behind_proxy(url)
    assert proxied.hosts_at("127.0.0.1") == hosts
    assert proxied.is_secure == is_secure
    assert proxied.cookie.startswith("__Host-") == is_secure


@pytest.mark.parametrize(
    "url",
    [
        *("robot.example", "ftp://robot.example", "https://", "//a", "https://a/b", "https://a?b"),
        *("https://u@a", "https://a:port", "https://a:70000", "https://[::1"),
    ],
)
def test_an_address_that_cannot_be_is_refused(url: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 (the sentence is for people)
        addresses.behind_proxy(url)


def test_addresses_as_a_host_header_has_them() -> None:
    assert bracketed("::ffff:10.0.0.7") == "10.0.0.7"
    assert bracketed("::1") == "[::1]"
    assert "127.0.0.1" not in lan_addresses()


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("0.0.0.0", ["192.168.1.5", "10.0.0.2"]),
        ("::", ["192.168.1.5", "10.0.0.2"]),
        ("10.0.0.2", ["10.0.0.2"]),
        ("127.0.0.1", []),
        ("::1", []),
    ],
)
def test_only_addresses_that_answer_are_named_to_others(host: str, expected: list[str]) -> None:
    assert addresses.answered_at(host, ["192.168.1.5", "10.0.0.2"]) == expected


@pytest.mark.parametrize(
    ("listens_at", "named"),
    [("0.0.0.0", "http://192.0.2.7:8300"), ("192.0.2.7", "http://192.0.2.7:8300"), ("127.0.0.1", "")],
)
def test_an_invitation_names_an_address_that_answers(
    listens_at: str, named: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(addresses, "lan_addresses", lambda: ["192.0.2.7"])
    own = "127.0.0.1:8300"
    assert addresses.link_base(addresses.lan(8300, listens_at=listens_at), own) == (named or f"http://{own}")
