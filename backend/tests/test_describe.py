"""Packets in words, as the command line prints them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from servodeck.errors import MalformedError
from servodeck.protocol.describe import pieces_of
from servodeck.protocol.pasted import bytes_in

FROM_BOARD = "; from a board: "
BOTH = bytes.fromhex("5555020F 5555040F3831")


def saleae(cell: str) -> str:
    rows = (f'"Async Serial","data",0.00{at:02},0.0001,{cell.format(one)}\n' for at, one in enumerate(BOTH))
    return "".join(rows)


def words_of(text: str) -> list[str]:
    return [piece.text for piece in pieces_of(bytes_in(text))]


@pytest.mark.parametrize(
    ("packet", "words"),
    [
        ("55 55 0B 03 02 20 03 02 B0 04 09 FC 08", "move servo 2 to 1200, servo 9 to 2300 in 800 ms"),
        ("55 55 05 06 08 01 00", "run group 8 once"),
        ("55 55 05 06 02 00 00", "run group 2 until stopped"),
        ("55 55 05 06 64 2C 01", "run group 100 300 times"),
        ("55 55 02 07", "stop the running group after the frame in progress"),
        ("55 55 03 08 00", "erase all groups"),
        ("55 55 02 0F", "ask for the battery voltage"),
        (
            "55 55 0E 19 05 02 01 02 F4 01 01 F4 01 02 C4 09",
            "store frame 1 (of 2, from 0) of group 5: servo 1 to 500, servo 2 to 2500 in 500 ms",
        ),
        ("55 55 08 19 07 03 01 00 F4 01", "store frame 1 (of 3, from 0) of group 7: nothing in 500 ms"),
        ("55 55 05 0B 08 32 00", "set the speed of group 8 to 50 %"),
        ("55 55 05 0B FF 2C 01", "set the speed of all groups to 300 %"),
        ("55 55 05 14 02 01 03", "take the torque off servo 1, servo 3"),
        ("55 55 04 15 01 06", "ask for the position of servo 6"),
        ("55 55 02 01", "ask for the version"),
        ("55 55 02 0D", "ask for the positions of all servos"),
        ("55 55 02 02", "ask for the offsets"),
        ("55 55 04 63 01 02", "unknown: CMD 99, parameters 01 02"),
    ],
)
def test_a_command_in_words(packet: str, words: str) -> None:
    (text,) = words_of(packet)
    assert text.partition(FROM_BOARD)[0] == words


@pytest.mark.parametrize(
    ("packet", "words"),
    [
        ("55 55 02 06", "run command taken"),
        ("55 55 05 06 08 03 00", "group 8 started, 3 times"),
        ("55 55 02 07", "the group ended by itself (OpenArm) or was stopped (LSC, bus servo boards)"),
        ("55 55 02 08", "all groups erased"),
        ("55 55 05 08 08 01 00", "group 8 ended by itself"),
        ("55 55 04 0F 4C 1D", "battery 7500 mV"),
        ("55 55 02 19", "download frame handled"),
        ("55 55 06 15 01 01 F4 01", "servo 1 is at 500"),
        (
            "55 55 14 0D 01 F4 01 02 FD FF 03 DC 05 04 DC 05 05 DC 05 06 DC 05",
            "servo 1 is at 500, servo 2 is at -3, servo 3 is at 1500, servo 4 is at 1500, "
            "servo 5 is at 1500, servo 6 is at 1500",
        ),
        (
            "55 55 0E 02 01 00 02 FB 03 00 04 0A 05 00 06 FF",
            "servo 1 has offset 0, servo 2 has offset -5, servo 3 has offset 0, servo 4 has offset 10, "
            "servo 5 has offset 0, servo 6 has offset -1",
        ),
        ("55 55 04 01 02 03", "version 3, bus servos"),
        ("55 55 04 01 09 03", "version 3, servos of type 9"),
        ("55 55 02 0B", "unknown: CMD 11, no parameters"),
    ],
)
def test_a_report_in_words(packet: str, words: str) -> None:
    (text,) = words_of(packet)
    assert text.split(FROM_BOARD)[-1] == words


@pytest.mark.parametrize(
    "text",
    [
        "5555020F 5555040F3831",
        "55,55,02,0f, 55,55,04,0f,38,31",
        "0x55, 0x55, 0x2, 0xF, 0X55 0x55 0x04 0x0F 0x38 0x31",
        r"\x55\x55\x02\x0f\x55\x55\x04\x0f\x38\x31",
        "Time [s],Value\n0.01,0x55\n0.02,0x55\n0.03,0x02\n0.04,0x0F\n1.01,0x55 0x55 0x04 0x0F 0x38 0x31",
        # Saleae Logic 2, its table with a decimal radix and quoted cells, and Logic 1
        'name,type,start_time,duration,"data"\n' + saleae('"{0:#04x}"'),
        "name,type,start_time,duration,data\n" + saleae("{0}"),
        "name,type,start_time,duration,data\n" + saleae('"{0:02X}"'),
        "name;type;start_time;duration;Value\n" + saleae("{0}").replace(",", ";"),
        # sigrok: PulseView and sigrok-cli
        "".join(f"{at}00-{at}90 UART: RX data: {one:02X}\n" for at, one in enumerate(BOTH)),
        "".join(f"uart-1: {one:02x}\n" for one in BOTH),
    ],
)
def test_bytes_are_read_as_people_paste_them(text: str) -> None:
    assert words_of(text) == ["ask for the battery voltage", "battery 12600 mV"]


@pytest.mark.parametrize("text", ["zz", "555", "55 5G", "0x55 0x1FF"])
def test_what_is_no_byte_is_named(text: str) -> None:
    with pytest.raises(MalformedError, match=r"no hex byte"):
        bytes_in(text)


def test_what_is_between_packets_is_shown() -> None:
    assert words_of("01 02 55 55 55 02 06 FF") == [
        "no packet: 01 02 55",
        "run command taken",
        "no packet: FF",
    ]


@given(
    st.lists(st.sampled_from(["5555020F", "5555040F3831", "55550506080100", "00", "55", "FFFE", "555508"]))
)
def test_no_byte_is_lost(parts: list[str]) -> None:
    data = bytes.fromhex("".join(parts))
    assert b"".join(piece.data for piece in pieces_of(data)) == data
