// A group as a program that plays it: what this page would send, in portions that fit the board, with the robot's trims, and around them an
// Arduino sketch or a Python program. Refused where the board or the robot cannot take it.

import type { Frame } from '../codec/commands.ts';
import { encodeCommand } from '../codec/encode.ts';
import type { Family } from '../codec/families.ts';
import { compile } from '../group/compile.ts';
import { type ActionGroup, isStraight, maxErrorOf, totalDurationMs } from '../group/group.ts';
import { onBoard, type Robot } from '../profile/robot.ts';
import { filled, misfitsOf, type Misfit } from './fit.ts';
import { fileNameOf } from './fileName.ts';
import timings from '../../protocol/timings.json' with { type: 'json' };

export interface Program {
  readonly group: ActionGroup;
  readonly family: Family;
  /** Whole poses, as the board counts. */
  readonly frames: readonly Frame[];
}

/** The way to the first frame is gentle: it is unknown where the servos stand. */
export const FIRST_MOVE_MS = timings.move.firstMs;

export function programOf(
  group: ActionGroup,
  family: Family,
  robot: Robot,
): { readonly program: Program } | { readonly misfits: readonly Misfit[] } {
  const misfits = misfitsOf(group, family, robot).filter(({ code }) => !STORED_ONLY.includes(code));
  if (misfits.length > 0) return { misfits };
  const frames = straightened(group, family).map(({ durationMs, targets }) => ({
    durationMs,
    targets: onBoard(robot, targets),
  }));
  return { program: { group, family, frames } };
}

/** A curve takes as many straight ways as this page would play it in; straight ways stay the frames they are. */
function straightened(group: ActionGroup, family: Family): readonly Frame[] {
  return group.frames.every(isStraight)
    ? filled(group).frames
    : compile(group, { family, maxErrorUnits: maxErrorOf(group, family) }).frames;
}

/** What limits a board's memory limits no program. */
const STORED_ONLY: readonly Misfit['code'][] = ['frameCount', 'servoCount', 'slot'];

/** One frame's moves in the order they are sent; none for a pause. */
function movesOf({ durationMs, targets }: Frame, family: Family): readonly Uint8Array[] {
  const size = family.servosPerMove;
  return Array.from({ length: Math.ceil(targets.length / size) }, (_, index) =>
    encodeCommand(
      { kind: 'move', durationMs, targets: targets.slice(index * size, (index + 1) * size) },
      family,
    ),
  );
}

/** An Arduino sketch: ready packets in flash and the few lines that send them. It plays while a pin is held, so that plugging in a cable moves nothing. */

export function arduinoOf({ group, family, frames }: Program): string {
  const first = frames.slice(0, 1).map(({ durationMs, targets }) => ({
    durationMs: Math.max(durationMs, FIRST_MOVE_MS),
    targets,
  }));
  const [firstRows, rows] = [first, frames].map((some) => some.map((frame) => rowsOf(frame, family)));
  const longest = Math.max(
    1,
    ...frames.flatMap((frame) => movesOf(frame, family)).map(({ length }) => length),
  );
  return `// ${fileNameOf({ name: group.name, slot: null }, '')}, for ${family.name}.
// Wiring: TX of the Arduino to RX of the board, GND to GND. Connect pin 2 to GND to play; open it to end after the frame.

#include <Arduino.h>

#define BOARD Serial  // boards with a second port: Serial1
const uint8_t PLAY_PIN = 2;
const unsigned int TIMES = ${group.times};  // how often it is played; 0: as long as the pin is held
const uint8_t GAP_MS = 10;  // what the board needs between two packets

// Each step: its milliseconds (low byte, high byte), the length of its packet, the packet.
const uint8_t STEPS[] PROGMEM = {
${rows?.join('') ?? ''}};

// Frame 1 while the positions of the servos are unknown: slowly.
const uint8_t FIRST_STEPS[] PROGMEM = {
${firstRows?.join('') ?? ''}};
const size_t SECOND_FRAME = ${bytesIn(frames.slice(0, 1), family)};

uint8_t packet[${longest}];
unsigned long deadlineMs;

bool isHeld() { return digitalRead(PLAY_PIN) == LOW; }

void play(const uint8_t *steps, size_t from, size_t end) {
  for (size_t at = from; at < end && isHeld();) {
    deadlineMs += pgm_read_byte(steps + at) | (unsigned long)pgm_read_byte(steps + at + 1) << 8;
    uint8_t length = pgm_read_byte(steps + at + 2);
    for (uint8_t i = 0; i < length; i++) packet[i] = pgm_read_byte(steps + at + 3 + i);
    BOARD.write(packet, length);
    BOARD.flush();
    delay(GAP_MS);
    while ((long)(millis() - deadlineMs) < 0) {
    }
    at += 3 + length;
  }
}

void setup() {
  pinMode(PLAY_PIN, INPUT_PULLUP);
  BOARD.begin(9600);
}

void loop() {
  while (!isHeld()) {
  }
  deadlineMs = millis();
  play(FIRST_STEPS, 0, sizeof(FIRST_STEPS));
  play(STEPS, SECOND_FRAME, sizeof(STEPS));
  for (unsigned int round = 1; isHeld() && (TIMES == 0 || round < TIMES); round++) play(STEPS, 0, sizeof(STEPS));
  while (isHeld()) {
  }
}
`;
}

/** One step for each packet of the frame, its time with the last of them; a pause is a step without a packet. */
function stepsOf(frame: Frame, family: Family): readonly (readonly number[])[] {
  const moves = movesOf(frame, family);
  const packets = moves.length === 0 ? [new Uint8Array()] : moves;
  return packets.map((packet, index) => {
    const ms = index === packets.length - 1 ? frame.durationMs : 0;
    return [ms & 0xff, ms >> 8, packet.length, ...packet];
  });
}

const bytesIn = (frames: readonly Frame[], family: Family): number =>
  frames.flatMap((frame) => stepsOf(frame, family).flat()).length;

const rowsOf = (frame: Frame, family: Family): string =>
  stepsOf(frame, family)
    .map((step) => `  ${step.map(hex).join(', ')},\n`)
    .join('');

const hex = (byte: number): string => `0x${byte.toString(16).toUpperCase().padStart(2, '0')}`;

/** A Python program: data a person can read and change, and the few lines that send it. Needs pyserial and nothing of ours. */

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
FIRST_MOVE_MS = ${FIRST_MOVE_MS}  # at least, because the positions of the servos are unknown
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
            print("Ended. The last move continues to its end.")


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
