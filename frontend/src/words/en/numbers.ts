// Numbers in English.

import { numbersIn } from '../numbers.ts';

export const numbers = numbersIn({
  locale: 'en',
  units: { us: 'µs', steps: 'steps' },
  gap: ' ',
});

export const {
  formatAge,
  formatCount,
  formatDegrees,
  formatList,
  formatLongAge,
  formatMs,
  formatNames,
  formatPercent,
  formatPosition,
  formatSeconds,
  formatTick,
  formatTimeOfDay,
  formatVolts,
  formatWhen,
  formatWhole,
  unitSymbol,
} = numbers;
