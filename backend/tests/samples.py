"""Packets of the protocol document for the tests, and how long they spend on the wire."""

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
DOWNLOAD = bytes.fromhex("55550b190a010001e80301dc05")

GAP_MS = 10.0


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
