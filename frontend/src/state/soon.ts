// Work that may wait a moment: asked for many times it is done once, and nobody's edit pays for it. Knows no work.

import type { Clock } from '#shared/clock.ts';

// Where this browser keeps a text from one visit to the next.

/** The part of the browser's Storage that is needed; it may throw, as it does where storage is forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

interface Soon {
  /** It is done `afterMs` from the first time of asking, or later where it takes long. */
  ask(): void;
  /** At once, if it was asked for: the page may be gone next. */
  flush(): void;
}

/** Of the time, for work that is asked for without end: a slow computer has most of it for the rest. */
const SHARE = 0.25;

export function createSoon(clock: Clock, afterMs: number, work: () => void): Soon {
  let cancelTimer: (() => void) | null = null;
  let restsUntilMs = -Infinity;

  function flush(): void {
    if (cancelTimer === null) return;
    cancelTimer();
    cancelTimer = null;
    const beganMs = clock.now();
    work();
    restsUntilMs = beganMs + (clock.now() - beganMs) / SHARE;
  }

  return {
    ask: () => (cancelTimer ??= clock.after(Math.max(afterMs, restsUntilMs - clock.now()), flush)),
    flush,
  };
}
