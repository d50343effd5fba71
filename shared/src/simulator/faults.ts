// What can go wrong on purpose: named faults with a value, and the plan a board follows, the same for the same seed.
// Knows bytes and replies as counts and chances; does not know what they mean.

import { HEADER } from '../codec/packet.ts';
import type { Press } from './engine.ts';

/** Faults of the line strike each byte by chance, in both directions. */
const LINE_FAULTS = ['droppedByte', 'doubledByte', 'flippedByte', 'insertedByte', 'stray55'] as const;
type LineFault = (typeof LINE_FAULTS)[number];

/** Faults of acknowledgements (empty replies to run, erase and download) strike by chance or the n-th alone, from 1. */
const ACK_FAULTS = ['lostAck', 'doubledAck', 'foreignAck'] as const;
type AckFaultName = (typeof ACK_FAULTS)[number];
type Strikes = { readonly probability: number } | { readonly nth: number };

export type Fault =
  | { readonly name: LineFault; readonly probability: number }
  /** `foreignAck` sends that of another command ahead of the right one. */
  | ({ readonly name: AckFaultName } & Strikes)
  /** It reaches the host that much later, and all behind it too. */
  | ({ readonly name: 'lateAck'; readonly delayMs: number } & Strikes)
  /** How long the chip takes to erase a sector: 45 ms typical, 400 ms at worst; Infinity for an erase without end. */
  | { readonly name: 'slowErase'; readonly sectorMs: number }
  | { readonly name: 'lowBattery'; readonly batteryMv: number }
  /** A person starts a group at the board itself, with its pad or its key. */
  | { readonly name: 'padRun' | 'keyRun'; readonly slot: number; readonly afterMs: number }
  /** A person presses the key that chooses what the board listens to (L2). */
  | { readonly name: 'modeKey'; readonly afterMs: number }
  /** A reset at that time; `brownOut` is without power for a moment first. */
  | { readonly name: 'reboot'; readonly afterMs: number }
  | { readonly name: 'brownOut'; readonly afterMs: number; readonly offMs: number }
  /** The line sends back what the host says, as joined wires or an adapter on its own do. */
  | { readonly name: 'loopback' }
  /** The cable comes off; motion continues. */
  | { readonly name: 'unplug'; readonly afterMs: number }
  /** After that many bytes on the wire, both directions counted together. */
  | { readonly name: 'unplug'; readonly atByte: number };

/** What happens to the board at a time of its own. */
export type Incident =
  | { readonly kind: 'unplug' }
  | ({ readonly kind: 'press' } & Press)
  | { readonly kind: 'pressMode' }
  | { readonly kind: 'reboot'; readonly offMs: number };

interface PlannedIncident {
  /** Since the board was created. */
  readonly afterMs: number;
  readonly incident: Incident;
}

/** What becomes of one acknowledgement. */
export interface AckDamage {
  readonly lost: boolean;
  readonly doubled: boolean;
  readonly foreign: boolean;
  readonly lateMs: number;
}

export const UNHARMED: AckDamage = { lost: false, doubled: false, foreign: false, lateMs: 0 };

export interface FaultPlan {
  /** What the other end gets for one byte sent. */
  distort(byte: number): readonly number[];
  nextAck(): AckDamage;
  readonly sectorMs: number;
  /** Null where the battery is as configured. */
  readonly batteryMv: number | null;
  readonly unplugAtByte: number;
  readonly loopsBack: boolean;
  readonly incidents: readonly PlannedIncident[];
}

const TYPICAL_SECTOR_MS = 45;
const WORST_SECTOR_MS = 400;
const LOW_BATTERY_MV = 6200;
/** How long looking at the button blocks the board's loop (S52, S55). */
const BLOCK_MS = { padRun: 5.2, keyRun: 60 } as const;
/** What the key starts (S55, X8). */
const KEY_SLOT = 100;
const SLOT_COUNT = 256;
/** Long enough for the board's capacitors. */
const BROWN_OUT_MS = 400;
/** About one byte a second on a busy line. */
const USUAL_LINE_PROBABILITY = 0.001;

type Strike = (byte: number, random: () => number) => readonly number[];

