// For what comes in real time, after promises of libraries: a check that is made again until it holds.

import { vi } from 'vitest';

/** Ends what hangs: tests may get only the processor time that others leave. */
const WITHIN_MS = 30_000;

export function eventually<T>(check: () => T | Promise<T>): Promise<T> {
  return vi.waitFor(check, { timeout: WITHIN_MS });
}
