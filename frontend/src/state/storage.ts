// The browser's text storage, how a choice is remembered in it, and writes that wait a moment so that many edits make one write. Knows no
// document.

import type { Clock } from '#shared/clock.ts';

/** The part of the browser's Storage in use. Both members may throw: storage can be forbidden or full. */
export interface TextStorage {
  getItem(key: string): string | null;
  setItem(key: string, text: string): void;
}

/** In some browsers reading `window.localStorage` throws; here that happens at each access, as in any other storage that is forbidden. */
export function storageOf(found: () => Storage): TextStorage {
  return {
    getItem: (key) => found().getItem(key),
    setItem: (key, text) => found().setItem(key, text),
  };
}

/** null where nothing is stored or storage is forbidden. */
export function readText(storage: TextStorage, key: string): string | null {
  try {
    return storage.getItem(key);
  } catch {
    return null;
  }
}

/** For choices: where storage is forbidden or full, they last as long as the page. */
export function saveText(storage: TextStorage, key: string, text: string): void {
  try {
    storage.setItem(key, text);
  } catch {
    // The caller still has it.
  }
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