const STRIKES: Readonly<Record<LineFault, Strike>> = {
  droppedByte: () => [],
  doubledByte: (byte) => [byte, byte],
  flippedByte: (byte, random) => [byte ^ (1 << Math.floor(random() * 8))],
  insertedByte: (byte, random) => [Math.floor(random() * 256), byte],
  // Only a third 55 does what a stray one does (S4).
  stray55: (byte) => (byte === HEADER ? [HEADER, byte] : [byte]),
};

function isLineFault(fault: Fault): fault is Extract<Fault, { name: LineFault }> {
  return LINE_FAULTS.some((name) => name === fault.name);
}

type AckFault = Extract<Fault, { name: AckFaultName | 'lateAck' }>;

function isAckFault(fault: Fault): fault is AckFault {
  return fault.name === 'lateAck' || ACK_FAULTS.some((name) => name === fault.name);
}

function strikesAt(fault: AckFault, ordinal: number, random: () => number): boolean {
  return 'nth' in fault ? fault.nth === ordinal : random() < fault.probability;
}

/** Gives the plan for these faults; where a name comes twice with a single value, the last one counts. */
export function planFaults(faults: readonly Fault[], seed: number): FaultPlan {
  const random = createRandom(seed);
  const lineFaults = faults.filter(isLineFault);
  const ackFaults = faults.filter(isAckFault);
  let acks = 0;

  function distort(byte: number): readonly number[] {
    const struck = lineFaults.find((fault) => random() < fault.probability);
    return struck ? STRIKES[struck.name](byte, random) : [byte];
  }

  function nextAck(): AckDamage {
    acks += 1;
    const striking = ackFaults.filter((fault) => strikesAt(fault, acks, random));
    const has = (name: AckFaultName) => striking.some((fault) => fault.name === name);
    const delays = striking.map((fault) => (fault.name === 'lateAck' ? fault.delayMs : 0));
    return {
      lost: has('lostAck'),
      doubled: has('doubledAck'),
      foreign: has('foreignAck'),
      lateMs: Math.max(0, ...delays),
    };
  }

  const plan = {
    distort,
    nextAck,
    sectorMs: TYPICAL_SECTOR_MS,
    batteryMv: null as number | null,
    unplugAtByte: Infinity,
    loopsBack: faults.some(({ name }) => name === 'loopback'),
    incidents: faults.flatMap(incidentOf),
  };
  for (const fault of faults) {
    if (fault.name === 'slowErase') plan.sectorMs = fault.sectorMs;
    if (fault.name === 'lowBattery') plan.batteryMv = fault.batteryMv;
    if (fault.name === 'unplug' && 'atByte' in fault) plan.unplugAtByte = fault.atByte;
  }
  return plan;
}

function incidentOf(fault: Fault): PlannedIncident[] {
  if (!('afterMs' in fault)) return [];
  const { afterMs } = fault;
  switch (fault.name) {
    case 'padRun':
    case 'keyRun':
      return [{ afterMs, incident: { kind: 'press', slot: fault.slot, blockMs: BLOCK_MS[fault.name] } }];
    case 'modeKey':
      return [{ afterMs, incident: { kind: 'pressMode' } }];
    case 'reboot':
      return [{ afterMs, incident: { kind: 'reboot', offMs: 0 } }];
    case 'brownOut':
      return [{ afterMs, incident: { kind: 'reboot', offMs: fault.offMs } }];
    case 'unplug':
      return [{ afterMs, incident: { kind: 'unplug' } }];
  }
}

function number(text: string): number {
  const value = text === '' ? NaN : Number(text);
  if (Number.isFinite(value) && value >= 0) return value;
  throw new RangeError(`the value of a fault is a number from 0, not "${text}"`);
}

function probability(text: string | undefined, usual: number): number {
  const value = text === undefined ? usual : number(text);
  if (value <= 1) return value;
  throw new RangeError(`a probability is 0..1, not ${value}`);
}

/** A whole number names the n-th acknowledgement, a fraction is a chance, no value strikes them all. */
function strikes(text: string | undefined): Strikes {
  const value = text === undefined ? NaN : number(text);
  if (Number.isInteger(value) && value > 0) return { nth: value };
  return { probability: probability(text, 1) };
}

function lateAck(text: string): Fault {
  const [delayText = '', strikesText] = text.split('@', 2);
  return { name: 'lateAck', delayMs: number(delayText), ...strikes(strikesText) };
}

