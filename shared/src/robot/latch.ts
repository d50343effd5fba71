// The latch of a robot, as a snapshot has it: set by STOP and by a lost link, changed as its stop leaves, released by Resume. Sends nothing:
// what a stop is made of is halt.ts on a cable of this computer, and the gateway's affair over a gateway.

import type { Clock } from '../clock.ts';
import type { Unheld } from '../motion/haltPlan.ts';
import { LinkError } from './linkError.ts';
import { requireReady } from './rules.ts';
import type { Latch } from './state.ts';
import type { SessionStore } from './store.ts';

export interface MotionLatchOptions {
  readonly clock: Clock;
  readonly store: SessionStore;
  /** Ends what waits or runs here. */
  drop(): void;
  /** The motion that continues in spite of a STOP pressed then, whose last packet left just now. */
  unheldSince(pressedMs: number): Unheld | null;
}

export interface MotionLatch {
  /** When the latest stop was requested: the remaining motion is counted from then, also where the stop is sent once more. */
  readonly pressedMs: number;
  /** Resolves when the latest stop has left or failed. */
  readonly settled: Promise<void>;
  set(next: Latch): void;
  clear(): void;
  /** `confirmed` stays, whatever is said later. */
  change(change: Partial<Pick<Latch, 'stop' | 'unheld'>>): void;
  press(): void;
  /** Notes how that stop ends; `undefined` where the remaining motion is not known with it. Rejects as it does. */
  follow(stopping: Promise<Unheld | null | undefined>): Promise<void>;
  /** Behind the stop under way, whose last hold would take back what is moved meanwhile. Rejects where another stop came. */
  release(elsewhere?: () => Promise<unknown>): Promise<void>;
}

export function createMotionLatch({ clock, store, drop, unheldSince }: MotionLatchOptions): MotionLatch {
  let pressedMs = 0;
  let settled: Promise<void> = Promise.resolve();
  /** Counted, so that a release does not undo a latch that came after it. */
  let latches = 0;

  const clear = (): void => store.update({ latch: null });

  function change(change: Partial<Pick<Latch, 'stop' | 'unheld'>>): void {
    const { latch } = store.state;
    if (latch === null) return;
    const isConfirmed = latch.stop === 'confirmed';
    if (isConfirmed && change.unheld === undefined) return;
    store.update({ latch: { ...latch, ...change, ...(isConfirmed && { stop: latch.stop }) } });
  }

  return {
    get pressedMs() {
      return pressedMs;
    },
    get settled() {
      return settled;
    },
    set(next) {
      latches += 1;
      store.update({ latch: next });
      drop();
    },
    clear,
    change,
    press: () => void (pressedMs = clock.now()),
    async follow(stopping) {
      settled = stopping.then(
        () => undefined,
        () => undefined,
      );
      try {
        const unheld = await stopping;
        change({ stop: 'sent', ...(unheld !== undefined && { unheld }) });
      } catch (error) {
        // What was planned to hold the robot did not leave.
        change({ stop: 'failed', unheld: unheldSince(pressedMs) });
        throw error;
      }
    },
    async release(elsewhere) {
      requireReady(store.state);
      const released = latches;
      await settled;
      if (released === latches) await elsewhere?.();
      if (released !== latches) throw new LinkError('latched', 'stopped again');
      clear();
    },
  };
}
