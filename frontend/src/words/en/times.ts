// How often something runs.

import { formatWhole } from './numbers.ts';

export function timesWords(times: number): string {
  if (times === 0) return 'until stopped';
  return times === 1 ? 'once' : `${formatWhole(times)} times`;
}
