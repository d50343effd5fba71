// The receiver of a hand-held pad, asked bit by bit every 50 ms: the main loop does nothing else meanwhile, so ticks and packets
// wait (S52). Knows times; no button, that is panel.ts.

import { noWork, type Work } from './work.ts';

export interface PadPoll {
  /** What is left of the poll that an idle loop began by itself before something woke it. */
  readonly begun: () => Work;
  /** What one pass of the main loop does for it. */
  readonly step: () => Work;
}

const EVERY_MS = 50;

export const NO_PAD_POLL: PadPoll = { begun: noWork, step: noWork };

/** Each poll takes `blockMs`. */
export function createPadPoll(now: () => number, blockMs: number): PadPoll {
  let nextMs = now() + EVERY_MS;

  function* begun(): Work {
    const overdue = now() - nextMs - blockMs;
    if (overdue > 0) nextMs += Math.ceil(overdue / (EVERY_MS + blockMs)) * (EVERY_MS + blockMs);
    if (nextMs >= now()) return;
    const endsMs = nextMs + blockMs;
    nextMs = endsMs + EVERY_MS;
    yield endsMs - now();
  }

  function* step(): Work {
    if (now() < nextMs) return;
    yield blockMs;
    nextMs = now() + EVERY_MS;
  }

  return { begun, step };
}
