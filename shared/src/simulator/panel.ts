// Key and pad of the board: a group somebody starts at the board itself (S55, S56, X8). Knows presses, not how a group runs.

import type { Work } from './work.ts';

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
