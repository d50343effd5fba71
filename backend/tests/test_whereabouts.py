"""A device that comes back under another name, another one that takes its name: never the wrong board.

The rows play on a bus below the link: what is plugged in at first, what is there after the loss, and what is
opened then, if anything.
"""

import asyncio
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from serial.tools import list_ports

from servodeck.errors import ErrorCode, PortError
from servodeck.port.ports import list_usb
from servodeck.port.whereabouts import UsbDevice, Whereabouts
from tests.fake_port import FakeBus
from tests.test_link import link_to
from tests.virtual_time import at, in_virtual_time

USB0, USB1 = "/dev/ttyUSB0", "/dev/ttyUSB1"
# A CH340 has no serial number, an FTDI chip has its own, all CP2102 share one.
CH340 = UsbDevice(USB0, 0x1A86, 0x7523, location="1-1")
FTDI = UsbDevice(USB0, 0x0403, 0x6001, serial="A50285BI", location="1-1")
CP2102 = UsbDevice(USB0, 0x10C4, 0xEA60, serial="0001", location="1-1")
# One adapter with two ports.
FIRST_OF_TWO = UsbDevice(USB0, 0x0403, 0x6010, serial="FT4V", location="1-1:1.0")
SECOND_OF_TWO = UsbDevice(USB1, 0x0403, 0x6010, serial="FT4V", location="1-1:1.1")
COM3 = UsbDevice("COM3", 0x1A86, 0x7523)
MOUSE = UsbDevice(USB0, 0x046D, 0xC077, location="1-4")


def at_path(device: UsbDevice, path: str) -> UsbDevice:
    return replace(device, path=path)


def in_socket(device: UsbDevice, location: str, path: str = USB1) -> UsbDevice:
    return replace(device, path=path, location=location)


@dataclass(frozen=True)
class Case:
    name: str
    ours: UsbDevice
    after: tuple[UsbDevice, ...]
    then: UsbDevice | ErrorCode
    beside: tuple[UsbDevice, ...] = ()
    """What is there from the beginning."""


CASES = [
    Case("the same again", CH340, (CH340,), CH340),
    Case("gone", CH340, (), "portMissing"),
    Case("another name, same socket", CH340, (at_path(CH340, USB1),), at_path(CH340, USB1)),
    Case("another name, another took ours", CH340, (at_path(CH340, USB1), MOUSE), at_path(CH340, USB1)),
    Case("another took our name", CH340, (MOUSE,), "otherDevice"),
    Case("a twin took our name", CH340, (in_socket(CH340, "1-2", USB0),), "otherDevice"),
    Case("a twin took our name, ours is back", CH340, (in_socket(CH340, "1-2", USB0), at_path(CH340, USB1)),
         at_path(CH340, USB1)),
    Case("the twin beside stays", CH340, (in_socket(CH340, "1-2"),), "portMissing",
         beside=(in_socket(CH340, "1-2"),)),
    Case("the twin beside takes our name", CH340, (in_socket(CH340, "1-2", USB0),), "otherDevice",
         beside=(in_socket(CH340, "1-2"),)),
    Case("no number, another socket: ours or a twin", CH340, (in_socket(CH340, "1-3"),), "otherDevice"),
    Case("a number, another socket", FTDI, (in_socket(FTDI, "1-3"),), in_socket(FTDI, "1-3")),
    Case("another number in our socket", FTDI, (replace(FTDI, serial="B1"),), "otherDevice"),
    Case("another number in our socket, other name", FTDI, (replace(FTDI, serial="B1", path=USB1),),
         "portMissing"),
    Case("a number that is not its own: the twin beside", CP2102, (in_socket(CP2102, "1-2", USB0),),
         "otherDevice", beside=(in_socket(CP2102, "1-2"),)),
    Case("a number that is not its own: ours moved, the twin stays", CP2102,
         (in_socket(CP2102, "1-2"), in_socket(CP2102, "1-3", USB0)), in_socket(CP2102, "1-3", USB0),
         beside=(in_socket(CP2102, "1-2"),)),
    Case("a number that is not its own: two new ones", CP2102,
         (in_socket(CP2102, "1-2", USB0), in_socket(CP2102, "1-3")), "otherDevice"),
    Case("the other port of the same adapter", FIRST_OF_TWO, (at_path(SECOND_OF_TWO, USB0),), "otherDevice"),
    Case("both ports, names swapped", FIRST_OF_TWO,
         (at_path(SECOND_OF_TWO, USB0), at_path(FIRST_OF_TWO, USB1)), at_path(FIRST_OF_TWO, USB1),
         beside=(SECOND_OF_TWO,)),
    Case("no socket, the same name", COM3, (COM3,), COM3),
    Case("no socket, another name", COM3, (replace(COM3, path="COM4"),), "otherDevice"),
    Case("our type became another in our socket", CH340, (replace(CH340, product=0x5523),), "otherDevice"),
]  # fmt: skip


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@in_virtual_time
async def test_after_a_loss_only_the_same_device_is_opened(case: Case) -> None:
    bus = FakeBus(case.ours, *case.beside)
    link, _ = link_to(bus)
    await link.use(case.ours.path)
    at(1, lambda: pull(bus, case))
    at(1.1, lambda: bus.plugged.extend(one for one in case.after if one not in bus.plugged))
    await asyncio.sleep(2)
    if isinstance(case.then, UsbDevice):
        assert bus.opened == [case.ours, case.then]
        assert (link.state.status, link.state.device) == ("open", case.then.path)
    else:
        assert bus.opened == [case.ours]
        assert (link.state.status, link.state.code) == ("lost", case.then)
    await link.close()


