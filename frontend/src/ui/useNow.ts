// The time on a clock, renewed at an interval: for ages and countdowns in words.

import { useEffect, useState } from 'react';

export function useNow(now: () => number, intervalMs: number): number {
  const [time, setTime] = useState(now);
  useEffect(() => {
    const timer = setInterval(() => setTime(now()), intervalMs);
    return () => clearInterval(timer);
  }, [now, intervalMs]);
  return time;
}
