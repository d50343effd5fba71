"""Packets of the protocol document for the tests, and how long they spend on the wire."""

from servodeck.protocol.packets import parse_command
from servodeck.protocol.values import Command, Frame, Move, ServoTarget
from servodeck.robot.board.download import Group, packets_of

MOVE = bytes.fromhex("5555080301e80301d007")
MOVE_ELSEWHERE = bytes.fromhex("5555080301e80301dc05")
# MOVE takes servo 1 to 2000 and MOVE_ELSEWHERE to 1500, in a second each.
MOVE_S = 1.0
RUN = bytes.fromhex("55550506080100")
STOP = bytes.fromhex("55550207")
STOPS = [STOP, STOP, STOP]
ERASE = bytes.fromhex("5555030800")
BATTERY = bytes.fromhex("5555020f")
BATTERY_REPORT = bytes.fromhex("5555040f4c1d")
# Its message to clients.
BATTERY_HEARD = {
    "type": "received",
    "report": {"kind": "battery", "batteryMv": 7500},
    "bytes": BATTERY_REPORT.hex(),
}
DOWNLOAD = bytes.fromhex("55550b190a010001e80301dc05")

GAP_MS = 10.0
# Of a second's move by 500: what it goes in a tick, while the board says something, while the hold leaves.
AHEAD, AHEAD_MS = 30, 60


def command_in(packet: bytes) -> Command:
    command = parse_command(packet)
    assert command
    return command


def wire_ms(packet: bytes) -> float:
    return len(packet) * 10_000 / 9_600


def hold_at(position: int, duration_ms: int = 20) -> bytes:
    """Servo 1 stays there."""
    return (
        bytes.fromhex("5555080301")
        + duration_ms.to_bytes(2, "little")
        + b"\x01"
        + position.to_bytes(2, "little")
    )


def is_held_ahead(packet: bytes, at: float, to: float) -> bool:
    """Servo 1 stays where it is, or what the estimate leaves open further on its way: never behind."""
    hold = parse_command(packet)
    assert isinstance(hold, Move)
    [target] = hold.targets
    ahead = (target.position - at) * (1 if to > at else -1)
    return target.servo == 1 and -1 <= ahead <= AHEAD and hold.duration_ms <= AHEAD_MS


def stored(slot: int, *durations_ms: int, board: str = "doc") -> list[bytes]:
    """The packets of a group whose frames take servo 1 to 1000, 1100 and so on."""
    frames = [
        Frame(duration_ms, (ServoTarget(1, 1000 + 100 * index),))
        for index, duration_ms in enumerate(durations_ms)
    ]
    return list(packets_of(Group(slot, "", frames), board))