def pull(bus: FakeBus, case: Case) -> None:
    """What stood beside it and is there afterwards has never been away, only its name may be another."""
    stayed = {one.place for one in case.beside}
    bus.replug(*(one for one in case.after if one.place in stayed))


@in_virtual_time
async def test_a_device_that_takes_the_name_while_it_is_opened_is_closed_again_unused() -> None:
    bus = FakeBus(CH340)
    link, notes = link_to(bus)
    await link.use(USB0)
    bus.when_opened = lambda: bus.plugged.__setitem__(0, MOUSE)
    at(1, lambda: bus.replug(CH340))
    await asyncio.sleep(1.3)
    assert (link.state.status, link.state.code) == ("lost", "otherDevice")
    assert bus.open_ports == 0
    assert notes.happened.count("opened") == 1
    await link.close()


@in_virtual_time
async def test_choosing_the_name_again_takes_the_device_that_has_it_now() -> None:
    bus = FakeBus(CH340)
    link, _ = link_to(bus)
    await link.use(USB0)
    twin = in_socket(CH340, "1-2", USB0)
    at(1, lambda: bus.replug(twin))
    await asyncio.sleep(2)
    assert link.state.detail == "/dev/ttyUSB0 is another device now. Choose the port again."
    await link.use(USB0)
    assert bus.opened == [CH340, twin]
    await link.close()


def test_a_device_chosen_by_a_lasting_name_keeps_it(tmp_path: Path) -> None:
    name = tmp_path / "by-id"
    name.symlink_to(USB0)
    whereabouts = Whereabouts(str(name))
    assert whereabouts.find([FTDI]) == str(name)
    whereabouts.opened(str(name), [FTDI])
    assert whereabouts.find([FTDI]) == str(name)
    assert whereabouts.find([at_path(FTDI, USB1), MOUSE]) == USB1


@pytest.mark.parametrize("name", ["/dev/pts/7", "socket://127.0.0.1:4000", "/dev/ttyS0"])
def test_what_has_no_place_on_the_bus_goes_by_its_name(name: str) -> None:
    whereabouts = Whereabouts(name)
    whereabouts.opened(name, [CH340])
    whereabouts.note_others([CH340, MOUSE])
    assert whereabouts.find([]) == name
    assert whereabouts.find([CH340, MOUSE]) == name


def test_a_board_is_remembered_by_its_own_number_else_by_its_socket_else_by_its_name() -> None:
    for device, lasting in (
        (FTDI, f"0403:6001 {FTDI.serial}"),
        (in_socket(FTDI, "1-3", USB0), f"0403:6001 {FTDI.serial}"),
        (FIRST_OF_TWO, "0403:6010 FT4V 1.0"),
        (SECOND_OF_TWO, "0403:6010 FT4V 1.1"),
        (in_socket(SECOND_OF_TWO, "2-1:1.1"), "0403:6010 FT4V 1.1"),
        (CP2102, "10c4:ea60 1-1"),
        (CH340, "1a86:7523 1-1"),
        (COM3, "COM3"),
    ):
        whereabouts = Whereabouts(device.path)
        assert whereabouts.lasting == device.path
        whereabouts.opened(whereabouts.find([device]), [device])
        assert whereabouts.lasting == lasting


PATHS = [f"/dev/ttyUSB{number}" for number in range(4)]
SOCKETS = ["1-1", "1-2", "1-3", "1-4"]
# Four adapters, each with an identity that only the test knows.
ADAPTERS = st.sampled_from([CH340, FTDI, CP2102, replace(FTDI, serial="B1")])


@given(st.data())
def test_no_history_of_a_bus_leads_to_a_device_that_was_there_beside_ours(data: st.DataObject) -> None:
    kinds = data.draw(st.lists(ADAPTERS, min_size=2, max_size=4))
    sockets = data.draw(st.permutations(SOCKETS))
    names = data.draw(st.permutations(PATHS))
    beside = [in_socket(*row) for row in zip(kinds, sockets, names, strict=False)]
    ours = beside.pop()
    whereabouts = Whereabouts(ours.path)
    whereabouts.opened(whereabouts.find([ours, *beside]), [ours, *beside])
    whereabouts.note_others(beside)
    # Ours is gone for good; those that stayed got other names at most.
    renamed = data.draw(st.permutations(PATHS))
    listed = [at_path(*row) for row in zip(beside, renamed, strict=False)]
    with pytest.raises(PortError):
        whereabouts.find(listed)


def test_the_bus_is_listed_as_the_system_lists_it(monkeypatch: pytest.MonkeyPatch) -> None:
    mainboard = SimpleNamespace(device="/dev/ttyS0", vid=None, pid=None, serial_number=None, location=None)
    adapter = SimpleNamespace(device=USB0, vid=0x1A86, pid=0x7523, serial_number=None, location="1-1")
    monkeypatch.setattr(list_ports, "comports", lambda: [mainboard, adapter])
    assert list_usb() == [CH340]
