// What can go wrong on purpose: named faults with a value, and the plan a board follows, the same for the same seed.
// Knows bytes and replies as counts and chances; does not know what they mean.

import type { Press } from './panel.ts';
import { createRandom } from './random.ts';

/** Faults of the line strike each byte by chance, in both directions. */
const LINE_FAULTS = ['droppedByte', 'doubledByte', 'flippedByte', 'insertedByte'] as const;
type LineFault = (typeof LINE_FAULTS)[number];

export type Fault =
  | { readonly name: LineFault; readonly probability: number }
  /** Loses acknowledgements (replies to run, erase and download) by chance. */
  | { readonly name: 'lostAck'; readonly probability: number }
  /** Loses the `nth` acknowledgement alone, counted from 1. */
  | { readonly name: 'lostAck'; readonly nth: number }
  /** How long the chip takes to erase a sector: 45 ms typical, 400 ms at worst. */
  | { readonly name: 'slowErase'; readonly sectorMs: number }
  | { readonly name: 'lowBattery'; readonly batteryMv: number }
  /** Somebody starts a group at the board itself, with its pad or its key. */
  | { readonly name: 'padRun' | 'keyRun'; readonly slot: number; readonly afterMs: number }
  /** The cable comes off; motion goes on. */
  | { readonly name: 'unplug'; readonly afterMs: number }
  /** After that many bytes on the wire, both directions counted together. */
  | { readonly name: 'unplug'; readonly atByte: number };

/** A group that somebody starts at the board. */
interface PlannedPress extends Press {
  readonly afterMs: number;
}

export interface FaultPlan {
  /** What the other end gets for one byte sent. */
  distort(byte: number): readonly number[];
  losesAck(): boolean;
  readonly sectorMs: number;
  /** Null where the battery is as configured. */
  readonly batteryMv: number | null;
  /** Since the board was created; Infinity for never. */
  readonly unplugAfterMs: number;
  readonly unplugAtByte: number;
  /** Since the board was created. */
  readonly presses: readonly PlannedPress[];
}

const TYPICAL_SECTOR_MS = 45;
const WORST_SECTOR_MS = 400;
const LOW_BATTERY_MV = 6200;
/** How long looking at the button blocks the board's loop (S52, S55). */
const BLOCK_MS = { padRun: 5.2, keyRun: 60 } as const;
/** What the key starts (S55, X8). */
const KEY_SLOT = 100;
const SLOT_COUNT = 256;
/** About one byte a second on a busy line. */
const USUAL_LINE_PROBABILITY = 0.001;

type Strike = (byte: number, random: () => number) => readonly number[];

const STRIKES: Readonly<Record<LineFault, Strike>> = {
  droppedByte: () => [],
  doubledByte: (byte) => [byte, byte],
  flippedByte: (byte, random) => [byte ^ (1 << Math.floor(random() * 8))],
  insertedByte: (byte, random) => [Math.floor(random() * 256), byte],
};

function isLineFault(fault: Fault): fault is Extract<Fault, { name: LineFault }> {
  return LINE_FAULTS.some((name) => name === fault.name);
}

/** Gives the plan for these faults; where a name comes twice with a single value, the last one counts. */
export function planFaults(faults: readonly Fault[], seed: number): FaultPlan {
  const random = createRandom(seed);
  const lineFaults = faults.filter(isLineFault);
  let acks = 0;

  function distort(byte: number): readonly number[] {
    const struck = lineFaults.find((fault) => random() < fault.probability);
    return struck ? STRIKES[struck.name](byte, random) : [byte];
  }

  function losesAck(): boolean {
    acks += 1;
    return faults.some((fault) => {
      if (fault.name !== 'lostAck') return false;
      return 'nth' in fault ? fault.nth === acks : random() < fault.probability;
    });
  }

  const plan = {
    distort,
    losesAck,
    sectorMs: TYPICAL_SECTOR_MS,
    batteryMv: null as number | null,
    unplugAfterMs: Infinity,
    unplugAtByte: Infinity,
    presses: faults.flatMap((fault) =>
      fault.name === 'padRun' || fault.name === 'keyRun'
        ? [{ slot: fault.slot, afterMs: fault.afterMs, blockMs: BLOCK_MS[fault.name] }]
        : [],
    ),
  };
  for (const fault of faults) {
    if (fault.name === 'slowErase') plan.sectorMs = fault.sectorMs;
    if (fault.name === 'lowBattery') plan.batteryMv = fault.batteryMv;
    if (fault.name === 'unplug' && 'afterMs' in fault) plan.unplugAfterMs = fault.afterMs;
    if (fault.name === 'unplug' && 'atByte' in fault) plan.unplugAtByte = fault.atByte;
  }
  return plan;
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

/** A whole number names the n-th acknowledgement, a fraction is a chance, no value loses them all. */
function lostAck(text: string | undefined): Fault {
  const value = text === undefined ? NaN : number(text);
  if (Number.isInteger(value) && value > 0) return { name: 'lostAck', nth: value };
  return { name: 'lostAck', probability: probability(text, 1) };
}

function unplug(text: string | undefined): Fault {
  const atByte = /^byte(.*)$/.exec(text ?? '')?.[1];
  if (atByte !== undefined) return { name: 'unplug', atByte: number(atByte) };
  return { name: 'unplug', afterMs: number(text ?? '') };
}

function padRun(text: string): Fault {
  const [slotText = '', afterText = ''] = text.split('@', 2);
  const slot = number(slotText);
  if (!Number.isInteger(slot) || slot >= SLOT_COUNT)
    throw new RangeError(`a group is 0..${SLOT_COUNT - 1}, not ${slot}`);
  return { name: 'padRun', slot, afterMs: number(afterText) };
}

/**
 * Reads `name` or `name=value`: `droppedByte=0.01`, `lostAck=3`, `slowErase=400`, `lowBattery=6200`, `unplug=1500` (ms),
 * `unplug=byte120`, `padRun=8@1500` (group 8 after 1500 ms), `keyRun=1500`. Throws RangeError with a sentence for people.
 */
export function parseFault(text: string): Fault {
  const [name, value] = text.split('=', 2);
  const lineFault = LINE_FAULTS.find((candidate) => candidate === name);
  if (lineFault) return { name: lineFault, probability: probability(value, USUAL_LINE_PROBABILITY) };
  switch (name) {
    case 'lostAck':
      return lostAck(value);
    case 'slowErase':
      return { name, sectorMs: value === undefined ? WORST_SECTOR_MS : number(value) };
    case 'lowBattery':
      return { name, batteryMv: value === undefined ? LOW_BATTERY_MV : number(value) };
    case 'padRun':
      return padRun(value ?? '');
    case 'keyRun':
      return { name, slot: KEY_SLOT, afterMs: number(value ?? '') };
    case 'unplug':
      return unplug(value);
    default:
      throw new RangeError(
        `no fault is called "${text}"; there are ${LINE_FAULTS.join(', ')}, lostAck, slowErase, lowBattery, padRun, keyRun, unplug`,
      );
  }
}
