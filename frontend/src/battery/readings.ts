// How a battery reading is shown: the truth mark of its level and the last known voltage. Pure.

import type { Battery } from '#shared/session/state.ts';
import type { Truth } from '../ui/Chip.tsx';
import type { Level } from './levels.ts';

export const LEVEL_TRUTH: Readonly<Record<Level, Truth>> = {
  good: 'confirmed',
  warning: 'warning',
  danger: 'danger',
};

export function lastMv(battery: Battery): number | null {
  return battery.kind === 'read' ? battery.batteryMv : battery.kind === 'silent' ? battery.lastMv : null;
}
