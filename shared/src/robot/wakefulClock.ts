// A clock that notices when a timer fires far too late: the computer slept, or the browser froze the page. What was to happen
// before must not happen now (safety.md section 5, I3). Knows lateness only; what to give up is the session's affair.

import type { Clock } from '../clock.ts';
import { OVERSLEPT_MS } from './timings.ts';

/** `overslept` is called before a late timer's own work, which it may still cancel. */
export function createWakefulClock(clock: Clock, overslept: () => void): Clock {
  return {
    now: () => clock.now(),
    after(delayMs, run) {
      const dueMs = clock.now() + delayMs;
      let isCancelled = false;
      const cancelTimer = clock.after(delayMs, () => {
        if (clock.now() - dueMs > OVERSLEPT_MS) overslept();
        if (!isCancelled) run();
      });
      return () => {
        isCancelled = true;
        cancelTimer();
      };
    },
  };
}
