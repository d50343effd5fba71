"""Opening, losing and getting back a port: states, pauses, sentences."""

import asyncio
from dataclasses import dataclass, field

import pytest

from servodeck.errors import (
    CancelledError,
    ClosedError,
    NotSupportedError,
    PortBusyError,
    PortLostError,
    PortMissingError,
)
from servodeck.port.diagnosis import Heard
from servodeck.port.link import Link, Ports
from servodeck.port.ports import OpenPort
from servodeck.port.wire import Wire
from servodeck.protocol.packets import CommandPacket
from servodeck.snapshots import PortState
from tests.fake_port import FakePort, FakePorts
from tests.virtual_time import at, in_virtual_time, now

MISSING = PortMissingError("There is no such port.")


@dataclass
class Notes:
    """The events of a link, in order."""

    happened: list[str] = field(default_factory=list)
    states: list[PortState] = field(default_factory=list)
    link: Link | None = None

    def port_opened(self, wire: Wire) -> None:
        self.happened.append("opened")

    def port_lost(self, unfinished: CommandPacket | None) -> None:
        self.happened.append("lost")

    def port_changed(self) -> None:
        assert self.link
        self.states.append(self.link.state)
        self.happened.append(self.link.state.status)


def link_to(ports: Ports) -> tuple[Link, Notes]:
    def make_wire(port: OpenPort) -> Wire:
        return Wire(port, gap_s=0.01, now=now, received=lambda _data: None)

    notes = Notes()
    notes.link = Link(ports, make_wire, notes, now)
    return notes.link, notes


@in_virtual_time
async def test_a_port_opens_serves_and_closes() -> None:
    port = FakePort()
    link, notes = link_to(FakePorts(port))
    with pytest.raises(ClosedError):
        link.wire()
    await link.use("/dev/board")
    assert isinstance(link.wire(), Wire)
    assert link.state == PortState(device="/dev/board", status="open")
    await link.close()
    assert notes.happened == ["opening", "opened", "open", "closed"]
    assert not port.is_open


@in_virtual_time
async def test_a_missing_port_is_tried_again_with_growing_pauses_up_to_five_seconds() -> None:
    ports = FakePorts(MISSING)
    link, _ = link_to(ports)
    with pytest.raises(PortMissingError):
        await link.use("/dev/board")
    await asyncio.sleep(20)
    await link.close()
    assert [at_s for at_s, _ in ports.attempts] == [0, 0.25, 0.75, 1.75, 3.75, 8.75, 13.75, 18.75]


@in_virtual_time
async def test_the_state_says_why_and_when_the_next_attempt_follows() -> None:
    link, notes = link_to(FakePorts(PortBusyError("minicom (7) has it.", ["minicom (7)"]), MISSING))
    with pytest.raises(PortBusyError):
        await link.use("/dev/board")
    await asyncio.sleep(0.3)
    await link.close()
    lost = [state for state in notes.states if state.status == "lost"]
    assert [(state.code, state.retry_in_ms) for state in lost] == [("portBusy", 250), ("portMissing", 500)]
    assert lost[0].detail == "minicom (7) has it."
    assert [state.held_by for state in lost] == [["minicom (7)"], []]


@in_virtual_time
async def test_a_lost_port_comes_back_by_itself_on_the_same_device() -> None:
    first, second = FakePort(), FakePort()
    ports = FakePorts(first, MISSING, second)
    link, notes = link_to(ports)
    await link.use("/dev/board")
    at(1, first.unplug)
    await asyncio.sleep(1.1)
    assert not first.is_open
    with pytest.raises(PortLostError):
        link.wire()
    await asyncio.sleep(2)
    assert link.state.status == "open"
    assert notes.happened == ["opening", "opened", "open", "lost", "lost", "lost", "opened", "open"]
    assert ports.attempts == [(0, "/dev/board"), (1.25, "/dev/board"), (1.75, "/dev/board")]
    await link.close()


@in_virtual_time
async def test_a_port_that_opens_and_fails_at_once_is_not_hammered() -> None:
    dead = [FakePort() for _ in range(4)]
    for port in dead:
        port.unplug()
    ports = FakePorts(*dead, MISSING)
    link, _ = link_to(ports)
    await link.use("/dev/board")
    await asyncio.sleep(3)
    await link.close()
    assert [at_s for at_s, _ in ports.attempts] == [0, 0.25, 0.75, 1.75]


