// This machine's time and timers as the shared code asks for them.

import type { Clock } from '#shared/clock.ts';

export const realClock: Clock = {
  now: () => performance.now(),
  after(delayMs, run) {
    const timer = setTimeout(run, delayMs);
    return () => clearTimeout(timer);
  },
};
