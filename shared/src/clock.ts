// Time as the shared code sees it. Nothing in shared/ may ask the platform for the time or set a timer: a Clock comes in
// from outside, so that every wait can be tested in virtual time.

export interface Clock {
  /** Milliseconds since an arbitrary start; never runs backwards. */
  now(): number;
  /** Calls `run` once after `delayMs` (≥ 0). Returns a function that cancels it; cancelling twice is harmless. */
  after(delayMs: number, run: () => void): () => void;
}

/** Resolves after `delayMs` on that clock. */
export function sleep(clock: Clock, delayMs: number): Promise<void> {
  return new Promise((resolve) => clock.after(delayMs, resolve));
}
