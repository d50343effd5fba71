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
  formatMinutes,
  formatLongAge,
  formatMs,
  formatNames,
  formatPercent,
  formatPosition,
  formatRoughly,
  formatSeconds,
  formatSecondsUp,
  formatTick,
  formatTimeOfDay,
  formatVolts,
  formatWhen,
  formatWhole,
  unitSymbol,
} = numbers;

/** `1 frame`, `2 frames`. */
export const counted = (count: number, one: string, more = `${one}s`): string =>
  `${formatCount(count)} ${count === 1 ? one : more}`;
