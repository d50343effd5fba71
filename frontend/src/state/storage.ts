// The browser's text storage, and writes that wait a moment so that many edits make one write. Knows no document.

import type { Clock } from '#shared/clock.ts';

/** The part of the browser's Storage in use. Both members may throw: storage can be forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

interface Throttle {
  /** Runs the work `afterMs` after the first request, or later if the work takes long. */
  request(): void;
  /** Runs requested work now: the page may be about to close. */
  flush(): void;
}

/** The largest share of time for the work, so that a slow computer stays responsive. */
const SHARE = 0.25;

export function createThrottle(clock: Clock, afterMs: number, work: () => void): Throttle {
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
    request: () => (cancelTimer ??= clock.after(Math.max(afterMs, restsUntilMs - clock.now()), flush)),
    flush,
  };
}
