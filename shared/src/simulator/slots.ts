// The main loop's time slots of 10 ms: one is taken per pass, every second one is a servo tick (S28). After a blocking job
// the missed ones are caught up back to back (S29). Counts slots; knows no clock and no servo.

import { TICK_MS } from './servos.ts';

export interface Slots {
  /** Takes one slot if it is due; true where that slot is a servo tick. */
  take(nowMs: number): boolean;
  /** What an idle loop has done by now: all slots that change nothing. */
  skipIdle(nowMs: number, moving: boolean): void;
  /** When the next servo tick is due. */
  nextTickMs(): number;
  taken(): number;
}

const SLOT_MS = 10;
const SLOTS_PER_TICK = TICK_MS / SLOT_MS;

export function createSlots(): Slots {
  let taken = 0;

  function nextTick(): number {
    return taken + SLOTS_PER_TICK - (taken % SLOTS_PER_TICK);
  }

  return {
    take(nowMs) {
      if (nowMs < (taken + 1) * SLOT_MS) return false;
      taken += 1;
      return taken % SLOTS_PER_TICK === 0;
    },
    skipIdle(nowMs, moving) {
      const passed = Math.floor(nowMs / SLOT_MS);
      taken = Math.max(taken, moving ? Math.min(passed, nextTick() - 1) : passed);
    },
    nextTickMs: () => nextTick() * SLOT_MS,
    taken: () => taken,
  };
}
