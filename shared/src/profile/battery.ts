// What feeds a robot and what its volts mean: the ends of the gauge, where to warn and to alarm, what share of a pack is left
// (boards.md chapter 8); and what many readings say together, none of which is trusted alone. Pure; knows no clock.

import robots from '../../protocol/robots.json' with { type: 'json' };
import timings from '../../protocol/timings.json' with { type: 'json' };
import { FAMILIES, type FamilyId } from '../codec/families.ts';
import type { BatteryKind, Robot } from './robot.ts';

export interface Supply {
  /** 0: a mains adapter or USB, of which nothing runs out. */
  readonly cells: 0 | 2 | 3;
  /** Ends of the gauge. */
  readonly lowMv: number;
  readonly highMv: number;
  /** At or below: charge soon, and charge now. */
  readonly warnMv: number;
  readonly alarmMv: number;
  /** Above this the board measures nothing more (S60); null where no such ceiling is known. */
  readonly ceilingMv: number | null;
}

const CELLS = robots.cells as Readonly<Record<BatteryKind, Supply['cells']>>;

export function supplyOf({ battery, board, batteryCare }: Robot): Supply {
  const cells = CELLS[battery];
  const usual = usualSupply(cells, board);
  return { cells, ...usual, ...batteryCare.thresholds, ceilingMv: FAMILIES[board].batteryCeilingMv };
}

function usualSupply(cells: Supply['cells'], board: FamilyId): typeof robots.cell {
  if (cells === 0) return FAMILIES[board].unit === 'us' ? robots.adapterUs : robots.adapterSteps;
  const { lowMv, highMv, warnMv, alarmMv } = robots.cell;
  return {
    lowMv: lowMv * cells,
    highMv: highMv * cells,
    warnMv: warnMv * cells,
    alarmMv: alarmMv * cells,
  };
}

/** New runs are refused with the battery at or below; null: never. */
export const refusedBelowMv = (robot: Robot): number | null =>
  robot.batteryCare.policy === 'tell' ? null : supplyOf(robot).alarmMv;

/** The same robot fed by something else: thresholds set for one pack mean nothing for another. */
export function fedBy(robot: Robot, battery: BatteryKind): Robot {
  return { ...robot, battery, batteryCare: { ...robot.batteryCare, thresholds: null } };
}

/** Rest voltage of one Li-ion cell at 0, 10 … 100 % (boards.md chapter 8). */
const CELL_CURVE_MV = [3100, 3300, 3420, 3530, 3630, 3720, 3800, 3890, 3990, 4050, 4190] as const;

/** What is left of a pack at that rest voltage, 0..100; null for an adapter. */
export function percentOf(restMv: number, { cells }: Pick<Supply, 'cells'>): number | null {
  if (cells === 0) return null;
  const cellMv = restMv / cells;
  const above = CELL_CURVE_MV.findIndex((mv) => mv > cellMv);
  if (above === 0) return 0;
  const from = CELL_CURVE_MV[above - 1];
  const to = CELL_CURVE_MV[above];
  if (from === undefined || to === undefined) return 100;
  return (above - 1 + (cellMv - from) / (to - from)) * 10;
}

/** 0..1 along the gauge. */
export function gaugeFraction(batteryMv: number, { lowMv, highMv }: Supply): number {
  return Math.max(0, Math.min(1, (batteryMv - lowMv) / (highMv - lowMv)));
}

// What many readings say together: the rest voltage of what feeds the robot, and whether that is low. One reading may
// be bent by a load, lost to noise or beyond what the board measures; nothing here trusts a single one.

export interface Reading {
  readonly atMs: number;
  readonly batteryMv: number;
  /** Nothing moved: the voltage is not bent by a load of our making. */
  readonly isAtRest: boolean;
}

/** `zero`: the board has no sample yet (S59). `saturated`: more than it can measure (S60). */
export type ReadingKind = 'plain' | 'zero' | 'saturated';
export type Level = 'good' | 'warning' | 'danger';