@in_virtual_time
async def test_after_a_steady_connection_the_pauses_are_short_again() -> None:
    port = FakePort()
    ports = FakePorts(MISSING, MISSING, port, MISSING)
    link, _ = link_to(ports)
    with pytest.raises(PortMissingError):
        await link.use("/dev/board")
    at(20, port.unplug)
    await asyncio.sleep(20.3)
    await link.close()
    assert [at_s for at_s, _ in ports.attempts] == [0, 0.25, 0.75, 20.25]


@in_virtual_time
async def test_choosing_the_device_again_tries_at_once() -> None:
    ports = FakePorts(MISSING, FakePort())
    link, _ = link_to(ports)
    with pytest.raises(PortMissingError):
        await link.use("/dev/board")
    await asyncio.sleep(0.1)
    await link.use("/dev/board")
    assert link.state.status == "open"
    assert [at_s for at_s, _ in ports.attempts] == [0, 0.1]
    await link.close()


@in_virtual_time
async def test_of_two_choices_at_once_the_later_one_holds() -> None:
    ports = FakePorts(FakePort())
    link, _ = link_to(ports)
    earlier, later = await asyncio.gather(link.use("/dev/a"), link.use("/dev/b"), return_exceptions=True)
    assert isinstance(earlier, CancelledError)
    assert later is None
    assert link.state == PortState(device="/dev/b", status="open")
    assert [device for _, device in ports.attempts] == ["/dev/b"]
    await link.close()


@in_virtual_time
async def test_closing_while_it_is_being_tried_ends_the_attempts() -> None:
    ports = FakePorts(MISSING)
    link, _ = link_to(ports)
    with pytest.raises(PortMissingError):
        await link.use("/dev/board")
    await link.close()
    await asyncio.sleep(10)
    assert len(ports.attempts) == 1
    assert link.state == PortState(device=None, status="closed")


@in_virtual_time
async def test_listening_at_other_speeds_gives_the_port_up_and_opens_it_again() -> None:
    first, second = FakePort(), FakePort()
    ports = FakePorts(first, second)
    ports.at_other_rates = (115200, Heard(packets=1))
    link, notes = link_to(ports)
    await link.use("/dev/board")
    at(1, lambda: notes.happened.append(f"open: {first.is_open}"))
    assert await link.find_rate() == (115200, Heard(packets=1))
    await asyncio.sleep(0)
    assert link.state == PortState(device="/dev/board", status="open")
    assert notes.happened == ["opening", "opened", "open", "opening", "open: False", "opened", "open"]
    assert ports.attempts == [(0, "/dev/board"), (5, "/dev/board")]


@in_virtual_time
async def test_a_port_that_cannot_be_listened_on_is_tried_again() -> None:
    ports = FakePorts(FakePort(), MISSING, FakePort())
    ports.at_other_rates = PortLostError("It is gone.")
    link, _ = link_to(ports)
    await link.use("/dev/board")
    with pytest.raises(PortLostError):
        await link.find_rate()
    await asyncio.sleep(1)
    assert link.state.status == "open"


@in_virtual_time
async def test_another_port_is_chosen_while_one_is_listened_on() -> None:
    link, _ = link_to(FakePorts(FakePort(), FakePort()))
    await link.use("/dev/board")
    listening = asyncio.create_task(link.find_rate())
    await asyncio.sleep(1)
    await link.use("/dev/other")
    with pytest.raises(CancelledError):
        await listening
    await asyncio.sleep(5)
    assert link.state == PortState(device="/dev/other", status="open")


@pytest.mark.parametrize("device", ["hid:497223563535", "ble:BT24", "socket://127.0.0.1:9"])
@in_virtual_time
async def test_what_has_no_other_speeds_is_not_listened_on(device: str) -> None:
    port = FakePort()
    link, _ = link_to(FakePorts(port))
    with pytest.raises(ClosedError):
        await link.find_rate()
    await link.use(device)
    with pytest.raises(NotSupportedError):
        await link.find_rate()
    assert port.is_open
