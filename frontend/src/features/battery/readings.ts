// How a battery is shown: the truth mark of its level, the last known voltage, the words for both. Pure.

import { readingKind, type Level, type Supply } from '#shared/profile/battery.ts';
import type { Battery } from '#shared/robot/battery.ts';
import type { Truth } from '../../ui/Chip.tsx';
import { words } from '../../i18n/words.ts';

export const LEVEL_TRUTH: Readonly<Record<Level, Truth>> = {
  good: 'confirmed',
  warning: 'warning',
  danger: 'danger',
};

export function lastMv(battery: Battery): number | null {
  return battery.kind === 'read' ? battery.batteryMv : battery.kind === 'silent' ? battery.lastMv : null;
}

/** `7.50 V`, `> 9.80 V` where the board can measure no more, a dash where nothing is known. */
export function voltsText(batteryMv: number | null, supply: Supply): string {
  if (batteryMv === null) return words.battery.noVolts;
  const { ceilingMv } = supply;
  if (ceilingMv !== null && readingKind(batteryMv, supply) === 'saturated')
    return words.battery.above({ volts: words.numbers.formatVolts(ceilingMv) });
  return words.numbers.formatVolts(batteryMv);
}

export function levelWord(level: Level, { cells }: Supply): string {
  return words.battery.level[cells === 0 ? 'adapter' : 'pack'][level];
}
