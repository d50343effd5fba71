// Key and pad of the board: a group somebody starts at the board itself (S55, S56, X8), and the pad's receiver, which the main
// loop asks bit by bit every 50 ms and does nothing else meanwhile (S52). Knows presses, not how a group runs.

import { type Work, noWork } from './agenda.ts';

export interface Press {
  readonly slot: number;
  /** How long the button blocks the loop while it is looked at: 60 ms for the key (S55), 5.2 ms for a pad's poll (S52). */
  readonly blockMs: number;
}

export interface Panel {
  readonly press: (press: Press) => void;
  readonly dueMs: () => number;
  /** What one pass of the main loop does for it. */
  readonly step: () => Work;
}

/** `start` runs the group once, as a command would. */
export function createPanel(start: (slot: number) => Work): Panel {
  const pressed: Press[] = [];

  function* step(): Work {
    const press = pressed.shift();
    if (!press) return;
    yield press.blockMs;
    yield* start(press.slot);
  }

  return {
    press: (press) => void pressed.push(press),
    dueMs: () => (pressed.length > 0 ? 0 : Infinity),
    step,
  };
}

// The receiver of a hand-held pad, asked bit by bit every 50 ms: the main loop does nothing else meanwhile, so ticks
// and packets wait (S52).

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
