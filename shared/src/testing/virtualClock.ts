// A clock that moves only by `advance`. Lets tests and simulations play hours in milliseconds, in an exact and repeatable
// order. Knows timers only; calls no platform.

import type { Clock } from '../clock.ts';

export interface VirtualClock extends Clock {
  /** Moves time on, firing each timer at its own instant; promises settle before the next timer and before it resolves. */
  advance(ms: number): Promise<void>;
  /** Fires timers until none is left. Rejects where that would take longer than `limitMs` of virtual time. */
  runUntilIdle(limitMs?: number): Promise<void>;
  /** How many timers wait. */
  pending(): number;
}

interface Timer {
  readonly dueMs: number;
  readonly run: () => void;
}

// A chain of awaits takes a few turns of the microtask queue for each link; session code is about ten links deep.
const SETTLE_TURNS = 40;

/** One for all turns: a test of the session spends much of its time here. */
const TURN = Promise.resolve();

async function settle(): Promise<void> {
  for (let turn = 0; turn < SETTLE_TURNS; turn += 1) await TURN;
}

export function createVirtualClock(startMs = 0): VirtualClock {
  /** In order of time; timers of one instant in the order they were set. */
  const timers: Timer[] = [];
  let nowMs = startMs;

  function after(delayMs: number, run: () => void): () => void {
    const timer: Timer = { dueMs: nowMs + Math.max(0, delayMs), run };
    const later = timers.findIndex((other) => other.dueMs > timer.dueMs);
    timers.splice(later < 0 ? timers.length : later, 0, timer);
    return () => {
      const at = timers.indexOf(timer);
      if (at >= 0) timers.splice(at, 1);
    };
  }

  async function fireUntil(limitMs: number): Promise<void> {
    await settle();
    for (let next = timers[0]; next && next.dueMs <= limitMs; next = timers[0]) {
      timers.shift();
      nowMs = next.dueMs;
      next.run();
      await settle();
    }
  }

  async function advance(ms: number): Promise<void> {
    const untilMs = nowMs + ms;
    await fireUntil(untilMs);
    nowMs = untilMs;
  }

  async function runUntilIdle(limitMs = 600_000): Promise<void> {
    const untilMs = nowMs + limitMs;
    await fireUntil(untilMs);
    if (timers.length > 0) throw new RangeError(`timers still wait after ${limitMs} ms`);
  }

  return { now: () => nowMs, after, advance, runUntilIdle, pending: () => timers.length };
}
