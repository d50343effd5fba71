// Board families as data: what a board of each kind takes, answers and means. One table for codec, session, simulator and
// page; behaviour that differs between boards is a row here, never an `if` elsewhere. Source: boards.md section 2.

import type { CommandKind } from './commands.ts';

export interface Range {
  readonly min: number;
  readonly max: number;
}

export interface Family {
  readonly id: BoardId;
  /** Shown to people; a proper name, the same in every language. */
  readonly name: string;
  readonly unit: 'us' | 'steps';
  readonly position: Range;
  /** Servos that may turn less far than `position` says; `positionRange` knows both. */
  readonly servoPosition: Readonly<Partial<Record<number, Range>>>;
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
  /** Where the group speed cannot be set, it is what it is. */
  readonly speedPercent: Range;
  /** What the board makes of `times` 0; where that is not endless, `runTimes` leaves it out. */
  readonly zeroTimes: 'endless' | 'once';
  /** Largest LEN that is safe to send. */
  readonly maxLength: number;
  readonly commands: readonly CommandKind[];
  /** LEN of the erase command: with a reserved byte or without. */
  readonly eraseLength: 2 | 3;
  /** Commands the board answers; the others are silent by design. */
  readonly answers: readonly CommandKind[];
  /**
   * Harmless questions that every such board answers, the cheapest first: the others may stay silent for good reasons. What
   * tells the families apart (boards.md 2.5), and whether a board is still there.
   */
  readonly certainAnswers: readonly Question[];
  /** Reports of runs name slot and times (6 and 8 with LEN 5), whoever asked for the run; otherwise they are empty. */
  readonly runReportsNameSlot: boolean;
  /** What an empty packet 7 says: opposite things per family (boards.md 2.4). */
  readonly emptySeven: 'runFinished' | 'runStopped' | 'unknown';
  /** Any question ends a running group, unsaid (L8): ask only while nothing runs. */
  readonly queryKillsRun: boolean;
  /** What frees a parser that waits for the rest of a cut packet (S7); null where that may do harm. */
  readonly resyncFiller: number | null;
  /** Command numbers that must not go out, not even by hand: they write settings, move, or mean nobody knows what. */
  readonly neverSend: readonly number[];
  /** Numbers it does not know do nothing at all there (S5); elsewhere nobody knows what they do. */
  readonly ignoresUnknown: boolean;
  /** Pause the board needs between two packets, after the last byte has left the wire (S52, S54). */
  readonly serviceGapMs: number;
  readonly motion: MotionTraits;
}

/** How a board turns its servos and plays its groups: what the motion estimate has to know of it. */
export interface MotionTraits {
  readonly tickMs: number;
  /**
   * The longest that its loop is busy without being deaf to us: with what it says (S21), a pad's poll (S52), entries handed on to
   * bus servos (S31). Its servos wait that long, and what came meanwhile is late (S29).
   */
  readonly talkMs: number;
  /** `shared`: any new target re-times every servo (S26). `perServo`: one that starts leaves the others alone. */
  readonly timing: 'shared' | 'perServo';
  /** `deadlines`: a frame takes its time, to the millisecond (S42). `polled`: the next begins some time behind it (L7). */
  readonly groups: 'deadlines' | 'polled';
  /** A stop halts these where they are; the others go on to the end of their frame (S50, L9). */
  readonly haltedByStop: readonly number[];
  /** When the group in this slot ends by itself, the next one is played once (S49). */
  readonly chainedSlot: number | null;
}

/** What may be asked of any board: it moves nothing, stores nothing and makes nothing drop. */
export type Question = Extract<CommandKind, 'readBattery' | 'readVersion' | 'readPositions'>;

/** `unknown` until a board has been identified. */
export type BoardId = FamilyId | 'unknown';

export type FamilyId =
  | 'doc'
  | 'openarm-old'
  | 'openarm-new'
  | 'lsc-6'
  | 'lsc-16'
  | 'lsc-24'
  | 'lsc-32'
  | 'bus-ctrl'
  | 'xarm'
  | 'learm-esp32'
  | 'learm-esp32-bus';

// Where a packet's own field is the only limit: one byte for the slot, two for the times.
const BYTE: Range = { min: 0, max: 255 };
const WORD: Range = { min: 0, max: 0xffff };
const AS_STORED: Range = { min: 100, max: 100 };
/** The longest packet that fits one HID report, which is how most of these boards are reached (boards.md chapter 6). */
const HID_LENGTH = 62;

