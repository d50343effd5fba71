// Has a stop said once more that the board may not have heard: while it works on its flash or talks to its servos it keeps one
// packet and drops the others (S9, S41, S53). Knows time; until when the board may be deaf and how it is stopped is told.

import type { Clock } from '../clock.ts';

export interface StopAgain {
  /** A stop has left. */
  stopped(): void;
  /** The board has said something: it may hear from now on. */
  heard(): void;
  /** The line is down, or the board is another one. */
  void(): void;
}

export function createStopAgain(clock: Clock, deafUntilMs: () => number, stop: () => void): StopAgain {
  let cancelTimer: (() => void) | null = null;

  function clear(): void {
    cancelTimer?.();
    cancelTimer = null;
  }

  function plan(): void {
    clear();
    cancelTimer = clock.after(Math.max(0, deafUntilMs() - clock.now()), () => {
      cancelTimer = null;
      stop();
    });
  }

  return {
    stopped() {
      if (clock.now() < deafUntilMs()) plan();
      else clear();
    },
    heard() {
      if (cancelTimer !== null) plan();
    },
    void: clear,
  };
}
