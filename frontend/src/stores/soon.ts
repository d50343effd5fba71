// Work that may wait a moment: asked for many times it is done once, and nobody's edit pays for it. Knows no work.

import type { Clock } from '#shared/clock.ts';

export interface Soon {
  /** It is done `afterMs` from the first time of asking. */
  ask(): void;
  isDue(): boolean;
  /** At once, if it was asked for: the page may be gone next. */
  flush(): void;
}

export function createSoon(clock: Clock, afterMs: number, work: () => void): Soon {
  let cancelTimer: (() => void) | null = null;

  function flush(): void {
    if (cancelTimer === null) return;
    cancelTimer();
    cancelTimer = null;
    work();
  }

  return {
    ask: () => (cancelTimer ??= clock.after(afterMs, flush)),
    isDue: () => cancelTimer !== null,
    flush,
  };
}
