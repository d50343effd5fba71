// Which servos may leave in the next move. Those of unknown position start one after another, each in a packet of
// its own, so that a person can see and stop what is about to happen. Knows the clock and who is unknown; no packet.

import type { Clock } from '../clock.ts';
import { FIRST_MOVE_STAGGER_MS } from './timings.ts';

export interface FirstMoveOptions {
  readonly clock: Clock;
  isUnknown(servo: number): boolean;
  /** Another one may start now. */
  due(): void;
  /** These are left, in the order they start in. */
  waiting(servos: readonly number[]): void;
}

export interface FirstMoves {
  /** Of the servos that wait for the wire, those of the next move. Empty: none may start yet. */
  next(servos: readonly number[]): readonly number[];
  /** Until the last of them has started, if no others are asked for. */
  startsWithinMs(servos: readonly number[]): number;
}

export function createFirstMoves({ clock, isUnknown, due, waiting }: FirstMoveOptions): FirstMoves {
  let nextStartMs = -Infinity;
  let cancelTimer = (): void => undefined;

  const untilNextMs = (): number => Math.max(0, nextStartMs - clock.now());

  function start(first: number): readonly number[] {
    nextStartMs = clock.now() + FIRST_MOVE_STAGGER_MS;
    return [first];
  }

  return {
    next(servos) {
      const unknown = servos.filter(isUnknown);
      const [first] = unknown;
      const mayStart = first !== undefined && untilNextMs() === 0;
      const chosen = mayStart ? start(first) : servos.filter((servo) => !unknown.includes(servo));
      const left = unknown.filter((servo) => !chosen.includes(servo));
      cancelTimer();
      if (left.length > 0) cancelTimer = clock.after(untilNextMs(), due);
      waiting(left);
      return chosen;
    },
    startsWithinMs(servos) {
      const count = servos.filter(isUnknown).length;
      return count === 0 ? 0 : untilNextMs() + (count - 1) * FIRST_MOVE_STAGGER_MS;
    },
  };
}
