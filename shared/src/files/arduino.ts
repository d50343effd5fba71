// A group as an Arduino sketch: ready packets in flash and the few lines that send them, wherever there is a hardware serial
// port. It plays while a pin is held, so that nothing moves because a cable was plugged in.

import type { Frame } from '../codec/commands.ts';
import type { Family } from '../codec/families.ts';
import { fileNameOf } from './fileName.ts';
import { FIRST_MOVE_MS, movesOf, type Program } from './program.ts';

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

// Frame 1 when nobody knows where the servos stand: slowly.
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
