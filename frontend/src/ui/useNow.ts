// The time on a clock, renewed at an interval: for ages and countdowns in words.

import { useState } from 'react';
import { useEachFrame } from './useEachFrame.ts';

export function useNow(now: () => number, intervalMs: number): number {
  const [time, setTime] = useState(now);
  useEachFrame(() => setTime(now()), { eachMs: intervalMs });
  return time;
}