const SHARED_TIME: MotionTraits = {
  tickMs: 20, // S27
  talkMs: 0,
  timing: 'shared', // S26
  groups: 'deadlines', // S42
  haltedByStop: [], // S50
  chainedSlot: null,
};

/** The open firmware (boards.md chapter 3); what its rows share with the ideal board of the protocol document. */
const openFirmware = {
  unit: 'us',
  position: { min: 500, max: 2500 }, // S24
  servoPosition: {},
  centre: 1500,
  durationMs: { min: 0, max: 30_000 }, // S25
  shortestMoveMs: 20, // S25, S27
  framesPerGroup: 255, // S34
  slot: BYTE,
  runTimes: WORD,
  speedPercent: AS_STORED,
  zeroTimes: 'endless', // S45
  maxLength: 253, // S3
  certainAnswers: [], // nobody knows which of the sold boards answer at all
  eraseLength: 3,
  runReportsNameSlot: false,
  emptySeven: 'runFinished', // S48
  queryKillsRun: false,
  resyncFiller: 0xfd, // S7
  neverSend: [],
  ignoresUnknown: true, // S5
  serviceGapMs: 10, // S54
  motion: { ...SHARED_TIME, talkMs: 4.2, chainedSlot: 100 }, // S21, S49
} as const;

/** The arm and hand with six outputs; its builds differ in what they report. */
const openArm = {
  ...openFirmware,
  servo: { min: 1, max: 6 }, // channels 0 and 7 are taken but have no pins (S23)
  usualServoCount: 6,
  servosPerMove: 6,
  servosPerFrame: 6, // room for 20, but a frame of more than 8 ends the run (S38)
  commands: ['move', 'run', 'stop', 'erase', 'download'],
} as const;

/** LSC and bus servo boards by document (boards.md chapter 5): closed firmware, so every figure is the careful one. */
const closedFirmware = {
  servoPosition: {},
  durationMs: { min: 0, max: 30_000 },
  shortestMoveMs: 20,
  // No download on this link: frame limits bound what is composed here and played from here.
  framesPerGroup: 255,
  slot: { min: 0, max: 229 }, // X5
  runTimes: WORD,
  speedPercent: { min: 1, max: 300 }, // the largest that the maker's examples show
  zeroTimes: 'endless',
  maxLength: HID_LENGTH,
  commands: ['move', 'run', 'stop', 'readBattery', 'setSpeed'],
  eraseLength: 3,
  answers: ['readBattery'],
  certainAnswers: ['readBattery'],
  runReportsNameSlot: true,
  emptySeven: 'runStopped',
  queryKillsRun: false,
  resyncFiller: null, // may count as bad data (X2)
  // Download and erase of the maker's program, whose steps nobody documented (X6), then what sources call now reading, now
  // writing of trims, and what hits every servo on the bus.
  neverSend: [5, 8, 12, 13, 14, 22, 23, 24, 26, 27, 28],
  ignoresUnknown: false, // X2
  serviceGapMs: 10,
  // Nobody has written down how it moves: bus servos time themselves, the rest is the open firmware's way.
  motion: { ...SHARED_TIME, talkMs: 7.3, timing: 'perServo' },
} as const;

const pulseBoard = {
  ...closedFirmware,
  unit: 'us',
  position: { min: 500, max: 2500 },
  centre: 1500,
} as const;

const busBoard = {
  ...closedFirmware,
  unit: 'steps',
  position: { min: 0, max: 1000 },
  centre: 500,
  usualServoCount: 6,
  commands: [...closedFirmware.commands, 'release', 'readPositions'],
  answers: ['readBattery', 'readPositions'],
  certainAnswers: ['readBattery', 'readPositions'],
} as const;

/** One move may name every output (boards.md section 1), also where that is more than a HID report holds. */
const outputs = (count: number) => ({
  servo: { min: 1, max: count },
  usualServoCount: count,
  servosPerMove: count,
  servosPerFrame: count,
  maxLength: Math.max(HID_LENGTH, 3 * count + 5),
});

/**
 * LeArm AI with the ESP32 core (boards.md chapter 4). Its STM32 core has no row: it ignores the time of a move (L5), so
 * nothing could be gentle there.
 */
