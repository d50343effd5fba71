// What each servo was just asked for, until the session says that it was sent: a value does not jump back while its packet waits
// for the wire. Knows no session.

import type { Clock } from '#shared/clock.ts';
import type { ServoTarget } from '#shared/codec/commands.ts';

// Whether anything is on its way, said so that it can be read: looked at a few times a second, and for a moment
// after the last move, so that a stream of drags is one motion.

interface MovingWatch {
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

/** A servo's target, where the session says that it was `sent` there. One that `isQueued` for its turn waits longer. */
export type Targets = (servo: number, sent: number | null, isQueued: boolean) => number | null;

interface TargetBook {
  wish(targets: readonly ServoTarget[]): void;
  clear(): void;
  /** How many servos were asked for something that has not left yet, as far as they were looked at since. */
  waiting(): number;
  /** Of all servos at one moment. */
  targets(): Targets;
}

/** Longer than any packet waits for the wire once its turn has come; a wish that has not left by then was dropped. */
const WISH_LASTS_MS = 1000;

interface Wish {
  readonly position: number;
  untilMs: number;
}

export function createTargetBook(clock: Clock): TargetBook {
  const wishes = new Map<number, Wish>();

  function isOpen(wish: Wish, sent: number | null, isQueued: boolean, nowMs: number): boolean {
    if (wish.position === sent) return false;
    if (isQueued) wish.untilMs = nowMs + WISH_LASTS_MS;
    return nowMs < wish.untilMs;
  }

  return {
    wish(targets) {
      const untilMs = clock.now() + WISH_LASTS_MS;
      for (const { servo, position } of targets) wishes.set(servo, { position, untilMs });
    },
    clear: () => wishes.clear(),
    waiting: () => wishes.size,
    targets() {
      const nowMs = clock.now();
      return (servo, sent, isQueued) => {
        const wish = wishes.get(servo);
        if (wish !== undefined && isOpen(wish, sent, isQueued, nowMs)) return wish.position;
        wishes.delete(servo);
        return sent;
      };
    },
  };
}
