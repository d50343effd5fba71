// What a voltage means on the supplies these boards have (boards.md section 8). A percentage would be a guess: an adapter
// gives 7.5 V for ever. Pure.

import type { Family } from '#shared/protocol/families.ts';

export interface Supply {
  /** Ends of the gauge. */
  readonly lowMv: number;
  readonly highMv: number;
  /** At or below: charge soon, and charge now. */
  readonly warnMv: number;
  readonly alarmMv: number;
}

export type Level = 'good' | 'warning' | 'danger';

/** Two cells or the 7.5 V adapter; the makers' own alarm is at 6.6 V. */
const TWO_CELLS: Supply = { lowMv: 6000, highMv: 8400, warnMv: 7000, alarmMv: 6600 };
/** Two or three cells, 6 to 12.6 V: only the board's own alarm is certain. */
const TWO_OR_THREE_CELLS: Supply = { lowMv: 5000, highMv: 12_600, warnMv: 6200, alarmMv: 5600 };

export function supplyOf({ unit }: Pick<Family, 'unit'>): Supply {
  return unit === 'us' ? TWO_CELLS : TWO_OR_THREE_CELLS;
}

export function levelOf(batteryMv: number, { warnMv, alarmMv }: Supply): Level {
  if (batteryMv <= alarmMv) return 'danger';
  return batteryMv <= warnMv ? 'warning' : 'good';
}

/** 0..1 along the gauge. */
export function gaugeFraction(batteryMv: number, { lowMv, highMv }: Supply): number {
  return Math.max(0, Math.min(1, (batteryMv - lowMv) / (highMv - lowMv)));
}