const leArm = {
  servo: { min: 1, max: 6 },
  usualServoCount: 6,
  servosPerMove: 6,
  servosPerFrame: 6, // a longer frame hangs the run (L10)
  durationMs: { min: 0, max: 30_000 }, // L5
  shortestMoveMs: 20,
  framesPerGroup: 255,
  slot: { min: 0, max: 254 }, // L12
  runTimes: { min: 1, max: 255 }, // kept in one byte (L6)
  speedPercent: AS_STORED,
  zeroTimes: 'once', // L6
  maxLength: 62, // more overwrites its memory (L3)
  commands: ['move', 'run', 'stop', 'erase', 'download', 'readVersion', 'readAllPositions', 'readOffsets'],
  eraseLength: 2,
  answers: ['erase', 'download', 'readVersion', 'readAllPositions', 'readOffsets'],
  certainAnswers: ['readVersion'],
  runReportsNameSlot: false,
  emptySeven: 'unknown', // neither start nor end is told (L6)
  queryKillsRun: true,
  resyncFiller: null, // L3
  neverSend: [4, 9, 10, 11, 12], // moves by other means, writes trims to flash, goes to the reset pose
  ignoresUnknown: false, // even these end a running group (L8)
  serviceGapMs: 10,
  motion: {
    tickMs: 10, // L5
    talkMs: 0,
    timing: 'perServo', // L5
    groups: 'polled', // L7
    haltedByStop: [1, 2, 3, 4, 5], // the base goes on (L9)
    chainedSlot: null,
  },
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
    motion: { ...openFirmware.motion, talkMs: 20 }, // a word of 6.3, and polls of 6.4 ms before a run begins and in it
  },
  'openarm-old': {
    ...openArm,
    id: 'openarm-old',
    name: 'uHand 2.0 / OpenArm, old build',
    answers: ['erase', 'download'], // S18
    emptySeven: 'unknown', // S48
    motion: { ...SHARED_TIME, talkMs: 16.5 }, // six entries of 5.2, and polls of 5.2 ms before a run begins and in it; no chain (S49)
  },
  'openarm-new': {
    ...openArm,
    id: 'openarm-new',
    name: 'uHand 2.0 / OpenArm',
    answers: ['run', 'erase', 'download'],
    motion: { ...openFirmware.motion, talkMs: 23 }, // a word of 4.2, six entries of 5.2, and polls of 6.4 ms before a run begins and in it
  },
  'lsc-6': { ...pulseBoard, ...outputs(6), id: 'lsc-6', name: 'LSC-6' },
  'lsc-16': { ...pulseBoard, ...outputs(16), id: 'lsc-16', name: 'LSC-16' },
  'lsc-24': { ...pulseBoard, ...outputs(24), id: 'lsc-24', name: 'LSC-24' },
  'lsc-32': { ...pulseBoard, ...outputs(32), id: 'lsc-32', name: 'LSC-32' },
  'bus-ctrl': {
    ...busBoard,
    id: 'bus-ctrl',
    name: 'Bus Servo Controller',
    servo: { min: 1, max: 253 }, // 254 would move every servo at once
    servosPerMove: 19,
    servosPerFrame: 19,
  },
  xarm: {
    ...busBoard,
    id: 'xarm',
    name: 'xArm',
    servo: { min: 1, max: 6 },
    servosPerMove: 6,
    servosPerFrame: 6,
    durationMs: { min: 0, max: 3000 }, // by one independent source; nobody says what more would do
  },
  'learm-esp32': {
    ...leArm,
    id: 'learm-esp32',
    name: 'LeArm AI',
    unit: 'us',
    position: { min: 500, max: 2500 },
    servoPosition: { 1: { min: 500, max: 1500 } },
    centre: 1500,
  },
  'learm-esp32-bus': {
    ...leArm,
    id: 'learm-esp32-bus',
    name: 'LeArm AI, bus servos',
    unit: 'steps',
    position: { min: 125, max: 875 },
    servoPosition: { 1: { min: 200, max: 700 } },
    centre: 500,
  },
};

/** A board nobody has identified yet: harmless questions and the stop, nothing that moves or stores. */
export const UNKNOWN_BOARD: Family = {
  ...openFirmware,
  id: 'unknown',
  name: 'Unknown board',
  servo: { min: 1, max: 1 },
  usualServoCount: 0,
  servosPerMove: 1,
  servosPerFrame: 0,
  maxLength: 6, // one servo's position asked for
  commands: ['stop', 'readBattery', 'readVersion', 'readPositions'],
  answers: ['readBattery', 'readVersion', 'readPositions'],
  emptySeven: 'unknown',
  resyncFiller: null,
  ignoresUnknown: false,
};

export function family(id: BoardId): Family {
  return id === 'unknown' ? UNKNOWN_BOARD : FAMILIES[id];
}

/** How far this servo may be turned. */
export function positionRange({ position, servoPosition }: Family, servo: number): Range {
  return servoPosition[servo] ?? position;
}
