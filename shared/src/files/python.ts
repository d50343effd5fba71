// A group as a Python program that plays it over a serial port: data a person can read and change, and the few lines that send
// it. Needs pyserial and nothing of ours.

import { totalDurationMs } from '../group/group.ts';
import { FIRST_MOVE_MS, type Program } from './program.ts';

export function pythonOf({ group, family, frames }: Program): string {
  const rows = frames.map(({ durationMs, targets }) => {
    const positions = targets.map(({ servo, position }) => `${servo}: ${position}`).join(', ');
    return `    (${durationMs}, {${positions}}),\n`;
  });
  return `#!/usr/bin/env python3
"""Plays an action group on a servo board over its serial port, then ends. Ctrl-C ends it at once.

    pip install pyserial
    python THIS_FILE /dev/ttyUSB0        (Windows: COM3)
"""

import sys
import time

import serial

NAME = ${asciiLiteral(group.name)}
BOARD = ${asciiLiteral(family.name)}
TIMES = ${group.times}  # how often it is played; 0: until Ctrl-C
FIRST_MOVE_MS = ${FIRST_MOVE_MS}  # at least, because nobody knows where the servos stand
SERVOS_PER_PACKET = ${family.servosPerMove}
BAUD = 9600
GAP_S = 0.01  # what the board needs between two packets

# Milliseconds, then positions in ${family.unit === 'us' ? 'microseconds' : 'steps'} by servo number. ${totalDurationMs(frames)} ms in all.
FRAMES = [
${rows.join('')}]

STOP = bytes.fromhex("55 55 02 07")


def move_packet(duration_ms, targets):
    body = bytes([3, len(targets)]) + duration_ms.to_bytes(2, "little")
    for servo, position in targets:
        body += bytes([servo]) + position.to_bytes(2, "little")
    return bytes([0x55, 0x55, len(body) + 1]) + body


def send(port, packet):
    port.write(packet)
    port.flush()
    time.sleep(GAP_S)


def play(port):
    begun = 0
    deadline = 0
    while TIMES == 0 or begun < TIMES * len(FRAMES):
        duration_ms, positions = FRAMES[begun % len(FRAMES)]
        if begun == 0:
            duration_ms = max(duration_ms, FIRST_MOVE_MS)
        targets = list(positions.items())
        for start in range(0, len(targets), SERVOS_PER_PACKET):
            send(port, move_packet(duration_ms, targets[start : start + SERVOS_PER_PACKET]))
        if begun == 0:
            deadline = time.monotonic()  # a port may take a while to let the first packet go
        begun += 1
        deadline += max(duration_ms, 1) / 1000
        time.sleep(max(0, deadline - time.monotonic()))


def main():
    if len(sys.argv) != 2:
        sys.exit(f"Name the serial port: python {sys.argv[0]} /dev/ttyUSB0")
    with serial.serial_for_url(sys.argv[1], BAUD) as port:
        print(f"Plays {NAME} on {BOARD}.")
        try:
            play(port)
        except KeyboardInterrupt:
            send(port, STOP)
            print("Ended. The last move goes on to its end.")


if __name__ == "__main__":
    main()
`;
}

/** Whatever a name holds is no code: a JSON string of ASCII means the same in Python. */
function asciiLiteral(text: string): string {
  return JSON.stringify(text.toWellFormed()).replaceAll(
    /[^ -~]/g,
    (unit) => `\\u${unit.charCodeAt(0).toString(16).padStart(4, '0')}`,
  );
}
