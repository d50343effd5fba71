// Asks an idle board whether it is still there, by the cheapest harmless question that such a board always answers. Knows when
// it may ask and how much silence means that the board is gone; not what follows from that.

import type { Clock } from '../clock.ts';
import type { Question } from '../codec/families.ts';
import { HEARTBEAT_MISSES, HEARTBEAT_MS, STALE_HEARTBEAT_MS } from './timings.ts';

export interface HeartbeatOptions {
  readonly clock: Clock;
  /** The question, or null while it may not be asked: nobody looks, something runs, no such board answers anything. */
  question(): Question | null;
  /** Sends it and waits; false when no answer came, null when nobody can tell. */
  ask(question: Question): Promise<boolean | null>;
  gone(): void;
}

export interface Heartbeat {
  /** `isGone`: it has been silent already, so it is asked more often. */
  start(isGone: boolean): void;
  stop(): void;
  /** The board said something: no need to ask for a while. */
  heard(): void;
}

export function createHeartbeat({ clock, question, ask, gone }: HeartbeatOptions): Heartbeat {
  let runs = false;
  let misses = 0;
  let cancelTimer = (): void => undefined;
  /** Counts lives, so that an answer to an old one's question is no answer now. */
  let life = 0;

  function wait(): void {
    cancelTimer();
    cancelTimer = clock.after(misses === 0 ? HEARTBEAT_MS : STALE_HEARTBEAT_MS, () => void beat(life));
  }

  async function beat(mine: number): Promise<void> {
    const asked = question();
    const answered = asked && (await ask(asked));
    if (mine !== life) return;
    if (answered === false) misses += 1;
    if (answered === false && misses === HEARTBEAT_MISSES) gone();
    wait();
  }

  return {
    start(isGone) {
      life += 1;
      runs = true;
      misses = isGone ? HEARTBEAT_MISSES : 0;
      wait();
    },
    stop() {
      life += 1;
      runs = false;
      cancelTimer();
    },
    heard() {
      misses = 0;
      if (runs) wait();
    },
  };
}
