// What a packet can look like in each direction: its command number and LEN, and where packets grow with the number of
// servos, the byte that counts them. Nothing else protects this wire (no checksum), so a header of another shape is
// taken for noise. Knows no meaning and no family: reports are the union over all families (boards.md 2.3, 2.4).

import timings from '../../protocol/timings.json' with { type: 'json' };
import { MAX_LENGTH } from './packet.ts';

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