export interface Gauge {
  readonly last: Reading | null;
  /** The median at rest; of a pack it never rises while the pack stays the same. */
  readonly restMv: number | null;
  readonly level: Level | null;
  /** Enough readings agree to act upon it. */
  readonly isSettled: boolean;
  /** Readings at rest that count now, oldest first. */
  readonly window: readonly Reading[];
}

export const EMPTY_GAUGE: Gauge = { last: null, restMv: null, level: null, isSettled: false, window: [] };

const WINDOW_MS = 30_000;
/** Fewer, or closer together, are not yet sustained. */
const SETTLED_COUNT = 3;
const SETTLED_MS = 5000;
/** A pack that recovers from a load rises less than that; more is another pack. */
export const NEW_PACK_STEP_MV = 300;
/** Back above a threshold by as much, or the level stays. */
export const HYSTERESIS_MV = timings.battery.hysteresisMv;
/** An older reading says nothing of now. */
const FRESH_MS = 60_000;

export function readingKind(batteryMv: number, { ceilingMv }: Supply): ReadingKind {
  if (batteryMv === 0) return 'zero';
  return ceilingMv !== null && batteryMv > ceilingMv ? 'saturated' : 'plain';
}

export function isPlain({ batteryMv }: Reading, supply: Supply): boolean {
  return readingKind(batteryMv, supply) === 'plain';
}

export function gaugeAfter(gauge: Gauge, reading: Reading, supply: Supply): Gauge {
  if (!isPlain(reading, supply) || !reading.isAtRest) return { ...gauge, last: reading };
  const since = reading.atMs - WINDOW_MS;
  const window = [...gauge.window.filter(({ atMs }) => atMs > since), reading];
  return judged({ ...gauge, last: reading, window }, supply);
}

export function gaugeOf(readings: readonly Reading[], supply: Supply): Gauge {
  return readings.reduce((gauge, reading) => gaugeAfter(gauge, reading, supply), EMPTY_GAUGE);
}

/** Whether the newest reading is one to act upon. */
export function isActionable({ last, isSettled }: Gauge, supply: Supply, nowMs: number): boolean {
  if (last === null || !isSettled) return false;
  return isPlain(last, supply) && nowMs - last.atMs <= FRESH_MS;
}

function judged(gauge: Gauge, supply: Supply): Gauge {
  const isSustained = spans(gauge.window);
  if (gauge.isSettled && !isSustained) return gauge;
  const median = medianMv(gauge.window);
  const before = gauge.isSettled ? gauge.restMv : null;
  const isNewPack = before === null || median > before + NEW_PACK_STEP_MV;
  const restMv = isNewPack || supply.cells === 0 ? median : Math.min(before, median);
  const level = levelAfter(isNewPack ? null : gauge.level, restMv, supply);
  return { ...gauge, restMv, level, isSettled: isSustained };
}

function spans(window: readonly Reading[]): boolean {
  const first = window[0]?.atMs ?? 0;
  const last = window.at(-1)?.atMs ?? 0;
  return window.length >= SETTLED_COUNT && last - first >= SETTLED_MS;
}

/** Of an even number the higher middle: two readings of which one is low are no low battery. */
function medianMv(window: readonly Reading[]): number {
  const sorted = window.map(({ batteryMv }) => batteryMv).sort((one, other) => one - other);
  return sorted[Math.floor(sorted.length / 2)] ?? 0;
}

function levelAfter(before: Level | null, restMv: number, { warnMv, alarmMv }: Supply): Level {
  if (restMv <= alarmMv || (before === 'danger' && restMv < alarmMv + HYSTERESIS_MV)) return 'danger';
  const wasLow = before === 'danger' || before === 'warning';
  return restMv <= warnMv || (wasLow && restMv < warnMv + HYSTERESIS_MV) ? 'warning' : 'good';
}
