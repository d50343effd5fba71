// The page's time for the shared code, out of sight too: a tab that another one relieves is hidden, and still has to stop the
// robot and hold it.

import type { Clock } from '#shared/clock.ts';
import { createTimersAside } from './workerTimers.ts';

const afterAside = createTimersAside();

export const browserClock: Clock = {
  now: () => performance.now(),
  after(delayMs, run) {
    const ring = (): void => {
      cancel();
      run();
    };
    const timer = setTimeout(ring, delayMs);
    const forget = document.visibilityState === 'hidden' ? afterAside(delayMs, ring) : undefined;
    const cancel = (): void => {
      clearTimeout(timer);
      forget?.();
    };
    return cancel;
  },
};
