// Whether anything is on its way, told so that it can be read: looked at a few times a second, and kept for a moment after the
// last move, so that a stream of drags is one motion. Knows no session.

import type { Clock } from '#shared/clock.ts';

export interface MovingWatch {
  isMoving(): boolean;
}

const LOOK_EACH_MS = 100;
/** Longer than a hand rests between two drags. */
const LINGER_MS = 600;

export function createMovingWatch(clock: Clock, isUnderWay: () => boolean): MovingWatch {
  let lookedMs = -Infinity;
  let movedMs = -Infinity;
  return {
    isMoving() {
      const nowMs = clock.now();
      if (nowMs - lookedMs >= LOOK_EACH_MS) {
        lookedMs = nowMs;
        if (isUnderWay()) movedMs = nowMs;
      }
      return nowMs - movedMs < LINGER_MS;
    },
  };
}
