"""All sliders dragged without Servodeck: pyserial alone at the board sends the newest value whenever the wire
is free.

Prints when it began, in milliseconds since the epoch; value k is of k pointer reports later.
Usage: plain_drag.py DEVICE SERVOS POINTER_MS DRAG_MS FIRST_POSITION GAP_MS
"""

import sys
import time

import serial

BAUD = 9600


def main() -> None:
    device = sys.argv[1]
    servos, pointer_ms, drag_ms, first, gap_ms = map(int, sys.argv[2:])
    last = drag_ms // pointer_ms - 1
    with serial.Serial(device, BAUD) as port:
        begun_s = time.time()
        event = -1
        while event < last:
            event = min(last, int((time.time() - begun_s) * 1000 / pointer_ms))
            packet = move_to(servos, first + event)
            left_s = time.perf_counter() + len(packet) * 10 / BAUD + gap_ms / 1000
            port.write(packet)
            time.sleep(max(0.0, left_s - time.perf_counter()))
    sys.stdout.write(f"{begun_s * 1000}\n")


def move_to(servos: int, position: int) -> bytes:
    targets = b"".join(bytes([servo]) + position.to_bytes(2, "little") for servo in range(1, servos + 1))
    return b"\x55\x55" + bytes([5 + len(targets), 3, servos]) + (50).to_bytes(2, "little") + targets


if __name__ == "__main__":
    main()
