// Board families as data: what a board of each kind takes, answers and means. One table for codec, session, simulator and
// page; behaviour that differs between boards is a row here, never an `if` elsewhere. Source: boards.md section 2.

import type { CommandKind } from './commands.ts';

export interface Range {
  readonly min: number;
  readonly max: number;
}

export interface Family {
  readonly id: FamilyId;
  /** Shown to people; a proper name, the same in every language. */
  readonly name: string;
  readonly unit: 'us' | 'steps';
  readonly position: Range;
  /** Centre of the position range, where a servo is at rest. */
  readonly centre: number;
  /** Servo numbers the board accepts in a packet. */
  readonly servo: Range;
  /** How many servos such a robot usually has, numbered from 1: the sliders of the page. */
  readonly usualServoCount: number;
  readonly servosPerMove: number;
  readonly servosPerFrame: number;
  /** Move and frame time. Shorter moves take the minimum step of the board, longer ones are cut by it (S25). */
  readonly durationMs: Range;
  readonly shortestMoveMs: number;
  readonly framesPerGroup: number;
  readonly slot: Range;
  readonly runTimes: Range;
  /** Largest LEN that is safe to send. */
  readonly maxLength: number;
  readonly commands: readonly CommandKind[];
  /** Commands the board answers; the others are silent by design. */
  readonly answers: readonly CommandKind[];
  /** Reports of runs name slot and times (6 and 8 with LEN 5), whoever asked for the run; otherwise they are empty. */
  readonly runReportsNameSlot: boolean;
  /** What an empty packet 7 says: opposite things per family (boards.md 2.4). */
  readonly emptySeven: 'runFinished' | 'runStopped' | 'unknown';
  /** Pause the board needs between two packets, after the last byte has left the wire (S52, S54). */
  readonly serviceGapMs: number;
}

export type FamilyId = 'doc' | 'openarm-new' | 'lsc-16' | 'bus-ctrl';

// Where a packet's own field is the only limit: one byte for the slot, two for the times.
const BYTE: Range = { min: 0, max: 255 };
const WORD: Range = { min: 0, max: 0xffff };

/** The open firmware (boards.md chapter 3); what its rows share with the ideal board of the protocol document. */
const openFirmware = {
  unit: 'us',
  position: { min: 500, max: 2500 }, // S24
  centre: 1500,
  durationMs: { min: 0, max: 30_000 }, // S25
  shortestMoveMs: 20, // S25, S27
  framesPerGroup: 255, // S34
  slot: BYTE,
  runTimes: WORD,
  maxLength: 253, // S3
  runReportsNameSlot: false,
  emptySeven: 'runFinished', // S48
  serviceGapMs: 10, // S54
} as const;

/** LSC and bus servo boards by document (boards.md chapter 5): closed firmware, so every figure is the careful one. */
const closedFirmware = {
  durationMs: { min: 0, max: 30_000 },
  shortestMoveMs: 20,
  // No download on this link: frame limits bound what is composed here and played from here.
  framesPerGroup: 255,
  slot: { min: 0, max: 229 }, // X5
  runTimes: WORD,
  maxLength: 62, // one HID report (boards.md chapter 6)
  commands: ['move', 'run', 'stop', 'readBattery'],
  answers: ['readBattery'],
  runReportsNameSlot: true,
  emptySeven: 'runStopped',
  serviceGapMs: 10,
} as const;

export const FAMILIES: Readonly<Record<FamilyId, Family>> = {
  /** The ideal board: the open firmware plus the battery answer that only the document gives it. */
  doc: {
    ...openFirmware,
    id: 'doc',
    name: 'Generic board',
    servo: { min: 1, max: 32 },
    usualServoCount: 6,
    servosPerMove: 32,
    servosPerFrame: 32,
    commands: ['move', 'run', 'stop', 'erase', 'readBattery', 'download'],
    answers: ['run', 'erase', 'readBattery', 'download'],
  },
  'openarm-new': {
    ...openFirmware,
    id: 'openarm-new',
    name: 'OpenArm, uHand 2.0',
    servo: { min: 1, max: 6 }, // channels 0 and 7 are taken but have no pins (S23)
    usualServoCount: 6,
    servosPerMove: 6,
    servosPerFrame: 6, // room for 20, but a frame of more than 8 ends the run (S38)
    commands: ['move', 'run', 'stop', 'erase', 'download'],
    answers: ['run', 'erase', 'download'],
  },
  'lsc-16': {
    ...closedFirmware,
    id: 'lsc-16',
    name: 'LSC-16',
    unit: 'us',
    position: { min: 500, max: 2500 },
    centre: 1500,
    servo: { min: 1, max: 16 },
    usualServoCount: 16,
    servosPerMove: 16,
    servosPerFrame: 16,
  },
  'bus-ctrl': {
    ...closedFirmware,
    id: 'bus-ctrl',
    name: 'Bus Servo Controller',
    unit: 'steps',
    position: { min: 0, max: 1000 },
    centre: 500,
    servo: { min: 1, max: 253 }, // 254 would move every servo at once
    usualServoCount: 6,
    servosPerMove: 19,
    servosPerFrame: 19,
  },
};

export function family(id: FamilyId): Family {
  return FAMILIES[id];
}
