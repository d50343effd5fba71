// What feeds a robot and what its volts mean: the ends of the gauge, where to warn and to alarm, what share of a pack is left
// (boards.md chapter 8). Tables and pure functions; knows no reading.

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
  /** Above this the board measures nothing more (S60); null where nobody knows of such a ceiling. */
  readonly ceilingMv: number | null;
}

const CELLS: Readonly<Record<BatteryKind, Supply['cells']>> = { adapter: 0, '2s': 2, '3s': 3 };

const CELL = { lowMv: 3100, highMv: 4200, warnMv: 3500, alarmMv: 3300 };
/** 5 V USB to 8.4 V; the usual adapter gives 7.5 V, and such boards want 6.4 V at least. */
const ADAPTER = { lowMv: 5000, highMv: 8400, warnMv: 7000, alarmMv: 6400 };
/** A bus servo board takes 6 to 12.6 V: only its own alarm is certain. */
const BUS_ADAPTER = { lowMv: 5000, highMv: 12_600, warnMv: 6200, alarmMv: 5600 };

export function supplyOf({ battery, board, batteryCare }: Robot): Supply {
  const cells = CELLS[battery];
  const usual = usualSupply(cells, board);
  return { cells, ...usual, ...batteryCare.thresholds, ceilingMv: FAMILIES[board].batteryCeilingMv };
}

function usualSupply(cells: Supply['cells'], board: FamilyId): typeof CELL {
  if (cells === 0) return FAMILIES[board].unit === 'us' ? ADAPTER : BUS_ADAPTER;
  const { lowMv, highMv, warnMv, alarmMv } = CELL;
  return {
    lowMv: lowMv * cells,
    highMv: highMv * cells,
    warnMv: warnMv * cells,
    alarmMv: alarmMv * cells,
  };
}

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