function unplug(text: string): Fault {
  const atByte = /^byte(.*)$/.exec(text)?.[1];
  if (atByte !== undefined) return { name: 'unplug', atByte: number(atByte) };
  return { name: 'unplug', afterMs: number(text) };
}

function eraseMs(text: string): number {
  return text === 'never' ? Infinity : number(text);
}

function padRun(text: string): Fault {
  const [slotText = '', afterText = ''] = text.split('@', 2);
  const slot = number(slotText);
  if (!Number.isInteger(slot) || slot >= SLOT_COUNT)
    throw new RangeError(`a group is 0..${SLOT_COUNT - 1}, not ${slot}`);
  return { name: 'padRun', slot, afterMs: number(afterText) };
}

function brownOut(text: string): Fault {
  const [afterText = '', offText] = text.split('@', 2);
  const offMs = offText === undefined ? BROWN_OUT_MS : number(offText);
  return { name: 'brownOut', afterMs: number(afterText), offMs };
}

/** One fault a name: what stands behind `=`, undefined where nothing does. */
const READERS: Readonly<Record<Fault['name'], (value: string | undefined) => Fault>> = {
  droppedByte: (value) => ({ name: 'droppedByte', probability: probability(value, USUAL_LINE_PROBABILITY) }),
  doubledByte: (value) => ({ name: 'doubledByte', probability: probability(value, USUAL_LINE_PROBABILITY) }),
  flippedByte: (value) => ({ name: 'flippedByte', probability: probability(value, USUAL_LINE_PROBABILITY) }),
  insertedByte: (value) => ({
    name: 'insertedByte',
    probability: probability(value, USUAL_LINE_PROBABILITY),
  }),
  stray55: (value) => ({ name: 'stray55', probability: probability(value, USUAL_LINE_PROBABILITY) }),
  lostAck: (value) => ({ name: 'lostAck', ...strikes(value) }),
  doubledAck: (value) => ({ name: 'doubledAck', ...strikes(value) }),
  foreignAck: (value) => ({ name: 'foreignAck', ...strikes(value) }),
  lateAck: (value = '') => lateAck(value),
  slowErase: (value) => ({
    name: 'slowErase',
    sectorMs: value === undefined ? WORST_SECTOR_MS : eraseMs(value),
  }),
  lowBattery: (value) => ({
    name: 'lowBattery',
    batteryMv: value === undefined ? LOW_BATTERY_MV : number(value),
  }),
  padRun: (value = '') => padRun(value),
  keyRun: (value = '') => ({ name: 'keyRun', slot: KEY_SLOT, afterMs: number(value) }),
  modeKey: (value = '') => ({ name: 'modeKey', afterMs: number(value) }),
  reboot: (value = '') => ({ name: 'reboot', afterMs: number(value) }),
  brownOut: (value = '') => brownOut(value),
  loopback: () => ({ name: 'loopback' }),
  unplug: (value = '') => unplug(value),
};

function isFaultName(text: string): text is Fault['name'] {
  return Object.hasOwn(READERS, text);
}

/**
 * Reads `name` or `name=value`: `droppedByte=0.01`, `lostAck=3`, `lateAck=400@3` (the third, 400 ms later),
 * `slowErase=400`, `slowErase=never`, `lowBattery=6200`, `unplug=1500` (ms), `unplug=byte120`, `padRun=8@1500` (group 8
 * after 1500 ms), `keyRun=1500`, `modeKey=1500`, `reboot=1500`, `brownOut=1500`, `brownOut=1500@60000` (off for a
 * minute), `loopback`. Throws RangeError with a sentence for people.
 */
export function parseFault(text: string): Fault {
  const [name = '', value] = text.split('=', 2);
  if (isFaultName(name)) return READERS[name](value);
  throw new RangeError(`no fault is called "${text}"; there are ${Object.keys(READERS).join(', ')}`);
}

/** Numbers in 0 ≤ n < 1 from a 32-bit counter whose bits are mixed well (splitmix32). */
export function createRandom(seed: number): () => number {
  let state = seed | 0;
  return () => {
    state = (state + 0x9e3779b9) | 0;
    let mixed = Math.imul(state ^ (state >>> 16), 0x21f0aaad);
    mixed = Math.imul(mixed ^ (mixed >>> 15), 0x735a2d97);
    return ((mixed ^ (mixed >>> 15)) >>> 0) / 2 ** 32;
  };
}
