// What a packet can look like in each direction (command number, LEN, count of servos), and whether one begins at a place in a run
// of bytes. The wire has no checksum, so a packet has to prove itself by its shape and by what follows it. Knows no meaning and no
// family: reports are the union over all families (boards.md 2.3, 2.4).

import timings from '../../protocol/timings.json' with { type: 'json' };
import { MAX_LENGTH, HEADER } from './packet.ts';

interface Shape {
  readonly command: number;
  /** LEN; of a growing packet, its LEN without servos. */
  readonly length: number;
  readonly perServo?: {
    readonly bytes: number;
    /** Index of the count byte in the parameters. */
    readonly countAt: number;
    readonly least: number;
    readonly most: number;
  };
}

/** Shapes compiled for one look-up per header. */
export interface ShapeRule {
  /** By LEN: 1 where some packet has it. */
  readonly lengths: Uint8Array;
  /** By command << 8 | LEN: 0 no such packet, 1 no count byte, otherwise 2 + what the count byte must be. */
  readonly counts: Uint8Array;
  /** By command: index of the count byte in the parameters. */
  readonly countAt: Uint8Array;
}

function compile(shapes: readonly Shape[]): ShapeRule {
  const rule = {
    lengths: new Uint8Array(256),
    counts: new Uint8Array(0x10000),
    countAt: new Uint8Array(256),
  };
  const add = (command: number, length: number, count: number): void => {
    rule.lengths[length] = 1;
    rule.counts[(command << 8) | length] = count;
  };
  for (const { command, length, perServo } of shapes) {
    if (perServo === undefined) {
      add(command, length, 1);
      continue;
    }
    rule.countAt[command] = perServo.countAt;
    for (let servos = perServo.least; servos <= perServo.most; servos++) {
      const grown = length + servos * perServo.bytes;
      if (grown <= MAX_LENGTH) add(command, grown, servos + 2);
    }
  }
  return rule;
}

const MOST_SERVOS = timings.decoder.mostServos;

/** Board to host. The long record 28 of one family is not documented well enough to be listed. */
export const REPORT_SHAPES: ShapeRule = compile([
  { command: 1, length: 4 }, // LeArm version
  { command: 2, length: 14 }, // LeArm offsets
  { command: 5, length: 4 }, // xArm download step
  { command: 6, length: 2 }, // OpenArm: run accepted
  { command: 6, length: 5 }, // LSC: run started
  { command: 7, length: 2 }, // OpenArm: run finished; LSC: run stopped
  { command: 8, length: 2 }, // erased
  { command: 8, length: 5 }, // LSC: run finished
  { command: 11, length: 2 }, // LeArm: offsets saved
  { command: 13, length: 20 }, // LeArm positions
  { command: 15, length: 4 }, // battery
  { command: 21, length: 3, perServo: { bytes: 3, countAt: 0, least: 1, most: MOST_SERVOS } }, // bus positions
  { command: 23, length: 3, perServo: { bytes: 2, countAt: 0, least: 1, most: MOST_SERVOS } }, // xArm offsets
  { command: 25, length: 2 }, // frame stored
]);

/** Host to board: the six commands of the protocol document, then what single families have. */
export const COMMAND_SHAPES: ShapeRule = compile([
  { command: 3, length: 5, perServo: { bytes: 3, countAt: 0, least: 0, most: 82 } },
  { command: 6, length: 5 },
  { command: 7, length: 2 },
  { command: 8, length: 2 }, // LeArm
  { command: 8, length: 3 },
  { command: 15, length: 2 },
  { command: 25, length: 8, perServo: { bytes: 3, countAt: 3, least: 0, most: 81 } },
  { command: 1, length: 2 }, // LeArm: version
  { command: 2, length: 2 }, // LeArm: offsets
  { command: 11, length: 5 }, // LSC, bus: speed
  { command: 13, length: 2 }, // LeArm: positions
  { command: 20, length: 3, perServo: { bytes: 1, countAt: 0, least: 1, most: MOST_SERVOS } }, // bus: release
  { command: 21, length: 3, perServo: { bytes: 1, countAt: 0, least: 1, most: MOST_SERVOS } }, // bus: positions
]);

// Decides whether a packet begins at a place in a run of bytes: yes, no, or "more bytes needed". The wire has no
// checksum, so a packet has to prove itself by its shape and by what follows it.

/** No packet begins here. */
export const NO = -1;
/** The bytes end before it is certain. */
export const WAIT = 0;
/** Two headers, LEN, CMD: a packet without parameters is no longer. */
const HEAD_SIZE = 4;

/**
 * The size of the packet at `at`, NO or WAIT. An empty packet is believed at once, unless its number equals its LEN: that
 * may be any packet whose LEN was doubled. Such a one and a packet with parameters are believed when the next byte begins
 * another packet: one byte too few or too many inside it shows there, and only there.
 * The answer never depends on bytes beyond those that settle it, so it is the same however the bytes arrive.
 */
export function judge(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  const size = packetSize(shape, bytes, at, end);
  if (size < HEAD_SIZE || (size === HEAD_SIZE && bytes[at + 3] !== bytes[at + 2])) return size;
  return at + size > end ? WAIT : followed(shape, bytes, at, size, end);
}

/** Like `judge` where nothing more will come: what is complete is believed, WAIT means cut short. */
export function judgeLast(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  const verdict = judge(shape, bytes, at, end);
  if (verdict !== WAIT) return verdict;
  const size = packetSize(shape, bytes, at, end);
  return at + size > end ? WAIT : size;
}

/** The size that the header at `at` announces, NO where it is none, WAIT while it is a header's beginning. */
function packetSize(shape: ShapeRule, bytes: Uint8Array, at: number, end: number): number {
  if (bytes[at] !== HEADER) return NO;
  if (at + 1 >= end) return WAIT;
  if (bytes[at + 1] !== HEADER) return NO;
  if (at + 2 >= end) return WAIT;
  const length = bytes[at + 2] ?? 0;
  // Also drops the first of three headers: no packet of either direction has LEN 0x55 (a board falls for it, S4).
  if (shape.lengths[length] === 0) return NO;
  if (at + 3 >= end) return WAIT;
  const command = bytes[at + 3] ?? 0;
  const count = shape.counts[(command << 8) | length] ?? 0;
  if (count === 0) return NO;
  if (count > 1) {
    const countAt = at + HEAD_SIZE + (shape.countAt[command] ?? 0);
    if (countAt < end && bytes[countAt] !== count - 2) return NO;
  }
  return length + 2;
}

/** Reads on byte by byte after a whole packet until its neighbour, or a header inside it, settles the matter. */
function followed(shape: ShapeRule, bytes: Uint8Array, at: number, size: number, end: number): number {
  const next = at + size;
  for (let seen = next + 1; seen <= end; seen++) {
    const neighbour = packetSize(shape, bytes, next, seen);
    if (neighbour === NO) return NO;
    if (neighbour > 0 || !straddled(shape, bytes, at, next, seen)) return size;
  }
  return WAIT;
}

/** Could a packet begin inside and run past `next`? Then the outer one may have lost bytes and eaten its neighbour's. */
function straddled(shape: ShapeRule, bytes: Uint8Array, at: number, next: number, seen: number): boolean {
  for (let inner = at + HEAD_SIZE; inner < next; inner++) {
    if (bytes[inner] !== HEADER) continue;
    const size = packetSize(shape, bytes, inner, seen);
    if (size === WAIT || inner + size > next) return true;
  }
  return false;
}
