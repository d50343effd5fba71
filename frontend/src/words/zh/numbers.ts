// Numbers in Chinese, which leaves no gap before a unit that it writes out. Nor is a space typed between any number and the
// characters around it: the gap that readers want there is the browser's (text-autospace), as wide everywhere.

import type { numbers as english } from '../en/numbers.ts';
import { numbersIn } from '../numbers.ts';

export const numbers: typeof english = numbersIn({
  locale: 'zh-CN',
  units: { us: '微秒', steps: '步' },
  gap: '',
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
